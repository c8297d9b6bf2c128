"""Radius outlier removal: keep the points that have company (J 5.3.3, step 1)."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InputError
from ...wording import say

EXPECTED_NEIGHBOURS = 16
"""Neighbours that the default radius holds on average inside a roof."""
MIN_NEIGHBOURS = 3
"""Default least number: below a quarter of the expected ones, so that corners of roofs stay."""


def default_radius(density: float) -> float:
    """Radius in metres in which `EXPECTED_NEIGHBOURS` points lie, `density` in points per m2."""
    if not density > 0:
        raise InputError(say("The point density must be above zero points per square metre."))
    return math.sqrt(EXPECTED_NEIGHBOURS / (math.pi * density))


def remove_radius_outliers(xy: np.ndarray, radius: float, min_neighbours: int = MIN_NEIGHBOURS) -> np.ndarray:
    """Mask (n,) of the points with at least `min_neighbours` others within `radius` metres.

    Parameters
    ----------
    xy : (n, 2) or (n, 3) coordinates in metres; with three columns the neighbourhood is a ball.
    radius : metres; `default_radius(density)` fits the point density, as J 5.3.3 asks.
    min_neighbours : the point itself does not count.
    """
    xy = np.asarray(xy, float)
    if not radius > 0:
        raise InputError(say("The outlier radius must be above zero metres."))
    if len(xy) == 0:
        return np.zeros(0, bool)
    count = cKDTree(xy).query_ball_point(xy, radius, return_length=True)
    return count - 1 >= min_neighbours
