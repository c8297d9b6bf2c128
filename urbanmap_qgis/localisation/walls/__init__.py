"""Walls of the map as a scanner on the road meets them."""
