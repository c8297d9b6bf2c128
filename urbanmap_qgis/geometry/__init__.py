"""Shapes that every stage shares: grids and their heights, solids, triangles."""
