"""Positions and clocks of satellites, and the earth-fixed frame that they are in."""
