"""Ghost points below the ground: multipath clusters 0.2 m to 15 m under a much denser, thin layer.

A mobile scanner sees wet or shiny ground, glass and retroreflectors by detours too; the points then lie in small
clusters below the road. They are too many to be isolated and often too near to the road to be told by height alone,
but the road above them is a thin layer of far more points. A wall is no thin layer, and ground that truly lies lower
continues in the cells around.
"""

from __future__ import annotations

import numpy as np

from .delaunay import extreme_in_cells

BIN = 0.1
"""m, thickness of the slices of height in which points are counted."""

GHOST_SHARE = 0.05
"""Ghosts are at most this share of the points of the layer above them, in the cell and its eight neighbours."""

_THIN_SHARE = 0.5  # a layer's points to those 0.4 m above it: a wall has as many there, a road with vehicles a tenth
_SLICES = 160  # ghosts of real drives lie up to 13 m deep
_ROUNDS = 4
_DENSE = 4  # elements a point up to which counting into all of them beats sorting
_AROUND = [(down, right) for down in (-1, 0, 1) for right in (-1, 0, 1)]


def without_ghosts(cell: np.ndarray, height: np.ndarray, shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Heights (n,) with those of ghosts set to inf, and the lowest height (cells,) of each cell that is left.

    A cell's answer depends on its points and those of its eight neighbours.

    Parameters
    ----------
    cell : (n,) flat cell numbers.
    height : (n,) m, inf where a point is left out.
    shape : rows and columns.
    """
    size = shape[0] * shape[1]
    lowest = extreme_in_cells(cell, height, size, highest=False)
    suspect = _suspects(cell, height, lowest, shape)
    if not len(suspect):
        return height, lowest
    counts = _Slices(cell, height, lowest, suspect, shape)
    floor = np.full(size, -np.inf)
    floor[suspect] = counts.floors()
    ghost = height < floor[cell]
    if not ghost.any():
        return height, lowest
    height = np.where(ghost, np.inf, height)
    haunted = np.zeros(size, bool)
    haunted[cell[ghost]] = True
    some = np.flatnonzero(haunted[cell])
    return height, np.where(haunted, extreme_in_cells(cell[some], height[some], size, highest=False), lowest)


def _suspects(cell: np.ndarray, height: np.ndarray, lowest: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Flat numbers of the cells with few points at the lowest one, compared with all around."""
    bottom = np.bincount(cell[height < lowest[cell] + 2 * BIN], minlength=lowest.size)
    total = np.pad(np.bincount(cell, minlength=lowest.size).reshape(shape), 1)
    around = sum(total[1 + down:1 + down + shape[0], 1 + right:1 + right + shape[1]] for down, right in _AROUND)
    return np.flatnonzero(np.isfinite(lowest) & (bottom <= GHOST_SHARE * around.ravel()))


class _Slices:
    """Points of suspect cells and their neighbours, counted in slices of height above the suspects' lowest points."""

    def __init__(self, cell: np.ndarray, height: np.ndarray, lowest: np.ndarray, suspect: np.ndarray,
                 shape: tuple[int, int]):
        self.base = np.floor(lowest[suspect] / BIN).astype(np.int64) - 2
        self.in_column = np.zeros((len(suspect), _SLICES), np.int64)
        self.around = np.zeros((len(suspect), _SLICES), np.int64)
        row, column = np.divmod(suspect, shape[1])
        cell, level, points = self._piles(*self._within(cell, height, suspect, shape), lowest.size)
        for down, right in _AROUND:
            inside = ((row + down >= 0) & (row + down < shape[0]) & (column + right >= 0) & (column + right < shape[1]))
            number = np.full(lowest.size, -1)
            number[suspect[inside] + down * shape[1] + right] = np.flatnonzero(inside)
            counts = self._count(number[cell], level, points)
            self.around += counts
            if not down and not right:
                self.in_column = counts

    def _within(self, cell: np.ndarray, height: np.ndarray, suspect: np.ndarray,
                shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        """The points that may be counted: in a suspect cell or beside one, below the highest slice of those there."""
        top = np.full((shape[0] + 2, shape[1] + 2), -np.inf)
        row, column = np.divmod(suspect, shape[1])
        for down, right in _AROUND:
            place = row + 1 + down, column + 1 + right
            top[place] = np.maximum(top[place], (self.base + _SLICES + 1) * BIN)
        some = np.flatnonzero(height < top[1:-1, 1:-1].ravel()[cell])
        return cell[some], height[some]

    def _piles(self, cell: np.ndarray, height: np.ndarray, cells: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Cell, slice of height and number of the points that share both, for slices that a suspect counts."""
        first = int(self.base.min())
        levels = int(self.base.max()) + _SLICES - first
        level = np.floor(height / BIN).astype(np.int64) - first
        some = np.flatnonzero((level >= 0) & (level < levels))
        code = cell[some] * np.int64(levels) + level[some]
        if cells * levels <= _DENSE * len(code):
            points = np.bincount(code)
            piles = np.flatnonzero(points)
            points = points[piles]
        else:
            piles, points = np.unique(code, return_counts=True)
        cell, level = np.divmod(piles, levels)
        return cell, level + first, points

    def _count(self, number: np.ndarray, level: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Points by suspect (its number; -1: none) and slice, (suspects, slices)."""
        used = np.flatnonzero(number >= 0)
        number, points = number[used], points[used]
        level = level[used] - self.base[number]
        near = (level >= 0) & (level < _SLICES)
        place = number[near] * _SLICES + level[near]
        flat = np.bincount(place, points[near], self.around.size).astype(np.int64)  # whole numbers: exact
        return flat.reshape(self.around.shape)

    def floors(self) -> np.ndarray:
        """Height (suspects,) m below which a suspect's points are ghosts; -inf where they are none."""
        pair = self.around[:, :-1] + self.around[:, 1:]
        layer = pair.copy()
        layer[:, :-4] = np.where(pair[:, 4:] <= _THIN_SHARE * pair[:, :-4], pair[:, :-4], 0)
        layer[:, -4:] = 0
        level, rows = np.full(len(pair), 2), np.arange(len(pair))
        floor = np.full(len(pair), -np.inf)
        for _ in range(_ROUNDS):
            lowest = pair[rows, level - 2] + pair[rows, level]
            above = np.where(np.arange(layer.shape[1]) >= level[:, None] + 2, layer, 0)
            peak = above.argmax(axis=1)
            ghost = (above[rows, peak] > 0) & (lowest <= GHOST_SHARE * above[rows, peak])
            if not ghost.any():
                break
            # A tenth below the layer still belongs to it.
            floor[ghost] = (self.base[ghost] + peak[ghost] - 1) * BIN
            left = np.where(np.arange(_SLICES) >= (peak - 1)[:, None], self.in_column, 0) > 0
            level[ghost] = np.clip(np.where(left.any(axis=1), left.argmax(axis=1), peak), 2, layer.shape[1] - 1)[ghost]
        return floor
