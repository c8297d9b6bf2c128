"""GNSS: reflections at walls, adjusted walls, visible satellites."""
