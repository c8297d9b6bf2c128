"""Heights of a raster at points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .grid import Grid


@dataclass(frozen=True)
class Bilinear:
    """Where points lie between the cell centres of a grid: found once, used for any raster of that grid.

    Attributes
    ----------
    index : (n,) flat number of the upper left of the four nearest centres.
    u, v : (n,) shares of the right and of the lower ones.
    grid : of at least 2 x 2 cells.
    """

    index: np.ndarray
    u: np.ndarray
    v: np.ndarray
    grid: Grid

    @classmethod
    def of(cls, grid: Grid, x: np.ndarray, y: np.ndarray) -> Bilinear:
        """Places of points (n,); those outside are drawn to the border, as are those within half a cell of it."""
        left, u = _before(x, 1.0 / grid.cell, -grid.x_min / grid.cell - 0.5, grid.columns)
        top, v = _before(y, -1.0 / grid.cell, grid.y_max / grid.cell - 0.5, grid.rows)
        return cls(top * grid.columns + left, u, v, grid)

    def corners(self, raster: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Upper left, upper right, lower left and lower right height round each point, (n,) each."""
        flat = np.ascontiguousarray(raster).ravel()
        columns = self.grid.columns
        return tuple(flat[shift:][self.index] for shift in (0, 1, columns, columns + 1))

    def heights(self, raster: np.ndarray) -> np.ndarray:
        """Bilinear heights (n,); NaN where one of the four is NaN."""
        upper, upper_right, lower, lower_right = self.corners(raster)
        upper_right -= upper
        upper_right *= self.u
        upper += upper_right
        lower_right -= lower
        lower_right *= self.u
        lower += lower_right
        lower -= upper
        lower *= self.v
        upper += lower
        return upper


def _before(coordinate: np.ndarray, factor: float, shift: float, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Centre before each coordinate (at most the last but one) and the share of the one after it."""
    position = coordinate * factor
    position += shift
    np.clip(position, 0.0, size - 1.0, out=position)
    before = position.astype(np.int64)
    np.minimum(before, size - 2, out=before)
    position -= before
    return before, position


def sample(grid: Grid, raster: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Bilinear heights at points, (n,).

    Parameters
    ----------
    grid : place of the raster.
    raster : (rows, columns), NaN where it is empty.
    x, y : (n,) in its CRS.

    Returns
    -------
    Interpolated between the four nearest cell centres. Empty cells among the four are left out; NaN where all
    four are empty or the point lies outside the raster. Within half a cell of the border the border holds.
    """
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    x_min, y_min, x_max, y_max = grid.bounds
    inside = (x >= x_min) & (x <= x_max) & (y >= y_min) & (y <= y_max)
    if not inside.all():
        height = np.full(x.shape, np.nan, dtype=raster.dtype)
        height[inside] = sample(grid, raster, x[inside], y[inside])
        return height
    if min(grid.shape) < 2:
        raster = np.pad(raster, ((0, 1), (0, 1)), mode="edge")
        grid = Grid(grid.x_min, grid.y_max, grid.cell, grid.rows + 1, grid.columns + 1)
        x, y = np.minimum(x, x_max - grid.cell / 2), np.maximum(y, y_min + grid.cell / 2)
    place = Bilinear.of(grid, x, y)
    height = place.heights(raster)
    gap = np.flatnonzero(np.isnan(height))
    if len(gap):
        place = Bilinear(place.index[gap], place.u[gap], place.v[gap], grid)
        a, b = place.u, place.v
        weights = np.stack(((1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b))
        height[gap] = _mean_of_filled(np.stack(place.corners(raster)), weights)
    return height


def _mean_of_filled(corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Weighted means over the first axis of the corners that are not NaN; NaN where there is none."""
    filled = ~np.isnan(corners)
    weights = np.where(filled, weights, 0)
    total = weights.sum(axis=0)
    value = (np.where(filled, corners, 0) * weights).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(total > 0, value / total, np.nan)
