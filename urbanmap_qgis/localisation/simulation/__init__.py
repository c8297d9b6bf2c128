"""Scans simulated and matched, to check the prediction."""
