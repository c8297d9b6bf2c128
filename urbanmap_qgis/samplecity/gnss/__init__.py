"""GNSS receivers in the city: orbits, signal paths, observations, delivered models."""
