"""Heights of triangles on a grid."""

from __future__ import annotations

import numpy as np

from ..geometry.grid import Grid
from ..geometry.tolerances import ROUNDING

_BATCH = 200_000


def rasterise(x: np.ndarray, y: np.ndarray, z: np.ndarray, triangles: np.ndarray, grid: Grid,
              raster: np.ndarray, only_empty: bool = False) -> None:
    """Write the linear height of each triangle into the cells whose centres it covers.

    Parameters
    ----------
    x, y, z : (n,) corners, metres.
    triangles : (m, 3) indices into them.
    raster : (rows, columns) of `grid`, changed in place. Cells that no triangle covers stay as they are. A centre on
        the side of two triangles takes the height of that side from either.
    only_empty : write only into cells that are NaN.
    """
    for first in range(0, len(triangles), _BATCH):
        corners = triangles[first:first + _BATCH]
        # Coordinates in cells, counted from the centre of the first cell; v grows southwards.
        u = (x[corners] - grid.x_min) / grid.cell - 0.5
        v = (grid.y_max - y[corners]) / grid.cell - 0.5
        _fill(u, v, z[corners], raster, only_empty)


def _fill(u: np.ndarray, v: np.ndarray, z: np.ndarray, raster: np.ndarray, only_empty: bool) -> None:
    """Scan-line fill: triangles to rows, rows to cells; u, v, z are (m, 3)."""
    rows, columns = raster.shape
    order = np.argsort(v, axis=1)
    u, v, z = (np.take_along_axis(values, order, axis=1) for values in (u, v, z))
    first = np.maximum(np.ceil(v[:, 0]), 0).astype(np.int64)
    last = np.minimum(np.floor(v[:, 2]), rows - 1).astype(np.int64)
    owner, row = _expand(first, last)
    if not len(owner):
        return
    left, right = _span(u, v, owner, row)
    # The allowance closes hairline gaps that rounding leaves between neighbours.
    start = np.maximum(np.ceil(left - ROUNDING), 0).astype(np.int64)
    stop = np.minimum(np.floor(right + ROUNDING), columns - 1).astype(np.int64)
    line, column = _expand(start, stop)
    owner, row = owner[line], row[line]
    across, along = _gradients(u, v, z)
    height = (z[owner, 0] + across[owner] * (column - u[owner, 0]) + along[owner] * (row - v[owner, 0]))
    # Slivers have no trustworthy gradient: their own corners bound them.
    np.clip(height, z.min(axis=1)[owner], z.max(axis=1)[owner], out=height)
    if only_empty:
        empty = np.isnan(raster[row, column])
        row, column, height = row[empty], column[empty], height[empty]
    raster[row, column] = height


def _expand(first: np.ndarray, last: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All whole numbers from first to last of each element, with the element's index."""
    count = np.maximum(last - first + 1, 0)
    owner = np.repeat(np.arange(len(count)), count)
    ends = np.cumsum(count)
    number = np.arange(len(owner)) - np.repeat(ends - count, count) + np.repeat(first, count)
    return owner, number


def _span(u: np.ndarray, v: np.ndarray, owner: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Left and right end of each triangle (corners in order of v) on each row."""
    u0, u1, u2 = (u[owner, k] for k in range(3))
    v0, v1, v2 = (v[owner, k] for k in range(3))
    long_side = _crossing(u0, v0, u2, v2, row)
    upper = row < v1
    short_side = np.where(upper, _crossing(u0, v0, u1, v1, row), _crossing(u1, v1, u2, v2, row))
    return np.minimum(long_side, short_side), np.maximum(long_side, short_side)


def _crossing(u_a: np.ndarray, v_a: np.ndarray, u_b: np.ndarray, v_b: np.ndarray, row: np.ndarray) -> np.ndarray:
    """u of the line a-b at a row; at level lines, that of b."""
    rise = v_b - v_a
    share = np.divide(row - v_a, rise, out=np.ones_like(rise), where=rise > 0)
    return u_a + np.clip(share, 0, 1) * (u_b - u_a)


def _gradients(u: np.ndarray, v: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Slope of each triangle along u and v, metres a cell; 0 where it has no area."""
    u1, u2, v1, v2 = u[:, 1] - u[:, 0], u[:, 2] - u[:, 0], v[:, 1] - v[:, 0], v[:, 2] - v[:, 0]
    z1, z2 = z[:, 1] - z[:, 0], z[:, 2] - z[:, 0]
    area = u1 * v2 - u2 * v1
    inverse = np.divide(1.0, area, out=np.zeros_like(area), where=np.abs(area) > 1e-12)
    return (z1 * v2 - z2 * v1) * inverse, (u1 * z2 - u2 * z1) * inverse
