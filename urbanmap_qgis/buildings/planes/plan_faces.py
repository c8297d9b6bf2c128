"""Faces that segments cut out of an outline, and the plane of each by a graph cut."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...execution import checkpoint
from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import say
from ..polygons.plan_arrangement import GRID, common_borders
from .alpha_expansion import expand_labels
from .label_raster import LabelRaster

SMOOTHNESS = 0.13
"""Cubic metres of misfit that a metre of border between two planes is worth."""

LEVEL_FAVOUR = 0.5  # A border where two planes meet at equal height costs this share of one with a step.
FULL_STEP = 0.3  # Step (m) from which a border costs all.
CAP = 2.0  # Heights farther off (m) cost no more: what lies there is not this roof.
UNSEEN_WEIGHT = 0.3  # Weight of a cell without points, which tells the plane of its nearest neighbour.
CLEARANCE = 0.3  # A roof more than this (m) above the highest point near it is not seen.
EXCESS_WEIGHT = 2.0  # Cost (m3) of a square metre of roof that stands a metre too high.
FAR = 6.0  # Metres from the places where a plane is seen up to which it may go on.

MOST_FACES = 40_000
"""Faces above which a plan is not divided: planes of noise or of trees, and no limit that a real roof meets."""

_AT_ONCE, _TABLE = 20_000, 1_000_000
"""Places that are looked up at once, and entries of the largest table that is made of them."""


@dataclass(frozen=True)
class PlanFaces:
    """Polygons (n,) without overlap that fill the outline; pairs (m, 2) of neighbours, their common borders' lengths
    (m,), m, and their ends (m, 2, 2), the longest piece of each."""

    polygons: np.ndarray
    pairs: np.ndarray
    length: np.ndarray
    border: np.ndarray


def plan_faces(outline: shapely.Geometry, segments: np.ndarray) -> PlanFaces:
    """Cut an outline by segments (m, 2, 2); loose ends cut nothing.

    Raises
    ------
    InsufficientDataError : the segments would cut more than about `MOST_FACES` faces.
    """
    expected = expected_faces(outline, segments)
    if expected > MOST_FACES:
        raise InsufficientDataError(say("its points lie on so many planes that they would cut its plan into about "
                                        "{faces:.0f} faces, more than {most}", faces=expected, most=MOST_FACES))
    network = shapely.union_all(np.append(shapely.linestrings(segments), shapely.boundary(outline)), grid_size=GRID)
    checkpoint()
    pieces = shapely.get_parts(shapely.polygonize([network]))
    checkpoint()
    inside = shapely.get_coordinates(shapely.point_on_surface(pieces))
    shapely.prepare(outline)
    pieces = pieces[shapely.contains_xy(outline, inside[:, 0], inside[:, 1])]
    pairs, ends = common_borders(pieces)
    return PlanFaces(pieces, pairs, np.hypot(*(ends[:, 1] - ends[:, 0]).T), ends)


def expected_faces(outline: shapely.Geometry, segments: np.ndarray) -> float:
    """About how many faces segments (m, 2, 2) cut an outline into."""
    # Lines of a total length l meet about l2 / (pi area) times, and so many faces they make.
    total = float(np.hypot(*(segments[:, 1] - segments[:, 0]).T).sum())
    return len(segments) + total**2 / (np.pi * max(outline.envelope.area, LEAST_DIVISOR))


@dataclass(frozen=True)
class _PlaneBorders:
    """What the borders of faces cost between planes (k, 3), computed when asked (`alpha_expansion.Borders`)."""

    pairs: np.ndarray
    ends: np.ndarray
    most: np.ndarray
    planes: np.ndarray

    def cost(self, rows: np.ndarray | slice, one: np.ndarray, two: np.ndarray) -> np.ndarray:
        """Costs (r,) of planes beside borders: all of `most` where they meet with a full step."""
        between = self.planes[one] - self.planes[two]
        ends = self.ends[rows]
        step = np.abs(ends[..., 0] * between[:, :1] + ends[..., 1] * between[:, 1:2] + between[:, 2:]).mean(axis=1)
        return np.where(one == two, 0.0, self.most[rows] * np.clip(step / FULL_STEP, LEVEL_FAVOUR, 1.0))


def label_faces(faces: PlanFaces, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
                label: np.ndarray) -> np.ndarray:
    """Plane (n,) of each face.

    Parameters
    ----------
    planes : (k, 3).
    points, label : (n, 3) and (n,); those without a plane (-1) do not count.
    """
    data = _data_costs(faces, raster, planes, points, label)
    borders = _PlaneBorders(faces.pairs, faces.border, SMOOTHNESS * faces.length, planes)
    return expand_labels(data, borders, data.argmin(axis=1))


def _data_costs(faces: PlanFaces, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
                label: np.ndarray) -> np.ndarray:
    """Cubic metres (n, k) between the points and each plane, over each face; infinite for planes that lie far."""
    checkpoint()
    near = _near_planes(faces, raster, len(planes))
    checkpoint()
    data = np.where(near, 0.0, np.inf)
    labelled = points[label >= 0]
    column = np.searchsorted(raster.x + raster.cell / 2, labelled[:, 0])
    row = np.searchsorted(-raster.y + raster.cell / 2, -labelled[:, 1])
    cell = row * len(raster.x) + column
    weight = raster.cell**2 / np.bincount(cell)[cell]

    def of_points(place: np.ndarray, plane: np.ndarray) -> np.ndarray:
        return np.minimum(np.abs(labelled[place, 2] - _heights(planes, plane, labelled[place])),
                          CAP) * weight[place]

    row, column = np.nonzero(raster.inside)
    xy = np.column_stack([raster.x[column], raster.y[row]])
    shown = _heights(planes, raster.label[row, column], xy)
    unseen = np.where(raster.seen[row, column], 0.0, UNSEEN_WEIGHT)
    low, high = seen_heights(planes, points, label, raster.cell)

    def of_cells(place: np.ndarray, plane: np.ndarray) -> np.ndarray:
        height = _heights(planes, plane, xy[place])
        cost = np.minimum(np.abs(height - shown[place]), CAP) * unseen[place]
        return cost + EXCESS_WEIGHT * np.clip(np.maximum(height - high[plane], low[plane] - height), 0.0, 3.0)

    tree = shapely.STRtree(faces.polygons)
    _add_sums(data, near, tree, labelled[:, :2], of_points, 1.0)
    _add_sums(data, near, tree, xy, of_cells, raster.cell**2)
    return data


def _near_planes(faces: PlanFaces, raster: LabelRaster, count: int) -> np.ndarray:
    """Mask (n, count) of the planes that cells show within `FAR` of each face's box; all where none is."""
    row, column = np.nonzero(raster.inside)
    label = raster.label[row, column]
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    for axis, place in enumerate((raster.x[column], raster.y[row])):
        np.minimum.at(low[:, axis], label, place)
        np.maximum.at(high[:, axis], label, place)
    bounds = shapely.bounds(faces.polygons)
    near = np.ones((len(bounds), count), bool)
    for axis in range(2):
        near &= bounds[:, axis, None] <= high[:, axis] + FAR
        near &= bounds[:, axis + 2, None] >= low[:, axis] - FAR
    near[~near.any(axis=1)] = True
    return near


