"""Faults of lane maps."""
