"""North-up grids: where a raster's cells lie."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..wording import say


@dataclass(frozen=True)
class Grid:
    """A north-up raster's place: row 0 is the northernmost, column 0 the westernmost.

    Parameters
    ----------
    x_min, y_max : outer corner of the first cell, in the units of the CRS.
    cell : side of a square cell, same units.
    rows, columns : size.
    """

    x_min: float
    y_max: float
    cell: float
    rows: int
    columns: int

    @classmethod
    def covering(cls, x_min: float, y_min: float, x_max: float, y_max: float, cell: float) -> Grid:
        """Smallest grid whose cell edges are multiples of `cell` and that covers the box.

        Snapping to multiples makes grids of neighbouring tiles fall on each other.
        """
        if not all(map(math.isfinite, (x_min, y_min, x_max, y_max))) or not cell > 0:
            raise InputError(say("The raster's extent or cell size is not a number: check the coordinates."))
        left, bottom = math.floor(x_min / cell), math.floor(y_min / cell)
        right, top = math.floor(x_max / cell) + 1, math.floor(y_max / cell) + 1
        return cls(left * cell, top * cell, cell, top - bottom, right - left)

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return self.rows, self.columns

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """(x_min, y_min, x_max, y_max) of the outer edges."""
        return (self.x_min, self.y_max - self.rows * self.cell,
                self.x_min + self.columns * self.cell, self.y_max)

    def cells(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Row and column of each point, and whether it lies on the grid (all arrays (n,)).

        Rows and columns of points outside are clipped to the border, so that they can index safely.
        """
        column = np.floor((np.asarray(x) - self.x_min) / self.cell).astype(np.int64)
        row = np.floor((self.y_max - np.asarray(y)) / self.cell).astype(np.int64)
        inside = (row >= 0) & (row < self.rows) & (column >= 0) & (column < self.columns)
        return np.clip(row, 0, self.rows - 1), np.clip(column, 0, self.columns - 1), inside

    def centres(self) -> tuple[np.ndarray, np.ndarray]:
        """x of the column centres (columns,) and y of the row centres (rows,)."""
        return (self.x_min + (np.arange(self.columns) + 0.5) * self.cell,
                self.y_max - (np.arange(self.rows) + 0.5) * self.cell)

    def window(self, x_min: float, y_min: float, x_max: float, y_max: float) -> tuple[slice, slice, Grid]:
        """Rows, columns and grid of the part of this grid that covers the box, clipped to this grid."""
        left = min(max(math.floor((x_min - self.x_min) / self.cell), 0), self.columns)
        right = min(max(math.floor((x_max - self.x_min) / self.cell) + 1, left), self.columns)
        top = min(max(math.floor((self.y_max - y_max) / self.cell), 0), self.rows)
        bottom = min(max(math.floor((self.y_max - y_min) / self.cell) + 1, top), self.rows)
        part = Grid(self.x_min + left * self.cell, self.y_max - top * self.cell, self.cell,
                    bottom - top, right - left)
        return slice(top, bottom), slice(left, right), part
