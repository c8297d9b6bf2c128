"""What stands between a camera and a facade: other buildings, and what the laser points show (trees, vehicles)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...io.raster import own_gdal
from ...progress import SILENT, Progress
from .sight_lines import blocked_lines, sight_lines

CELL = 0.25
"""Side of the cells in which heights of buildings and laser points are kept, m."""

OFF_WALL = 0.35
"""Rays are followed from this far in front of the facade, m: nearer lie its own cells."""

OFF_POINTS = 0.8
"""Laser points nearer to the facade's plane than this (m) belong to it."""

ENOUGH = 2
"""Laser points in a cell from which it hides."""


@dataclass(frozen=True)
class OccupiedVoxels:
    """Cells of `CELL` side with at least `ENOUGH` laser points: whole numbers (n, 3) of x, y, z in cells."""

    cells: np.ndarray

    def within(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Those between two corners (3,), m."""
        keep = ((self.cells >= np.floor(low / CELL)) & (self.cells <= np.floor(high / CELL))).all(axis=1)
        return self.cells[keep]


NO_POINTS = OccupiedVoxels(np.empty((0, 3), np.int32))


def voxels_of(chunks: Iterable[np.ndarray]) -> OccupiedVoxels:
    """Cells that hold laser points, from chunks (n, 3) of points; memory grows with the cells, not the points."""
    cells, counts = np.empty((0, 3), np.int32), np.empty(0, np.int64)
    for points in chunks:
        found, number = np.unique(np.floor(points / CELL).astype(np.int32), axis=0, return_counts=True)
        cells, place = np.unique(np.vstack([cells, found]), axis=0, return_inverse=True)
        counts = np.bincount(place.ravel(), np.concatenate([counts, number]), len(cells))
    return OccupiedVoxels(cells[counts >= ENOUGH])


def voxels_from_cloud(cloud: PointCloud, progress: Progress = SILENT) -> OccupiedVoxels:
    """Cells that hold laser points of files of any size; noise and withheld points are left out."""
    def chunks():
        for chunk in iter_chunks(cloud, progress):
            keep = valid_points(chunk)
            yield np.column_stack([np.asarray(chunk[axis])[keep] for axis in "xyz"])

    return voxels_of(chunks())


@dataclass(frozen=True)
class ViewObstacles:
    """What may hide facades within a box.

    Attributes
    ----------
    low : (3,) corner of the box, m.
    tops : (rows, columns) heights of buildings from the box's south-west corner northwards, -inf where there is none.
    filled : (rows, columns, levels) cells with laser points.
    """

    low: np.ndarray
    tops: np.ndarray
    filled: np.ndarray

    def hidden(self, places: np.ndarray, cameras: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Mask (n,) of places (n, 3) of a facade that their cameras (n, 3) do not see.

        `normal` (3,) is the facade's, outwards. What lies outside the box hides nothing.
        """
        lines = sight_lines(places, cameras)
        off = np.maximum(lines[0] @ normal, 1e-6)

        def blocks(at: np.ndarray, left: np.ndarray, along: np.ndarray) -> np.ndarray:
            return self._blocks(at, along * off[left] > OFF_POINTS)

        return blocked_lines(places, lines, OFF_WALL / off, self.low[2] + CELL * self.filled.shape[2], CELL, blocks)

    def _blocks(self, at: np.ndarray, clear_of_wall: np.ndarray) -> np.ndarray:
        """Mask (n,) of places (n, 3) inside a building or, clear of the wall, in a cell with laser points."""
        column, row, level = np.floor((at - self.low) / CELL).astype(int).T
        rows, columns, levels = self.filled.shape
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        blocked = np.zeros(len(at), bool)
        blocked[inside] = self.tops[row[inside], column[inside]] > at[inside, 2]
        inside &= clear_of_wall & (level >= 0) & (level < levels)
        blocked[inside] |= self.filled[row[inside], column[inside], level[inside]]
        return blocked


def obstacles_within(low: np.ndarray, high: np.ndarray, roofs: Sequence[shapely.Polygon], heights: np.ndarray,
                     voxels: OccupiedVoxels = NO_POINTS) -> ViewObstacles:
    """Obstacles in a box between two corners (3,), m.

    Parameters
    ----------
    roofs : plans of roofs that touch the box.
    heights : (n,) their heights, m.
    """
    low = np.floor(np.asarray(low, float) / CELL) * CELL
    columns, rows, levels = np.maximum(np.ceil((np.asarray(high) - low) / CELL).astype(int), 1)
    tops = np.full((rows, columns), -np.inf, np.float32)
    if len(roofs):
        order = np.argsort(heights, kind="stable")
        place = Affine(CELL, 0.0, low[0], 0.0, CELL, low[1])
        with own_gdal():
            drawn = rasterize([(roofs[k], float(heights[k])) for k in order], (rows, columns), fill=np.nan,
                              transform=place, dtype="float64")
        tops = np.where(np.isfinite(drawn), drawn, -np.inf).astype(np.float32)
    filled = np.zeros((rows, columns, levels), bool)
    cells = voxels.within(low, low + CELL * (np.array([columns, rows, levels]) - 0.5)) - np.rint(low / CELL).astype(int)
    filled[cells[:, 1], cells[:, 0], cells[:, 2]] = True
    return ViewObstacles(low, tops, filled)
