"""Heights of a raster at points."""

from __future__ import annotations

import numpy as np

from .grid import Grid


def sample(grid: Grid, raster: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Bilinear heights at points, (n,) in the raster's dtype.

    Parameters
    ----------
    grid : place of the raster. raster : (rows, columns), NaN where it is empty. x, y : (n,) in its CRS.

    Returns
    -------
    Interpolated between the four nearest cell centres. Empty cells among the four are left out; NaN where all
    four are empty or the point lies outside the raster. Within half a cell of the border the border holds.
    """
    column = (np.asarray(x, dtype=np.float64) - grid.x_min) / grid.cell
    row = (grid.y_max - np.asarray(y, dtype=np.float64)) / grid.cell
    with np.errstate(invalid="ignore"):
        outside = ~((column >= 0) & (column <= grid.columns) & (row >= 0) & (row <= grid.rows))
    some_outside = bool(outside.any())
    if some_outside:
        column, row = np.where(outside, 0.0, column), np.where(outside, 0.0, row)
    left, right, u = _neighbours(column - 0.5, grid.columns, raster.dtype)
    top, bottom, v = _neighbours(row - 0.5, grid.rows, raster.dtype)
    flat = np.ascontiguousarray(raster).ravel()
    top, bottom = top * grid.columns, bottom * grid.columns
    upper_left, upper_right = flat[top + left], flat[top + right]
    lower_left, lower_right = flat[bottom + left], flat[bottom + right]
    upper = upper_left + u * (upper_right - upper_left)
    lower = lower_left + u * (lower_right - lower_left)
    height = upper + v * (lower - upper)
    gap = np.flatnonzero(np.isnan(height))
    if len(gap):
        corners = np.stack((upper_left[gap], upper_right[gap], lower_left[gap], lower_right[gap]))
        a, b = u[gap], v[gap]
        weights = np.stack(((1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b))
        height[gap] = _mean_of_filled(corners, weights)
    if some_outside:
        height[outside] = np.nan
    return height


def _neighbours(position: np.ndarray, size: int, dtype: np.dtype) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cell centres before and after a position, and the share of the second."""
    position = np.clip(position, 0, size - 1)
    before = position.astype(np.int64)
    return before, np.minimum(before + 1, size - 1), (position - before).astype(dtype)


def _mean_of_filled(corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Weighted means over the first axis of the corners that are not NaN; NaN where there is none."""
    filled = ~np.isnan(corners)
    weights = np.where(filled, weights, 0)
    total = weights.sum(axis=0)
    value = (np.where(filled, corners, 0) * weights).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(total > 0, value / total, np.nan)
