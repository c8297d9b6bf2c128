"""Building models from airborne laser points and rough outlines (J chapter 5)."""
