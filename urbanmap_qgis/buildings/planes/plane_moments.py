"""Planes z = a x + b y + c by least squares from moments, so that sets of points are joined without their points."""

from __future__ import annotations

import numpy as np

COLUMNS = 10
"""n, sums of x, y, z, and of the products xx, xy, yy, xz, yz, zz."""

_RIDGE = 1e-9
"""Share of the plan spread added to the normal equations, so that points on one line have a plane: the flattest."""


def moments(points: np.ndarray, label: np.ndarray, count: int) -> np.ndarray:
    """Moments (count, 10) of the points (n, 3) of each label; negative labels are left out."""
    labelled = label >= 0
    x, y, z = points[labelled].T
    label = label[labelled]
    columns = (None, x, y, z, x * x, x * y, y * y, x * z, y * z, z * z)
    return np.column_stack([np.bincount(label, weights, count) for weights in columns]).astype(float)


def moments_of(points: np.ndarray) -> np.ndarray:
    """Moments (10,) of points (n, 3)."""
    x, y, z = points.T
    return np.array([len(x), x.sum(), y.sum(), z.sum(), x @ x, x @ y, y @ y, x @ z, y @ z, z @ z])


def solve(m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Planes (..., 3) as a, b, c and the sums of squared height plane_distances (...) from moments (..., 10)."""
    m = np.asarray(m, float)
    n = np.maximum(m[..., 0], 1.0)
    mx, my, mz = m[..., 1] / n, m[..., 2] / n, m[..., 3] / n
    xx, xy, yy = m[..., 4] / n - mx * mx, m[..., 5] / n - mx * my, m[..., 6] / n - my * my
    xz, yz, zz = m[..., 7] / n - mx * mz, m[..., 8] / n - my * mz, m[..., 9] / n - mz * mz
    ridge = _RIDGE * (xx + yy) + 1e-12
    xx, yy = xx + ridge, yy + ridge
    determinant = xx * yy - xy * xy
    a = (yy * xz - xy * yz) / determinant
    b = (xx * yz - xy * xz) / determinant
    squares = np.maximum(zz - a * xz - b * yz, 0.0) * m[..., 0]
    return np.stack([a, b, mz - a * mx - b * my], axis=-1), squares


def heights(plane: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Heights (n,) of one plane (3,) at places (n, 2)."""
    return xy @ plane[:2] + plane[2]


def plane_distances(plane: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Distances (n,) of points (n, 3) from a plane (3,), at right angles to it, above positive, m."""
    return (points[:, 2] - heights(plane, points[:, :2])) / np.sqrt(1.0 + plane[0] ** 2 + plane[1] ** 2)


def slope_degrees(plane: np.ndarray) -> float:
    """Angle of a plane (3,) to the level, degrees."""
    return float(np.degrees(np.arctan(np.hypot(plane[0], plane[1]))))


def azimuth_degrees(plane: np.ndarray) -> float:
    """Direction that a plane (3,) falls to, degrees clockwise from north; NaN where it is level."""
    if plane[0] == 0 and plane[1] == 0:
        return float("nan")
    return float(np.degrees(np.arctan2(-plane[0], -plane[1])) % 360.0)
