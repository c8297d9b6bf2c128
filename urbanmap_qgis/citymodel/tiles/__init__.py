"""3D Tiles of a city model."""
