"""Facade textures from line images and frames (Z 4.2)."""
