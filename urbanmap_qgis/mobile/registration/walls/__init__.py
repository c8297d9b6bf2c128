"""Walls as a second witness: facades that the survey saw, straight as they are, and outlines that they belong to."""
