"""Runs over areas of any size, tile by tile."""
