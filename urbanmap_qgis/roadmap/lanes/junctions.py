"""Virtual lanes through junctions, where a drive shows them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import say
from ..map_records import Bound, DrivenPath, Finding, MapLane, VectorMap
from .lane_assembly import centre_line
from .narrow_places import passes_narrow_place

LONGEST = 90.0
"""Way through a junction, m."""

BESIDE = 1.2
"""A lane whose middle a path keeps this near to, in its own widths, is one that the path goes past."""

END_REACH = 12.0
"""A drive leaves a lane at its end, and enters the next at its begin, within so many metres."""

STATION = 1.0
"""Distance of the places of a drive that are looked at, m."""

SMOOTH = 0.5
"""Cosine of the largest angle at which a way's bounds leave a lane's end or enter its begin."""

STRAIGHT = np.radians(25.0)


@dataclass(frozen=True)
class _Visit:
    """A lane and the first and last place of a drive in it."""

    lane: int
    first: int
    last: int


def connect_by_drives(built: VectorMap, drives: Sequence[DrivenPath]) -> None:
    """Add a virtual lane for every way that a drive takes from the end of one lane to the begin of another.

    What is driven outside all lanes becomes a finding.
    """
    areas = [built.area(number) for number in range(len(built.lanes))]
    tree = shapely.STRtree(areas)
    known: set[tuple[int, int]] = set()
    for drive in drives:
        places = _resampled(drive.places)
        visits = _visits(built, places, tree)
        covered = np.zeros(len(places), bool)
        for visit in visits:
            covered[visit.first:visit.last + 1] = True
        for one, other in zip(visits[:-1], visits[1:]):
            linked = _linked(built, one.lane, other.lane) or (one.lane, other.lane) in known
            if linked or _connects(built, places, one, other):
                covered[one.last:other.first + 1] = True
            if not linked and covered[(one.last + other.first) // 2]:
                known.add((one.lane, other.lane))
                _add_virtual(built, one.lane, other.lane, places[one.last:other.first + 1])
        _tell_uncovered(built, places, covered)


def _resampled(places: np.ndarray) -> np.ndarray:
    """Places (n, 3) at equal distances along a drive; stops fall away."""
    steps = np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(np.where(steps < 0.005, 0.0, steps))])
    keep = np.concatenate([[True], np.diff(at) > 0])
    where = np.arange(0.0, at[-1], STATION)
    return np.column_stack([np.interp(where, at[keep], column[keep]) for column in places.T])


def _visits(built: VectorMap, places: np.ndarray, tree: shapely.STRtree) -> list[_Visit]:
    """Lanes of the drive's direction that it runs in, in their order."""
    course = np.gradient(places[:, :2], axis=0)
    point, lane = tree.query(shapely.points(places[:, :2]), predicate="intersects")
    visits: list[_Visit] = []
    for k, number in sorted(zip(point.tolist(), lane.tolist())):
        centre = built.lanes[number].centre
        nearest = int(np.argmin(np.linalg.norm(centre[:, :2] - places[k, :2], axis=1)))
        ahead, behind = min(nearest + 1, len(centre) - 1), max(nearest - 1, 0)
        along = centre[ahead, :2] - centre[behind, :2]
        if course[k] @ along < 0.7 * np.linalg.norm(course[k]) * np.linalg.norm(along):
            continue
        if abs(places[k, 2] - centre[nearest, 2]) > 4.5:
            continue
        if visits and visits[-1].lane == number and k - visits[-1].last <= 5:
            visits[-1] = _Visit(number, visits[-1].first, k)
        else:
            visits.append(_Visit(number, k, k))
    return [visit for visit in visits if visit.last - visit.first >= 2]


def _linked(built: VectorMap, one: int, other: int) -> bool:
    """Whether a lane leads into another, or a change of lanes does."""
    lane = built.lanes[one]
    onward = [one, *lane.successors]
    beside = [near for number in onward for near in (built.lanes[number].left_neighbour,
                                                     built.lanes[number].right_neighbour)]
    return other in onward or other in beside


def _connects(built: VectorMap, places: np.ndarray, one: _Visit, other: _Visit) -> bool:
    """Whether the drive goes from the end of the one lane to the begin of the other, in a junction's length."""
    if not 0 <= (other.first - one.last) * STATION <= LONGEST:
        return False
    if passes_narrow_place(built.findings, places[one.last:other.first + 1]):
        return False
    if goes_past_lanes(built, places[one.last:other.first + 1]):
        return False
    exit_gap = np.linalg.norm(places[one.last, :2] - built.lanes[one.lane].centre[-1, :2])
    entry_gap = np.linalg.norm(places[other.first, :2] - built.lanes[other.lane].centre[0, :2])
    return bool(exit_gap < END_REACH and entry_gap < END_REACH)


def goes_past_lanes(built: VectorMap, path: np.ndarray) -> bool:
    """Whether a path (n, 3) outside lanes runs beside the whole of a lane of a street: lines of its own are missing
    there, and it is no way through a junction."""
    course = shapely.LineString(path[:, :2]) if len(path) > 1 else shapely.Point(path[0, :2])
    return any(lane.kind == "lane" and len(lane.centre) > 1
               and shapely.LineString(lane.centre[:, :2]).length > END_REACH
               and course.buffer(BESIDE * lane.width).covers(shapely.LineString(lane.centre[:, :2]))
               for lane in built.lanes)


