"""Reports and charts of the GNSS algorithms."""
