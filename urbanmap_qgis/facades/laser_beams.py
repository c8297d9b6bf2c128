"""Lines of sight from the scanner to what it measured: what hid a wall, and where beams went through it (J 5.7).

A beam that ends before a wall's plane would have met the wall farther on: there the wall is hidden. A beam that ends
behind the plane went through it: there is glass, an opening, or nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mobile.trajectory import Trajectory, gaps, interpolate
from .plane_fit import WallPlane, component

OFF = 0.3  # What ends less than this (m) before or behind a plane belongs to its wall.
SPREAD = 1.0  # Largest half width (m) of a shadow: farther apart the few beams that are kept tell nothing.


@dataclass(frozen=True, eq=False)
class LaserBeams:
    """Beams from the scanner to places that it measured.

    Attributes
    ----------
    origin : (n, 3) where the scanner was, m, to about the lever arm.
    target : (n, 3) what it measured, m.
    width : side of the cubes, m, of which each target stands for one.
    """

    origin: np.ndarray
    target: np.ndarray
    width: float

    def __len__(self) -> int:
        return len(self.origin)


def laser_beams(target: np.ndarray, time: np.ndarray, trajectory: Trajectory, width: float) -> LaserBeams:
    """Lines of sight to thinned places of a survey; those at whose time no pose is known are left out.

    Parameters
    ----------
    target : (n, 3) places, m, one in each cube of `width` m.
    time : (n,) GPS seconds in the trajectory's time; NaN where there is none.
    trajectory : of the vehicle, in the CRS and heights of the places.
    """
    lost = gaps(trajectory)
    known = np.isfinite(time) & trajectory.within(np.nan_to_num(time, nan=-np.inf))
    if len(lost):
        before = np.searchsorted(lost[:, 0], time[known]) - 1
        known[known] = (before < 0) | (time[known] >= lost[before, 1])
    return LaserBeams(interpolate(trajectory, time[known]).place, target[known], width)


def crossed_cells(lines: LaserBeams, plane: WallPlane, corner: tuple[float, float], shape: tuple[int, int],
                  cell: float) -> tuple[np.ndarray, np.ndarray]:
    """Cells of a wall that beams would have met had they not ended before it, and cells that they went through.

    Parameters
    ----------
    corner : left and low end of the cells in the plane's axes, m.
    shape : rows (upwards) and columns.
    cell : side of a cell, m.

    Returns
    -------
    hidden, through : masks of `shape`; a cell may be both, by beams from different places.
    """
    start, end = plane.distance(lines.origin), plane.distance(lines.target)
    faced = start > np.maximum(end, 0.0) + OFF
    masks = []
    for rows in (faced & (end > OFF), faced & (end < -OFF)):
        # Where the beam meets the plane, in lengths of the beam.
        share = start[rows] / (start[rows] - end[rows])
        half = share * lines.width / 2
        place = lines.origin[rows] + share[:, None] * (lines.target[rows] - lines.origin[rows])
        away = place - plane.point
        flat = np.column_stack([component(away, axis) for axis in plane.axes]) - corner
        near = half <= SPREAD
        masks.append(_covered(flat[near], half[near], shape, cell))
    return masks[0], masks[1]


def _covered(flat: np.ndarray, half: np.ndarray, shape: tuple[int, int], cell: float) -> np.ndarray:
    """Mask of the cells of which squares (n,) about places (n, 2), of given half widths (m), hold the middle."""
    first = np.ceil((flat - half[:, None]) / cell - 0.5).astype(np.int64)
    last = np.floor((flat + half[:, None]) / cell - 0.5).astype(np.int64)
    limit = np.array([shape[1], shape[0]])
    meets = ((last >= 0) & (first < limit) & (last >= first)).all(axis=1)
    left, low = np.clip(first[meets], 0, limit - 1).T
    right, high = np.clip(last[meets], 0, limit - 1).T + 1
    # Squares are counted by their corners: sums along both axes give how many cover each cell.
    count = np.zeros((shape[0] + 1, shape[1] + 1), np.int64)
    for row, column, sign in ((low, left, 1), (high, right, 1), (low, right, -1), (high, left, -1)):
        np.add.at(count, (row, column), sign)
    return count.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0
