"""What the cloud is like about each outline: its density, told by what stands round it, and where it ends.

A building whose points are missing in part tells nothing of the density of its cloud; ground and roofs round it do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.ndimage import distance_transform_edt

from ...geometry.grid import Grid

POINTS_PER_CELL = 8.0  # Pulses a cell on average.
LEAST_CELL = 1.0  # Least side (m) of a cell.
REACH = 20.0  # Distance (m) beyond an outline within which the density is told.
LEAST_CELLS = 12  # Cells with points from which a density is told; from fewer that of all round is taken.
# Width (m) of a gap in the cloud up to which it is not the cloud's edge: streets of clouds of buildings alone,
# a shadow, a canal.
GAP = 40.0
TRIMMED = 0.25  # Share of the fullest and of the emptiest cells that a density leaves out.


@dataclass(frozen=True)
class CloudCover:
    """The cloud about each of n outlines.

    Attributes
    ----------
    density : (n,) pulses a m2 within `REACH` of the outline, its own points left out; NaN where there are none.
    beyond : (n,) share of the outline that lies beyond the cloud's edge; NaN where it is not known.
    """

    density: np.ndarray
    beyond: np.ndarray

    @classmethod
    def of(cls, density: np.ndarray | None, beyond: np.ndarray | None) -> CloudCover | None:
        """Of the columns of a layer; None where it lacks one."""
        return None if density is None or beyond is None else cls(density, beyond)

    def select(self, rows: np.ndarray) -> CloudCover:
        """That of some of the outlines."""
        return CloudCover(self.density[rows], self.beyond[rows])

    def of_outline(self, row: int) -> tuple[float, float]:
        """Density and share of one outline."""
        return float(self.density[row]), float(self.beyond[row])

    @classmethod
    def unknown(cls, count: int) -> CloudCover:
        """Of `count` outlines nothing is known."""
        return cls(np.full(count, np.nan), np.full(count, np.nan))


def cloud_cover(x: np.ndarray, y: np.ndarray, last: np.ndarray, outlines: np.ndarray, density: float) -> CloudCover:
    """The cloud about outlines.

    Parameters
    ----------
    x, y : (n,) all points round the outlines, m, of any class.
    last : (n,) whether the point is the last of its pulse.
    outlines : (k,) Polygon or MultiPolygon; may be missing.
    density : points a m2 of the whole cloud, from which the cells are made.
    """
    found = CloudCover.unknown(len(outlines))
    known = np.flatnonzero(~shapely.is_missing(outlines))
    if not len(x) or not len(known):
        return found
    cell = max(math.sqrt(POINTS_PER_CELL / density), LEAST_CELL)
    margin = REACH + GAP
    bounds = shapely.total_bounds(outlines[known])
    grid = Grid.covering(*(bounds[:2] - margin), *(bounds[2:] + margin), cell)
    count, hit = _counts(grid, x[last], y[last]), _counts(grid, x, y) > 0
    ended = _ended(hit, cell)
    everywhere = _density(count[hit], cell)
    for row in known:
        found.density[row], found.beyond[row] = _of_outline(outlines[row], grid, count, ended, everywhere)
    return found


def _of_outline(outline: shapely.Geometry, grid: Grid, count: np.ndarray, ended: np.ndarray,
                everywhere: float) -> tuple[float, float]:
    """Density about an outline, and its share beyond the cloud's edge."""
    west, south, east, north = outline.bounds
    reach = REACH
    rows, columns, part = grid.window(west - reach, south - reach, east + reach, north + reach)
    x, y = np.meshgrid(*part.centres())
    shapely.prepare(outline)
    within = shapely.contains_xy(outline, x, y)
    near = distance_transform_edt(~within) * grid.cell if within.any() else np.zeros(within.shape)
    # A cell's breadth is left out as well: its cells are the building's in part.
    beside = (near > grid.cell) & (near <= reach) if within.any() else np.ones(within.shape, bool)
    around = count[rows, columns][beside]
    beyond = float(ended[rows, columns][within].mean()) if within.any() else 0.0
    return _density(around, grid.cell, everywhere), beyond


def _density(count: np.ndarray, cell: float, otherwise: float = float("nan")) -> float:
    """Mean pulses a m2 of the middle half of the cells that have any, or `otherwise` where they are few."""
    count = count[count > 0]
    if len(count) < LEAST_CELLS:
        return otherwise
    out = int(TRIMMED * len(count))  # at each end
    return float(np.sort(count)[out:len(count) - out].mean()) / cell**2


def _counts(grid: Grid, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Points in each cell."""
    row, column, inside = grid.cells(x, y)
    flat = row[inside] * grid.columns + column[inside]
    return np.bincount(flat, minlength=grid.rows * grid.columns).reshape(grid.shape)


def _ended(hit: np.ndarray, cell: float) -> np.ndarray:
    """Cells beyond the cloud's edge: those that closing the gaps between the cells with points does not reach."""
    if not hit.any():
        return np.ones(hit.shape, bool)
    half = 0.5 * GAP
    far = distance_transform_edt(~hit) * cell > half
    return distance_transform_edt(~far) * cell <= half if far.any() else np.zeros(hit.shape, bool)
