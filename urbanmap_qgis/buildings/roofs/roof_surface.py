"""The raster of one building that its roofs are segmented on: cell heights, support and roughness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
import shapely

from ...geometry.grid import Grid
from ...geometry.tolerances import ROUNDING
from ...io.points.point_buckets import stable_order

# Cells are made this full on average: the finest at which neighbouring points still lie in neighbouring
# cells.
POINTS_PER_CELL = 1.0
# Limits of the cell size, m.
MIN_CELL = 0.4
MAX_CELL = 2.0
# The largest raster of a building; a larger building (or a stray point) gets larger cells.
MAX_CELLS = 250_000
NEIGHBOURHOOD = np.ones((3, 3), np.uint8)


@dataclass(frozen=True)
class RoofSurface:
    """Raster of one building (all arrays (rows, columns) of `grid`).

    Attributes
    ----------
    grid : place of the cells.
    cell_of_point : (n,) flat index of the cell of each point.
    count : points in each cell.
    height : median height of the points of a cell, m; NaN without points.
    inside : cell centre inside the outline.
    roughness : root mean square distance of the points from the best plane through any 3 x 3 window that holds
        the cell, m. Low on roofs up to their very edges, high in trees. NaN where no window holds 4 points.
    """

    grid: Grid
    cell_of_point: np.ndarray
    count: np.ndarray
    height: np.ndarray
    inside: np.ndarray
    roughness: np.ndarray


def roof_cell_size(density: float, width: float, depth: float) -> float:
    """Cell size in m, a multiple of 0.1, for `density` points/m2 and a building of width x depth m."""
    size = min(max(math.sqrt(POINTS_PER_CELL / density), MIN_CELL), MAX_CELL)
    return math.ceil(10 * max(size, math.sqrt(width * depth / MAX_CELLS)) - ROUNDING) / 10


def roof_surface(x: np.ndarray, y: np.ndarray, z: np.ndarray, outline: shapely.Geometry,
                 density: float) -> RoofSurface:
    """Raster of the points of one building.

    Parameters
    ----------
    x, y, z : (n,) points without the ones near the ground, m.
    outline : polygon or multipolygon.
    density : points/m2, positive.
    """
    left, bottom, right, top = outline.bounds
    left, right = x.min(initial=left), x.max(initial=right)
    bottom, top = y.min(initial=bottom), y.max(initial=top)
    grid = Grid.covering(left, bottom, right, top, roof_cell_size(density, right - left, top - bottom))
    row, column, _ = grid.cells(x, y)
    cell = row * grid.columns + column
    size = grid.rows * grid.columns
    count = np.bincount(cell, minlength=size)
    centre_x, centre_y = grid.centres()
    shapely.prepare(outline)
    inside = shapely.contains_xy(outline, *np.meshgrid(centre_x, centre_y))
    roughness = _roughness(x - left, y - bottom, z - z.mean() if len(z) else z, cell, grid)
    return RoofSurface(grid, cell, count.reshape(grid.shape), _median(cell, z, count).reshape(grid.shape),
                       inside, roughness)


def _window_sum(cell: np.ndarray, weights: np.ndarray | None, grid: Grid) -> np.ndarray:
    """Sum of the weights (or number) of the points in the 3 x 3 window around each cell."""
    per_cell = np.bincount(cell, weights, grid.rows * grid.columns).reshape(grid.shape)
    return cv2.boxFilter(per_cell.astype(float), -1, (3, 3), normalize=False, borderType=cv2.BORDER_CONSTANT)


def _median(cell: np.ndarray, z: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Median of z in each cell, NaN in empty cells."""
    order = sorted_within(cell, z)
    start = np.cumsum(count) - count
    filled = np.flatnonzero(count)
    ordered = z[order]
    median = np.full(len(count), np.nan)
    low = start[filled] + (count[filled] - 1) // 2
    high = start[filled] + count[filled] // 2
    median[filled] = (ordered[low] + ordered[high]) / 2
    return median


def sorted_within(group: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Order (n,) that sorts by whole numbers `group` and in each group by `value`; equal values in any order."""
    order = np.argsort(value)
    return order[stable_order(group[order])]


def _roughness(x: np.ndarray, y: np.ndarray, z: np.ndarray, cell: np.ndarray, grid: Grid) -> np.ndarray:
    """See `RoofSurface.roughness`; by moving-window moments."""
    def window(weights: np.ndarray | None) -> np.ndarray:
        return _window_sum(cell, weights, grid)

    n = window(None)
    some = np.maximum(n, 1)
    mean_x, mean_y, mean_z = window(x) / some, window(y) / some, window(z) / some
    xx = window(x * x) / some - mean_x**2
    yy = window(y * y) / some - mean_y**2
    xy = window(x * y) / some - mean_x * mean_y
    xz = window(x * z) / some - mean_x * mean_z
    yz = window(y * z) / some - mean_y * mean_z
    zz = window(z * z) / some - mean_z**2
    # A hair of ridge keeps windows with all points on one line solvable.
    ridge = 1e-4 * grid.cell**2
    determinant = (xx + ridge) * (yy + ridge) - xy**2
    explained = ((yy + ridge) * xz**2 - 2 * xy * xz * yz + (xx + ridge) * yz**2) / determinant
    # Three parameters are fitted: n - 3 degrees of freedom.
    variance = np.maximum(zz - explained, 0) * some / np.maximum(some - 3, 1)
    variance[n < 4] = np.inf
    variance = cv2.erode(variance, NEIGHBOURHOOD, borderType=cv2.BORDER_CONSTANT, borderValue=np.inf)
    variance[~np.isfinite(variance)] = np.nan
    return np.sqrt(variance)
