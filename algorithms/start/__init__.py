"""To begin without data of one's own."""
