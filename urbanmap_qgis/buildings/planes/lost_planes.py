"""Planes that have points but no place in a divided plan."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import shapely

from ...geometry.grid import Grid

# Points this far (m) from the model are not explained; side of the cells (m) that tell how broad their place is.
LOST_STEP = 0.5
LOST_CELL = 0.5


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
