"""Files of the Geospatial Information Authority of Japan (GSI): outlines and elevation models."""
