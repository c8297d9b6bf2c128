"""Roof polygons: the paper's method, and outlines divided among their roofs (J 5.3.3)."""
