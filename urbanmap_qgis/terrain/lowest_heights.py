"""Lowest believable heights of the nodes of a cloth, without isolated points, ghosts and loose points below ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.grid import Grid
from .delaunay import extreme_in_cells
from .ghost_points import without_ghosts
from .outliers import isolated

NEIGHBOUR_STEP = 1.0
"""m: heights of neighbouring cells that differ by less support each other."""

PIT_DEPTH = 1.0
"""m: a second height of a cell lies at least so far above its lowest."""

_LOOSE_DEPTH = 0.5  # m above the lowest point: what lies so near to it belongs to the same level
_PIT_SHARE = 0.5


def node_of_points(x: np.ndarray, y: np.ndarray, grid: Grid) -> np.ndarray:
    """Flat cell number of each point, (n,) int32; the grid must cover all points."""
    column = ((x - grid.x_min) * (1.0 / grid.cell)).astype(np.int32)
    row = ((grid.y_max - y) * (1.0 / grid.cell)).astype(np.int32)
    # A point on the lower or right edge belongs to the last cell.
    np.minimum(column, grid.columns - 1, out=column)
    np.minimum(row, grid.rows - 1, out=row)
    row *= np.int32(grid.columns)
    row += column
    return row


@dataclass(frozen=True)
class LowestHeights:
    """Lowest heights of the cells of a grid.

    Attributes
    ----------
    lowest : (rows, columns) lowest believable height, inf where there is none.
    second : the lowest height more than a metre above it where fewer than half of the cell's points lie at the
        lowest; inf elsewhere.
    support : number of points at the lowest (within half a metre); 0 where they are fewer than half.
    """

    lowest: np.ndarray
    second: np.ndarray
    support: np.ndarray


def lowest_heights(x: np.ndarray, y: np.ndarray, z: np.ndarray, grid: Grid, neighbours: int = 5) -> LowestHeights:
    """Lowest believable heights of each cell.

    Left out are points alone in space (`outliers.isolated`), and the lowest points of a cell where fewer than
    five (or 5 % of those around) lie within half a metre of each other and no neighbouring cell has its lowest
    points at that height: multipath below the ground.

    So are clusters close below the ground (`ghost_points`). All points must be plausible and on the grid. A cell's
    answer depends on the points within two voxels and two cells of it.
    """
    cell, height = node_of_points(x, y, grid), z
    alone = isolated(x, y, z, neighbours=neighbours)
    if alone.any():
        height = np.where(alone, np.inf, z)
    size = grid.rows * grid.columns
    count = np.bincount(cell, minlength=size)
    height, lowest = without_ghosts(cell, height, grid.shape)
    limit = np.minimum(4.0, 0.05 * _around(count.reshape(grid.shape)))
    support = _support(lowest, cell, height)
    found = _MembersOfFew(cell, size)
    for _ in range(4):
        loose = _loose(lowest.reshape(grid.shape), support.reshape(grid.shape), limit).ravel()
        members = found.of(loose)
        if not len(members):
            break
        left = members[height[members] >= lowest[cell[members]] + _LOOSE_DEPTH]
        refound = extreme_in_cells(cell[left], height[left], size, highest=False)
        lowest = np.where(loose, refound, lowest)
        support = np.where(loose, _support(refound, cell[left], height[left]), support)
    sparse = np.isfinite(lowest) & (support < _PIT_SHARE * count)
    members = np.flatnonzero(sparse[cell])
    upper = members[height[members] >= lowest[cell[members]] + PIT_DEPTH]
    second = extreme_in_cells(cell[upper], height[upper], size, highest=False)
    support = np.where(sparse, 0, support)
    return LowestHeights(*(values.reshape(grid.shape) for values in (lowest, second, support)))


class _MembersOfFew:
    """Points of few cells, asked for again and again: mostly of some of the cells asked for before."""

    def __init__(self, cell: np.ndarray, cells: int):
        self._cell, self._asked = cell, np.zeros(cells, bool)
        self._members = np.zeros(0, np.int64)

    def of(self, wanted: np.ndarray) -> np.ndarray:
        """Ascending numbers of the points in the cells that `wanted` (cells,) marks."""
        if (wanted & ~self._asked).any():
            self._asked = self._asked | wanted
            self._members = np.flatnonzero(self._asked[self._cell])
        return self._members[wanted[self._cell[self._members]]]


def _support(lowest: np.ndarray, cell: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Number of points within half a metre above the lowest of each cell, (cells,)."""
    return np.bincount(cell[height < lowest[cell] + _LOOSE_DEPTH], minlength=lowest.size)


def _around(values: np.ndarray) -> np.ndarray:
    """Sum of each cell and its eight neighbours."""
    padded = np.pad(values, 1)
    across = padded[:, :-2] + padded[:, 1:-1] + padded[:, 2:]
    return across[:-2] + across[1:-1] + across[2:]


def _loose(lowest: np.ndarray, support: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """Cells whose lowest points are too few to be believed, (rows, columns) bool."""
    total = support.copy()
    padded_lowest = np.pad(lowest, 1, constant_values=np.inf)
    padded_support = np.pad(support, 1)
    rows, columns = lowest.shape
    for down in range(3):
        for right in range(3):
            if down == 1 and right == 1:
                continue
            window = slice(down, down + rows), slice(right, right + columns)
            with np.errstate(invalid="ignore"):
                level = np.abs(padded_lowest[window] - lowest) < NEIGHBOUR_STEP
            total += np.where(level, padded_support[window], 0)
    return np.isfinite(lowest) & (total <= limit)
