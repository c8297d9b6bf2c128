"""Jobs: chains that are kept in a file, filled into algorithms and run step by step."""