def _add_virtual(built: VectorMap, one: int, other: int, path: np.ndarray) -> None:
    """A virtual lane along a drive; its bounds keep their distance to the drive, changing evenly from end to begin.

    Where they would cross, they are drawn at a lane's width about a smooth curve from lane to lane, and that is told.
    """
    x, y = path[len(path) // 2, :2]
    sides = []
    for side in ("left", "right"):
        first, last = built.coordinates(one, side)[-1], built.coordinates(other, side)[0]
        sides.append(_between(first, last, path, built.lanes[one].centre, built.lanes[other].centre))
    if append_way(built, one, other, sides, "drive"):
        return
    if append_way(built, one, other, about_curve(built, one, other), "drive, by width"):
        built.findings.append(Finding("way drawn by width", say("A drive leads from one lane to another here, but "
                                                                "bounds along it would cross; they are drawn at a "
                                                                "lane's width about a smooth curve."),
                                      float(x), float(y)))
        return
    built.findings.append(Finding("way not drawn", say("A drive leads from one lane to another "
                                                       "here, but bounds along it would cross; "
                                                       "no virtual lane was made."), float(x), float(y)))


def append_way(built: VectorMap, one: int, other: int, sides: Sequence[np.ndarray], evidence: str) -> bool:
    """Add a virtual lane with given inner points (n, 3) of its left and right bound; False where they would cross.

    It shares its bounds with the ways beside, also with one of the other direction, unless they would cross then.
    """
    return (_append(built, one, other, sides, evidence, opposite=True)
            or _append(built, one, other, sides, evidence, opposite=False))


def _append(built: VectorMap, one: int, other: int, sides: Sequence[np.ndarray], evidence: str,
            opposite: bool) -> bool:
    ends = _end_nodes(built, one), _begin_nodes(built, other)
    before = len(built.nodes), len(built.bounds), len(built.lanes)
    (left, left_forward), (right, right_forward) = (
        _virtual_bound(built, ends[0][k], ends[1][k], points, opposite) for k, points in enumerate(sides))
    width = [np.linalg.norm((built.coordinates(lane, "left")[at] - built.coordinates(lane, "right")[at])[:2])
             for lane, at in ((one, -1), (other, 0))]
    number = len(built.lanes)
    connection = MapLane(left, right, left_forward, right_forward, np.zeros((0, 3)), float(np.mean(width)),
                         float(min(width)), "virtual", evidence,
                         _turn(built.lanes[one].centre, built.lanes[other].centre), successors=[other])
    built.lanes.append(connection)
    if not (built.area(number).is_valid and _is_smooth(built, one, other, number)):
        del built.nodes[before[0]:], built.bounds[before[1]:], built.lanes[before[2]:]
        return False
    connection.centre = centre_line(built.coordinates(number, "left"), built.coordinates(number, "right"))
    built.lanes[one].successors.append(number)
    return True


def _virtual_bound(built: VectorMap, first: int, last: int, inner: np.ndarray, opposite: bool) -> tuple[int, bool]:
    """Number of the virtual bound from node to node, and whether its nodes run so.

    It is that of the way beside, where there is one (`opposite`: also of the other direction), else a new one.
    """
    for number, bound in enumerate(built.bounds):
        ends = bound.nodes[0], bound.nodes[-1]
        if bound.kind == "virtual" and (ends == (first, last) or (opposite and ends == (last, first))):
            return number, ends == (first, last)
    begin = len(built.nodes)
    built.nodes.extend(inner)
    built.bounds.append(Bound([first, *range(begin, len(built.nodes)), last], "virtual"))
    return len(built.bounds) - 1, True


def _is_smooth(built: VectorMap, one: int, other: int, way: int) -> bool:
    """Whether a way's bounds leave the end of a lane and enter the begin of another about in their directions."""
    tips = _unit(built.lanes[one].centre[-1] - built.lanes[one].centre[-2]), _unit(
        built.lanes[other].centre[1] - built.lanes[other].centre[0])
    for side in ("left", "right"):
        points = built.coordinates(way, side)
        if _unit(points[1] - points[0]) @ tips[0] < SMOOTH or _unit(points[-1] - points[-2]) @ tips[1] < SMOOTH:
            return False
    return True


def about_curve(built: VectorMap, one: int, other: int) -> list[np.ndarray]:
    """Inner points of bounds about the cubic from the end of a lane to the begin of another, in their directions."""
    begin, end = built.lanes[one].centre, built.lanes[other].centre
    chord = float(np.linalg.norm((end[0] - begin[-1])[:2]))
    leave, enter = chord * _unit(begin[-1] - begin[-2]), chord * _unit(end[1] - end[0])
    p = np.linspace(0.0, 1.0, max(4, int(chord / 2.0) + 1))[1:-1, None]
    middle = ((2 * p ** 3 - 3 * p ** 2 + 1) * begin[-1, :2] + (p ** 3 - 2 * p ** 2 + p) * leave
              + (3 * p ** 2 - 2 * p ** 3) * end[0, :2] + (p ** 3 - p ** 2) * enter)
    slope = ((6 * p ** 2 - 6 * p) * (begin[-1, :2] - end[0, :2]) + (3 * p ** 2 - 4 * p + 1) * leave
             + (3 * p ** 2 - 2 * p) * enter)
    slope /= np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), LEAST_DIVISOR)
    normal = np.column_stack([-slope[:, 1], slope[:, 0]])
    sides = []
    for side in ("left", "right"):
        first, last = built.coordinates(one, side)[-1], built.coordinates(other, side)[0]
        half = [np.linalg.norm((place - centre)[:2]) for place, centre in ((first, begin[-1]), (last, end[0]))]
        across = (half[0] + (half[1] - half[0]) * p) * (1.0 if side == "left" else -1.0)
        sides.append(np.column_stack([middle + normal * across, first[2] + (last[2] - first[2]) * p[:, 0]]))
    return sides


