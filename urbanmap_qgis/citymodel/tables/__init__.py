"""A city model as tables of buildings, kept out of memory."""
