"""Heights above the ground round each point: the ground is the lower surface of cells, freed of what stands on it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.ndimage import distance_transform_edt, grey_opening

from ...io.points.point_buckets import stable_order
from .edge_records import POINT

CELL = 0.5
"""m."""

# Cells; what is narrower in some direction and rises above the ground stands on it: vehicles, rails, walls.
WIDEST = 7
SHADOW = 17
RISE = 0.6  # m; retaining walls and steps of terraces are wider plateaus, or lower
# m below and above the ground within which points may belong to it or to a kerb.
NEAR_BELOW = 0.3
NEAR_ABOVE = 0.4
# m: side of a cell, and range of the heights in it that only upright things have
FINE = 0.1
UPRIGHT = 0.35
LOW = 0.1  # share of a cell's points that may lie below its ground
GHOSTS = 3  # points below which a cell's lowest ones count for nothing

Heights = Callable[[np.ndarray, np.ndarray], np.ndarray]


def above_ground(points: np.ndarray, ground: Heights | None = None, shaded: bool = False) -> np.ndarray:
    """Heights (n,), m, of points (`POINT`) above the ground; NaN where `ground` knows none.

    `ground` : heights at places x, y; without it the ground is found among the points.
    `shaded` : whether what stands behind parked vehicles counts, where no point lies on the ground: what rises above
    all around it by more than `rise` is none, then, up to `shadow` cells wide.
    """
    if not set(POINT.names) <= set(points.dtype.names or ()):
        raise TypeError(f"points are {points.dtype}, without the fields of POINT")
    if not len(points):
        return np.zeros(0)
    if ground is not None:
        return points["z"] - ground(points["x"], points["y"])
    low, cell = _lowest(points)
    known = np.isfinite(low)
    nearest = distance_transform_edt(~known, return_distances=False, return_indices=True)
    surface = grey_opening(low[tuple(nearest)], WIDEST, mode="nearest")
    if shaded:
        around = grey_opening(surface, SHADOW, mode="nearest")
        surface = np.where(surface - around > RISE, around, surface)
    return points["z"] - _smooth_at(surface, points, cell)


def near_ground(points: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Mask (n,) of points that may lie on the ground or on a kerb, not on what stands there.

    `height` (n,) as of `above_ground`.
    """
    low = (height > -NEAR_BELOW) & (height < NEAR_ABOVE)
    if not low.any():
        return low
    rows = np.flatnonzero((height > -NEAR_BELOW) & (height < 2.0))
    column, row = (np.floor((points[name][rows] - points[name][rows].min()) / FINE).astype(np.int64)
                   for name in "xy")
    flat = column * (int(row.max()) + 1) + row
    order = np.argsort(flat, kind="stable")
    starts = np.flatnonzero(np.diff(flat[order], prepend=-1))
    z = points["z"][rows][order]
    tall = np.maximum.reduceat(z, starts) - np.minimum.reduceat(z, starts) > UPRIGHT
    upright = np.zeros(len(rows), bool)
    upright[order] = np.repeat(tall, np.diff(np.append(starts, len(rows))))
    low[rows[upright]] = False
    return low


def _lowest(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Low height of each cell (rows, columns), NaN without points, and the corner (2,) of the grid."""
    corner = np.floor(np.array([points["x"].min(), points["y"].min()]) / CELL)
    column = (np.floor(points["x"] / CELL) - corner[0]).astype(np.int64)
    row = (np.floor(points["y"] / CELL) - corner[1]).astype(np.int64)
    shape = (int(row.max()) + 1, int(column.max()) + 1)
    flat = row * shape[1] + column
    by_height = np.argsort(points["z"])
    order = by_height[stable_order(flat[by_height])]
    count = np.bincount(flat, minlength=shape[0] * shape[1])
    start = np.concatenate([[0], np.cumsum(count)[:-1]])
    full = np.flatnonzero(count >= GHOSTS)
    rank = np.minimum((LOW * count[full]).astype(np.int64) + 1, count[full] - 1)
    low = np.full(len(count), np.nan)
    low[full] = points["z"][order[start[full] + rank]]
    return low.reshape(shape), corner


def _smooth_at(surface: np.ndarray, points: np.ndarray, corner: np.ndarray) -> np.ndarray:
    """Height (n,) of the surface of cells at the points, bilinear between the middles of the cells."""
    column, row = points["x"] / CELL - corner[0] - 0.5, points["y"] / CELL - corner[1] - 0.5
    column = np.clip(column, 0.0, surface.shape[1] - 1.0)
    row = np.clip(row, 0.0, surface.shape[0] - 1.0)
    i, j = np.minimum(row.astype(int), surface.shape[0] - 2), np.minimum(column.astype(int), surface.shape[1] - 2)
    i, j = np.maximum(i, 0), np.maximum(j, 0)
    next_i, next_j = np.minimum(i + 1, surface.shape[0] - 1), np.minimum(j + 1, surface.shape[1] - 1)
    s, t = row - i, column - j
    return ((1 - s) * ((1 - t) * surface[i, j] + t * surface[i, next_j])
            + s * ((1 - t) * surface[next_i, j] + t * surface[next_i, next_j]))
