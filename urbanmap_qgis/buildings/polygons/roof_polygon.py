"""Roof polygons from detected edges (J 5.3.3, step 4), and the whole chain from points to polygons."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import Polygon

from ...errors import InputError
from ...geometry.alpha_shape import alpha_shape, default_alpha
from ...wording import say
from .hough_lines import BoundaryLine, hough_lines
from .radius_outliers import MIN_NEIGHBOURS, default_radius, remove_radius_outliers

LINE_DISTANCE_SPACINGS = 0.75
"""Default of J's d in mean point spacings: what the zigzag of an alpha shape along a straight edge needs."""


@dataclass(frozen=True)
class PaperParameters:
    """Numbers of J 5.3.3; None: from the point density.

    Parameters
    ----------
    outlier_radius : metres.
    min_neighbours : within it.
    alpha : metres.
    min_line_points : J's n. J: "sometimes an edge is represented by only 5 or 6 points".
    line_distance : J's d, metres.
    min_part_area : square metres; smaller parts and courtyards of a roof are left out.
    """

    outlier_radius: float | None = None
    min_neighbours: int = MIN_NEIGHBOURS
    alpha: float | None = None
    min_line_points: int = 5
    line_distance: float | None = None
    min_part_area: float = 4.0


@dataclass(frozen=True)
class PaperRoof:
    """One roof as J 5.3.3 draws it.

    Parameters
    ----------
    roof_number : as given.
    polygon : None where the points make no area.
    boundary : (m, 2) ordered boundary points of the largest outer ring.
    lines : its edges in the order of detection.
    status : "lines"; "repaired" (the edges crossed each other, made valid); "alpha shape" (less than three
        edges found: the alpha shape itself); "too few points".
    """

    roof_number: int
    polygon: Polygon | shapely.MultiPolygon | None
    boundary: np.ndarray
    lines: tuple[BoundaryLine, ...]
    status: str


def roof_polygon(lines: list[BoundaryLine], boundary_xy: np.ndarray) -> Polygon:
    """Closed polygon of the edges of one boundary, by the ten steps of J 5.3.3.

    Where the last point of an edge is the first point of another, that point is their corner. Elsewhere the
    edge with the closest first point follows, and the perpendicular images of both points on their lines
    become corners. Needs three edges. The polygon can be invalid, as the paper's: check `is_valid`.
    """
    if len(lines) < 3:
        raise InputError(say("A roof polygon needs at least three edges: lower the least number of edge points."))
    boundary = np.asarray(boundary_xy, float)
    corners = []
    waiting = list(range(1, len(lines)))
    current = lines[0]
    while waiting:
        following, shared = _following(current, lines, waiting, boundary)
        if shared:
            corners.append(boundary[current.last])
        else:
            corners.append(current.project(boundary[current.last]))
            corners.append(lines[following].project(boundary[lines[following].first]))
        waiting.remove(following)
        current = lines[following]
    # Step 2 puts the first point of the first edge down before it is known which case closes the ring;
    # here it is put down last, by the same two cases.
    if current.last == lines[0].first:
        corners.append(boundary[current.last])
    else:
        corners += [current.project(boundary[current.last]), lines[0].project(boundary[lines[0].first])]
    return Polygon(_without_repeats(np.array(corners)))


def _following(current: BoundaryLine, lines: list[BoundaryLine], waiting: list[int],
               boundary: np.ndarray) -> tuple[int, bool]:
    """The next edge, and whether it begins exactly where the current one ends (steps 3 and 5)."""
    for i in waiting:
        if lines[i].first == current.last:
            return i, True
    gaps = boundary[[lines[i].first for i in waiting]] - boundary[current.last]
    return waiting[int(np.argmin(np.hypot(gaps[:, 0], gaps[:, 1])))], False


def _without_repeats(ring: np.ndarray) -> np.ndarray:
    different = np.hypot(*(ring - np.roll(ring, 1, axis=0)).T) > 1e-9
    return ring[different] if different.sum() >= 3 else ring


def paper_roof_polygons(x: np.ndarray, y: np.ndarray, roof_of_point: np.ndarray, density: float,
                        parameters: PaperParameters | None = None) -> list[PaperRoof]:
    """Polygon of every roof by the paper's method alone (J 5.3.3), in the order of roof numbers.

    Parameters
    ----------
    x, y : (n,) metres.
    roof_of_point : (n,) roof number of each point, 0 = none.
    density : points per m2.
    """
    parameters = parameters or PaperParameters()
    if not density > 0:
        raise InputError(say("The point density must be above zero points per square metre."))
    xy = np.column_stack([x, y]).astype(float)
    roof_of_point = np.asarray(roof_of_point)
    return [_one_roof(int(number), xy[roof_of_point == number], density, parameters)
            for number in np.unique(roof_of_point[roof_of_point > 0])]


def _one_roof(number: int, xy: np.ndarray, density: float, parameters: PaperParameters) -> PaperRoof:
    radius = parameters.outlier_radius or default_radius(density)
    xy = xy[remove_radius_outliers(xy, radius, parameters.min_neighbours)]
    rings = [xy[ring] for ring in alpha_shape(xy, parameters.alpha or default_alpha(density))]
    if not rings:
        return PaperRoof(number, None, np.zeros((0, 2)), (), "too few points")
    distance = parameters.line_distance or LINE_DISTANCE_SPACINGS / math.sqrt(density)
    outer, holes, status = [], [], "lines"
    lines: tuple[BoundaryLine, ...] = ()
    for i, ring in enumerate(rings):
        area = shapely.Polygon(ring)
        if i > 0 and area.area < parameters.min_part_area:
            continue
        found = hough_lines(ring, parameters.min_line_points, distance)
        polygon, how = (roof_polygon(found, ring), "lines") if len(found) >= 3 else (area, "alpha shape")
        if not polygon.is_valid:
            polygon, how = shapely.make_valid(polygon), "repaired"
        if i == 0:
            status, lines = how, tuple(found)
        hole = not shapely.LinearRing(ring).is_ccw
        (holes if hole else outer).append(polygon)
    area = shapely.union_all(outer)
    if holes:
        area = shapely.difference(area, shapely.union_all(holes))
    return PaperRoof(number, _polygons_only(area), rings[0], lines, status)


def _polygons_only(geometry: shapely.Geometry) -> Polygon | shapely.MultiPolygon | None:
    pieces = shapely.get_parts(shapely.get_parts(geometry))
    parts = [piece for piece in pieces if piece.geom_type == "Polygon" and piece.area > 0]
    if not parts:
        return None
    return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
