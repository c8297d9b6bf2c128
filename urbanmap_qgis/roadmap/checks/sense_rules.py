"""Our own rules on what elements say of each other: stop lines, turns, who yields to whom, lanelets drawn twice."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ..formats.lanelet_tags import VEHICLE_SUBTYPES
from .inspection import CheckedLane, MapInspection
from .rule_table import Broken, MapRule, broken, rule

ACROSS = 0.5  # A stop line lies across a lanelet over so much, m.
STEEPEST = 0.71  # Cosine of the angle between a stop line and a lanelet's course, at most.
BEYOND = 1.0  # It may lie so far beyond the lanelet's end, m.
OFF_LANES = 10.0  # Where no lanelet is so near, a stop line may belong to roads that are not drawn, m.
TURNS = 5.0  # A turn to a side bends so much to it at least, degrees.
STRAIGHT = 60.0  # A way straight on bends by so much at most, degrees.
COVERED = 0.5  # Lanelets that share more than this of the smaller one's area are one drawn twice.
ONE_WAY = 0.9  # Cosine between courses that are one.

ROLES = {"refers", "ref_line", "cancels", "cancel_line", "right_of_way", "yield", "light_bulbs", "start_line",
         "end_line", "crosswalk_polygon", "traffic_light", "regulatory_element"}
"""Roles that readers know in regulatory elements."""

ROLE_KINDS = {"right_of_way": "relation", "yield": "relation", "ref_line": "way", "light_bulbs": "way"}


@rule("Lanelet2.Members-001")
def _wrong_kind(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules.values():
        for role, wanted in ROLE_KINDS.items():
            other = [number for kind, number in one.roles.get(role, ()) if kind != wanted]
            if other:
                yield broken("relation", one.number, role=role, other=other[0], wanted=wanted)


@rule("Lanelet2.Members-002")
def _unknown_role(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules.values():
        for role in one.roles.keys() - ROLES:
            yield broken("relation", one.number, role=role)


@rule("Lanelet2.Yield-002")
def _yields_to_itself(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("right_of_way"):
        both = set(one.ids("yield")) & set(one.ids("right_of_way"))
        if both:
            yield broken("relation", one.number, other=min(both))


@rule("Lanelet2.Yield-003")
def _yields_to_no_crosswalk(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("right_of_way"):
        walks = [number for number in one.ids("right_of_way") if number in inspected.lanes
                 and inspected.lanes[number].subtype in ("crosswalk", "walkway")]
        for number in one.ids("yield") if walks and len(walks) == len(one.ids("right_of_way")) else ():
            if number in inspected.lanes and not any(inspected.areas[number].intersects(inspected.areas[walk])
                                                     for walk in walks):
                yield broken("relation", one.number, other=number)


@rule("Shape.StopLine-001")
def _stop_line_along_or_aside(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    numbers, tree = inspected.lane_tree
    for way in inspected.ways_of("stop_line"):
        line = inspected.shape(way)
        if line is None or not numbers:
            continue
        if line.length < ACROSS:
            yield broken("way", way)
            continue
        near = [inspected.lanes[numbers[k]] for k in tree.query(line, predicate="dwithin", distance=OFF_LANES)]
        if not near and not _is_referred(inspected, way):
            continue
        if not any(_lies_across(inspected, lane, way) for lane in near):
            yield broken("way", way)


def _is_referred(inspected: MapInspection, way: int) -> bool:
    return any(way in one.ids(role) for one in inspected.rules.values() for role in ("refers", "ref_line"))


def _lies_across(inspected: MapInspection, lane: CheckedLane, way: int) -> bool:
    line = inspected.shape(way)
    end = shapely.LineString(inspected.places(lane.end)[:, :2])
    beyond = end.distance(line.interpolate(0.5, normalized=True)) > BEYOND
    if beyond and line.intersection(inspected.valid_areas[lane.number]).length < ACROSS:
        return False
    drawn = np.diff(inspected.places(inspected.line(way))[[0, -1], :2], axis=0)[0]
    middle = np.array(line.interpolate(0.5, normalized=True).coords[0])
    return any(abs(_cosine(drawn, step)) <= STEEPEST for step in _steps_near(inspected, lane, middle))


def _steps_near(inspected: MapInspection, lane: CheckedLane, place: np.ndarray) -> list[np.ndarray]:
    """The steps of both bounds that lie nearest to a place."""
    steps = []
    for side in (lane.left, lane.right):
        points = inspected.places(side)[:, :2]
        step = np.diff(points, axis=0)
        steps.append(step[np.argmin(np.linalg.norm((points[:-1] + points[1:]) / 2.0 - place, axis=1))])
    return steps


def _cosine(one: np.ndarray, other: np.ndarray) -> float:
    return float(one @ other / max(np.linalg.norm(one) * np.linalg.norm(other), LEAST_DIVISOR))


@rule("Shape.Turn-001")
def _turns_otherwise(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        value = lane.tags.get("turn_direction")
        if value is None:
            continue
        bend = _bend(inspected, lane)
        wrong = {"left": bend < TURNS, "right": bend > -TURNS, "straight": abs(bend) > STRAIGHT}
        if wrong.get(value, False):
            yield broken("relation", lane.number, value=value, bend=f"{bend:+.0f}")


def _bend(inspected: MapInspection, lane: CheckedLane) -> float:
    """Angle by which a lanelet bends from its begin to its end, degrees, positive to the left."""
    headings = []
    for first, last in ((0, 1), (-2, -1)):
        step = sum(inspected.places(side)[last, :2] - inspected.places(side)[first, :2]
                   for side in (lane.left, lane.right))
        headings.append(np.arctan2(step[1], step[0]))
    return float(np.degrees((headings[1] - headings[0] + np.pi) % (2.0 * np.pi) - np.pi))


@rule("Shape.Overlap-001")
def _drawn_twice(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    numbers = [lane.number for lane in inspected.lanes.values()
               if lane.subtype in VEHICLE_SUBTYPES and "turn_direction" not in lane.tags]
    areas = np.array([inspected.valid_areas[number] for number in numbers], object)
    middles = shapely.centroid(areas)
    # Of two that share most of the smaller one's area each holds about the other's middle: a cheap question first.
    one, other = shapely.STRtree(areas).query(middles, predicate="within")
    for k, j in zip(one[one != other], other[one != other]):
        lanes = [inspected.lanes[numbers[n]] for n in sorted((k, j))]
        smaller = min(areas[k].area, areas[j].area)
        if _apart(*lanes) and _one_course(inspected, *lanes) and \
                areas[k].intersection(areas[j]).area > COVERED * smaller:
            yield broken("relation", lanes[1].number, other=lanes[0].number)


def _apart(lane: CheckedLane, other: CheckedLane) -> bool:
    """Whether two lanelets of one kind share neither a bound nor a node of their ends."""
    return lane.subtype == other.subtype and not (
        {*lane.begin, *lane.end} & {*other.begin, *other.end} or set(lane.ways) & set(other.ways))


def _one_course(inspected: MapInspection, lane: CheckedLane, other: CheckedLane) -> bool:
    chords = [np.diff(inspected.places((one.left[0], one.left[-1]))[:, :2], axis=0)[0] for one in (lane, other)]
    return _cosine(*chords) > ONE_WAY
