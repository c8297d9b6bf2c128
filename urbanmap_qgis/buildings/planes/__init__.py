"""Sloped roofs (LoD2.2): planes grown on the points, a plan divided among them by a graph cut."""
