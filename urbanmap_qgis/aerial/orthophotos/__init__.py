"""Orthophotos of the ground from several frames, vehicles left out (J 3.2.1)."""
