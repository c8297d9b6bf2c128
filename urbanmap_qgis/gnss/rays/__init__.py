"""Signal paths among building walls: line of sight, blocked, reflected (J 5.6)."""
