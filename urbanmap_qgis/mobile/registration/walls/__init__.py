"""Walls as a second witness: facades that the survey saw, and outlines that they belong to."""
