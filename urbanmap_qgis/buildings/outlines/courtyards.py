"""Courtyards that the official outlines leave out: found by the ground seen inside a building.

Rough outlines often lose their courtyards (J 5.3.1: "2D map only provides a footprint"). Laser points on the ground
well inside an outline show them.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from scipy import ndimage

from ...errors import InsufficientDataError
from ...geometry.grid import Grid
from ..point_assignment import PlanIndex
from ..polygons.outline_from_points import outline_from_points

LEAST_AREA = 16.0  # Area (m2) of the smallest courtyard.
LEAST_WIDTH = 2.5  # Width (m) of the narrowest courtyard.
# Share of a cell's points that must lie on the ground: trees may stand in a courtyard, roofs let nothing
# through.
LOW_SHARE = 0.3
POINTS_PER_CELL = 4.0

INSIDE = 1.5
"""Distance (m) from the outline within which ground is that of the street: outlines are not exact."""


def with_courtyards(outlines: np.ndarray, x: np.ndarray, y: np.ndarray, low: np.ndarray,
                    density: float) -> np.ndarray:
    """The outlines (k,), with the courtyards cut out that show in the points.

    Parameters
    ----------
    outlines : polygons at their right places; missing ones stay missing.
    x, y : (n,) all points.
    low : (n,) bool, whether a point lies on the ground.
    density : points a m2.
    """
    result = outlines.copy()
    on_ground = np.flatnonzero(low)
    ground_index, index = PlanIndex(x[on_ground], y[on_ground]), None
    cell = max(math.sqrt(POINTS_PER_CELL / density), 0.5)
    least = LEAST_AREA / cell**2
    for row in np.flatnonzero(~shapely.is_missing(outlines)):
        inner = shapely.buffer(outlines[row], -INSIDE)
        if inner.area < LEAST_AREA:
            continue
        if len(ground_index.inside(inner)) < least:  # at least one point in each cell of the smallest courtyard
            continue
        index = index or PlanIndex(x, y)
        near = index.inside(inner)
        courts = _courtyards(inner, x[near], y[near], low[near], cell)
        if courts:
            result[row] = shapely.difference(outlines[row], shapely.union_all(courts), grid_size=0.001)
    return result


def _courtyards(inner: shapely.Geometry, x: np.ndarray, y: np.ndarray, low: np.ndarray,
                cell: float) -> list[shapely.Geometry]:
    """Polygons of the courtyards among points (n,) well inside one outline."""
    grid = Grid.covering(*inner.bounds, cell)
    row, column, _ = grid.cells(x, y)
    place = row * grid.columns + column
    size = grid.rows * grid.columns
    count, below = np.bincount(place, minlength=size), np.bincount(place[low], minlength=size)
    is_open = ((below > 0) & (below >= LOW_SHARE * count)).reshape(grid.shape)
    side = max(math.ceil(LEAST_WIDTH / cell), 1)
    is_open = ndimage.binary_opening(ndimage.binary_closing(np.pad(is_open, side), np.ones((2, 2))),
                                     np.ones((side, side)))[side:-side, side:-side]
    label, number = ndimage.label(is_open)
    of_point = label.ravel()[place]
    courts = []
    for court in range(1, number + 1):
        area = np.count_nonzero(label == court) * cell**2
        members = low & (of_point == court)
        if area < LEAST_AREA:
            continue
        try:
            drawn = outline_from_points(x[members], y[members], np.count_nonzero(members) / area)
        except InsufficientDataError:
            continue  # too few points to draw its walls: it stays covered
        courts.extend(part for part in shapely.get_parts(shapely.intersection(drawn.outline, inner))
                      if part.geom_type == "Polygon" and part.area >= LEAST_AREA)
    return courts
