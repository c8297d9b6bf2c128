"""What an orthophoto shows of a road beside its lines: its edges, and lines that are nearly worn away."""
