"""The surface that an outline shows: the nearest one that is connected, and its plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from .outline_points import OutlinePoints

# Points whose distances differ by more than this (m), with none between, lie on different things.
DEPTH_GAP = 0.4
# A surface holds at least this share of the points behind the outline: single outliers are passed over.
MIN_SHARE = 0.1
FLAT = 0.05
WIDE = 0.05

MIN_POINTS = 8
"""Laser points that a surface needs."""


@dataclass(frozen=True, eq=False)
class SurfacePlane:
    """A plane n . (p - middle) = 0 fitted to points.

    Attributes
    ----------
    middle : (3,) m.
    normal : (3,) unit vector towards the camera.
    rmse : of the points used, m.
    sigma : standard deviation of the plane's place at its middle, m.
    points : how many were used.
    fitted : False where the points are too few or too narrow for a plane of their own, and one that faces the camera
        was taken.
    """

    middle: np.ndarray
    normal: np.ndarray
    rmse: float
    sigma: float
    points: int
    fitted: bool


def nearest_surface(points: OutlinePoints) -> OutlinePoints:
    """The points on the nearest thing connected in depth; none where there is no such thing."""
    order = np.argsort(points.distance, kind="stable")
    distance = points.distance[order]
    ends = np.flatnonzero(np.diff(distance) > DEPTH_GAP) + 1
    for group in np.split(order, ends):
        if len(group) >= max(MIN_POINTS, MIN_SHARE * len(points)):
            return points.subset(np.sort(group))
    return points.subset(np.empty(0, int))


def surface_plane(points: OutlinePoints, camera: np.ndarray) -> SurfacePlane:
    """A robust plane through the points (Tukey's weights), its normal towards the camera (3,).

    Points along a line, as on a pole, tell no plane: then it is the upright one that faces the camera.
    """
    place = points.place
    weight = np.ones(len(place))
    for _ in range(20):
        middle = weight @ place / weight.sum()
        off = place - middle
        spread, axes = np.linalg.eigh((weight[:, None] * off).T @ off / weight.sum())
        residual = off @ axes[:, 0]
        scale = max(SIGMA_OF_MAD * np.median(np.abs(residual)), 0.005)
        share = np.clip(residual / (4.0 * scale), -1.0, 1.0)
        weight = np.maximum((1.0 - share**2) ** 2, 1e-12)
    used = np.abs(residual) < 4.0 * scale
    rmse = float(np.sqrt(np.mean(residual[used] ** 2)))
    flat = rmse < FLAT and np.sqrt(max(spread[1], 0.0)) > WIDE and used.sum() >= MIN_POINTS
    normal = axes[:, 0]
    if not flat:
        towards = (camera - middle) * [1.0, 1.0, 0.0]
        normal = towards / max(np.linalg.norm(towards), LEAST_DIVISOR)
        middle = np.median(place, axis=0)
        rmse = float(np.std((place - middle) @ normal))
        used = np.ones(len(place), bool)
    normal = normal if (camera - middle) @ normal > 0 else -normal
    count = int(used.sum())
    # Points of one scan line share its errors; a tenth of them is taken as independent.
    return SurfacePlane(middle, normal, rmse, rmse / np.sqrt(max(count / 10.0, 1.0)), count, bool(flat))


def ray_intersections(plane: SurfacePlane, origin: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Where rays (n, 3) meet a plane; NaN where they run along it or away from it."""
    cosine = direction @ plane.normal
    length = (plane.middle - origin) @ plane.normal / np.where(np.abs(cosine) > 0.05, cosine, np.nan)
    return origin + np.where(length > 0, length, np.nan)[:, None] * direction
