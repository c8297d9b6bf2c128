"""File formats: point clouds, rasters, building outlines, city models and reports."""
