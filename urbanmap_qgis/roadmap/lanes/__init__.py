"""Lanes from lines and drives: sections, strips, assembly, junctions."""
