"""What walls, markings and satellites tell of a place."""
