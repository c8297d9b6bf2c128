"""Carriageways between measured edges: gaps of an edge drawn on, both sides closed where the survey ends."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from ...errors import InputError
from ...wording import say
from ..road_records import RoadFinding
from ..road_surface import GRID, ClosingLimits, OpenEdgesError, surface_of
from .above import roads_above
from .area_records import EdgeLine
from .one_sided import one_sided_carriageways
from .tram_tracks import without_tracks

SAME = 0.8  # m: parts of one chain whose ends are nearer follow each other; stations are 0.5 m apart
GAP = 12.0  # m; two parked cars; what was not seen over more is not drawn on
TURN = 60.0  # degrees by which an edge may turn from its end into a gap
SMOOTH = 0.01  # m by which lines may leave what was measured, in plan and in height
STATION = 0.5  # m between places of an edge that is drawn on
ON = 0.03  # m: borders this near to a measured line are measured
ACROSS = 0.5  # cosine of the angle between an edge and the line that closes it; less runs across the road
NARROW = 2.0  # m: what is narrower on average is no carriageway
PIECE = 6.0  # m: shorter edges beside one at least twice as long, nearer than `narrow`, bound no carriageway


class NoCarriagewayError(InputError):
    """Measured edges bound no carriageway; `findings` say of which edges that was seen."""

    def __init__(self, message: str, findings: Sequence[RoadFinding] = ()):
        super().__init__(message)
        self.findings = tuple(findings)


@dataclass(frozen=True, eq=False)
class Carriageways:
    """Polygons between the edges, m.

    Attributes
    ----------
    polygons : with islands as holes.
    measured : all measured lines as one geometry.
    sure : those of them that are not doubtful.
    ends : lines (2, 2) across the road where the survey ends.
    gaps : lines (2, 2) along the road, longer than `gap`, where an edge was not seen between what was; the road lies
        on their left.
    continued : what edges are over shorter gaps, between the heights of both sides.
    findings : on the way.
    open_sides : borders that are no kerb, as nobody saw what lies beyond.
    between : number of the polygons, the first ones, that lie between two edges.
    """

    polygons: tuple[shapely.Polygon, ...]
    measured: shapely.Geometry
    sure: shapely.Geometry
    ends: tuple[np.ndarray, ...]
    findings: tuple[RoadFinding, ...]
    open_sides: shapely.Geometry
    between: int
    gaps: tuple[np.ndarray, ...] = ()
    continued: tuple[EdgeLine, ...] = ()

    @cached_property
    def near(self) -> shapely.Geometry:
        """What lies so near to a measured line that it is measured."""
        return shapely.buffer(self.measured, ON)

    @cached_property
    def near_sure(self) -> shapely.Geometry:
        """What lies so near to a line without doubt that it is measured."""
        return shapely.buffer(self.sure, ON)

    @cached_property
    def border(self) -> shapely.Geometry:
        """What lies on the border of a carriageway."""
        return shapely.buffer(shapely.union_all([polygon.boundary for polygon in self.polygons]), GRID)

    @cached_property
    def end_zones(self) -> shapely.Geometry:
        """What lies where the survey ends."""
        return shapely.buffer(shapely.union_all([shapely.linestrings(end) for end in self.ends]), 5 * GRID)


def carriageways_between(edges: Sequence[EdgeLine], lanes: Sequence[shapely.Polygon] = ()) -> Carriageways:
    """Carriageways between measured edges, and between an edge and lanes where the other edge was not seen.

    Parameters
    ----------
    lanes : plan polygons, m.

    Raises
    ------
    NoCarriagewayError : there is no edge, or the edges enclose nothing and no lanes lie beside them.
    """
    if not edges:
        raise NoCarriagewayError(say("There are no kerbs or road borders among the edges: give the lines of “Road "
                                     "edges”."))
    findings: list[RoadFinding] = []
    edges = without_tracks(_without_pieces(edges, findings), findings, surface_between)
    lines = [shapely.linestrings(_thinned(edge)) for edge in edges]
    measured = shapely.union_all(lines)
    sure = shapely.union_all([line for line, edge in zip(lines, edges) if not edge.doubt])
    continued: list[EdgeLine] = []
    bridges = _bridges(edges, findings, continued)
    polygons, open_findings = _between_two([*lines, *bridges])
    known = shapely.STRtree(shapely.get_parts(shapely.union_all([measured, *bridges])))
    closed = [line for polygon in polygons for line in _closed_over(polygon, known)]
    ends = [line for line, along in closed if not along]
    gaps = [line for line, along in closed if along]
    findings += [_continued(line) for line in gaps]
    whole = [shapely.linestrings(edge.plan) for edge in edges]
    others = one_sided_carriageways([*whole, *bridges], lanes, polygons)
    if not polygons and not others.polygons:
        raise NoCarriagewayError(_one_sided(), (*findings, *others.findings))
    made = (*polygons, *others.polygons)
    return Carriageways(made, measured, sure, (*ends, *others.ends), (
        *findings, *open_findings, *others.findings, *_doubts(edges, lines, made), *roads_above(edges)),
        others.open_sides, len(polygons), tuple(gaps), tuple(continued))


def _doubts(edges: Sequence[EdgeLine], lines: Sequence[shapely.LineString],
            polygons: Sequence[shapely.Polygon]) -> list[RoadFinding]:
    """One for each doubtful edge on the border of a carriageway, at the middle of it."""
    border = shapely.STRtree(shapely.get_parts(shapely.union_all([polygon.boundary for polygon in polygons])))
    found = []
    for edge, line in zip(edges, lines):
        if edge.doubt and _open_length(line, border) < 0.5 * line.length:
            found.append(RoadFinding("edge doubtful", say(
                "{length:.1f} m of this edge are doubtful ({reason}): the border is drawn along them; look at the "
                "points or the place.", length=line.length, reason=edge.doubt),
                *shapely.get_coordinates(shapely.line_interpolate_point(line, 0.5, normalized=True))[0].tolist()))
    return found


def surface_between(edges: Sequence[EdgeLine]) -> list[shapely.Polygon]:
    """Polygons that edges enclose; none where they enclose nothing."""
    lines = [shapely.linestrings(_thinned(edge)) for edge in edges]
    return _between_two([*lines, *_bridges(edges, [], [])])[0] if lines else []


def _between_two(lines: Sequence[shapely.LineString]) -> tuple[list[shapely.Polygon], tuple[RoadFinding, ...]]:
    """Polygons that lines enclose, and findings; none where they enclose nothing."""
    try:
        surface = surface_of(lines, ClosingLimits(touch=ON))
    except OpenEdgesError:
        return [], ()
    polygons = [polygon for polygon in surface.polygons if 2.0 * polygon.area / polygon.length > NARROW]
    return polygons, surface.findings if polygons else ()


def _one_sided() -> str:
    """Why there is no carriageway."""
    return say("The edges enclose no carriageway: of no road the survey shows both edges all along, and no lanes tell "
               "how far one goes. Give the drives of both directions together, or lanes.")


def _without_pieces(edges: Sequence[EdgeLine], findings: list[RoadFinding]) -> list[EdgeLine]:
    """Edges without short ones that lie wholly beside a longer one, which are told: steps and joints of an island."""
    plans = [shapely.linestrings(edge.plan) for edge in edges]
    length: dict[int, float] = defaultdict(float)
    for edge, plan in zip(edges, plans):
        length[edge.chain] += plan.length
    remaining = []
    for edge, plan in zip(edges, plans):
        longer = [other for one, other in zip(edges, plans) if length[one.chain] >= 2.0 * length[edge.chain]]
        if length[edge.chain] < PIECE and longer and shapely.covers(
                shapely.buffer(shapely.union_all(longer), NARROW), plan):
            findings.append(RoadFinding("edge beside another", say(
                "A short edge lies nearer than {distance:.0f} m beside a longer one: no carriageway runs between them, "
                "and it is left out.", distance=NARROW), *edge.plan.mean(axis=0).tolist()))
        else:
            remaining.append(edge)
    return remaining


def _thinned(edge: EdgeLine) -> np.ndarray:
    """Places (n, 2) of an edge without those between which its plan, its foot and its step run straight."""
    plan = edge.plan
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plan, axis=0).T))])
    plan_corners = {tuple(point) for point in shapely.get_coordinates(shapely.simplify(
        shapely.linestrings(plan), SMOOTH)).tolist()}
    marks = set()
    for heights in (edge.foot[:, 2], edge.top[:, 2] - edge.foot[:, 2]):
        known = np.isfinite(heights)
        if np.count_nonzero(known) < 2:
            continue
        profile = shapely.simplify(shapely.linestrings(np.column_stack([along, heights])[known]), SMOOTH)
        marks |= set(shapely.get_coordinates(profile)[:, 0].tolist())
    return plan[[place in marks or tuple(point) in plan_corners for place, point in zip(along.tolist(), plan.tolist())]]


def _bridges(edges: Sequence[EdgeLine], findings: list[RoadFinding],
             continued: list[EdgeLine]) -> list[shapely.LineString]:
    """Lines over the gaps between parts of one edge, which are told, and the edges there."""
    chains: dict[int, list[EdgeLine]] = defaultdict(list)
    for edge in edges:
        chains[edge.chain].append(edge)
    bridges = []
    for parts in chains.values():
        for one, other in zip(parts, parts[1:]):
            start, end = one.plan[-1], other.plan[0]
            length = float(np.hypot(*(end - start)))
            if length == 0:
                continue
            if length > SAME and (not one.gap or length > GAP):
                continue
            line = shapely.linestrings(_course(one.plan, other.plan))
            bridges.append(line)
            if length > SAME:
                findings.append(_continued(np.vstack([start, end])))
                continued.append(_drawn_on(one, other, line))
    return bridges


def _drawn_on(one: EdgeLine, other: EdgeLine, line: shapely.LineString) -> EdgeLine:
    """The edge along a line between two parts: without it a kerb would sink into the road where nobody saw it."""
    plan = shapely.get_coordinates(shapely.segmentize(line, STATION))
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plan, axis=0).T))])
    foot, top = (np.column_stack([plan, np.interp(along, along[[0, -1]], ends)])[1:-1] for ends in (
        (one.foot[-1, 2], other.foot[0, 2]), (one.top[-1, 2], other.top[0, 2])))
    return replace(one, foot=foot, top=top, sigma_z=max(one.sigma_z, other.sigma_z))


def _continued(line: np.ndarray) -> RoadFinding:
    """That an edge was not seen along a line (2, 2)."""
    return RoadFinding("edge continued", say("The edge was not seen over {length:.1f} m and is drawn on here.",
                                             length=float(np.hypot(*(line[1] - line[0])))),
                       *line.mean(axis=0).tolist())


def _course(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """A line (n, 2) from the end of one part to the begin of the next that leaves and arrives in their directions."""
    start, end = before[-1], after[0]
    chord = end - start
    length = np.hypot(*chord)
    leaving, arriving = _direction(before[::-1]) * -1.0, _direction(after)
    limit = np.cos(np.radians(TURN))
    if length < SAME or min(leaving @ chord, arriving @ chord) < limit * length:
        return np.array([start, end])
    share = np.linspace(0.0, 1.0, max(int(np.ceil(length)), 2) + 1)[:, None]
    return ((2 * share**3 - 3 * share**2 + 1) * start + (share**3 - 2 * share**2 + share) * length * leaving
            + (3 * share**2 - 2 * share**3) * end + (share**3 - share**2) * length * arriving)


def _direction(line: np.ndarray, reach: float = 2.0) -> np.ndarray:
    """Unit vector in which a line leaves its first point, over some metres."""
    away = np.hypot(*(line - line[0]).T)
    far = int(np.argmax(away >= min(reach, away.max())))
    vector = line[max(far, 1)] - line[0]
    return vector / max(np.hypot(*vector), 1e-12)


def _closed_over(polygon: shapely.Polygon, known: shapely.STRtree) -> list[tuple[np.ndarray, bool]]:
    """Parts of the border that neither are among known lines nor near to one, as lines (2, 2) with the polygon on their
    left: those across the road, and, marked, those along it that are longer than what is drawn on."""
    found = []
    corners = shapely.get_coordinates(shapely.geometry.polygon.orient(polygon).exterior)[:-1]
    chords = np.roll(corners, -1, axis=0) - corners
    length = np.hypot(*chords.T)
    unit = chords / length[:, None]
    for number in np.flatnonzero(length > NARROW):
        line = np.vstack([corners[number], corners[(number + 1) % len(corners)]])
        open_length = _open_length(shapely.linestrings(line), known)
        onwards = [float(unit[number] @ unit[other]) for other in (number - 1, (number + 1) % len(unit))]
        if open_length > 0.5 * length[number] and (max(map(abs, onwards)) < ACROSS
                                                   or length[number] > GAP):
            # Where the survey ends the border turns back, along the other edge; beside a gap it goes on.
            found.append((line, min(onwards) >= ACROSS))
    return found


def _open_length(line: shapely.LineString, known: shapely.STRtree) -> float:
    """How much of a line, m, is farther than `on` from all known lines; only those about it are asked."""
    near = known.geometries[known.query(line, predicate="dwithin", distance=ON)]
    return float(shapely.length(shapely.difference(line, shapely.buffer(shapely.union_all(near), ON))))
