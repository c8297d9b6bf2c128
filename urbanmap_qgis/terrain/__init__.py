"""The ground and the surface above it, from laser points."""
