"""Corners of a divided plan at which a plane stands higher than any point near it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree


@dataclass(frozen=True)
class HighCornerLimits:
    """Limits of high corners, each with its unit."""

    reach: float = 1.0  # Distance in plan (m) within which the highest point bounds a corner,
    reach_spacings: float = 2.0  # or so many spacings of the points, where that is more.
    clearance: float = 0.4  # Height (m) over that point from which a corner is too high.
    most: float = 3.0  # Height (m) over that from which it costs no more.
    weight: float = 2.0  # Cost (m3) of a metre too high, for a square metre.
    area: tuple[float, float] = 1.0, 2.0  # Smaller and larger faces (m2) count as if they were as large as this.


LIMITS = HighCornerLimits()

_AT_ONCE = 100_000
"""Planes over polygons that are looked at at once."""


def highest_near(xy: np.ndarray, points: np.ndarray, spacing: float) -> np.ndarray:
    """Height (k,) of the highest of the points (n, 3) near each place (k, 2), m; inf where there is none.

    Parameters
    ----------
    spacing : of the points, m.
    """
    reach = max(LIMITS.reach, LIMITS.reach_spacings * spacing)
    near = cKDTree(points[:, :2]).query_ball_point(xy, reach)
    count = np.array([len(rows) for rows in near], np.int64)
    top = np.full(len(xy), np.inf)
    if count.any():
        starts = (np.cumsum(count) - count)[count > 0]
        top[count > 0] = np.maximum.reduceat(points[np.concatenate(near[count > 0]).astype(np.int64), 2], starts)
    return top


def high_corners(polygons: np.ndarray, planes: np.ndarray, points: np.ndarray, spacing: float) -> np.ndarray:
    """Corners (c, 2) of polygons (n,) on their `planes` (n, 3) that stand higher than any of the points (p, 3) near."""
    xy, polygon = shapely.get_coordinates(polygons, return_index=True)
    node, corner = np.unique(xy, axis=0, return_inverse=True)
    height = (xy * planes[polygon, :2]).sum(axis=1) + planes[polygon, 2]
    return xy[height > highest_near(node, points, spacing)[corner.ravel()] + LIMITS.clearance]


def high_corner_costs(polygons: np.ndarray, planes: np.ndarray, near: np.ndarray, points: np.ndarray,
                      spacing: float) -> np.ndarray:
    """Cost (n, k) of each plane over each polygon (n,) for corners higher than any point near them, m3.

    Parameters
    ----------
    planes : (k, 3).
    near : (n, k) planes that are asked for; of others the cost is 0.
    points : (p, 3) of the building, m, and their `spacing`, m.
    """
    xy, polygon = shapely.get_coordinates(polygons, return_index=True)
    node, corner = np.unique(xy, axis=0, return_inverse=True)
    ceiling = highest_near(node, points, spacing)[corner.ravel()]
    costs = np.zeros(near.shape)
    corners = np.bincount(polygon, minlength=len(polygons))
    first = np.cumsum(corners) - corners
    asked = np.flatnonzero(near)
    for part in np.array_split(asked, len(asked) // _AT_ONCE + 1):
        face, plane = np.divmod(part, near.shape[1])
        times = corners[face]
        if not len(part):
            continue
        starts = np.cumsum(times) - times
        at = np.arange(times.sum()) + np.repeat(first[face] - starts, times)
        a, b, c = planes[np.repeat(plane, times)].T
        height = xy[at, 0] * a + xy[at, 1] * b + c
        over = np.clip(height - ceiling[at] - LIMITS.clearance, 0.0, LIMITS.most)
        costs.ravel()[part] = np.maximum.reduceat(over, starts)
    return costs * (LIMITS.weight * np.clip(shapely.area(polygons), *LIMITS.area))[:, None]
