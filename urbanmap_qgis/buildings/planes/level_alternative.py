"""Level roofs in place of planes, for buildings that planes do not fit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..roofs.roof_segmentation import segment_roofs

SUSPECT = 0.6
"""A building whose plane model misses its points by more than this (root mean square of the best 95 %, m) is looked
at again."""

BETTER = 0.9
"""Level roofs are taken where their misfit is below this share of the planes'."""

BEST_SHARE = 0.95
_BELOW = 0.5
_MISSED = 3.0


def roof_misfit(polygons: Sequence[shapely.Polygon], points: np.ndarray) -> float:
    """Root mean square height difference of the best 95 % of points (n, 3) to the polygons with z over or under them,
    m; a difference counts as 3 m at most."""
    flat = shapely.force_2d(np.array(polygons, dtype=object))
    place, row = shapely.STRtree(flat).query(shapely.points(points[:, :2]), predicate="intersects")
    if not len(place):
        return 0.0
    off = np.full(len(points), np.inf)
    for number, polygon in enumerate(polygons):
        own = place[row == number]
        corners = shapely.get_coordinates(polygon, include_z=True)
        middle = corners.mean(axis=0)
        slope = np.linalg.lstsq((corners - middle)[:, :2], corners[:, 2] - middle[2], rcond=None)[0]
        off[own] = np.abs(points[own, 2] - middle[2] - (points[own, :2] - middle[:2]) @ slope)
    off = np.sort(np.minimum(off[np.isfinite(off)], _MISSED))
    best = off[:max(int(np.ceil(BEST_SHARE * len(off))), 1)]
    return float(np.sqrt(np.mean(best**2)))


def high_points(points: np.ndarray, roof: np.ndarray) -> np.ndarray:
    """Points (m, 3) that are not below all roofs: those of roofs (not 0) and what stands on and between them."""
    return points[points[:, 2] >= points[roof > 0, 2].min() - _BELOW]


def level_roof_numbers(outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray) -> np.ndarray:
    """Level roofs (n,) of points (n, 3), numbered after the planes in `roof` (n,); 0 where a point has none."""
    inside = max(np.count_nonzero(roof) / outline.area, 0.1)
    ground = float(points[roof > 0, 2].min()) - _BELOW - 2.0
    found = segment_roofs(*points.T, outline, ground, inside).roof_of_point.astype(np.int64)
    return np.where(found > 0, found + int(roof.max()), 0)
