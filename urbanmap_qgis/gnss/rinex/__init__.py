"""Files of observations and broadcast orbits (RINEX), and the times in them."""
