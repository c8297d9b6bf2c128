"""Made fronts of buildings with what stands before them, scanned from the street, with their truth."""
