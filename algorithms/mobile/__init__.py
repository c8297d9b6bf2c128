"""Mobile mapping surveys: ground, markings, registration, control."""
