"""Facades measured from the street: walls from a mobile survey (J 5.7)."""
