"""Kerbs, borders, rails and walls at the road from the mobile survey (J 6.2)."""
