"""What stands above the ground, from a surface raster and a ground raster."""

from __future__ import annotations

import math
import os

import cv2
import numpy as np

from ...errors import InputError
from ...geometry.grid import Grid
from ...io.raster import RasterSampler

STEP = 2.5
"""Neighbouring heights this far apart, m, are a wall; so high, m, are the lower parts of a building at least."""

LOW_PART_WIDTH = 4.0  # Wider than any vehicle, m.
LOW_PART_REACH = 15.0  # How far a lower part may lie from something raised, m.
# Share of a wall's height above which a cell is taken for its top. Points on walls scatter, and a surface
# holds the highest of what lies in a place, so that half the height stands outside the wall.
WALL_SHARE = 2 / 3
# Cells that the top of a wall stands outside the last raised cell's centre; its foot stands at half a cell.
TOP_OUTWARD = 0.35

_BEYOND = np.float32(1e9)


class NormalisedSurface:
    """A surface raster and the ground below it, read by windows. Use as a context manager.

    Attributes
    ----------
    grid : of the surface.
    ground : the ground's heights.
    crs_wkt : the surface's CRS, "" where it states none.
    """

    def __init__(self, dsm: str | os.PathLike, ground: str | os.PathLike):
        self._surface = RasterSampler(dsm)
        try:
            self.ground = RasterSampler(ground)
        except InputError:
            self._surface.__exit__()
            raise
        self.grid = self._surface.grid
        self.crs_wkt = self._surface.crs_wkt
        self._last: tuple = (None,), ()  # window and heights

    def __enter__(self) -> NormalisedSurface:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._surface.__exit__()
        self.ground.__exit__()

    def known(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Whether both heights are known at points (n,)."""
        return np.isfinite(self._surface.sample(x, y)) & np.isfinite(self.ground.sample(x, y))

    def heights(self, rows: slice, columns: slice, steepen: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Heights of a window, by default with steepened walls, and heights above the ground, m; NaN where unknown."""
        (outer_rows, outer_columns), inner = self._widened(rows, columns, 1)
        z = self._surface.read(outer_rows, outer_columns)
        z = (steepened_walls(z) if steepen else z)[inner]
        if self.ground.grid == self.grid:
            return z, z - self.ground.read(rows, columns)
        x, y = np.broadcast_arrays(*cell_centres(self.grid, rows, columns))
        return z, z - self.ground.sample(x.ravel(), y.ravel()).reshape(x.shape)

    def raised(self, rows: slice, columns: slice, threshold: float, low_parts: bool,
               steepen: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Heights of a window, by default with steepened walls, and which cells count as raised.

        Parameters
        ----------
        threshold : m above the ground.
        low_parts : whether lower parts at a building count (see `with_low_parts`).
        """
        if not low_parts:
            z, above = self.heights(rows, columns, steepen)
            return z, above > threshold
        halo = math.ceil((LOW_PART_REACH + LOW_PART_WIDTH) / self.grid.cell) + 1
        outer, inner = self._widened(rows, columns, halo)
        z, above = self._next_heights(*outer, steepen)
        return np.array(z[inner]), with_low_parts(above, threshold, self.grid.cell)[inner]

    def _next_heights(self, rows: slice, columns: slice, steepen: bool) -> tuple[np.ndarray, np.ndarray]:
        """As `heights`; of windows one below the other, what they share is not read again."""
        place, previous = self._last
        if place[1:] == (columns, steepen) and place[0].start <= rows.start < place[0].stop < rows.stop:
            more = self.heights(slice(place[0].stop, rows.stop), columns, steepen)
            known = slice(rows.start - place[0].start, None)
            heights = tuple(np.concatenate([old[known], new]) for old, new in zip(previous, more))
        else:
            heights = self.heights(rows, columns, steepen)
        self._last = (rows, columns, steepen), heights
        return heights

    def _widened(self, rows: slice, columns: slice, by: int) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
        """A window with so many cells more on each side, as far as the raster reaches, and the first one in it."""
        outer = (slice(max(rows.start - by, 0), min(rows.stop + by, self.grid.rows)),
                 slice(max(columns.start - by, 0), min(columns.stop + by, self.grid.columns)))
        inner_rows, inner_columns = (slice(part.start - whole.start, part.stop - whole.start)
                                     for part, whole in zip((rows, columns), outer))
        return outer, (inner_rows, inner_columns)


def cell_centres(grid: Grid, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray]:
    """x (1, n) and y (m, 1) of the cell centres of a window."""
    x, y = grid.centres()
    return x[None, columns], y[rows, None]


def steepened_walls(z: np.ndarray) -> np.ndarray:
    """Heights (m, n) in which walls drop from one cell to the next.

    Triangles between a roof and the ground give the cells between the two heights that are neither. Where the 3 x 3
    neighbours differ by more than `STEP`, a cell takes the highest of them where it reaches `WALL_SHARE` of the
    difference, and the lowest otherwise.
    """
    unknown, square = np.isnan(z), np.ones((3, 3), np.uint8)
    gaps = bool(unknown.any())
    low = cv2.erode(np.where(unknown, _BEYOND, z) if gaps else z, square, borderType=cv2.BORDER_REPLICATE)
    high = cv2.dilate(np.where(unknown, -_BEYOND, z) if gaps else z, square, borderType=cv2.BORDER_REPLICATE)
    wall = high - low > STEP
    wall &= ~unknown
    at = np.flatnonzero(wall)
    low, high, steep = low.take(at), high.take(at), np.array(z)
    steep.ravel()[at] = np.where(z.take(at) > low + np.float32(WALL_SHARE) * (high - low), high, low)
    return steep


def with_low_parts(above: np.ndarray, threshold: float, cell: float) -> np.ndarray:
    """Cells higher than the threshold, and the podiums and annexes at them.

    These are lower than the threshold but higher than `STEP`, wider than `LOW_PART_WIDTH` in both directions of
    the raster, which no vehicle is, and within `LOW_PART_REACH` of a cell above the threshold.

    Parameters
    ----------
    above : (m, n) heights above the ground, m.
    cell : m.
    """
    high = above > threshold
    if threshold <= STEP or not high.any():
        return high
    width = max(round(LOW_PART_WIDTH / cell), 1)
    wide = np.ones((width, width), np.uint8)
    near = np.ones((2 * round(LOW_PART_REACH / cell) + 1,) * 2, np.uint8)
    # Opening by squares of even width moves things by a cell, unless the second anchor mirrors the first.
    part = cv2.erode((above > STEP).astype(np.uint8), wide, anchor=(0, 0))
    part = cv2.dilate(part, wide, anchor=(width - 1, width - 1))
    return high | ((part > 0) & (cv2.dilate(high.astype(np.uint8), near) > 0))


def wall_offsets(high: np.ndarray, cell: float) -> tuple[np.ndarray, np.ndarray]:
    """Shifts in x and y, m, (m, n) each, that put walls where they are.

    A wall stands between the last raised cell and the first low one: the low cell's vertex, its foot, moves half a
    cell towards its raised neighbours, the raised cell's, its top, `TOP_OUTWARD` towards its low ones.
    """
    flags = high.astype(np.float32)
    # Moves from low to raised neighbours: a foot goes with them, a top against them.
    east = np.array([[-1, 0, 1]] * 3, np.float32)
    step = np.where(high, np.float32(-TOP_OUTWARD * cell), np.float32(cell / 2))
    shifts = [cv2.filter2D(flags, -1, kernel, borderType=cv2.BORDER_REPLICATE) for kernel in (east, -east.T)]
    step /= np.maximum(np.maximum(np.abs(shifts[0]), np.abs(shifts[1])), 1)
    return shifts[0] * step, shifts[1] * step
