"""Which building a laser point belongs to, also where expanded outlines overlap (J 5.3.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ..io.points.point_buckets import stable_order

INDEX_CELL = 8.0
"""Side (m) of the cells that points are sorted into to find those near an outline."""

MIN_CORE_POINTS = 3
"""Uncontested points that a building needs before its surface can claim contested ones."""


@dataclass(frozen=True)
class Assignment:
    """Owners of points.

    Attributes
    ----------
    owner : (n,) row of the building that each point belongs to, -1 for none.
    primary : (n,) whether the point lies inside its owner's outline itself, not only the expanded one.
    """

    owner: np.ndarray
    primary: np.ndarray


class PlanIndex:
    """Points sorted into square cells, so that those in a box are found without a search of all."""

    def __init__(self, x: np.ndarray, y: np.ndarray):
        self.x, self.y = x, y
        self._x0, self._y0 = (x.min(), y.min()) if len(x) else (0.0, 0.0)
        column = ((x - self._x0) // INDEX_CELL).astype(np.int64)
        row = ((y - self._y0) // INDEX_CELL).astype(np.int64)
        self._columns = int(column.max(initial=0)) + 1
        self._rows = int(row.max(initial=0)) + 1
        cell = row * self._columns + column
        self._order = stable_order(cell)
        self._starts = np.r_[0, np.cumsum(np.bincount(cell, minlength=self._rows * self._columns))]

    def _near(self, x_min: float, y_min: float, x_max: float, y_max: float) -> np.ndarray:
        """Numbers of the points in the cells that the box touches, cell after cell."""
        left = max(int((x_min - self._x0) // INDEX_CELL), 0)
        right = min(int((x_max - self._x0) // INDEX_CELL), self._columns - 1)
        bottom = max(int((y_min - self._y0) // INDEX_CELL), 0)
        top = min(int((y_max - self._y0) // INDEX_CELL), self._rows - 1)
        if right < left or top < bottom:
            return np.zeros(0, np.int64)
        rows = np.arange(bottom, top + 1) * self._columns
        pieces = [self._order[a:b] for a, b in zip(self._starts[rows + left], self._starts[rows + right + 1])]
        return np.concatenate(pieces)

    def inside(self, polygon: shapely.Geometry) -> np.ndarray:
        """Ascending numbers of the points inside a polygon."""
        near = self._near(*polygon.bounds)
        if not len(near):
            return near
        shapely.prepare(polygon)
        return np.sort(near[shapely.contains_xy(polygon, self.x[near], self.y[near])])


def assign_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, outlines: np.ndarray,
                  expansion: float) -> Assignment:
    """Give each point (n,) to one building at most.

    A point in one expanded outline only is that building's. Where several claim it, it goes to the building
    whose own surface is nearest to it in space, that is, nearest to those points in the building's outline
    that no other building claims. An eave that hangs over a lower neighbour so stays with its own roof.

    Parameters
    ----------
    x, y, z : (n,) coordinates, m.
    outlines : (k,) Polygon or MultiPolygon; missing ones own nothing.
    expansion : m by which the outlines are expanded.
    """
    index = PlanIndex(x, y)
    rows = np.flatnonzero(~shapely.is_missing(outlines))
    expanded = shapely.buffer(outlines[rows], expansion, join_style="mitre")
    members = [index.inside(polygon) for polygon in expanded]
    starts = np.cumsum([0, *map(len, members)])
    point = np.concatenate([*members, np.zeros(0, np.int64)])
    building = np.repeat(rows, np.diff(starts))
    primary = np.zeros(len(point), bool)
    for row, start, end in zip(rows, starts, starts[1:]):
        shapely.prepare(outlines[row])
        primary[start:end] = shapely.contains_xy(outlines[row], x[point[start:end]], y[point[start:end]])
    contested = np.bincount(point, minlength=len(x))[point] > 1
    won = ~contested
    won[_nearest_surface(np.column_stack([x, y, z]), point, primary, contested, starts)] = True
    owner = np.full(len(x), -1, np.int64)
    in_primary = np.zeros(len(x), bool)
    owner[point[won]] = building[won]
    in_primary[point[won]] = primary[won]
    return Assignment(owner, in_primary)


def points_in_expanded(x: np.ndarray, y: np.ndarray, outlines: np.ndarray,
                       expansion: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All points within each expanded outline (J 5.3.1, to the letter): a point in several is taken for each.

    Returns the numbers of the points (c,), the row of the building that takes each (c,), building after building,
    and whether the point lies in the primary outline (c,).
    """
    index = PlanIndex(x, y)
    rows = np.flatnonzero(~shapely.is_missing(outlines))
    members = [index.inside(polygon) for polygon in shapely.buffer(outlines[rows], expansion, join_style="mitre")]
    primary = []
    for row, inside in zip(rows, members):
        shapely.prepare(outlines[row])
        primary.append(shapely.contains_xy(outlines[row], x[inside], y[inside]))
    building = np.repeat(rows, [len(inside) for inside in members])
    return (np.concatenate([*members, np.zeros(0, np.int64)]), building,
            np.concatenate([*primary, np.zeros(0, bool)]))


def _nearest_surface(place: np.ndarray, point: np.ndarray, primary: np.ndarray, contested: np.ndarray,
                     starts: np.ndarray) -> np.ndarray:
    """Claims that win the contested points, one for each of those points.

    `place` (n, 3); `point`, `primary` and `contested` (c,) describe the claims, which lie building after
    building: those of the k-th from starts[k] to starts[k + 1].
    """
    distance = np.full(len(point), np.inf)
    for start, end in zip(starts, starts[1:]):
        claim = start + np.flatnonzero(contested[start:end])
        rows = np.arange(start, end)[primary[start:end]]
        core = rows[~contested[rows]]
        if len(core) < MIN_CORE_POINTS:
            core = rows
        if len(core) and len(claim):
            # An unbalanced tree is made in half the time, and gives the same distances.
            tree = cKDTree(place[point[core]], balanced_tree=False, compact_nodes=False)
            distance[claim] = tree.query(place[point[claim]])[0]
    claim = np.flatnonzero(contested)
    order = claim[np.lexsort((claim, ~primary[claim], distance[claim], point[claim]))]
    return order[np.unique(point[order], return_index=True)[1]]
