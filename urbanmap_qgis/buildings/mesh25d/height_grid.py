"""Heights of a building's top surface on a grid, cut into surfaces where they step (J 5.7)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from scipy import ndimage

from ...errors import InsufficientDataError
from ...geometry.grid import Grid
from ...geometry.linked_groups import linked_groups
from ...wording import say

MIN_CELL = 0.2
MAX_CELL = 1.0
LAYER = 0.3  # Points this far below the highest of their cell (m) lie on the same surface.
MAX_ITERATIONS = 20

MIN_POINTS = 20
"""Points that a mesh needs at least."""


@dataclass(frozen=True, eq=False)
class HeightGrid:
    """The top surface on a grid that covers a building's plan with a margin.

    Attributes
    ----------
    grid : its place.
    z : (rows, columns) heights, m, without gaps.
    measured : cells with points of that surface.
    label : (rows, columns) number of the surface, from 0.
    plan : the building's plan.
    """

    grid: Grid
    z: np.ndarray
    measured: np.ndarray
    label: np.ndarray
    plan: shapely.Geometry


def cell_size(points: np.ndarray, area: float) -> float:
    """Side of a cell (m) that holds about one of points (n, 3) on an area (m2)."""
    return float(np.clip(math.sqrt(area / max(len(points), 1)), MIN_CELL, MAX_CELL))


def height_grid(points: np.ndarray, plan: shapely.Geometry, step: float, min_area: float) -> HeightGrid:
    """Grid the top surface of points (n, 3), m, and cut it where neighbouring cells differ by more than `step` (m).

    Surfaces smaller than `min_area` (m2) count as the one beside them that is nearest in height; their own heights
    are taken from there.

    Raises
    ------
    InsufficientDataError : fewer than 20 points.
    """
    if len(points) < MIN_POINTS:
        raise InsufficientDataError(say("only {points_count} points lie in it", points_count=len(points)))
    cell = cell_size(points, plan.area)
    x_min, y_min, x_max, y_max = plan.bounds
    grid = Grid.covering(x_min - 2 * cell, y_min - 2 * cell, x_max + 2 * cell, y_max + 2 * cell, cell)
    z = _top_heights(points, grid)
    measured = np.isfinite(z)
    if not measured.any():
        raise InsufficientDataError(say("none of its points lies on its outline"))
    inside = _inside(plan, grid)
    for _ in range(MAX_ITERATIONS):
        filled = _filled(z)
        label = _surfaces(filled, max(step, 1.5 * cell))
        small = _small(label, inside & np.isfinite(z), min_area / cell**2)
        if not small.any():
            break
        # A small piece goes to the surface around it: its heights are forgotten and filled from beside.
        z = np.where(small, np.nan, z)
        if not np.isfinite(z).any():
            z = _top_heights(points, grid)
            label = np.zeros(grid.shape, np.int64)
            break
    return HeightGrid(grid, _filled(z), np.isfinite(z), _without_corner_contacts(label), plan)


def _top_heights(points: np.ndarray, grid: Grid) -> np.ndarray:
    """Median of the uppermost layer of points in each cell, (rows, columns), NaN without points."""
    row, column, inside = grid.cells(points[:, 0], points[:, 1])
    cell = (row * grid.columns + column)[inside]
    z = points[inside, 2]
    top = np.full(grid.rows * grid.columns, -np.inf)
    np.maximum.at(top, cell, z)
    upper = z > top[cell] - LAYER
    cell, z = cell[upper], z[upper]
    order = np.lexsort((z, cell))
    cell, z = cell[order], z[order]
    heights = np.full(grid.rows * grid.columns, np.nan)
    if len(cell):
        names, start, count = np.unique(cell, return_index=True, return_counts=True)
        heights[names] = (z[start + (count - 1) // 2] + z[start + count // 2]) / 2
    return heights.reshape(grid.shape)


def _inside(plan: shapely.Geometry, grid: Grid) -> np.ndarray:
    """Cells whose centres lie in the plan."""
    x, y = np.meshgrid(*grid.centres())
    shapely.prepare(plan)
    return shapely.contains_xy(plan, x, y)


def _filled(z: np.ndarray) -> np.ndarray:
    """Heights with gaps filled from the nearest cell."""
    place = ndimage.distance_transform_edt(np.isnan(z), return_distances=False, return_indices=True)
    return z[tuple(place)]


def _surfaces(z: np.ndarray, step: float) -> np.ndarray:
    """Number of the surface of each cell: neighbours whose heights differ by up to `step` belong together."""
    number = np.arange(z.size).reshape(z.shape)
    links = []
    for near, far in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        alike = np.abs(z[near] - z[far]) <= step
        links.append(np.stack([number[near][alike], number[far][alike]]))
    one, two = np.concatenate(links, axis=1)
    return linked_groups(one, two, z.size)[1].reshape(z.shape)


def _small(label: np.ndarray, counted: np.ndarray, least: float) -> np.ndarray:
    """Measured cells of surfaces with fewer than `least` of them; never of the largest."""
    size = np.bincount(label[counted], minlength=label.max() + 1)
    small = size < least
    small[size.argmax()] = False
    return small[label] & counted


def _without_corner_contacts(label: np.ndarray) -> np.ndarray:
    """Labels without cells that touch others of their surface only at a corner, and numbered from 0."""
    label = label.copy()
    for _ in range(MAX_ITERATIONS):
        a, b, c, d = label[:-1, :-1], label[:-1, 1:], label[1:, :-1], label[1:, 1:]
        # Two surfaces crosswise, or four: the lower right cell joins its left neighbour.
        cross = ((a == d) & (b != a) & (c != a)) | ((b == c) & (a != b) & (d != b))
        cross |= (a != b) & (a != c) & (b != d) & (c != d)
        if not cross.any():
            break
        rows, columns = np.nonzero(cross)
        label[rows + 1, columns + 1] = label[rows + 1, columns]
    return np.unique(label, return_inverse=True)[1].reshape(label.shape)