def _end_nodes(built: VectorMap, lane: int) -> tuple[int, int]:
    return _tip(built, lane, "left", -1), _tip(built, lane, "right", -1)


def _begin_nodes(built: VectorMap, lane: int) -> tuple[int, int]:
    return _tip(built, lane, "left", 0), _tip(built, lane, "right", 0)


def _tip(built: VectorMap, lane: int, side: str, at: int) -> int:
    """Number of the first (0) or last (-1) node of a lane's bound."""
    one = built.lanes[lane]
    number, forward = (one.left, one.left_forward) if side == "left" else (one.right, one.right_forward)
    nodes = built.bounds[number].nodes
    return nodes[at if forward else -1 - at]


def _between(first: np.ndarray, last: np.ndarray, path: np.ndarray, before: np.ndarray,
             after: np.ndarray) -> np.ndarray:
    """Points (n, 3) from `first` to `last` that run beside a smooth curve fitted to the drive's path."""
    begin, end = before[-1], after[0]
    inner = path[(np.linalg.norm(path[:, :2] - begin[:2], axis=1) > 2.5)
                 & (np.linalg.norm(path[:, :2] - end[:2], axis=1) > 2.5)]
    inner = inner[((inner[:, :2] - begin[:2]) @ _unit(before[-1] - before[-2]) > 1.0)
                  & ((end[:2] - inner[:, :2]) @ _unit(after[1] - after[0]) > 1.0)]
    curve = np.vstack([begin[:2], inner[:, :2], end[:2]])
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    # The drive lies beside the lanes' middles: its offset there goes over evenly into the lanes' own.
    shares = np.linspace(0.0, 1.0, max(3, int(at[-1] / 2.0)))
    middle = np.column_stack([np.interp(shares * at[-1], at, column) for column in curve.T])
    middle = _smooth(middle)
    tangent = np.gradient(middle, axis=0)
    tangent[0], tangent[-1] = before[-1, :2] - before[-2, :2], after[1, :2] - after[0, :2]
    tangent /= np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), LEAST_DIVISOR)
    normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    offsets = np.array([(first[:2] - begin[:2]) @ normal[0], (last[:2] - end[:2]) @ normal[-1]])
    along = np.array([(first[:2] - begin[:2]) @ tangent[0], (last[:2] - end[:2]) @ tangent[-1]])
    across = offsets[0] + (offsets[1] - offsets[0]) * shares
    ahead = along[0] * (1 - shares) ** 4 + along[1] * shares ** 4
    plan = middle + normal * across[:, None] + tangent * ahead[:, None]
    height = first[2] + (last[2] - first[2]) * shares
    return np.column_stack([plan, height])[1:-1]


def _smooth(points: np.ndarray) -> np.ndarray:
    """A path with its corners rounded, the ends held."""
    smoothed = points.copy()
    for _ in range(6):
        smoothed[1:-1] = 0.25 * smoothed[:-2] + 0.5 * smoothed[1:-1] + 0.25 * smoothed[2:]
    return smoothed


def _unit(vector: np.ndarray) -> np.ndarray:
    plan = np.asarray(vector, float)[:2]
    return plan / max(np.linalg.norm(plan), LEAST_DIVISOR)


def _turn(before: np.ndarray, after: np.ndarray) -> str:
    """Whether the way goes straight on, left or right."""
    one, other = _unit(before[-1] - before[-2]), _unit(after[1] - after[0])
    angle = np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other)
    return "straight" if abs(angle) < STRAIGHT else "left" if angle > 0 else "right"


def _tell_uncovered(built: VectorMap, places: np.ndarray, covered: np.ndarray) -> None:
    """Findings where a drive runs outside all lanes for 10 m or more."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], (~covered).astype(np.int8), [0]]))).reshape(-1, 2)
    for start, end in edges:
        if (end - start) * STATION >= 10.0:
            x, y = places[(start + end) // 2, :2]
            built.findings.append(Finding("driven without lane", say("A drive runs {end:.0f} m outside all lanes "
                                                                     "here: lines are missing, or were not seen.",
                                                                     end=(end - start) * STATION), float(x),
                                          float(y)))
