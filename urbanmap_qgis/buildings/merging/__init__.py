"""Building models from above joined with walls measured from the street (J 5.7)."""
