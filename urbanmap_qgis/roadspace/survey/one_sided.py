"""Carriageways of which one edge was seen: from that edge as far as lanes were measured, and no farther."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...wording import say
from ..road_records import RoadFinding
from ..road_surface import GRID

BESIDE = 6.0  # m from an edge to the nearest lane: a row of parked cars, a cycle path, a wide shoulder
BETWEEN = 0.6  # m between two lanes side by side: a double line
WIDEST = 30.0  # m across
CHORD = 1.0  # m to either side, over which an edge's direction is taken
BEGINNING = 0.3  # m from an edge's own place, from which what is met is another edge
BEYOND = 1.5  # m past the outermost lane at which another edge is the carriageway's
NARROW = 1.0  # m: what is narrower on average beside known carriageways is none
LEAST = 5.0  # m of an edge: shorter pieces make no carriageway, and are not told


@dataclass(frozen=True, eq=False)
class OneSided:
    """Polygons, m, the sides of them that no edge shows, lines (2, 2) across at their ends, and findings."""

    polygons: tuple[shapely.Polygon, ...]
    open_sides: shapely.Geometry
    ends: tuple[np.ndarray, ...]
    findings: tuple[RoadFinding, ...]


@dataclass(frozen=True)
class _Strip:
    """Places (n, 2) along an edge and straight across from each as far as lanes reach, m."""

    near: np.ndarray
    far: np.ndarray

    @property
    def polygon(self) -> shapely.Geometry:
        """What lies between, of quadrilaterals: rays of an edge that bends may cross."""
        rings = np.stack([self.near[:-1], self.near[1:], self.far[1:], self.far[:-1]], axis=1)
        cells = shapely.polygons(rings)
        return shapely.union_all(cells[shapely.is_valid(cells)], grid_size=GRID)


def one_sided_carriageways(edges: Sequence[shapely.LineString], lanes: Sequence[shapely.Polygon],
                           known: Sequence[shapely.Polygon]) -> OneSided:
    """Carriageways along edges whose other side was not seen.

    Parameters
    ----------
    edges : measured lines and what joins them, m.
    lanes : plan polygons, m.
    known : carriageways between two edges, where nothing is to be made.
    """
    whole = shapely.union_all(list(known))
    lines = [line for line in shapely.get_parts(shapely.line_merge(shapely.union_all(list(edges), grid_size=GRID)))
             if line.geom_type == "LineString" and not line.is_empty]
    driven = shapely.union_all(list(lanes))
    strips = []
    if lines and not driven.is_empty:
        met, room = _Segments(shapely.union_all(lines)), _Room(driven)
        strips = [strip for line in lines for strip in _strips(line, met, room, whole)]
    surface = shapely.difference(shapely.union_all([strip.polygon for strip in strips]), whole)
    polygons = [part for part in shapely.get_parts(surface)
                if part.geom_type == "Polygon" and 2.0 * part.area > NARROW * part.length]
    rings = [polygon.exterior for polygon in polygons]
    border, tree = shapely.union_all(rings), shapely.STRtree(rings)
    ends = [end for strip in strips for end in (np.vstack([strip.near[k], strip.far[k]]) for k in (0, -1))
            if _on(end, tree)]
    open_sides = shapely.difference(border, shapely.buffer(shapely.union_all(
        [*lines, *map(shapely.linestrings, ends), whole.boundary]), 0.03))
    return OneSided(tuple(polygons), open_sides, tuple(ends),
                    (*_open_findings(polygons, open_sides), *_lonely(lines, [*known, *polygons])))


def _on(line: np.ndarray, rings: shapely.STRtree) -> bool:
    """Whether most of a line (2, 2) lies on a border, of which only the rings near it are looked at."""
    shape = shapely.linestrings(line)
    near = shapely.union_all(rings.geometries[rings.query(shapely.buffer(shape, 3 * GRID))])
    return bool(shapely.length(shapely.intersection(shape, shapely.buffer(near, 2 * GRID))) > 0.5 * shape.length)


def _strips(line: shapely.LineString, edges: _Segments, room: _Room, whole: shapely.Geometry) -> list[_Strip]:
    """Strips along a line on the side on which lanes lie nearer to it."""
    places = shapely.get_coordinates(shapely.segmentize(line, CHORD))
    at = shapely.line_locate_point(line, shapely.points(places))
    behind, ahead = (shapely.get_coordinates(shapely.line_interpolate_point(line, np.clip(at + by, 0.0, line.length)))
                     for by in (-CHORD, CHORD))
    course = (ahead - behind) / np.maximum(np.hypot(*(ahead - behind).T), GRID)[:, None]
    across = np.column_stack([-course[:, 1], course[:, 0]])
    sides = []
    for side in (1.0, -1.0):
        near, far = _reaches(places, side * across, edges, room)
        far[_behind(places, side * across, whole)] = np.nan
        sides.append((np.count_nonzero(np.isfinite(far)), -float(np.nansum(near)), side, far))
    _, _, side, far = max(sides, key=lambda one: one[:2])
    runs = np.split(np.arange(len(places)), np.flatnonzero(np.diff(np.isfinite(far).astype(int))) + 1)
    return [_Strip(places[run], places[run] + side * across[run] * far[run, None]) for run in runs
            if np.isfinite(far[run[0]]) and len(run) > 1 and at[run[-1]] - at[run[0]] >= LEAST]


def _behind(places: np.ndarray, course: np.ndarray, whole: shapely.Geometry) -> np.ndarray:
    """Mask (n,) of places on the border of known carriageways from which a course leads away from these: an edge has a
    carriageway on one side, an island or a sidewalk on the other."""
    on = shapely.distance(whole.boundary, shapely.points(places)) < BEGINNING / 2.0
    return on & ~shapely.contains(whole, shapely.points(places + BEGINNING * course))


def _reaches(places: np.ndarray, course: np.ndarray, edges: _Segments, room: _Room) -> tuple[np.ndarray, np.ndarray]:
    """How far from each place (n, 2) along a unit vector lanes begin and the carriageway ends, m; NaN without lanes."""
    near, far = np.full(len(places), np.nan), np.full(len(places), np.nan)
    rays = np.stack([places + BEGINNING * course, places + WIDEST * course], axis=1)
    walls = edges.met(rays, places, course)
    for k, (met, spans) in enumerate(zip(walls, room.spans(rays, places, course))):
        wall = float(met.min()) if len(met) else np.inf
        spans = [(low, min(high, wall)) for low, high in spans if low < wall]
        if not spans or spans[0][0] > BESIDE:
            continue
        near[k], far[k] = spans[0]
        for low, high in spans[1:]:
            if low - far[k] <= BETWEEN:
                far[k] = max(far[k], high)
        far[k] = wall if wall - far[k] < BEYOND else far[k]
    return near, far


class _Segments:
    """The segments of lines, of which each ray is held to those near it: a city has many times as many."""

    def __init__(self, lines: shapely.Geometry):
        corners, line = shapely.get_coordinates(shapely.get_parts(lines), return_index=True)
        first = np.flatnonzero(line[1:] == line[:-1])
        self._segments = shapely.linestrings(np.stack([corners[first], corners[first + 1]], axis=1))
        self._tree = shapely.STRtree(self._segments)

    def met(self, rays: np.ndarray, places: np.ndarray, course: np.ndarray) -> list[np.ndarray]:
        """Distances, m, from each place (n, 2) along a unit vector at which its ray (n, 2, 2) meets a line."""
        lines = shapely.linestrings(rays)
        ray, segment = self._tree.query(lines, predicate="intersects")
        points, pair = shapely.get_coordinates(shapely.intersection(lines[ray], self._segments[segment]),
                                               return_index=True)
        ray = ray[pair]
        order = np.argsort(ray, kind="stable")
        distance = ((points - places[ray]) * course[ray]).sum(axis=1)[order]
        return np.split(distance, np.searchsorted(ray[order], np.arange(1, len(rays))))


class _Room:
    """Where lanes are: what of a ray lies in them is told by its crossings of their border."""

    def __init__(self, lanes: shapely.Geometry):
        shapely.prepare(lanes)
        self._lanes, self._border = lanes, _Segments(lanes.boundary)

    def spans(self, rays: np.ndarray, places: np.ndarray, course: np.ndarray) -> list[list[tuple[float, float]]]:
        """Spans (from, to), m, in lanes of each ray (n, 2, 2): distances from its place (n, 2) along a unit vector."""
        ends = ((rays - places[:, None]) * course[:, None]).sum(axis=2)
        cuts = [np.unique(np.concatenate([one, met])) for one, met in zip(ends, self._border.met(rays, places, course))]
        owner = np.repeat(np.arange(len(cuts)), [len(cut) - 1 for cut in cuts])
        low, high = (np.concatenate([cut[part] for cut in cuts]) for part in (np.s_[:-1], np.s_[1:]))
        middle = places[owner] + (0.5 * (low + high))[:, None] * course[owner]
        within = shapely.intersects_xy(self._lanes, *middle.T)
        spans: list[list[tuple[float, float]]] = [[] for _ in cuts]
        for number, start, end in zip(owner[within].tolist(), low[within].tolist(), high[within].tolist()):
            mine = spans[number]
            if mine and mine[-1][1] == start:
                start = mine.pop()[0]
            mine.append((start, end))
        return spans


def _open_findings(polygons: Sequence[shapely.Polygon], open_sides: shapely.Geometry) -> list[RoadFinding]:
    """One for each carriageway, at the middle of what no edge shows."""
    found = []
    for polygon in polygons:
        side = shapely.intersection(polygon.exterior, shapely.buffer(open_sides, 2 * GRID))
        if side.length < LEAST:
            continue
        longest = max(shapely.get_parts(shapely.line_merge(side)), key=shapely.length)
        x, y = shapely.get_coordinates(shapely.line_interpolate_point(longest, 0.5, normalized=True))[0]
        found.append(RoadFinding("other edge not seen", say(
            "The edge on this side was not seen over {length:.0f} m: the carriageway is drawn to the outermost lane "
            "that was measured, and nothing beside it. Give the drive of the other direction, too.",
            length=side.length), x, y))
    return found


def _lonely(lines: Sequence[shapely.LineString], polygons: Sequence[shapely.Polygon]) -> list[RoadFinding]:
    """Edges that are the border of no carriageway."""
    near = shapely.buffer(shapely.union_all([polygon.boundary for polygon in polygons]), 0.1)
    found = []
    for part in shapely.get_parts(shapely.difference(shapely.union_all(list(lines)), near)):
        if part.length < LEAST:
            continue
        x, y = shapely.get_coordinates(shapely.line_interpolate_point(part, 0.5, normalized=True))[0]
        found.append(RoadFinding("edge without a carriageway", say(
            "Of {length:.0f} m of this edge neither the other edge nor a lane beside it was seen: no carriageway is "
            "made.", length=part.length), x, y))
    return found
