"""Outlines drawn on images as 3D features (Z 4.2)."""
