"""Looks of surfaces as glTF, and models as one binary file."""
