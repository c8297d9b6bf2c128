"""The 2.5D Delaunay surface (J 3.2.1.1, 4.1): points triangulated in plan, heights carried along.

One triangulation of millions of points is slow, so the plane is cut into blocks. A Delaunay triangle depends
on nothing outside its circumcircle: every triangle of circumradius up to `radius` whose circumcentre lies in
a block is found from the points of the block and a margin of `radius`. These are exactly the triangles of
that size of the one global triangulation, each found in exactly one block. What they leave uncovered (across
water, courtyards without returns, along the outer border) is closed by one triangulation of the few points
on its rim. The result is the global Delaunay triangulation, wherever the cuts lie.

Plan coordinates are rounded to a lattice of about a millimetre for the triangulation only, so that its
orientation tests are exact.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from scipy.spatial import Delaunay, QhullError

from ..errors import InsufficientDataError
from ..geometry.linked_groups import linked_groups
from ..geometry.tolerances import LEAST_SQUARE
from ..wording import say

_BLOCK_POINTS = 12_000
_LATTICE_BITS = 18
# Seams run beside round coordinates: points of a regular raster have circumcentres there, and a centre on a
# seam could be claimed twice.
_SEAM_SHIFT = 0.38196601


@dataclass(frozen=True)
class Blocks:
    """How the plane is cut: the same for a whole data set, so that results do not depend on tiles.

    Parameters
    ----------
    side : side of a square block, m.
    radius : largest circumradius found inside blocks, m.
    scale : lattice steps a metre, a power of two.
    """

    side: float
    radius: float
    scale: float

    @classmethod
    def for_spacing(cls, spacing: float) -> Blocks:
        """Blocks for points about `spacing` metres apart."""
        side = float(math.ceil(spacing * math.sqrt(_BLOCK_POINTS)))
        radius = 7.0 * spacing
        scale = 2.0 ** math.floor(_LATTICE_BITS - math.log2(side + 2 * radius))
        return cls(side, radius, scale)

    def box(self, column: int, row: int) -> tuple[float, float, float, float]:
        """(x_min, y_min, x_max, y_max) of a block, metres."""
        x, y = (column + _SEAM_SHIFT) * self.side, (row + _SEAM_SHIFT) * self.side
        return x, y, x + self.side, y + self.side

    def of(self, x: float, y: float) -> tuple[int, int]:
        """Column and row of the block that holds a point."""
        return (math.floor(x / self.side - _SEAM_SHIFT), math.floor(y / self.side - _SEAM_SHIFT))


def highest_in_cells(cell_of_point: np.ndarray, z: np.ndarray, cells: int,
                     tie: tuple[np.ndarray, np.ndarray] | None = None) -> np.ndarray:
    """Indices of the highest point of each occupied cell, ascending by cell.

    Parameters
    ----------
    cell_of_point : (n,) cell number of each point, below `cells`.
    z : (n,) heights.
    tie : (x, y) of the points; of points equally high the one with the smaller x, then y, is taken, so that the order
        of the points does not matter. Without it the first one is taken.
    """
    top = extreme_in_cells(cell_of_point, z, cells, highest=True)
    winner = np.flatnonzero(z == top[cell_of_point])
    if tie is not None:
        order = np.lexsort((tie[1][winner], tie[0][winner], cell_of_point[winner]))
    else:
        order = np.argsort(cell_of_point[winner], kind="stable")
    winner = winner[order]
    cell = cell_of_point[winner]
    first = np.ones(len(cell), dtype=bool)
    first[1:] = cell[1:] != cell[:-1]
    return winner[first]


def extreme_in_cells(cell_of_point: np.ndarray, z: np.ndarray, cells: int, highest: bool) -> np.ndarray:
    """Highest (or lowest) height in each cell, (cells,); -inf (or inf) where there is no point.

    Each pass writes all candidates, of which one stays; those that beat it go into the next pass. That halves
    the candidates, and is several times faster than sorting or `ufunc.at`. Points that follow each other in one cell,
    as scan lines have them, are taken together first.
    """
    best = np.full(cells, -np.inf if highest else np.inf, dtype=z.dtype)
    cell, height = _runs(cell_of_point, z, highest)
    while len(cell):
        best[cell] = height
        beats = height > best[cell] if highest else height < best[cell]
        cell, height = cell[beats], height[beats]
    return best


def _runs(cell: np.ndarray, z: np.ndarray, highest: bool) -> tuple[np.ndarray, np.ndarray]:
    """Cell and extreme height of each run of points in the same cell, where runs make far fewer candidates."""
    if len(cell) < 2:
        return cell, z
    starts = np.flatnonzero(cell[1:] != cell[:-1]) + 1
    if len(starts) > 0.7 * len(cell):
        return cell, z
    starts = np.concatenate([[0], starts])
    return cell[starts], (np.maximum if highest else np.minimum).reduceat(z, starts)


def block_triangles(x: np.ndarray, y: np.ndarray, blocks: Blocks, column: int, row: int) -> np.ndarray:
    """Global Delaunay triangles up to `blocks.radius` whose circumcentre lies in one block.

    Parameters
    ----------
    x, y : (n,) all points of the block and of a margin of `blocks.radius` round it; more do no harm but cost
        time. Metres.

    Returns
    -------
    (m, 3) indices into the points, counter-clockwise.
    """
    x_min, y_min, x_max, y_max = blocks.box(column, row)
    origin_x = math.floor((x_min - blocks.radius) * blocks.scale)
    origin_y = math.floor((y_min - blocks.radius) * blocks.scale)
    qx = np.rint(x * blocks.scale) - origin_x
    qy = np.rint(y * blocks.scale) - origin_y
    extent = math.ceil((blocks.side + 2 * blocks.radius) * blocks.scale) + 2
    near = np.flatnonzero((qx >= 0) & (qx <= extent) & (qy >= 0) & (qy <= extent))
    if len(near) < 3:
        return np.empty((0, 3), dtype=np.int64)
    qx, qy = qx[near], qy[near]
    triangles = _delaunay_of_lattice(qx, qy, extent)
    cx, cy, r = circumcircles(qx, qy, triangles)
    cx, cy, r = ((cx + origin_x) / blocks.scale, (cy + origin_y) / blocks.scale, r / blocks.scale)
    keep = ((r <= blocks.radius) & (cx >= x_min) & (cx < x_max) & (cy >= y_min) & (cy < y_max))
    return near[triangles[keep]]


def _delaunay_of_lattice(qx: np.ndarray, qy: np.ndarray, extent: int) -> np.ndarray:
    """Delaunay triangles (m, 3) of points with whole coordinates 0 to `extent`, counter-clockwise."""
    # A walk along a serpentine of strips keeps each insertion next to the one before.
    strips = max(1, int(math.sqrt(len(qx) / 4)))
    strip = (qy * (strips / (extent + 1))).astype(np.int64)
    order = np.lexsort((np.where(strip % 2 == 0, qx, -qx), strip))
    subdivision = cv2.Subdiv2D((-1, -1, extent + 3, extent + 3))
    subdivision.insert(np.column_stack((qx[order], qy[order])).astype(np.float32))
    corners = subdivision.getTriangleList()
    if corners is None or not len(corners):
        return np.empty((0, 3), dtype=np.int64)
    corners = corners.reshape(-1, 3, 2).astype(np.int64)
    key = qx.astype(np.int64) * (extent + 1) + qy.astype(np.int64)
    by_key = np.argsort(key, kind="stable")
    triangles = by_key[np.searchsorted(key[by_key], corners[..., 0] * (extent + 1) + corners[..., 1])]
    return _counter_clockwise(qx, qy, triangles)


def _counter_clockwise(x: np.ndarray, y: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Triangles turned counter-clockwise; those without area are dropped."""
    a, b, c = triangles.T
    twice_area = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    turned = np.where((twice_area < 0)[:, None], triangles[:, ::-1], triangles)
    return turned[twice_area != 0]


