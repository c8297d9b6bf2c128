"""Acceptance of a product: errors at check points against the limits of its map level."""
