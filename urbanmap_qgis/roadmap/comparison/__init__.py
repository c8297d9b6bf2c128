"""Lane maps of one place compared: what moved, was added, removed or painted anew."""
