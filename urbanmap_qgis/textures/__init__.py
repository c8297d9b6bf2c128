"""Facades of building models textured from line images and frames (Z 4.2)."""
