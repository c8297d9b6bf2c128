"""The roof planes of one building from its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .plane_merging import merge_planes, nearest_plane_labels
from .plane_moments import moments, solve
from .region_growing import grow_planes, surroundings

PLANES, LEVELS = "planes", "levels"
"""What roofs are: planes, level or sloped (LoD2.2), or level pieces (LoD1.3, as in J 5.3)."""

FEWEST = 6


@dataclass(frozen=True)
class PlaneParameters:
    """How planes are found.

    Attributes
    ----------
    tolerance : farthest distance of a point from its plane, m.
    least_area : area of the smallest plane in plan, m2.
    merge_tolerance : residual that joining two planes may add for each point of the smaller one, m.
    """

    tolerance: float = 0.2
    least_area: float = 1.5
    merge_tolerance: float = 0.1


def detect_planes(points: np.ndarray, density: float, parameters: PlaneParameters) -> np.ndarray:
    """Number (n,) of the roof plane of each point (n, 3), 0 based, -1 for clutter, trees and walls.

    Parameters
    ----------
    points : those that stand above the ground, m, on a local origin. density : points/m2 on roofs.
    """
    if len(points) < FEWEST:
        return np.full(len(points), -1)
    around = surroundings(points, density)
    fewest = max(FEWEST, round(parameters.least_area * density))
    label = grow_planes(points, around, parameters.tolerance, fewest)
    label = merge_planes(points, around.neighbours, label, parameters.merge_tolerance)
    for _ in range(2):
        label = nearest_plane_labels(points, around.neighbours, label, parameters.tolerance)
    return _without_small(label, fewest)


def _without_small(label: np.ndarray, fewest: int) -> np.ndarray:
    """Labels without those of too few points, numbered anew."""
    count = np.bincount(label[label >= 0], minlength=1)
    number = np.cumsum(count >= fewest) - 1
    keep = (label >= 0) & (count >= fewest)[label]
    return np.where(keep, number[label], -1)


def fitted_planes(points: np.ndarray, label: np.ndarray) -> np.ndarray:
    """Planes (k, 3) as a, b, c of z = a x + b y + c, one for each label."""
    return solve(moments(points, label, int(label.max(initial=-1)) + 1))[0]
