"""Images that may show a thing: where it lies in them, and what stands before it."""
