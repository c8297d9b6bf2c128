"""Roofs of one building from its points (J 5.3.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
import shapely

from ...errors import InputError
from ...geometry.tolerances import SIGMA_OF_MAD
from ...settings.buildings import RoofParameters
from ...wording import say
from .roof_levels import MAX_PARAPET_WIDTH, RoofLevels, roof_levels
from .roof_surface import NEIGHBOURHOOD, RoofSurface, roof_surface, sorted_within

OK, FEW_POINTS, NO_POINTS = "ok", "few points", "no roof points"
"""What `RoofSegmentation.status` can be."""

MIN_POINTS = 3
"""A building with fewer usable points gets no roof."""

POINTS_TO_DIVIDE = 12  # A building with fewer usable points gets one flat roof.
# Distance above or below the cells of a roof at which a point still belongs to it, m.
HEIGHT_TOLERANCE = 0.3
PARAPET_SLICE = 0.3  # Height range of the hits on the top of a parapet, m.
NOWHERE = -1e9  # Height of what is no roof, m.

PARAPET_SHARE = 0.15
"""Hits in that range for each cell of the roof's border strip that make a parapet."""

DEFAULTS = RoofParameters()


@dataclass(frozen=True)
class RoofTable:
    """One row for each roof, arrays (k,).

    Attributes
    ----------
    number : 1..k, from low to high.
    height : median height of the roof's points, m.
    height_max : height of its highest point, m (the roof height of J 5.3.2: the top of the parapet).
    points : number of points.
    area : area of its cells with points and of gaps of a cell between them, m2.
    density : points/m2 of that.
    rmse : root mean square distance of its points from `height`, m.
    """

    number: np.ndarray
    height: np.ndarray
    height_max: np.ndarray
    points: np.ndarray
    area: np.ndarray
    density: np.ndarray
    rmse: np.ndarray

    def __len__(self) -> int:
        return len(self.number)


NO_ROOFS = RoofTable(np.empty(0, np.int32), np.empty(0), np.empty(0), np.empty(0, np.int64), np.empty(0), np.empty(0),
                     np.empty(0))


@dataclass(frozen=True)
class RoofSegmentation:
    """Roofs of one building.

    Attributes
    ----------
    roof_of_point : (n,) int32 roof of each point, 0 = none (clutter, wall, tree, ground).
    roofs : the table of the roofs.
    status : OK, FEW_POINTS (one flat roof, from too few points to separate parts) or NO_POINTS (no roof).
    """

    roof_of_point: np.ndarray
    roofs: RoofTable
    status: str


def segment_roofs(x: np.ndarray, y: np.ndarray, z: np.ndarray, outline: shapely.Geometry, ground: float,
                  density: float, parameters: RoofParameters = DEFAULTS,
                  least_height: np.ndarray | None = None) -> RoofSegmentation:
    """Roofs of one building.

    The height histogram of J 5.3.2 gives the roofs of the paper. In plan they are cut into thin level pieces, and
    these are joined again, cheapest first, until the heights would be worse than `height_rmse`: so sloped roofs
    become a few level ones, a maximum of the histogram that is two roofs apart becomes two, and small roofs that
    the histogram's threshold drops stand out.

    Parameters
    ----------
    x, y, z : (n,) points of the building, m; may hold walls, roof furniture and some ground.
    outline : the primary (not expanded) outline, polygon or multipolygon.
    ground : height of the ground at the building, m.
    density : points/m2 of the cloud on roofs.
    least_height : (n,) height of each point above the ground from which it can be roof, m; `min_height` without it.

    Raises
    ------
    InputError : arrays of different lengths, coordinates, ground or density not finite.
    """
    x, y, z = (np.asarray(a, dtype=float) for a in (x, y, z))
    _check(x, y, z, ground, density)
    high = z >= ground + (parameters.min_height if least_height is None else least_height)
    usable = np.flatnonzero(high)
    surface = roof_surface(x[usable], y[usable], z[usable], outline, density)
    if len(usable) < MIN_POINTS:
        return RoofSegmentation(np.zeros(len(z), np.int32), NO_ROOFS, NO_POINTS)
    if len(usable) < POINTS_TO_DIVIDE:
        return _one_roof(z, usable, surface)
    plan = roof_levels(surface, z[usable], density, outline.area, parameters)
    of_point = roofs_of_points(plan, surface, z[usable], parameters)
    return _numbered(z, usable, surface, of_point, plan.labels, OK)


