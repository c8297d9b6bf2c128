"""Line scanners and line cameras of a vehicle, and the rectification of its trajectory by tie points (Z)."""
