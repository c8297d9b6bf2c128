"""Beams and where they end; airborne laser scanning."""
