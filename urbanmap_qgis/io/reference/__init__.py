"""Coordinate reference systems as text, their horizontal and vertical parts, plane rectangular zones."""
