"""Windows of marking points matched to normal distributions of the reference."""
