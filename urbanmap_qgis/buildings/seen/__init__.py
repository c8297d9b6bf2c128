"""What of the buildings the cloud has seen: density about them, the cloud's edge, the seen share of each roof."""
