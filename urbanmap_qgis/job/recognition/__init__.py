"""What a file is, told from its content: kind, reference system, heights, time span, extent and count."""
