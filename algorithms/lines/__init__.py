"""Line scanners and line cameras: scans, rectified trajectories, facade textures, objects."""
