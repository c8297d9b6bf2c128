"""Signs by which a result is judged without any truth."""
