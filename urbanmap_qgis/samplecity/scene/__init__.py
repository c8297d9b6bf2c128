"""The true world: streets, ground, paint, buildings, furniture, trees, vehicles."""
