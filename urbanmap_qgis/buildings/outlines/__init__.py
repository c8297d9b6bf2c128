"""Official outlines: made usable, moved to their points, courtyards cut out (J 5.3.1)."""
