"""The roof planes of one building from its points."""

from __future__ import annotations

import math

import numpy as np

from ...settings.buildings import PlaneParameters
from .plane_moments import moments, solve
from .region_growing import grow_planes, surroundings

FEWEST = 4  # Points of the smallest plane, however thin the cloud.
# Points/m2 below which the tolerance grows with the distance between points, and how far it grows.
DENSE = 8.0
THIN_FACTOR = 2.0


def detect_planes(points: np.ndarray, density: float, parameters: PlaneParameters) -> np.ndarray:
    """Number (n,) of the roof plane of each point (n, 3), 0 based, -1 for clutter, trees and walls.

    Parameters
    ----------
    points : those that stand above the ground, m, on a local origin.
    density : points/m2 on roofs.
    """
    if len(points) < FEWEST:
        return np.full(len(points), -1)
    around = surroundings(points, density)
    fewest = max(FEWEST, round(parameters.least_area * density))
    tolerance = parameters.tolerance * min(max(math.sqrt(DENSE / density), 1.0), THIN_FACTOR)
    return grow_planes(points, around, tolerance, fewest)


def fitted_planes(points: np.ndarray, label: np.ndarray) -> np.ndarray:
    """Planes (k, 3) as a, b, c of z = a x + b y + c, one for each label."""
    return solve(moments(points, label, int(label.max(initial=-1)) + 1))[0]
