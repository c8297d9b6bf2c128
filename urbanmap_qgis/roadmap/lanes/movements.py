"""Movements through junctions that no drive shows: what arrows, ends of lanes and the rule of the road allow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import known, mark, say
from ..map_records import TURNS, Finding, MapArea, MapLane, VectorMap
from .junctions import about_curve, append_way, goes_past_lanes
from .movement_confidence import LIMITS as CONFIDENCE
from .movement_confidence import ArrowStatistics, arrow_statistics, forced_turns, rule_confidence


@dataclass(frozen=True)
class MovementLimits:
    """Limits of inferred movements, each with its unit."""

    longest: float = 60.0  # From the end of a lane to the begin of the next, m.
    straight: float = np.radians(30.0)
    # A turn changes the course by so much at least and at the most.
    turn: tuple[float, float] = (np.radians(45.0), np.radians(135.0))
    # A stop line lies so near to the end of a lane, a crosswalk so far ahead of it, where there is a junction, m.
    stop_line: float = 5.0
    crosswalk: float = 12.0
    # The lane straight on lies beside the prolongation of a lane by no more than so many of its widths.
    beside: float = 0.75
    overlap: float = 0.05  # No way lies by more than this share of its area in other lanes.
    upstream: float = 60.0  # Arrows so far before the end of a lane belong to the junction, m.
    level: float = 2.5  # Lanes whose heights differ by more are not of one junction, m.


LIMITS = MovementLimits()

BY_ARROW, BY_RULE = mark("inferred from arrows"), mark("inferred from the rule of the road")
"""Evidence of ways that no drive shows."""

_TURN_WORDS = {"straight": mark("straight on"), "left": mark("to the left"), "right": mark("to the right")}


@dataclass(frozen=True)
class _Side:
    """Lanes of one direction side by side that end at a junction, or begin there, from left to right.

    Attributes
    ----------
    lanes : their numbers.
    place : middle of their ends or begins (3,).
    course : unit direction (2,) there.
    """

    lanes: list[int]
    place: np.ndarray
    course: np.ndarray


def add_movements(built: VectorMap, stops: Sequence[np.ndarray], crosswalks: Sequence[MapArea],
                  least: float = 0.0) -> int:
    """Add a virtual lane for each movement that is allowed and not there yet; returns their number.

    A lane whose arrows are told leads where they point. Where none is told in all lanes of an approach, each leads
    straight on and the outermost ones turn to their side; where only those of others are told, it leads straight on,
    or where theirs leave it; it must where none of them does. Such movements have a confidence; those below `least` are
    not made but become findings. A turn needs a junction: a stop line, a crosswalk or a driven way at the approach. A
    way that would lie in other lanes is not made.
    """
    approaches = [side for side in _sides(built, -1) if _is_junction(built, side, stops, crosswalks)]
    departures = _sides(built, 0)
    plain = [number for number, lane in enumerate(built.lanes) if lane.kind == "lane"]
    areas = shapely.STRtree([built.area(number) for number in plain])
    turns_of = {lane: _arrow_turns(built, lane) for approach in approaches for lane in approach.lanes}
    statistics = arrow_statistics(built, [approach.lanes for approach in approaches], turns_of)
    before = len(built.lanes)
    for approach in approaches:
        allowed = _allowed_turns(built, approach, turns_of, statistics)
        for turn in TURNS:
            departure = _departure(approach, departures, turn)
            if departure is None:
                continue
            for one, other in _pairs(built, approach, departure, turn, allowed):
                confidence, evidence = allowed[one][turn]
                if confidence < least:
                    _offer(built, one, other, turn, confidence)
                elif _add_way(built, one, other, evidence, areas, plain):
                    built.lanes[-1].confidence = confidence
    return len(built.lanes) - before


def _offer(built: VectorMap, one: int, other: int, turn: str, confidence: float) -> None:
    """A finding for a movement that is not sure enough, unless it is there."""
    if any(other in built.lanes[follower].successors for follower in built.lanes[one].successors):
        return
    x, y = built.lanes[one].centre[-1, :2]
    built.findings.append(Finding("way possible", say(
        "By the rule of the road a way {turn} is possible from this lane (confidence {confidence:.2f}), but no arrow "
        "or drive shows it; it is not in the map.", turn=known(_TURN_WORDS[turn]), confidence=confidence), float(x),
        float(y)))


def _sides(built: VectorMap, tip: int) -> list[_Side]:
    """Approaches (`tip` -1: lanes that lead into no other lane) or departures (0: lanes that none leads into)."""
    followed = {follower for lane in built.lanes if lane.kind == "lane" for follower in lane.successors
                if built.lanes[follower].kind == "lane"}
    leading = {number for number, lane in enumerate(built.lanes)
               if any(built.lanes[follower].kind == "lane" for follower in lane.successors)}
    taken = leading if tip else followed
    free = {number for number, lane in enumerate(built.lanes) if lane.kind == "lane" and number not in taken}
    sides = []
    for number in sorted(free):
        if built.lanes[number].left_neighbour in free:
            continue
        row = [number]
        while (beside := built.lanes[row[-1]].right_neighbour) in free and beside not in row:
            row.append(beside)
        ends = np.array([built.lanes[lane].centre[tip] for lane in row])
        courses = np.array([_course(built.lanes[lane], tip) for lane in row])
        sides.append(_Side(row, ends.mean(axis=0), _unit(courses.mean(axis=0))))
    return sides


def _course(lane: MapLane, tip: int) -> np.ndarray:
    """Unit direction (2,) of a lane over 5 m at its end (-1) or begin (0)."""
    line = shapely.LineString(lane.centre[:, :2])
    span = min(5.0, line.length)
    at = (line.length - span, line.length) if tip else (0.0, span)
    first, last = shapely.get_coordinates(shapely.line_interpolate_point(line, at))
    return _unit(last - first)


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / max(np.linalg.norm(vector), LEAST_DIVISOR)


def _is_junction(built: VectorMap, approach: _Side, stops: Sequence[np.ndarray],
                 crosswalks: Sequence[MapArea]) -> bool:
    """Whether a stop line, a crosswalk ahead or a driven way shows that the lanes of an approach end at a junction."""
    if any(built.lanes[follower].kind == "virtual" for lane in approach.lanes
           for follower in built.lanes[lane].successors):
        return True
    for lane in approach.lanes:
        end, course = built.lanes[lane].centre[-1, :2], _course(built.lanes[lane], -1)
        near = shapely.LineString([end - LIMITS.stop_line * course, end + LIMITS.stop_line * course])
        ahead = shapely.LineString([end - LIMITS.stop_line * course, end + LIMITS.crosswalk * course])
        if any(near.intersects(shapely.LineString(stop[:, :2])) for stop in stops):
            return True
        if any(ahead.intersects(area.polygon) for area in crosswalks):
            return True
    return False


def _allowed_turns(built: VectorMap, approach: _Side, turns_of: Mapping[int, set[str]],
                   statistics: ArrowStatistics) -> dict[int, dict[str, tuple[float, str]]]:
    """Turns that each lane of an approach may allow, with the confidence and what it comes from."""
    any_told = any(turns_of[lane] for lane in approach.lanes)
    forced = forced_turns(approach.lanes, turns_of)
    allowed = {}
    for lane in approach.lanes:
        painted = turns_of[lane] or forced.get(lane)
        if painted:
            allowed[lane] = dict.fromkeys(painted, (CONFIDENCE.arrow, BY_ARROW))
            continue
        turns = {"straight"}
        if not any_told and lane == approach.lanes[0]:
            turns.add("left")
        if not any_told and lane == approach.lanes[-1]:
            turns.add("right")
        allowed[lane] = {turn: (rule_confidence(statistics, built, approach.lanes, lane, turn, turns_of), BY_RULE)
                         for turn in turns}
    return allowed


def _arrow_turns(built: VectorMap, lane: int) -> set[str]:
    """Turns that the arrows of a lane and of those that lead into it tell, nearest lane first; none where unknown."""
    length = 0.0
    while lane >= 0 and length <= LIMITS.upstream:
        kinds = [kind.removeprefix("arrow ") for kind in built.lanes[lane].arrows]
        turns = {word for kind in kinds for word in kind.split() if word in TURNS}
        if turns:
            return turns
        length += shapely.LineString(built.lanes[lane].centre[:, :2]).length
        before = [number for number, one in enumerate(built.lanes) if one.kind == "lane" and lane in one.successors]
        lane = before[0] if len(before) == 1 else -1
    return set()


def _departure(approach: _Side, departures: Sequence[_Side], turn: str) -> _Side | None:
    """The nearest road to which a turn leads."""
    best = None
    for side in departures:
        way = side.place - approach.place
        distance = float(np.linalg.norm(way[:2]))
        if distance > LIMITS.longest or abs(way[2]) > LIMITS.level:
            continue
        if way[:2] @ approach.course <= 0.0 or way[:2] @ side.course <= 0.0 or _turn(approach, side) != turn:
            continue
        if best is None or distance < best[0]:
            best = distance, side
    return best[1] if best else None


def _turn(approach: _Side, departure: _Side) -> str:
    """The name of the turn from one course to the other, "" where it is none."""
    one, other = approach.course, departure.course
    angle = np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other)
    if abs(angle) < LIMITS.straight:
        return "straight"
    return ("left" if angle > 0 else "right") if LIMITS.turn[0] <= abs(angle) <= LIMITS.turn[1] else ""


def _pairs(built: VectorMap, approach: _Side, departure: _Side, turn: str,
           allowed: Mapping[int, Mapping[str, object]]) -> list[tuple[int, int]]:
    """Lanes of an approach and of the road that they lead to by a turn.

    Straight on the lane that lies ahead; turns to the left from the left, to the right from the right, in this order.
    """
    lanes = [lane for lane in approach.lanes if turn in allowed[lane]]
    if turn != "straight":
        side = 1 if turn == "left" else -1
        return list(zip(lanes[::side], departure.lanes[::side]))
    pairs = []
    for lane in lanes:
        end, course = built.lanes[lane].centre[-1, :2], _course(built.lanes[lane], -1)
        across = [abs(course[0] * way[1] - course[1] * way[0])
                  for way in (built.lanes[other].centre[0, :2] - end for other in departure.lanes)]
        nearest = int(np.argmin(across))
        if across[nearest] <= LIMITS.beside * built.lanes[lane].width:
            pairs.append((lane, departure.lanes[nearest]))
    return pairs


def _add_way(built: VectorMap, one: int, other: int, evidence: str, areas: shapely.STRtree,
             plain: Sequence[int]) -> bool:
    """A virtual lane about a smooth curve, unless there is one or it would lie in or beside other lanes; whether it was
    made."""
    if any(other in built.lanes[follower].successors for follower in built.lanes[one].successors):
        return False
    left, right = sides = about_curve(built, one, other)
    ends = [built.coordinates(lane, side)[tip, :2] for lane, tip, side in (
        (one, -1, "left"), (other, 0, "left"), (other, 0, "right"), (one, -1, "right"))]
    area = shapely.Polygon(np.vstack([ends[0], left[:, :2], ends[1], ends[2], right[::-1, :2], ends[3]]))
    if not area.is_valid or goes_past_lanes(built, (left + right) / 2.0):
        return False
    beside = sum(areas.geometries[k].intersection(area).area for k in areas.query(area) if plain[k] not in (one, other))
    return beside <= LIMITS.overlap * area.area and append_way(built, one, other, sides, evidence)
