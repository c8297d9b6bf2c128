"""Level roofs in place of planes, for buildings that planes do not fit."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import shapely

from ...geometry.grid import Grid
from ..roofs.roof_segmentation import segment_roofs

SUSPECT = 0.25
"""A building whose plane model misses its points by more than this (root mean square of the best 95 %, m) is looked
at again."""

BETTER = 0.96
"""Level roofs are taken where their misfit is below this share of the planes'."""

BEST_SHARE = 0.95
# Points this far (m) from the model are not explained; side of the cells (m) that tell how broad their place
# is.
LOST_STEP = 0.5
LOST_CELL = 0.5
BELOW = 0.5
MISSED = 3.0


def roof_misfit(polygons: Sequence[shapely.Polygon], points: np.ndarray) -> float:
    """Root mean square height difference of the best 95 % of points (n, 3) to the polygons with z over or under them,
    m; a difference counts as 3 m at most."""
    off = heights_over(polygons, points)
    off = np.sort(np.minimum(np.abs(off[np.isfinite(off)]), MISSED))
    best = off[:max(int(np.ceil(BEST_SHARE * len(off))), 1)]
    return float(np.sqrt(np.mean(best**2))) if len(best) else 0.0


def heights_over(polygons: Sequence[shapely.Polygon], points: np.ndarray) -> np.ndarray:
    """Heights (n,) of points (n, 3) above the polygons with z at their places, m; NaN where there is none."""
    flat = shapely.force_2d(np.array(polygons, dtype=object))
    place, row = shapely.STRtree(flat).query(shapely.points(points[:, :2]), predicate="intersects")
    off = np.full(len(points), np.nan)
    for number, polygon in enumerate(polygons):
        members = place[row == number]
        corners = shapely.get_coordinates(polygon, include_z=True)
        middle = corners.mean(axis=0)
        slope = np.linalg.lstsq((corners - middle)[:, :2], corners[:, 2] - middle[2], rcond=None)[0]
        off[members] = points[members, 2] - middle[2] - (points[members, :2] - middle[:2]) @ slope
    return off


def has_lost_plane(polygons: Sequence[shapely.Polygon], plane_of: Sequence[int], points: np.ndarray, roof: np.ndarray,
                   density: float, least_area: float) -> bool:
    """Whether planes without a polygon leave points far from all polygons, on a place of `least_area` m2 or more that
    is no strip (a parapet, an eave).

    Parameters
    ----------
    plane_of : plane of each polygon.
    points, roof : (n, 3) and (n,) plane of each.
    density : points/m2.
    """
    lost = (roof > 0) & ~np.isin(roof, plane_of)
    if not lost.any():
        return False
    off = np.abs(heights_over(polygons, points[lost]))
    return broad_area(points[lost][off > LOST_STEP], density) >= least_area


def broad_area(points: np.ndarray, density: float) -> float:
    """Area (m2) that points (n, 2 or more) cover in plan, narrow strips such as parapets and eaves left out.

    Parameters
    ----------
    density : of the cloud, points/m2.
    """
    if not len(points):
        return 0.0
    cell = max(LOST_CELL, 1.0 / np.sqrt(density))
    grid = Grid.covering(*points[:, :2].min(axis=0), *points[:, :2].max(axis=0), cell)
    row, column, _ = grid.cells(points[:, 0], points[:, 1])
    hit = np.zeros((grid.rows + 2, grid.columns + 2), np.uint8)
    hit[row + 1, column + 1] = 1
    return float(np.count_nonzero(cv2.morphologyEx(hit, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))) * cell**2)


def high_points(points: np.ndarray, roof: np.ndarray) -> np.ndarray:
    """Points (m, 3) that are not below all roofs: those of roofs (not 0) and what stands on and between them."""
    return points[points[:, 2] >= points[roof > 0, 2].min() - BELOW]


def level_roof_numbers(outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray) -> np.ndarray:
    """Level roofs (n,) of points (n, 3), numbered after the planes in `roof` (n,); 0 where a point has none."""
    inside = max(np.count_nonzero(roof) / outline.area, 0.1)
    ground = float(points[roof > 0, 2].min()) - BELOW - 2.0
    found = segment_roofs(*points.T, outline, ground, inside).roof_of_point.astype(np.int64)
    return np.where(found > 0, found + int(roof.max()), 0)
