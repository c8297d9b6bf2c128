"""Coordinates, rasters and heights taken into another reference system."""
