"""The styles of layers by subject, written by make_styles.py."""
