"""One adjustment for all drives of a survey: they agree with each other, and lie on control and reference."""
