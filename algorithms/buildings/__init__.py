"""Building models from laser points and outlines."""
