"""The photo flight: camera, exposures, rendered frames, orthophoto, masks."""
