"""Settings that users give, by room: what is said of each stands with its field alone."""
