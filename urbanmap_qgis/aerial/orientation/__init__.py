"""Exterior orientation of aerial frames by few control points (J, step 3 of the method)."""
