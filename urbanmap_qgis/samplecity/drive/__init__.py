"""The survey vehicle: its motion, scanners, line camera and navigation error."""
