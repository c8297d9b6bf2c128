"""The surface between the edges of roads: given polygons dissolved, given lines closed to faces.

Source: Project PLATEAU, standard working procedure of 3D city models, annex D, D.6.1.2 (edges of roads joined to
surfaces); the Fundamental Geospatial Data of the GSI have the edges as lines (RdEdg).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ..errors import InputError
from ..geometry.tolerances import OFF_THE_EARTH
from ..wording import say
from .road_records import RoadFinding

GRID = 0.001
"""Corners nearer to each other than this are one, m: files of degrees have them so."""


class OpenEdgesError(InputError):
    """Lines along roads enclose no surface."""


@dataclass(frozen=True)
class ClosingLimits:
    """What closing of edges goes by.

    Attributes
    ----------
    widest : widest road whose two edges are joined at the end of the data, m.
    touch : ends of edges nearer than this are one, m: half of the drawing accuracy of map level 500.
    """

    widest: float = 60.0
    touch: float = 0.125


LIMITS = ClosingLimits()


@dataclass(frozen=True, eq=False)
class RoadSurface:
    """Surfaces of roads: polygons that do not touch each other, m, and what was found on the way."""

    polygons: tuple[shapely.Polygon, ...]
    findings: tuple[RoadFinding, ...]


def surface_of(geometries: Sequence[shapely.Geometry | None], limits: ClosingLimits = LIMITS) -> RoadSurface:
    """The surface of polygons or of lines along both edges of roads, m.

    Raises
    ------
    InputError : there is neither.
    OpenEdgesError : the lines enclose nothing.
    """
    given = [shapely.force_2d(one) for one in geometries if one is not None and not one.is_empty]
    polygons = [one for one in given if one.geom_type in ("Polygon", "MultiPolygon")]
    lines = [one for one in given if one.geom_type in ("LineString", "MultiLineString", "LinearRing")]
    if not polygons and not lines:
        raise InputError(say("The layer holds no polygons or lines: give surfaces of roads, or lines along both of "
                             "their edges."))
    if any(not (np.abs(shapely.get_coordinates(one)) < OFF_THE_EARTH).all() for one in (*polygons, *lines)):
        raise InputError(say("A road has a corner whose coordinates are no numbers or off the earth: repair the layer "
                             "first."))
    findings: list[RoadFinding] = []
    faces = _valid_polygons(polygons, findings) + (_faces_between(lines, limits, findings) if lines else [])
    if not faces:
        raise OpenEdgesError(say("The lines enclose no surface: give the lines along both edges of the roads, joined "
                                 "at their ends, or surfaces."))
    whole = shapely.union_all(faces, grid_size=GRID)
    parts = [part for part in shapely.get_parts(whole) if part.geom_type == "Polygon" and part.area > 0]
    return RoadSurface(tuple(parts), tuple(findings))


def _valid_polygons(polygons: list, findings: list[RoadFinding]) -> list[shapely.Polygon]:
    """Polygons repaired where they cross themselves, which is told."""
    valid = []
    for polygon in polygons:
        if not polygon.is_valid:
            point = shapely.get_coordinates(polygon)[0]
            findings.append(RoadFinding("surface repaired", say("A surface crosses itself and was repaired: compare it "
                                                                "with its source."), *point.tolist()))
            polygon = shapely.make_valid(polygon)
        valid += [part for part in shapely.get_parts(polygon) if part.geom_type in ("Polygon", "MultiPolygon")]
    return valid


def _faces_between(lines: list, limits: ClosingLimits, findings: list[RoadFinding]) -> list[shapely.Polygon]:
    """Faces on the road's side of lines along roads: each line has road on one side and none on the other."""
    parts = [part for line in lines for part in shapely.get_parts(line)]
    parts = [part for part in shapely.set_precision(np.array(parts), GRID) if part.length > 0]
    crossing = shapely.union_all(parts, grid_size=GRID)
    merged = shapely.get_parts(shapely.line_merge(crossing))
    closing = _closing_lines(merged, limits, findings)
    edges = shapely.union_all([*merged, *closing], grid_size=GRID)
    faces = [face for face in shapely.get_parts(shapely.polygonize(shapely.get_parts(edges))) if face.area > GRID]
    if not faces:
        return []
    return _road_side(faces, shapely.union_all(closing, grid_size=GRID) if closing else None, findings)


