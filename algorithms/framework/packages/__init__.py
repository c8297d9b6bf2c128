"""The Python packages that algorithms need: found, refused by name, installed."""
