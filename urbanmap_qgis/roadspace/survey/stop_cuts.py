"""Where carriageways are cut at junctions: at the extension of stop lines, else at corners.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.3.1.4 (LOD3.1 and finer: the stop
line's extension where there is one; else the corner cut-offs, as in LOD2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..junctions import Arm, Junction, junctions_of
from ..road_axis import skeleton_of

REACH = 20.0  # m from the cut at the corners outwards; stop lines farther away belong to another junction
INSIDE = 3.0  # m inwards of it
LEAST = 1.2  # m, of a stop line
WHOLE = 0.4  # share of the road's width from which a stop line tells its own direction
TURNED = 6.0  # degrees; a shorter one that turns less from the road's cross direction takes that
SKEW = 40.0  # degrees from the road's cross direction
SMOOTH = 0.1  # m: corners nearer to a straight line are none
# m along an edge from a contact: where its straight part is fitted, and how far inwards a curve is followed.
STRAIGHT = (3.0, 8.0)
INWARDS = 3.0
STATION = 0.1  # m
BEND = 0.04  # m off the straight part, from which an edge is bent; four times that tells of a curve
CURVE = 0.35  # m between the two places, of a curve; less is a corner


@dataclass(frozen=True, eq=False)
class JunctionCut:
    """A cut across an arm: line (2, 2), m, whether it is a stop line's extension, and the number of its junction."""

    line: np.ndarray
    at_stop_line: bool
    junction: int


@dataclass(frozen=True, eq=False)
class CutJunctions:
    """Cuts of a carriageway, and its junctions."""

    cuts: tuple[JunctionCut, ...]
    junctions: tuple[Junction, ...]


def junction_cuts(polygon: shapely.Polygon, stops: Sequence[shapely.LineString],
                  inner: Sequence[shapely.Polygon] = ()) -> CutJunctions:
    """Cuts of one carriageway.

    Parameters
    ----------
    stops : stop lines, m; empty where they are not to cut.
    inner : islands, which divide no road.
    """
    whole = shapely.Polygon(polygon.exterior, [ring for ring in polygon.interiors
                                              if not any(shapely.Polygon(ring).equals(island) for island in inner)])
    smooth = shapely.simplify(whole, SMOOTH)
    if smooth.geom_type != "Polygon" or not smooth.is_valid or smooth.is_empty:
        smooth = whole
    junctions = junctions_of(skeleton_of(smooth))
    cuts = []
    for number, junction in enumerate(junctions):
        arms = {arm.key: arm for arm in junction.arms}
        for cut in junction.cuts:
            corner = np.vstack([_curve_end(whole, point, arms[cut.arm]) for point in (cut.left, cut.right)])
            stop = _stop_cut(arms[cut.arm], cut.place, stops, whole)
            cuts.append(JunctionCut(corner if stop is None else stop, stop is not None, number))
        for arm in junction.uncut:
            stop = _stop_cut(arm, 0.0, stops, whole)
            if stop is not None:
                cuts.append(JunctionCut(stop, True, number))
    return CutJunctions(tuple(cuts), tuple(junctions))


