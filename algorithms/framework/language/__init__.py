"""The user's language, and help pages."""
