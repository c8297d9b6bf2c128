"""Points that cannot belong to a surface: absurd heights, and points isolated in the air or below it."""

from __future__ import annotations

import numpy as np

LOWEST_HEIGHT = -500.0
HIGHEST_HEIGHT = 9000.0
VOXEL = 4.0
MIN_NEIGHBOURS = 5
_FEWEST = 100


def plausible(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Which points have finite coordinates and a height that exists on Earth (metres), (n,) bool."""
    with np.errstate(invalid="ignore"):
        return (np.isfinite(x) & np.isfinite(y) & (z >= LOWEST_HEIGHT) & (z <= HIGHEST_HEIGHT))


def isolation_limit(count: int, area: float) -> int:
    """Limit of `isolated` for `count` points on `area` m2: at most a quarter of what flat ground would have.

    0, which finds none, for clouds of fewer than 100 points: they are too few to tell.
    """
    if count < _FEWEST:
        return 0
    return int(min(MIN_NEIGHBOURS, 0.25 * count / area * (3 * VOXEL) ** 2))


def isolated(x: np.ndarray, y: np.ndarray, z: np.ndarray, neighbours: int = MIN_NEIGHBOURS) -> np.ndarray:
    """Points with at most `neighbours` points, themselves included, in the 3 x 3 x 3 voxels round them, (n,) bool.

    Voxels lie on multiples of `VOXEL` metres, so that the answer for a point depends only on the points within
    two voxels of it, not on the tile. `isolation_limit` gives a limit that suits sparse clouds.
    """
    if not len(z):
        return np.zeros(0, dtype=bool)
    column, columns = _steps(x)
    row, rows = _steps(y)
    level, levels = _levels(z)
    index = level * rows
    index += row
    index *= columns
    index += column
    count = np.bincount(index, minlength=levels * rows * columns).astype(np.int32)
    around = count.reshape(levels, rows, columns)
    for axis in range(3):
        around = _sum_of_three(around, axis)
    return (around.ravel() <= neighbours)[index]


def _steps(coordinate: np.ndarray) -> tuple[np.ndarray, int]:
    """Voxel number along one axis, from 1, and how many there are with an empty one at both ends."""
    lowest = np.floor(coordinate.min() / VOXEL)
    place = coordinate / VOXEL
    np.floor(place, out=place)
    place -= lowest - 1
    step = place.astype(np.int32)
    return step, int(step.max()) + 2


def _levels(z: np.ndarray) -> tuple[np.ndarray, int]:
    """Like `_steps` in height, with runs of empty levels shrunk to one: one point at 5 km costs no memory."""
    step, count = _steps(z)
    used = np.bincount(step, minlength=count) > 0
    needed = used.copy()
    needed[:-1] |= used[1:]
    if needed[:-1].all():
        return step.astype(np.int64), count - 1
    return (np.cumsum(needed) - 1)[step], int(needed.sum())


def _sum_of_three(counts: np.ndarray, axis: int) -> np.ndarray:
    """Each element plus its two neighbours along an axis."""
    moved = np.moveaxis(counts, axis, 0)
    total = moved.copy()
    total[1:] += moved[:-1]
    total[:-1] += moved[1:]
    return np.moveaxis(total, 0, axis)
