"""Aerial frames: camera, poses, and what buildings hide in them (J 3.2.1.1)."""
