"""GNSS: observations, satellites, reflections at walls (J 5.6)."""
