"""Planes made level where the points agree within their noise."""

from __future__ import annotations

import numpy as np

from .plane_moments import solve

LEVEL_ERROR, LEVEL_SLOPE = 0.04, 0.02
"""A plane is level where that adds no more than this root mean square error (m); so is one of less slope."""


def regular_planes(table: np.ndarray) -> np.ndarray:
    """Planes (k, 3) of the moments (k, 10) of their points, level where the points agree."""
    planes, squares = solve(table)
    n = np.maximum(table[:, 0], 1.0)
    mean = table[:, 3] / n
    added = np.maximum(table[:, 9] / n - mean**2, 0.0) - squares / n
    level = (added < LEVEL_ERROR**2) | (np.hypot(planes[:, 0], planes[:, 1]) < LEVEL_SLOPE)
    return np.where(level[:, None], np.column_stack([np.zeros((len(mean), 2)), mean]), planes)
