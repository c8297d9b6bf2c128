"""The marking points of one drive as the reference that another drive is registered to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import grey_closing

from ...geometry.grid import Grid
from ..markings.records import MarkingPoints
from ..registration.start.reference import Coverage, GroundPart

CELL = 0.1
"""m, cells in which the points count as paint."""

_HEIGHT_CELL = 0.5  # m; a road is plane enough over it
_TILE = 20.0  # m, by which points are found
_FILLED = 3  # cells; a marking's paint has no hole of this width


@dataclass(frozen=True)
class PointReference:
    """Paint and its heights where one drive saw them; asked like a `Reference`, box by box.

    Attributes
    ----------
    points : (n, 3) m, sorted by tile.
    weight : (n,) how surely each is paint, 0 to 1.
    tile : (n,) number of the tile of each point, increasing.
    first, columns : what tiles are numbered from.
    """

    points: np.ndarray
    weight: np.ndarray
    tile: np.ndarray
    first: np.ndarray
    columns: int

    has_heights = True

    @classmethod
    def of(cls, markings: MarkingPoints) -> PointReference:
        """From the marking points of a drive, or of a part of one, as it reports them."""
        points = np.column_stack([markings.x, markings.y, markings.z])
        cells = np.floor(points[:, :2] / _TILE).astype(np.int64)
        first = cells.min(axis=0)
        cells -= first
        columns = int(cells[:, 0].max()) + 1
        tile = cells[:, 1] * columns + cells[:, 0]
        order = np.argsort(tile, kind="stable")
        return cls(points[order], np.asarray(markings.weight, float)[order], tile[order], first, columns)

    def _inside(self, x_min: float, y_min: float, x_max: float, y_max: float) -> tuple[np.ndarray, np.ndarray]:
        """Points and weights in a box."""
        low = np.floor(np.array([x_min, y_min]) / _TILE).astype(np.int64) - self.first
        high = np.floor(np.array([x_max, y_max]) / _TILE).astype(np.int64) - self.first
        left, right = max(low[0], 0), min(high[0], self.columns - 1)
        rows = range(max(int(low[1]), 0), int(high[1]) + 1) if left <= right else ()
        spans = [slice(*np.searchsorted(self.tile, [row * self.columns + left, row * self.columns + right + 1]))
                 for row in rows]
        points = np.concatenate([self.points[span] for span in spans] or [self.points[:0]])
        weight = np.concatenate([self.weight[span] for span in spans] or [self.weight[:0]])
        inside = ((points[:, 0] >= x_min) & (points[:, 0] <= x_max) & (points[:, 1] >= y_min)
                  & (points[:, 1] <= y_max))
        return points[inside], weight[inside]

    def coverage(self, x_min: float, y_min: float, x_max: float, y_max: float) -> Coverage:
        """The paint in a box (m): cells with points, and what scan lines leave open between them."""
        grid = Grid.covering(x_min, y_min, x_max, y_max, CELL)
        points, weight = self._inside(*grid.bounds)
        share = np.zeros(grid.shape, np.float32)
        if len(points):
            row, column, inside = grid.cells(points[:, 0], points[:, 1])
            np.maximum.at(share, (row[inside], column[inside]), weight[inside].astype(np.float32))
            share = grey_closing(share, size=(_FILLED, _FILLED))
        return Coverage(grid, share)

    def ground_part(self, x_min: float, y_min: float, x_max: float, y_max: float) -> GroundPart:
        """Heights of the paint in a box; NaN away from it."""
        grid = Grid.covering(x_min - _HEIGHT_CELL, y_min - _HEIGHT_CELL, x_max + _HEIGHT_CELL, y_max + _HEIGHT_CELL,
                             _HEIGHT_CELL)
        total, count = np.zeros(grid.shape), np.zeros(grid.shape)
        points, _ = self._inside(*grid.bounds)
        if len(points):
            row, column, inside = grid.cells(points[:, 0], points[:, 1])
            np.add.at(total, (row[inside], column[inside]), points[inside, 2])
            np.add.at(count, (row[inside], column[inside]), 1.0)
        return GroundPart(grid, _filled(total, count), self)

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the paint at points (n,), m; NaN where the drive saw none."""
        if not len(x):
            return np.zeros(0)
        ground = self.ground_part(float(np.min(x)), float(np.min(y)), float(np.max(x)), float(np.max(y)))
        return ground.interpolate(x, y)


def _filled(total: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Mean heights of cells; an empty cell takes the mean of its neighbours that have one."""
    height = np.full(total.shape, np.nan, np.float32)
    for around in (0, 1):
        if around:
            total, count = (_sum_around(values) for values in (total, count))
        empty = np.isnan(height) & (count > 0)
        height[empty] = total[empty] / count[empty]
    return height


def _sum_around(values: np.ndarray) -> np.ndarray:
    """Sums over 3 x 3 cells."""
    padded = np.pad(values, 1)
    return sum(padded[i:i + values.shape[0], j:j + values.shape[1]] for i in range(3) for j in range(3))
