"""Judges: each compares what a part of the program makes with the truth; `scripts/judge.py` runs them."""
