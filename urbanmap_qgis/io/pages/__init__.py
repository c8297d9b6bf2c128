"""Reports: pages that hold everything they show, and their drawings."""
