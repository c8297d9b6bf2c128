"""Rings of polygons, sooner than by shapely where there are no holes, as mostly."""

from __future__ import annotations

import numpy as np
import shapely


def polygon_rings(polygons: np.ndarray | shapely.Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Rings (r,) of polygons (n,), or of one shape, and the number of the polygon of each.

    What `shapely.get_rings` gives, which takes several times as long for the few polygons of a building.
    """
    polygons = np.atleast_1d(np.asarray(polygons, object))
    outer = shapely.get_exterior_ring(polygons)  # none of what is no polygon
    if shapely.get_num_interior_rings(polygons).any() or not shapely.get_num_coordinates(outer).all():
        return shapely.get_rings(polygons, return_index=True)
    return outer, np.arange(len(polygons))