def _closing_lines(lines: np.ndarray, limits: ClosingLimits, findings: list[RoadFinding]) -> list:
    """Lines between loose ends: the nearest ones first, each end once; ends that stay loose are told."""
    ends = np.array([shapely.get_coordinates(line)[number] for line in lines for number in (0, -1)
                     if not line.is_closed]).reshape(-1, 2)
    if not len(ends):
        return []
    _, owner, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    loose = ends[count[owner.ravel()] == 1]
    pairs = [(float(np.hypot(*(loose[a] - loose[b]))), a, b)
             for a, b in cKDTree(loose).query_pairs(limits.widest)] if len(loose) else []
    net = shapely.union_all(list(lines))
    used, closing = set(), []
    for distance, a, b in sorted(pairs):
        segment = shapely.linestrings(loose[[a, b]])
        if a in used or b in used or (distance > limits.touch and _crosses(segment, net, loose[[a, b]])):
            continue
        used |= {a, b}
        closing.append(segment)
    for number in sorted(set(range(len(loose))) - used):
        findings.append(RoadFinding("edge not closed", say(
            "An edge ends here without another end within {distance:.0f} m to be joined to: the road is left out, or "
            "its edge goes on in a file that was not given.", distance=limits.widest), *loose[number].tolist()))
    return closing


def _crosses(segment: shapely.Geometry, net: shapely.Geometry, ends: np.ndarray) -> bool:
    """Whether a line meets edges elsewhere than at its ends, or runs along one."""
    common = shapely.intersection(segment, net)
    met = shapely.get_coordinates(common)
    return common.length > 4 * GRID or any(np.hypot(*(ends - point).T).min() > 4 * GRID for point in met)


def _road_side(faces: list, closing, findings: list[RoadFinding]) -> list[shapely.Polygon]:
    """Of faces side by side every second one: the choice that is closed across, or has the narrower faces."""
    tree = shapely.STRtree(faces)
    one, other = tree.query(faces, predicate="touches")
    beside: list[list[tuple[int, bool]]] = [[] for _ in faces]
    for a, b in zip(one.tolist(), other.tolist()):
        common = shapely.intersection(faces[a].boundary, faces[b].boundary)
        if closing is not None:
            open_length = shapely.length(shapely.intersection(common, closing))
            if open_length > 0.5 * common.length:
                beside[a].append((b, False))
                continue
        if common.length > GRID:
            beside[a].append((b, True))
    side = np.full(len(faces), -1)
    chosen = []
    for start in range(len(faces)):
        if side[start] >= 0:
            continue
        side[start], group, waiting = 0, [start], deque([start])
        while waiting:
            node = waiting.popleft()
            for neighbour, changes in beside[node]:
                wanted = side[node] ^ changes
                if side[neighbour] < 0:
                    side[neighbour] = wanted
                    group.append(neighbour)
                    waiting.append(neighbour)
                elif side[neighbour] != wanted and node < neighbour:
                    point = shapely.get_coordinates(shapely.point_on_surface(faces[node]))[0]
                    findings.append(RoadFinding("sides contradict", say(
                        "The edges around this face do not tell on which of their sides the road lies: an edge is "
                        "missing, or a line is none of an edge."), *point.tolist()))
        chosen += _chosen_side(faces, group, side, closing)
    return chosen


def _chosen_side(faces: list, group: list[int], side: np.ndarray, closing) -> list[shapely.Polygon]:
    """Of the two choices the one that is closed across, as roads are where the data end; else the narrower one."""
    choices = [[faces[number] for number in group if side[number] == value] for value in (0, 1)]
    if not all(choices):
        return choices[0] or choices[1]
    if closing is not None:
        closed = [shapely.length(shapely.intersection(shapely.union_all([face.boundary for face in choice]), closing))
                  for choice in choices]
        if max(closed) > 2.0 * min(closed) + 1.0:
            return choices[int(np.argmax(closed))]
    widths = [sum(face.area for face in choice) / sum(face.length for face in choice) for choice in choices]
    return choices[int(np.argmin(widths))]
