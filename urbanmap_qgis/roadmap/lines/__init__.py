"""Lines from the polygons of markings: strokes, dashes, crosswalks, stop lines, symbols (J 6.2)."""
