"""Walls adjusted by reflected signals (J 5.6)."""
