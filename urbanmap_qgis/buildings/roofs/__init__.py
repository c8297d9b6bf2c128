"""The roofs in the points of one building (J 5.3.2)."""
