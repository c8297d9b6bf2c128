"""Road markings of a mobile survey: ranges, intensity calibration and marking points (J 3.2.3.2 and 3.2.3.3)."""