def _check(x: np.ndarray, y: np.ndarray, z: np.ndarray, ground: float, density: float) -> None:
    if not (x.shape == y.shape == z.shape and x.ndim == 1):
        raise InputError(say("The x, y and z of a building's points differ in number."))
    if not (np.isfinite(x).all() and np.isfinite(y).all() and np.isfinite(z).all()):
        raise InputError(say("Some coordinates of a building's points are not numbers: remove them."))
    if not (np.isfinite(density) and density > 0 and np.isfinite(ground)):
        raise InputError(say("A building's ground height and point density must be numbers, density above 0."))


def roofs_of_points(plan: RoofLevels, surface: RoofSurface, z: np.ndarray,
                    parameters: RoofParameters) -> np.ndarray:
    """Roof (n,) of each point of the raster, 0 for clutter.

    A point belongs to the roof of its cell if its height is in the range of that roof's cells; else to a roof
    beside it that has its height; else, up to a parapet's height above the border of its roof, it is the parapet.
    """
    low, high = _height_ranges(plan)
    labels = plan.labels.ravel()
    cell = surface.cell_of_point
    cell_roof = labels[cell]
    fits = (cell_roof > 0) & (z >= low[cell_roof]) & (z <= high[cell_roof])
    roof = np.where(fits, cell_roof, 0)

    rest = np.flatnonzero(~fits)
    columns = surface.grid.columns
    padded = np.pad(plan.labels, 1).ravel()
    at = (cell[rest] // columns + 1) * (columns + 2) + cell[rest] % columns + 1
    nearest = np.full(len(rest), np.inf)
    middle = np.where(low <= high, (low + high) / 2, NOWHERE)
    for shift in (-columns - 3, -columns - 2, -columns - 1, -1, 1, columns + 1, columns + 2, columns + 3):
        beside = padded[at + shift]
        distance = np.abs(z[rest] - middle[beside])
        better = (beside > 0) & (z[rest] >= low[beside]) & (z[rest] <= high[beside]) & (distance < nearest)
        roof[rest[better]] = beside[better]
        nearest[better] = distance[better]

    rest = rest[roof[rest] == 0]
    reach = math.ceil(MAX_PARAPET_WIDTH / 2 / surface.grid.cell)
    border = _drops_beside(plan.labels, middle, parameters.distinct_step, reach).ravel()
    cell_roof = labels[cell[rest]]
    above = z[rest] - high[cell_roof]
    candidate = border[cell[rest]] & (cell_roof > 0) & (above > 0) & (above <= parameters.max_parapet)
    border_cells = np.bincount(labels[border], minlength=len(low))
    top = _parapet_tops(cell_roof[candidate], above[candidate], border_cells)
    parapet = np.zeros(len(rest), dtype=bool)
    parapet[candidate] = above[candidate] <= top[cell_roof[candidate]]
    roof[rest[parapet]] = cell_roof[parapet]
    return roof


def _parapet_tops(roof: np.ndarray, above: np.ndarray, border_cells: np.ndarray) -> np.ndarray:
    """Top (k + 1,) of each roof's parapet, m above its height range; 0 where there is none.

    A parapet is level: enough of the points (n,) over the roof's border lie in one slice. Walls and furniture scatter.
    """
    order = np.lexsort((above, roof))
    roof, above = roof[order], above[order]
    # Roofs one after the other on one axis, so far apart that no slice reaches into the next.
    axis = roof * 1e3 + above
    count = np.searchsorted(axis, axis + PARAPET_SLICE, side="right") - np.arange(len(axis))
    level = count >= np.maximum(PARAPET_SHARE * border_cells[roof], MIN_POINTS)
    best = np.lexsort((count, roof))
    best = best[level[best]]
    top = np.zeros(len(border_cells))
    top[roof[best]] = above[best] + PARAPET_SLICE
    return top


def _height_ranges(plan: RoofLevels) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest height (k + 1,) that points of each roof have, m; 0 and unmeasured roofs have none."""
    use = plan.measured & (plan.labels > 0)
    label, height = plan.labels[use], plan.height[use]
    k = int(plan.labels.max(initial=0))
    distance = np.abs(height - _group_medians(label, height, k)[label])
    # Walls and clutter among the cells must not widen the range: nothing beyond three standard deviations counts.
    limit = np.maximum(3 * SIGMA_OF_MAD * _group_medians(label, distance, k), HEIGHT_TOLERANCE)
    typical = distance <= limit[label]
    low, high = np.full(k + 1, -NOWHERE), np.full(k + 1, NOWHERE)
    np.minimum.at(low, label[typical], height[typical] - HEIGHT_TOLERANCE)
    np.maximum.at(high, label[typical], height[typical] + HEIGHT_TOLERANCE)
    return low, high


def _group_medians(label: np.ndarray, value: np.ndarray, k: int) -> np.ndarray:
    """Lower median (k + 1,) of the values of each label, 0 for labels without any."""
    ordered = value[sorted_within(label, value)]
    n = np.bincount(label, minlength=k + 1)
    start = np.cumsum(n) - n
    median = np.zeros(k + 1)
    some = n > 0
    median[some] = ordered[(start + (n - 1) // 2)[some]]
    return median


def _drops_beside(labels: np.ndarray, middle: np.ndarray, step: float, reach: int) -> np.ndarray:
    """Cells of a roof with no roof or a roof lower by `step` m at most `reach` cells away."""
    height = np.where(labels > 0, middle[labels], NOWHERE)
    window = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
    lowest = cv2.erode(height, window, borderType=cv2.BORDER_CONSTANT, borderValue=NOWHERE)
    return (labels > 0) & (lowest <= height - step)


def _numbered(z: np.ndarray, usable: np.ndarray, surface: RoofSurface, of_point: np.ndarray, of_cell: np.ndarray,
              status: str) -> RoofSegmentation:
    """The result, with roofs numbered from low to high; `of_cell` (rows, columns) roof of each cell."""
    hit = np.zeros(surface.grid.shape, np.uint8)
    hit.ravel()[surface.cell_of_point[of_point > 0]] = 1
    of_cell = np.where(cv2.morphologyEx(hit, cv2.MORPH_CLOSE, NEIGHBOURHOOD) > 0, of_cell, 0)
    k = int(of_cell.max(initial=0))
    points = np.bincount(of_point, minlength=k + 1)
    order = sorted_within(of_point, z[usable])
    start = np.cumsum(points) - points
    sorted_z = z[usable][order]
    present = np.flatnonzero(points[1:] > 0) + 1
    first, last = start[present], start[present] + points[present] - 1
    height = (sorted_z[(first + last) // 2] + sorted_z[(first + last + 1) // 2]) / 2
    rank = np.argsort(height, kind="stable")
    present, height = present[rank], height[rank]
    number = np.zeros(k + 1, dtype=np.int32)
    number[present] = np.arange(1, len(present) + 1)

    of_point, of_cell = number[of_point], number[of_cell]
    height_of = np.r_[0.0, height]
    squares = np.bincount(of_point, (z[usable] - height_of[of_point])**2, len(present) + 1)[1:]
    points = points[present]
    cell_area = surface.grid.cell**2
    area = np.bincount(of_cell.ravel(), minlength=len(present) + 1)[1:] * cell_area
    table = RoofTable(np.arange(1, len(present) + 1, dtype=np.int32), height, sorted_z[last[rank]], points,
                      area, points / np.maximum(area, cell_area), np.sqrt(squares / points))
    roof_of_point = np.zeros(len(z), dtype=np.int32)
    roof_of_point[usable] = of_point
    return RoofSegmentation(roof_of_point, table, status)


def _one_roof(z: np.ndarray, usable: np.ndarray, surface: RoofSurface) -> RoofSegmentation:
    """One flat roof at the median height of the points, for want of more."""
    inner = surface.inside.ravel()[surface.cell_of_point]
    if inner.sum() < MIN_POINTS:
        inner = np.ones(len(usable), dtype=bool)
    near = np.abs(z[usable] - np.median(z[usable][inner])) <= 2 * HEIGHT_TOLERANCE
    if not near.any():
        near = inner
    return _numbered(z, usable, surface, near.astype(np.int64), np.ones(surface.grid.shape, np.int64), FEW_POINTS)
