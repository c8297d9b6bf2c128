"""Registration of windows of mobile road-marking points to the aerial reference (J 3.2.4 and chapter 4)."""
