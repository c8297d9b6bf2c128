"""The mobile survey: its trajectory and calibration, road markings, registration to the aerial reference."""