def circumcircles(x: np.ndarray, y: np.ndarray,
                  triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circumcentre x, y and circumradius of each triangle, (m,) each."""
    a, b, c = triangles.T
    bx, by, cx, cy = x[b] - x[a], y[b] - y[a], x[c] - x[a], y[c] - y[a]
    b2, c2 = bx * bx + by * by, cx * cx + cy * cy
    with np.errstate(divide="ignore", invalid="ignore"):
        d = 0.5 / (bx * cy - by * cx)
        ux, uy = (cy * b2 - by * c2) * d, (bx * c2 - cx * b2) * d
    return x[a] + ux, y[a] + uy, np.hypot(ux, uy)


def open_edges(triangles: np.ndarray) -> np.ndarray:
    """Directed edges (k, 2) of counter-clockwise triangles that no other triangle shares."""
    if not len(triangles):
        return np.empty((0, 2), dtype=np.int64)
    # Most corners are closed round: the sides opposite to them form rings, along which any numbers given to the
    # corners cancel. Only edges between two corners where they do not need to be looked at. The numbers are
    # scattered (squares), so that they do not cancel by chance, and whole, so that they cancel exactly.
    number = np.arange(int(triangles.max()) + 1) * 2_654_435_761 % 2_147_483_648
    number = (number * number % 17_592_186_044_399).astype(float)
    a, b, c = triangles.T
    balance = np.bincount(a, number[b] - number[c], len(number))
    balance += np.bincount(b, number[c] - number[a], len(number))
    balance += np.bincount(c, number[a] - number[b], len(number))
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    is_open = balance != 0
    return cancel_twins(edges[is_open[edges[:, 0]] & is_open[edges[:, 1]]])


def cancel_twins(edges: np.ndarray) -> np.ndarray:
    """Directed edges (k, 2) without those that also occur in the other direction."""
    if not len(edges):
        return edges
    low, high = edges.min(axis=1), edges.max(axis=1)
    # Squares of fewer than 3,000 million corners fit: more were never in memory.
    key = low.astype(np.uint64) * np.uint64(int(high.max()) + 1) + high.astype(np.uint64)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    same = ordered[1:] == ordered[:-1]
    paired = np.zeros(len(edges), dtype=bool)
    paired[1:] |= same
    paired[:-1] |= same
    return edges[np.sort(order[~paired])]


def bridge(x: np.ndarray, y: np.ndarray, rim: np.ndarray) -> np.ndarray:
    """Triangles that close what the small triangles leave uncovered inside the convex hull.

    Parameters
    ----------
    x, y : (n,) the corners of all open edges, and all points without a triangle.
    rim : (k, 2) open directed edges as indices into the points; the covered side is on their left.

    Returns
    -------
    (m, 3) counter-clockwise indices: the Delaunay triangles of the points that lie outside the covered side.
    """
    if len(x) < 3:
        return np.empty((0, 3), dtype=np.int64)
    try:
        triangulation = Delaunay(np.column_stack((x - x.mean(), y - y.mean())), qhull_options="Qbb Qc Qz Q12")
    except QhullError:  # all points on one line: there is nothing to close
        return np.empty((0, 3), dtype=np.int64)
    corners = triangulation.simplices.astype(np.int64)
    a, b, c = corners.T
    area = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    corners = np.where((area < 0)[:, None], corners[:, ::-1], corners)
    if not len(rim):
        return corners[area != 0]
    return corners[_outside(corners, rim, len(x)) & (area != 0)]


def _outside(corners: np.ndarray, rim: np.ndarray, points: int) -> np.ndarray:
    """Which triangles can be reached from the open side of the rim without crossing it, (m,) bool."""
    edges = corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(corners)), 3)
    forward = edges[:, 0] * points + edges[:, 1]
    backward = edges[:, 1] * points + edges[:, 0]
    rim_forward = rim[:, 0] * points + rim[:, 1]
    rim_backward = rim[:, 1] * points + rim[:, 0]
    on_rim = np.isin(forward, rim_forward) | np.isin(forward, rim_backward)
    order = np.argsort(forward)
    place = np.minimum(np.searchsorted(forward[order], backward), len(forward) - 1)
    has_twin = forward[order][place] == backward
    joined = has_twin & ~on_rim
    _, label = linked_groups(owner[joined], owner[order[place[joined]]], len(corners))
    open_side = np.unique(label[owner[np.isin(forward, rim_backward)]])
    covered_side = np.unique(label[owner[np.isin(forward, rim_forward)]])
    return np.isin(label, np.setdiff1d(open_side, covered_side, assume_unique=True))


def triangulate(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Delaunay triangles of points in plan, in memory.

    Parameters
    ----------
    x, y : (n,) metres. Of points within a lattice step (about a millimetre) of each other one is used.

    Returns
    -------
    (m, 3) counter-clockwise indices into the points; sides that are needed to make the hull convex included.

    Raises
    ------
    InsufficientDataError : fewer than three points, or all on one line.
    """
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    if len(x) < 3:
        raise InsufficientDataError(say("A surface needs at least three points: check the input's extent."))
    blocks = Blocks.for_spacing(typical_spacing(x, y))
    parts, edge_parts = [np.empty((0, 3), dtype=np.int64)], [np.empty((0, 2), dtype=np.int64)]
    reach = blocks.radius
    first = blocks.of(float(x.min()) - reach, float(y.min()) - reach)
    last = blocks.of(float(x.max()) + reach, float(y.max()) + reach)
    for column, row, points in points_of_blocks(x, y, blocks, first, last):
        corners = block_triangles(x[points], y[points], blocks, column, row)
        parts.append(points[corners])
        edge_parts.append(points[open_edges(corners)])
    small = np.concatenate(parts)
    edges = cancel_twins(np.concatenate(edge_parts))
    unused = np.ones(len(x), dtype=bool)
    unused[small] = False
    members = np.union1d(edges, np.flatnonzero(unused))
    large = members[bridge(x[members], y[members], np.searchsorted(members, edges))]
    triangles = np.concatenate((small, large))
    if not len(triangles):
        raise InsufficientDataError(say("All points lie on one line: a surface cannot be built from them."))
    return triangles


def typical_spacing(x: np.ndarray, y: np.ndarray) -> float:
    """Distance between neighbouring points, m, from the share of a coarse grid that they occupy."""
    width, height = float(np.ptp(x)), float(np.ptp(y))
    cell = max(math.sqrt(max(width * height, LEAST_SQUARE) / len(x)), max(width, height) / len(x), 1e-3) * 4
    column = np.floor((x - x.min()) / cell).astype(np.int64)
    row = np.floor((y - y.min()) / cell).astype(np.int64)
    columns = int(column.max()) + 1
    occupied = np.count_nonzero(np.bincount(row * columns + column))
    return cell * math.sqrt(occupied / len(x))


def points_of_blocks(x: np.ndarray, y: np.ndarray, blocks: Blocks, first: tuple[int, int],
                     last: tuple[int, int]) -> Iterator[tuple[int, int, np.ndarray]]:
    """Yield (column, row, point indices with margin) of each block from `first` to `last` that has points."""
    (first_column, first_row), (last_column, last_row) = first, last
    row_order = np.argsort(y, kind="stable")
    sorted_y = y[row_order]
    for row in range(first_row, last_row + 1):
        _x, y_min, _x2, y_max = blocks.box(0, row)
        start, stop = np.searchsorted(sorted_y, (y_min - blocks.radius - 0.01, y_max + blocks.radius + 0.01))
        band = row_order[start:stop]
        if not len(band):
            continue
        band = band[np.argsort(x[band], kind="stable")]
        sorted_x = x[band]
        for column in range(first_column, last_column + 1):
            x_min, _y, x_max, _y2 = blocks.box(column, row)
            left, right = np.searchsorted(sorted_x,
                                          (x_min - blocks.radius - 0.01, x_max + blocks.radius + 0.01))
            if right - left >= 3:
                yield column, row, band[left:right]
