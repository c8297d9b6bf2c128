"""Buildings found in laser points alone, without outlines."""
