"""Closed solids from roof polygons, and their checks (J 5.3.4)."""
