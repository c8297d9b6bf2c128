"""The stiff trend that lies under a town: what the cloth is stretched on."""

from __future__ import annotations

import numpy as np
from scipy import ndimage
from scipy.sparse import coo_matrix, csc_matrix, diags
from scipy.sparse.linalg import spsolve

from ..geometry.tolerances import LEAST_DIVISOR

BLOCK = 16.0
KNOT = 32.0
MOST_KNOTS = 40_000
STIFFNESS = 3.0
ABOVE = 0.05
SCALE = 2.0
PASSES = 10


def trend_surface(lowest: np.ndarray, cell: float) -> np.ndarray:
    """Smooth surface through the bottom of the lowest heights, (rows, columns).

    A plate on knots about 32 m apart (wider for large areas), fitted to the lowest height of each 16 m block by
    asymmetric least squares (Eilers and Boelens 2005): blocks above it count a twentieth, and less the higher
    they are; blocks far below it, less the lower. It bends over hills and valleys, not over buildings, and
    continues straight across gaps.

    Parameters
    ----------
    lowest : (rows, columns) metres, inf where empty, at least one finite.
    cell : m.
    """
    row, column, height = _lowest_of_blocks(lowest, max(1, round(BLOCK / cell)))
    knot = max(KNOT / cell, np.sqrt(lowest.size / MOST_KNOTS), 1.0)
    rows, columns = (int(np.ceil((size - 1) / knot)) + 1 for size in lowest.shape)
    rows, columns = max(rows, 2), max(columns, 2)
    design = _bilinear(row / knot, column / knot, rows, columns)
    plate = _plate(rows, columns)
    base = height.min()
    target = height - base
    weight = np.ones(len(target))
    values = np.zeros(rows * columns)
    for turn in range(PASSES):
        normal = design.T @ diags(weight) @ design + plate
        values = spsolve(csc_matrix(normal), design.T @ (weight * target))
        residual = target - design @ values
        far = np.minimum(1.0, SCALE / np.maximum(np.abs(residual), LEAST_DIVISOR))
        # At first whatever lies low draws the plate down; then what stays far below counts less and less.
        weight = np.where(residual > 0, ABOVE * far ** 2, far if turn < PASSES // 2 else far ** 2)
    place = np.mgrid[:lowest.shape[0], :lowest.shape[1]] / knot
    return base + ndimage.map_coordinates(values.reshape(rows, columns), place, order=3, mode="nearest")


def _lowest_of_blocks(lowest: np.ndarray, side: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Row, column and height of the lowest node of each block of side x side nodes that has one."""
    rows, columns = lowest.shape
    padded = np.pad(lowest, ((0, -rows % side), (0, -columns % side)), constant_values=np.inf)
    blocks = padded.reshape(padded.shape[0] // side, side, padded.shape[1] // side, side)
    blocks = blocks.transpose(0, 2, 1, 3).reshape(-1, side * side)
    place = blocks.argmin(axis=1)
    height = blocks[np.arange(len(blocks)), place]
    block = np.flatnonzero(np.isfinite(height))
    across = padded.shape[1] // side
    return (block // across * side + place[block] // side, block % across * side + place[block] % side,
            height[block])


def _bilinear(row: np.ndarray, column: np.ndarray, rows: int, columns: int) -> csc_matrix:
    """Matrix that takes knot values to heights at positions counted in knots."""
    top = np.clip(row.astype(np.int64), 0, rows - 2)
    left = np.clip(column.astype(np.int64), 0, columns - 2)
    v, u = row - top, column - left
    index = np.concatenate([(top + i) * columns + left + j for i in (0, 1) for j in (0, 1)])
    weight = np.concatenate([(v if i else 1 - v) * (u if j else 1 - u) for i in (0, 1) for j in (0, 1)])
    points = np.tile(np.arange(len(row)), 4)
    return coo_matrix((weight, (points, index)), shape=(len(row), rows * columns)).tocsc()


def _plate(rows: int, columns: int) -> csc_matrix:
    """Bending energy of the plate: squared second differences along rows, columns and diagonals."""
    number = np.arange(rows * columns).reshape(rows, columns)
    terms = [([number[:, :-2], number[:, 1:-1], number[:, 2:]], (1.0, -2.0, 1.0)),
             ([number[:-2], number[1:-1], number[2:]], (1.0, -2.0, 1.0)),
             ([number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]],
              tuple(np.sqrt(2) * np.array((1.0, -1.0, -1.0, 1.0))))]
    energy = csc_matrix((rows * columns, rows * columns))
    for knots, factors in terms:
        count = knots[0].size
        if not count:
            continue
        matrix = coo_matrix((np.repeat(factors, count),
                             (np.tile(np.arange(count), len(knots)), np.concatenate([k.ravel() for k in knots]))),
                            shape=(count, rows * columns)).tocsc()
        energy = energy + matrix.T @ matrix
    # A whisper of a tie to the base keeps the system solvable where fewer than three blocks have points.
    return STIFFNESS * energy + 1e-9 * diags(np.ones(rows * columns))
