"""Boresight angles and lever arms of scanners from a drive that saw the same surfaces from different sides."""
