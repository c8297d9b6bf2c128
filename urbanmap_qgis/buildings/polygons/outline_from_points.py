"""The outer limit of a building from its roof points alone, where no official outline can be trusted."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...errors import InputError, InsufficientDataError
from ...geometry.alpha_shape import alpha_shape, default_alpha
from ...geometry.tolerances import SAME_PLACE
from ...wording import say
from .radius_outliers import default_radius, remove_radius_outliers
from .regularisation import regularise_ring

UNORDERED_SHRINK = 0.45
"""By how much, in mean point spacings, the alpha shape of points without order lies inside the true edge
(measured on simulated rectangles, L and T shapes at 2 to 20 points per m2: 0.39 to 0.54)."""
NEIGHBOURS = 13

MIN_PART_AREA = 8.0
"""Smaller parts and courtyards (m2) are left out."""

PARTY_WALL_DISTANCE = 0.6
"""Walls nearer than this (m) to a neighbour's are the neighbour's."""


@dataclass(frozen=True)
class PointOutline:
    """Outline from points: Polygon or MultiPolygon; "regular", "partly curved" or "curved"; RMS in metres."""

    outline: shapely.Geometry
    status: str
    rms: float


class _Shrink:
    """How far the true edge of a wall lies outside its boundary points: half the spacing across the wall.

    The spacing is measured, because scan lines are denser along than across (J 5.5): from the points behind the
    wall, the mean step to the next point in the quarter circle that looks towards the wall.
    """

    def __init__(self, xy: np.ndarray, density: float):
        self.xy = xy
        self.spacing = 1.0 / math.sqrt(density)
        k = min(NEIGHBOURS, len(xy))
        self.step = xy[cKDTree(xy).query(xy, k)[1][:, 1:]] - xy[:, None, :]

    def __call__(self, a: np.ndarray, b: np.ndarray) -> float:
        length = float(np.hypot(*(b - a)))
        if length == 0:
            return 0.0
        along = (b - a) / length
        outward = np.array([along[1], -along[0]])  # the ring is counterclockwise
        depth = -(self.xy - a) @ outward
        place = (self.xy - a) @ along
        behind = (depth > self.spacing) & (depth < 6.0 * self.spacing) & (place > 0) & (place < length)
        if behind.sum() < 8:
            return UNORDERED_SHRINK * self.spacing
        out, side = self.step[behind] @ outward, np.abs(self.step[behind] @ along)
        far = np.where(out > side, np.hypot(out, side), np.inf)
        best = np.argmin(far, axis=1)
        rows = np.arange(len(best))
        found = np.isfinite(far[rows, best])
        if found.sum() < 8:
            return UNORDERED_SHRINK * self.spacing
        return 0.5 * float(np.mean(out[rows, best][found]))


def outline_from_points(x: np.ndarray, y: np.ndarray, density: float,
                        neighbours: list[shapely.Geometry] | None = None, regularity: float = 1.0,
                        outward: bool = True) -> PointOutline:
    """Regularised outline of a building's roof points, courtyards included.

    Parameters
    ----------
    x, y : (n,) all roof points of the building, metres.
    density : points per m2.
    neighbours : outlines of the buildings beside it; walls near theirs follow them, and what they cover is theirs.
    outward : whether edges are put half a spacing outside their points, where the roof ends.
    regularity : of the tolerance for straight walls, in multiples of what the spacing calls for.

    Raises
    ------
    InsufficientDataError : the points make no area.
    """
    if not density > 0:
        raise InputError(say("The point density must be above zero points per square metre."))
    xy = np.column_stack([x, y]).astype(float)
    xy = xy[remove_radius_outliers(xy, default_radius(density))]
    rings = [xy[ring] for ring in alpha_shape(xy, default_alpha(density))]
    rings = [ring for ring in rings if shapely.Polygon(ring).area >= MIN_PART_AREA]
    if not rings:
        raise InsufficientDataError(say("The building's points are too few to draw an outline from them."))
    tolerance = regularity * max(0.5, 1.2 / math.sqrt(density))
    shrink = _Shrink(xy, density) if outward else _no_shrink
    outer, holes, drawn = [], [], []
    for ring in rings:
        hole = not shapely.LinearRing(ring).is_ccw
        corners, curved, rms = regularise_ring(ring[::-1] if hole else ring, tolerance,
                                               (lambda a, b: -shrink(b, a)) if hole else shrink)
        drawn.append((curved, rms, len(ring)))
        polygon = shapely.make_valid(shapely.Polygon(corners))
        (holes if hole else outer).append(polygon)
    outline = shapely.difference(shapely.union_all(outer), shapely.union_all(holes))
    if neighbours:
        outline = _with_party_walls(outline, neighbours)
    outline = _areas(outline, MIN_PART_AREA)
    if outline.is_empty:
        raise InsufficientDataError(say("The building's points lie on its neighbours: check the building outlines."))
    bent = [one for one, _, _ in drawn]
    status = "curved" if bent[0] else "partly curved" if any(bent) else "regular"
    squares = sum(rms ** 2 * n for _, rms, n in drawn) / sum(n for _, _, n in drawn)
    return PointOutline(outline, status, math.sqrt(squares))


def _no_shrink(_a: np.ndarray, _b: np.ndarray) -> float:
    """For edges that run through their points."""
    return 0.0


def _with_party_walls(outline: shapely.Geometry, neighbours: list[shapely.Geometry]) -> shapely.Geometry:
    """Outline that meets its neighbours without gap or overlap where it runs along them."""
    beside = shapely.union_all(neighbours)
    # closing fills the strip between two near walls; mitred joins keep the corners square
    closed = shapely.union(outline, beside).buffer(0.5 * PARTY_WALL_DISTANCE, join_style="mitre")
    closed = closed.buffer(-0.5 * PARTY_WALL_DISTANCE, join_style="mitre")
    gap = shapely.difference(shapely.difference(closed, beside), outline)
    near = [part for part in shapely.get_parts(gap) if part.area > 0 and part.distance(beside) < SAME_PLACE
            and part.distance(outline) < SAME_PLACE]
    joined = shapely.difference(shapely.union_all([outline, *near]), beside)
    # slivers thinner than the tolerance on the far side of a neighbour vanish by opening
    core = joined.buffer(-0.25 * PARTY_WALL_DISTANCE, join_style="mitre")
    reach = core.buffer(0.25 * PARTY_WALL_DISTANCE + 1e-6, join_style="mitre")
    return shapely.intersection(joined, reach)


def _areas(geometry: shapely.Geometry, smallest: float) -> shapely.Geometry:
    pieces = shapely.get_parts(shapely.get_parts(geometry))
    parts = [piece for piece in pieces if piece.geom_type == "Polygon" and piece.area >= smallest]
    return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
