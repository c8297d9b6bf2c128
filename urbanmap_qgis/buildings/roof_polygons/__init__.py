"""The roof polygons of one building: level roofs, sloped planes, or each roof as the paper draws it."""
