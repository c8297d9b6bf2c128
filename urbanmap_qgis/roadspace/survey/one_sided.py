"""Carriageways of which one edge was seen: from that edge as far as lanes were measured, and no farther."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...wording import say
from ..road_records import RoadFinding
from ..road_surface import GRID


@dataclass(frozen=True)
class OneSidedLimits:
    """Limits of carriageways with one edge, each with its unit."""

    beside: float = 6.0  # m from an edge to the nearest lane: a row of parked cars, a cycle path, a wide shoulder
    between: float = 0.6  # m between two lanes side by side: a double line
    widest: float = 30.0  # m across
    chord: float = 1.0  # m to either side, over which an edge's direction is taken
    beginning: float = 0.3  # m from an edge's own place, from which what is met is another edge
    beyond: float = 1.5  # m past the outermost lane at which another edge is the carriageway's
    narrow: float = 1.0  # m: what is narrower on average beside known carriageways is none
    least: float = 5.0  # m of an edge: shorter pieces make no carriageway, and are not told


LIMITS = OneSidedLimits()


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
    room = shapely.union_all(list(lanes))
    shapely.prepare(room)
    strips = [] if room.is_empty else [strip for line in lines for strip in _strips(line, lines, room, whole)]
    surface = shapely.difference(shapely.union_all([strip.polygon for strip in strips]), whole)
    polygons = [part for part in shapely.get_parts(surface)
                if part.geom_type == "Polygon" and 2.0 * part.area > LIMITS.narrow * part.length]
    border = shapely.union_all([polygon.exterior for polygon in polygons])
    ends = [end for strip in strips for end in (np.vstack([strip.near[k], strip.far[k]]) for k in (0, -1))
            if _on(end, border)]
    open_sides = shapely.difference(border, shapely.buffer(shapely.union_all(
        [*lines, *map(shapely.linestrings, ends), whole.boundary]), 0.03))
    return OneSided(tuple(polygons), open_sides, tuple(ends),
                    (*_open_findings(polygons, open_sides), *_lonely(lines, [*known, *polygons])))


def _on(line: np.ndarray, border: shapely.Geometry) -> bool:
    """Whether most of a line (2, 2) lies on a border."""
    shape = shapely.linestrings(line)
    return bool(shapely.length(shapely.intersection(shape, shapely.buffer(border, 2 * GRID))) > 0.5 * shape.length)


def _strips(line: shapely.LineString, lines: Sequence[shapely.LineString], room: shapely.Geometry,
            whole: shapely.Geometry) -> list[_Strip]:
    """Strips along a line on the side on which lanes lie nearer to it."""
    places = shapely.get_coordinates(shapely.segmentize(line, LIMITS.chord))
    at = shapely.line_locate_point(line, shapely.points(places))
    behind, ahead = (shapely.get_coordinates(shapely.line_interpolate_point(line, np.clip(at + by, 0.0, line.length)))
                     for by in (-LIMITS.chord, LIMITS.chord))
    course = (ahead - behind) / np.maximum(np.hypot(*(ahead - behind).T), GRID)[:, None]
    across = np.column_stack([-course[:, 1], course[:, 0]])
    sides = []
    for side in (1.0, -1.0):
        near, far = _reaches(places, side * across, lines, room)
        far[_behind(places, side * across, whole)] = np.nan
        sides.append((np.count_nonzero(np.isfinite(far)), -float(np.nansum(near)), side, far))
    _, _, side, far = max(sides, key=lambda one: one[:2])
    runs = np.split(np.arange(len(places)), np.flatnonzero(np.diff(np.isfinite(far).astype(int))) + 1)
    return [_Strip(places[run], places[run] + side * across[run] * far[run, None]) for run in runs
            if np.isfinite(far[run[0]]) and len(run) > 1 and at[run[-1]] - at[run[0]] >= LIMITS.least]


def _behind(places: np.ndarray, course: np.ndarray, whole: shapely.Geometry) -> np.ndarray:
    """Mask (n,) of places on the border of known carriageways from which a course leads away from these: an edge has a
    carriageway on one side, an island or a sidewalk on the other."""
    on = shapely.distance(whole.boundary, shapely.points(places)) < LIMITS.beginning / 2.0
    return on & ~shapely.contains(whole, shapely.points(places + LIMITS.beginning * course))


def _reaches(places: np.ndarray, course: np.ndarray, lines: Sequence[shapely.LineString],
             room: shapely.Geometry) -> tuple[np.ndarray, np.ndarray]:
    """How far from each place (n, 2) along a unit vector lanes begin and the carriageway ends, m; NaN without lanes."""
    near, far = np.full(len(places), np.nan), np.full(len(places), np.nan)
    net = shapely.union_all(list(lines))
    rays = shapely.linestrings(np.stack([places + LIMITS.beginning * course, places + LIMITS.widest * course], axis=1))
    for k, (ray, inside) in enumerate(zip(rays, shapely.intersection(rays, room))):
        met = shapely.get_coordinates(shapely.intersection(ray, net))
        wall = float(np.min((met - places[k]) @ course[k])) if len(met) else np.inf
        spans = sorted(tuple(sorted(((shapely.get_coordinates(part) - places[k]) @ course[k])[[0, -1]].tolist()))
                       for part in shapely.get_parts(inside) if part.geom_type == "LineString" and not part.is_empty)
        spans = [(low, min(high, wall)) for low, high in spans if low < wall]
        if not spans or spans[0][0] > LIMITS.beside:
            continue
        near[k], far[k] = spans[0]
        for low, high in spans[1:]:
            if low - far[k] <= LIMITS.between:
                far[k] = max(far[k], high)
        far[k] = wall if wall - far[k] < LIMITS.beyond else far[k]
    return near, far


def _open_findings(polygons: Sequence[shapely.Polygon], open_sides: shapely.Geometry) -> list[RoadFinding]:
    """One for each carriageway, at the middle of what no edge shows."""
    found = []
    for polygon in polygons:
        side = shapely.intersection(polygon.exterior, shapely.buffer(open_sides, 2 * GRID))
        if side.length < LIMITS.least:
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
        if part.length < LIMITS.least:
            continue
        x, y = shapely.get_coordinates(shapely.line_interpolate_point(part, 0.5, normalized=True))[0]
        found.append(RoadFinding("edge without a carriageway", say(
            "Of {length:.0f} m of this edge neither the other edge nor a lane beside it was seen: no carriageway is "
            "made.", length=part.length), x, y))
    return found
