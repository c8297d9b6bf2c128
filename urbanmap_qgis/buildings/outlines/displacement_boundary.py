"""Boundaries of many outlines as flat arrays, and sums of a raster over the moved outlines.

Green's theorem turns the sum over an outline's area into one along its boundary, over a raster added up along its
rows: the cost grows with the perimeter, and one outline can be tried at a hundred places at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.grid import Grid
from ...geometry.tolerances import ROUNDING, SAME_PLACE

FINE_PIECE, COARSE_PIECE = 0.1, 0.25  # m, longest piece of boundary taken as lying in one row of cells
LOOKUPS = 2_000_000  # raster lookups that are added up together: bounds the memory
CACHED = 30_000  # raster lookups whose arrays fit into the processor's cache


@dataclass(frozen=True)
class Edges:
    """Straight edges of all outlines, sorted by outline, the interior on the left of each.

    Attributes
    ----------
    owner : (m,) outline number.
    start, end : (m, 2) in m.
    """

    owner: np.ndarray
    start: np.ndarray
    end: np.ndarray


@dataclass(frozen=True)
class Pieces:
    """Short pieces of boundary, sorted by outline: owner (m,), x, y (m,) middle, dx, dy (m,) its vector, in m."""

    owner: np.ndarray
    x: np.ndarray
    y: np.ndarray
    dx: np.ndarray
    dy: np.ndarray


def edges_of(polygons: np.ndarray) -> Edges:
    """Edges of (multi)polygons (n,), interior on the left; empty or missing polygons give none."""
    rings, of_ring = _rings(polygons)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    same = ring[1:] == ring[:-1]
    start, end, ring = points[:-1][same], points[1:][same], ring[:-1][same]
    longer = np.hypot(*(end - start).T) > SAME_PLACE
    return Edges(of_ring[ring[longer]], start[longer], end[longer])


def _rings(polygons: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All rings, outer ones anticlockwise and holes clockwise, and the polygon each belongs to."""
    parts, of_part = shapely.get_parts(polygons, return_index=True)
    is_area = shapely.get_type_id(parts) == 3
    parts, of_part = parts[is_area], of_part[is_area]
    rings, of_ring = shapely.get_rings(parts, return_index=True)
    first = np.r_[True, of_ring[1:] != of_ring[:-1]] if len(of_ring) else np.zeros(0, bool)
    turn = shapely.is_ccw(rings) != first
    rings[turn] = shapely.reverse(rings[turn])
    return rings, of_part[of_ring]


def pieces_of(edges: Edges, longest: float = FINE_PIECE) -> Pieces:
    """The edges cut to pieces of at most `longest` m."""
    vector = edges.end - edges.start
    # The hair keeps rounding in the last digit from cutting one piece more.
    count = np.maximum(np.ceil(np.hypot(*vector.T) / longest - ROUNDING), 1).astype(np.int64)
    of = np.repeat(np.arange(len(count)), count)
    position = (np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[of]
    middle = edges.start[of] + position[:, None] * vector[of]
    step = vector[of] / count[of][:, None]
    return Pieces(edges.owner[of], middle[:, 0], middle[:, 1], step[:, 0], step[:, 1])


def row_sums(values: np.ndarray, cell: float) -> np.ndarray:
    """Integral of a raster along its rows, from the left edge to each column's edge: (rows, columns + 1)."""
    sums = np.zeros((values.shape[0], values.shape[1] + 1))
    np.cumsum(values, axis=1, dtype=np.float64, out=sums[:, 1:])
    return sums * cell


def sums_inside(pieces: Pieces, shifts: np.ndarray, sums: np.ndarray, grid: Grid) -> np.ndarray:
    """Integral of a raster over every outline at every one of its shifts, in m2 times the raster's unit.

    Parameters
    ----------
    shifts : (n, k, 2) in m.
    sums : the raster's `row_sums` on `grid`.
    """
    n, k = shifts.shape[:2]
    result = np.zeros((n, k))
    at_once = max(1, LOOKUPS // max(k, 1))
    for first in range(0, len(pieces.owner), at_once):
        part = Pieces(*(getattr(pieces, name)[first:first + at_once] for name in Pieces.__dataclass_fields__))
        starts = np.flatnonzero(np.r_[True, part.owner[1:] != part.owner[:-1]])
        # A few shifts at a time, so that the arrays stay in the processor's cache.
        several = max(1, CACHED // len(part.owner))
        for begin in range(0, k, several):
            shift = shifts[:, begin:begin + several].transpose(2, 1, 0)
            values = _along_boundary(part, shift[:, :, part.owner], sums, grid)
            result[part.owner[starts], begin:begin + several] += np.add.reduceat(values, starts, axis=1).T
    return result


def _along_boundary(pieces: Pieces, shift: np.ndarray, sums: np.ndarray, grid: Grid) -> np.ndarray:
    """Share (k, m) of each piece in the integral over its outline, at each of its shifts (2, k, m) in m."""
    row = np.floor((grid.y_max - pieces.y - shift[1]) / grid.cell).astype(np.int64)
    place = np.clip((pieces.x + shift[0] - grid.x_min) / grid.cell, 0, grid.columns)
    column = np.minimum(place.astype(np.int64), grid.columns - 1)
    place -= column
    inside = (row >= 0) & (row < grid.rows)
    flat = np.where(inside, row, 0) * sums.shape[1] + column
    left = sums.reshape(-1)[flat]
    flat += 1
    value = sums.reshape(-1)[flat]
    value -= left
    value *= place
    value += left
    value *= inside
    value *= pieces.dy
    return value
