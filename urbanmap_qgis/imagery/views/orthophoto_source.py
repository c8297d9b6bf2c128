"""An orthophoto as an image that looks straight down."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rasterio
from rasterio.windows import Window

from ...errors import InputError
from ...geometry.grid import Grid
from ...io.raster import OPENING_ERRORS, RasterSampler, own_gdal
from ...wording import say
from .views import eight_bits

_ABOVE = 10_000.0  # m from where it is looked down


@dataclass(frozen=True, eq=False)
class OrthophotoImage:
    """An orthophoto; its pixels are named as those of frames: column and row of their middles, from the top left."""

    number: int
    name: str
    path: Path
    grid: Grid
    crs_wkt: str

    def size(self) -> tuple[int, int]:
        """Columns and rows of the image."""
        return self.grid.columns, self.grid.rows

    def image_range(self, max_range: float) -> float:
        """How far the image shows things, m: everything that lies in it."""
        return np.inf

    def rays(self, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where the rays of pixels (n,) start, and their unit directions, (n, 3) each: straight down."""
        place = np.column_stack([self.grid.x_min + (column + 0.5) * self.grid.cell,
                                 self.grid.y_max - (row + 0.5) * self.grid.cell, np.full(len(column), _ABOVE)])
        return place, np.broadcast_to((0.0, 0.0, -1.0), place.shape)

    def window(self, left: int, top: int, right: int, bottom: int) -> np.ndarray:
        """Pixels (rows, columns, 3) uint8 from column `left` to before `right`, row `top` to before `bottom`.

        Raises
        ------
        InputError : a part of the file is damaged.
        """
        try:
            with own_gdal(), rasterio.open(self.path) as source:
                bands = [1, 2, 3] if source.count >= 3 else [1, 1, 1]
                return eight_bits(source.read(bands, window=Window(left, top, right - left, bottom - top)))
        except OPENING_ERRORS as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error

    def pixels(self, points: np.ndarray, window: tuple[float, float, float, float],
               max_range: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where points (n, 3) lie within a window (left, top, right, bottom): index, column, row and distance (m,)."""
        left, top, right, bottom = window
        column = (points[:, 0] - self.grid.x_min) / self.grid.cell - 0.5
        row = (self.grid.y_max - points[:, 1]) / self.grid.cell - 0.5
        keep = np.flatnonzero((column >= left) & (column <= right) & (row >= top) & (row <= bottom))
        return keep, column[keep], row[keep], _ABOVE - points[keep, 2]


def orthophoto_source(path: str | os.PathLike, number: int = 0) -> OrthophotoImage:
    """The orthophoto at `path`.

    Raises
    ------
    InputError : it cannot be read, or its pixels are not square.
    """
    with RasterSampler(path) as source:
        return OrthophotoImage(number, Path(path).name, Path(path), source.grid, source.crs_wkt)
