"""An old building model against a new cloud: what changed."""
