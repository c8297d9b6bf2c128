"""Road markings in orthophotos: candidates, confidence, polygons, report (J 3.2.2)."""
