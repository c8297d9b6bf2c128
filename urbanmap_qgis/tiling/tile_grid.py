"""One grid of tiles for point clouds, rasters and outlines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely

from ..errors import InputError
from ..wording import say

MAX_TILES = 1_000_000
"""More tiles than this are a mistake in the tile's size or the coordinates."""

Bounds = tuple[float, float, float, float]
"""x_min, y_min, x_max, y_max in the units of the CRS."""


@dataclass(frozen=True)
class GridTile:
    """A rectangle of the grid.

    Attributes
    ----------
    column, row : its place in the grid; row 0 lies north of y = 0.
    core : what the tile answers for; its left and lower edges belong to it, its right and upper ones to its neighbours.
    outer : the core and the buffer around it: what the tile reads.
    """

    column: int
    row: int
    core: Bounds
    outer: Bounds

    @property
    def name(self) -> str:
        """Lower left corner in whole units of the CRS, such as ``-12500_-45000``."""
        return f"{self.core[0]:.0f}_{self.core[1]:.0f}"

    @property
    def fills_core(self) -> bool:
        """Whether the tile is all of the box `core`."""
        return True

    @property
    def square(self) -> shapely.Polygon:
        """The core as a polygon."""
        return shapely.box(*self.core)

    def owns(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Mask (n,) of the points that lie in the core."""
        x_min, y_min, x_max, y_max = self.core
        return (x >= x_min) & (x < x_max) & (y >= y_min) & (y < y_max)

    def reads(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Mask (n,) of the points that lie in the core or its buffer."""
        x_min, y_min, x_max, y_max = self.outer
        return (x >= x_min) & (x < x_max) & (y >= y_min) & (y < y_max)

    def owns_of(self, chunk) -> np.ndarray:
        """Mask (n,) of the points of a chunk of a point cloud that are the tile's own."""
        return self.owns(np.asarray(chunk.x), np.asarray(chunk.y))

    def reads_of(self, chunk) -> np.ndarray:
        """Mask (n,) of the points of a chunk of a point cloud that the tile reads."""
        return self.reads(np.asarray(chunk.x), np.asarray(chunk.y))

    def reads_all(self, bounds: Bounds) -> bool:
        """Whether the tile reads all points of a file with such a box."""
        x_min, y_min, x_max, y_max = self.outer
        return bounds[0] >= x_min and bounds[1] >= y_min and bounds[2] < x_max and bounds[3] < y_max


@dataclass(frozen=True)
class TileGrid:
    """Squares whose corners are multiples of their size, so that all data of an area falls on the same tiles.

    Parameters
    ----------
    size : side of a tile, whole units of the CRS.
    buffer : width of the surroundings that a tile reads, same units.
    """

    size: float
    buffer: float

    def __post_init__(self):
        if not (self.size >= 1 and float(self.size).is_integer()) or not self.buffer >= 0:
            raise InputError(say("The side of a tile must be a whole number of metres, and its buffer not negative: "
                                 "change them."))

    @property
    def sides(self) -> tuple[float, float]:
        """Width and height of a tile."""
        return self.size, self.size

    @property
    def key(self) -> object:
        """What tells this grid from others, beside its buffer."""
        return self.size

    @property
    def title(self) -> str:
        """What the tiles are, for reports."""
        return say("squares of {size:g} m", size=self.size)

    def around(self, core: Bounds) -> Bounds:
        """A core and the buffer around it."""
        return core[0] - self.buffer, core[1] - self.buffer, core[2] + self.buffer, core[3] + self.buffer

    def tile(self, column: int, row: int) -> GridTile:
        """The tile in a column and row of the grid."""
        width, height = self.sides
        core = (column * width, row * height, (column + 1) * width, (row + 1) * height)
        return GridTile(column, row, core, self.around(core))

    def numbers(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Column and row (n,) int64 of the tiles that own the points."""
        width, height = self.sides
        return (np.floor(np.asarray(x) / width).astype(np.int64), np.floor(np.asarray(y) / height).astype(np.int64))

    def numbers_of(self, chunk) -> tuple[np.ndarray, np.ndarray]:
        """Column and row (n,) int64 of the tiles that own the points of a chunk of a point cloud."""
        return self.numbers(chunk.x, chunk.y)

    def covering(self, bounds: Bounds) -> list[GridTile]:
        """Tiles whose cores meet a box, row by row from the south-west.

        Raises
        ------
        InputError : the box is not finite, or takes more than a million tiles.
        """
        if not all(map(math.isfinite, bounds)):
            raise InputError(say("The extent of the data is not a number: check its coordinates."))
        left, bottom, right, top = (math.floor(value / side) for value, side in zip(bounds, 2 * self.sides))
        count = (right - left + 1) * (top - bottom + 1)
        if count > MAX_TILES:
            raise InputError(say("The data would take {count:,} tiles of {size:g} m: give larger tiles, or check the "
                                 "coordinates.", count=count, size=self.size))
        return [self.tile(column, row) for row in range(bottom, top + 1) for column in range(left, right + 1)]
