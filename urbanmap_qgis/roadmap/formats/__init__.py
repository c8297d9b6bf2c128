"""A lane map as other programs read it: Lanelet2 and OpenDRIVE, and their projection."""
