"""Where the survey lies within a few metres: reference, patches, correlation."""
