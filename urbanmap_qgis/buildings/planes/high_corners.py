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


LIMITS = HighCornerLimits()


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
