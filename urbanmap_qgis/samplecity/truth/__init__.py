"""What is true, in files, and the official outlines."""
