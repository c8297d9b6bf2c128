"""Points and edges of models over images (Z 4.1)."""