def _heights(planes: np.ndarray, plane: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Height (n,) of planes (n,) at places (n, 2 or more), m."""
    a, b, c = planes[plane].T
    return xy[:, 0] * a + xy[:, 1] * b + c


def seen_heights(planes: np.ndarray, points: np.ndarray, label: np.ndarray,
                 spacing: float) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest height (k,) at which each plane is seen, with what `CLEARANCE` and the `spacing` of
    points leave open: no plane is drawn on to where it was not seen. One without points is free."""
    labelled = label >= 0
    low, high = np.full(len(planes), np.inf), np.full(len(planes), -np.inf)
    np.minimum.at(low, label[labelled], points[labelled, 2])
    np.maximum.at(high, label[labelled], points[labelled, 2])
    reach = CLEARANCE + spacing * np.hypot(planes[:, 0], planes[:, 1])
    return (np.where(np.isfinite(low), low - reach, -np.inf), np.where(np.isfinite(high), high + reach, np.inf))


def _add_sums(data: np.ndarray, near: np.ndarray, tree: shapely.STRtree, xy: np.ndarray,
              cost: Callable[[np.ndarray, np.ndarray], np.ndarray], factor: float) -> None:
    """Add to `data` (n, k) the `cost` of every place (p, 2) in a polygon with each plane that is near to it."""
    count = near.sum(axis=1)
    plane_of = np.nonzero(near)[1]
    first = np.cumsum(count) - count
    sums = data[near]
    for start in range(0, len(xy), _AT_ONCE):
        checkpoint()
        place, face = tree.query(shapely.points(xy[start:start + _AT_ONCE]), predicate="intersects")
        for part in np.array_split(np.arange(len(place)), count[face].sum() // _TABLE + 1):
            times = count[face[part]]
            point_row = np.repeat(place[part] + start, times)
            at = np.arange(times.sum()) + np.repeat(first[face[part]] - (np.cumsum(times) - times), times)
            sums += factor * np.bincount(at, cost(point_row, plane_of[at]), len(sums))
    data[near] = sums