def _curve_end(surface: shapely.Polygon, contact: np.ndarray, arm: Arm) -> np.ndarray:
    """Where the curve of a rounded corner ends in the straight edge of an arm (2,); a contact at a corner stays.

    A curve of radius r leaves its tangent by d after sqrt(2 r d): the places where it is off by d and by 4 d lie as far
    apart as the tangent's end and the first.
    """
    rings = [shapely.LinearRing(ring) for ring in (surface.exterior, *surface.interiors)]
    ring = min(rings, key=lambda one: shapely.distance(one, shapely.points(contact)))
    start = shapely.line_locate_point(ring, shapely.points(contact))
    marks = np.arange(-INWARDS, STRAIGHT[1], STATION)
    axis = shapely.linestrings(arm.branch.points)
    ahead, back = (shapely.line_locate_point(axis, shapely.line_interpolate_point(
        ring, (start + side * STRAIGHT[0]) % ring.length)) for side in (1.0, -1.0))
    sense = 1.0 if ahead > back else -1.0
    places = shapely.get_coordinates(shapely.line_interpolate_point(ring, (start + sense * marks) % ring.length))
    fitted = places[marks >= STRAIGHT[0]]
    middle = fitted.mean(axis=0)
    along = np.linalg.svd(fitted - middle, full_matrices=False)[2][0]
    off = np.abs((places - middle) @ np.array([-along[1], along[0]]))
    first, second = (np.flatnonzero(off > limit) for limit in (BEND, 4.0 * BEND))
    if not len(first) or not len(second) or off[marks >= STRAIGHT[0]].max() > BEND:
        return contact
    between = marks[first[-1]] - marks[second[-1]]
    if between < CURVE:
        return contact
    end = start + sense * (marks[first[-1]] + between)
    return shapely.get_coordinates(shapely.line_interpolate_point(ring, end % ring.length))[0]


def _stop_cut(arm: Arm, place: float, stops: Sequence[shapely.LineString],
              surface: shapely.Polygon) -> np.ndarray | None:
    """The extension (2, 2) over the whole road of the stop line nearest to a junction in an arm; None without one."""
    axis = _to_the_end(arm)
    best: tuple[float, np.ndarray] | None = None
    for stop in stops:
        middle = shapely.line_interpolate_point(stop, 0.5, normalized=True)
        along = float(shapely.line_locate_point(axis, middle))
        if not place - INSIDE <= along <= place + REACH or along == 0.0:
            continue
        width = 2.0 * float(np.interp(along, _chainage(arm.branch.points), arm.branch.clearance))
        off = shapely.distance(axis, middle)
        ends = shapely.get_coordinates(stop)[[0, -1]]
        across = ends[1] - ends[0]
        before, behind = shapely.get_coordinates(shapely.line_interpolate_point(
            axis, np.clip([along - width / 4.0, along + width / 4.0], 0.0, axis.length)))
        course = behind - before
        cosine = abs(across @ course) / max(np.hypot(*across) * np.hypot(*course), 1e-12)
        if off > width / 2.0 or np.hypot(*across) < LEAST or cosine > np.sin(np.radians(SKEW)):
            continue  # among them lines that come back to where they begin
        if stop.length < WHOLE * width and cosine < np.sin(np.radians(TURNED)):
            cross = np.array([-course[1], course[0]]) / np.hypot(*course)
            ends = ends.mean(axis=0) + np.outer([-0.5, 0.5], cross)
        cut = _extended(ends, surface, width)
        if cut is not None and (best is None or along < best[0]):
            best = (along, cut)
    return None if best is None else best[1]


def _to_the_end(arm: Arm) -> shapely.LineString:
    """The middle line of an arm, drawn on where it ends: it stops about half a width before the end of the surface."""
    points = arm.branch.points
    line = shapely.linestrings(points)
    one, other = shapely.get_coordinates(shapely.line_interpolate_point(line, [0.3, 0.7], normalized=True))
    course = (other - one) / max(np.hypot(*(other - one)), 1e-12)
    return shapely.linestrings(np.vstack([points, points[-1] + 1.5 * float(arm.branch.clearance.max()) * course]))


def _chainage(points: np.ndarray) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def _extended(ends: np.ndarray, surface: shapely.Polygon, width: float) -> np.ndarray | None:
    """A line drawn on to both borders of a surface; None where it lies beyond its end."""
    direction = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
    middle = ends.mean(axis=0)
    long = shapely.linestrings(np.vstack([middle - 1.5 * width * direction, middle + 1.5 * width * direction]))
    parts = [part for part in shapely.get_parts(shapely.intersection(long, surface))
             if part.geom_type == "LineString" and not part.is_empty]
    if not parts:
        return None
    nearest = min(parts, key=lambda part: shapely.distance(part, shapely.points(middle)))
    return shapely.get_coordinates(nearest)[[0, -1]]
