"""Made-up streets from above with known paint, of many kinds: what the model of road markings learns from."""
