"""Autoware's rules on intersections: areas, turns, who has the right of way."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ..formats.lanelet_tags import as_number
from .inspection import CheckedLane, CheckedRule, MapInspection
from .rule_table import Broken, MapRule, broken, rule

SIGNAL_BEFORE = 15.0
"""Turn signals are set so far before a turn where the lanelet does not tell, m."""

HARD = 0.10
"""Lanelets that cover more than this share of each other's area conflict; less is told softly."""

BEYOND = 0.01
"""Lanelets may leave an intersection area by this share of theirs."""

OPPOSITE = -0.7
"""Cosine between directions that are opposite."""


def _areas(inspected: MapInspection) -> Iterator[tuple[int, shapely.Polygon]]:
    for way in inspected.ways_of("intersection_area"):
        polygon = inspected.polygon(way)
        if polygon is not None and polygon.is_valid:
            yield way, polygon


def _turning(inspected: MapInspection) -> Iterator[CheckedLane]:
    for lane in inspected.lanes.values():
        if "turn_direction" in lane.tags:
            yield lane


def _inside(inspected: MapInspection) -> Iterator[tuple[int, CheckedLane]]:
    """Areas with the roads wholly in them."""
    for way, polygon in _areas(inspected):
        for lane in inspected.meeting(polygon):
            if lane.subtype == "road" and polygon.covers(inspected.areas[lane.number]):
                yield way, lane


@rule("Intersection.IntersectionAreaDanglingReference-001")
def _dangling(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    known = set(map(str, inspected.ways_of("intersection_area")))
    for lane in inspected.lanes.values():
        value = lane.tags.get("intersection_area")
        if value is not None and value not in known:
            yield broken("relation", lane.number, value=value)


@rule("Intersection.TurnDirectionTagging-001")
def _no_turn(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in dict.fromkeys(lane for _, lane in _inside(inspected)):
        if "turn_direction" not in lane.tags:
            yield broken("relation", lane.number)


@rule("Intersection.IntersectionAreaSegmentType-001")
def _area_points(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    border_nodes = {node for way in inspected.ways_of("road_border") for node in inspected.line(way)}
    border_nodes |= {node for lane in inspected.lanes.values() for node in (*lane.begin, *lane.end)}
    for way in inspected.ways_of("intersection_area"):
        loose = list(dict.fromkeys(node for node in inspected.line(way) if node not in border_nodes))
        if loose:
            yield broken("way", way, points=", ".join(map(str, loose)))


@rule("Intersection.IntersectionAreaTagging-001")
def _area_untagged(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way, lane in _inside(inspected):
        if "intersection_area" not in lane.tags:
            yield broken("relation", lane.number, area=way)


@rule("Intersection.IntersectionAreaTagging-002")
def _area_tagged_otherwise(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way, lane in _inside(inspected):
        if lane.tags.get("intersection_area", str(way)) != str(way):
            yield broken("relation", lane.number, area=way, value=lane.tags["intersection_area"])


@rule("Intersection.IntersectionAreaTagging-003")
def _area_left(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    polygons = {str(way): polygon for way, polygon in _areas(inspected)}
    for lane in inspected.lanes.values():
        polygon = polygons.get(lane.tags.get("intersection_area", ""))
        area = inspected.valid_areas[lane.number]
        if polygon is not None and area.difference(polygon).area > BEYOND * area.area:
            yield broken("relation", lane.number, value=lane.tags["intersection_area"])


@rule("Intersection.LaneletDivision-001")
def _divided(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        area = lane.tags.get("intersection_area")
        for other in inspected.followers(lane) if area is not None else ():
            if other.tags.get("intersection_area") == area:
                yield broken("relation", lane.number, other=other.number, area=area)


@rule("Intersection.LaneletBorderType-001")
def _border_types(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if "intersection_area" in lane.tags and any(inspected.way_type(way) not in ("virtual", "road_border")
                                                    for way in lane.ways):
            yield broken("relation", lane.number)


@rule("Intersection.TurnSignalDistanceOverlap-001")
def _turns_follow(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in _turning(inspected):
        stated = as_number(lane.tags.get("turn_signal_distance", ""))
        distance = stated if np.isfinite(stated) else SIGNAL_BEFORE
        others = _turns_before(inspected, lane, distance) if lane.tags["turn_direction"] != "straight" else []
        if others:
            yield broken("relation", lane.number, distance=f"{distance:g}", others=", ".join(map(str, others)))


def _turns_before(inspected: MapInspection, lane: CheckedLane, distance: float) -> list[int]:
    """Lanelets with the opposite turn that begin within a distance before one."""
    opposite = {"left": "right", "right": "left"}.get(lane.tags["turn_direction"], "")
    others, reached, seen = [], [(one, 0.0) for one in inspected.before(lane)], {lane.number}
    while reached:
        one, way = reached.pop()
        way += np.mean([shapely.LineString(inspected.places(side)[:, :2]).length for side in (one.left, one.right)])
        if one.number in seen or way >= distance:
            continue
        seen.add(one.number)
        others += [one.number] if one.tags.get("turn_direction") == opposite else []
        reached += [(before, way) for before in inspected.before(one)]
    return sorted(others)


# Right of way: three sets of rules, by what else the lanelets refer to.

LIGHTS, VIRTUAL, PLAIN = ("Intersection.RightOfWayWithTrafficLights", "Intersection.RightOfWayForVirtualTrafficLights",
                          "Intersection.RightOfWayWithoutTrafficLights")


def _group(inspected: MapInspection, lane: CheckedLane) -> str:
    """Which set of rules holds for a lanelet."""
    if inspected.lane_rules(lane, "virtual_traffic_light"):
        return VIRTUAL
    return LIGHTS if inspected.lane_rules(lane, "traffic_light") else PLAIN


def _ways(inspected: MapInspection, rule: MapRule) -> Iterator[tuple[CheckedLane, list[CheckedRule]]]:
    """Turning lanelets of a rule's set with their right_of_way elements."""
    for lane in _turning(inspected):
        if rule.code.startswith(_group(inspected, lane)):
            yield lane, inspected.lane_rules(lane, "right_of_way")


def _conflicting(inspected: MapInspection, lane: CheckedLane) -> dict[int, float]:
    """Lanelets that overlap one, with the larger share of either area that is common; of those that begin together
    only where a virtual traffic light lets them go one by one."""
    found = {}
    for number, share in inspected.conflicts(lane, together=_group(inspected, lane) == VIRTUAL).items():
        areas = [inspected.valid_areas[one].area for one in (lane.number, number)]
        found[number] = max(share, share * areas[0] / max(areas[1], LEAST_DIVISOR))
    return found


def _expected(inspected: MapInspection, lane: CheckedLane) -> list[int]:
    """Lanelets that a turning one at traffic lights may expect to wait, or to have red: all that it meets but the
    oncoming ones with lights of their own, to which it yields itself when it turns across them."""
    across = lane.tags["turn_direction"] == "right"
    return [number for number, share in _conflicting(inspected, lane).items() if share > HARD and not (
        across and _heading(inspected, lane) @ _heading(inspected, inspected.lanes[number]) < OPPOSITE
        and inspected.lanes[number].tags.get("turn_direction") in ("straight", "left")
        and inspected.lane_rules(inspected.lanes[number], "traffic_light"))]


@rule(f"{LIGHTS}-001", f"{VIRTUAL}-001")
def _no_right_of_way(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, rules in _ways(inspected, rule):
        turns = lane.tags["turn_direction"] in ("left", "right") and _conflicting(inspected, lane)
        if not rules and (turns or rule.code.startswith(VIRTUAL)):
            yield broken("relation", lane.number, value=lane.tags["turn_direction"])


@rule(f"{LIGHTS}-002", f"{VIRTUAL}-002")
def _several_rights_of_way(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, rules in _ways(inspected, rule):
        if len(rules) > 1 and rule.code.startswith(LIGHTS):
            for one in rules[1:]:
                yield broken("relation", one.number, other=lane.number)
        elif len(rules) > 1:
            yield broken("relation", lane.number)


@rule(f"{VIRTUAL}-003", f"{PLAIN}-001")
def _not_one_first(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    elements = dict.fromkeys(one for _, rules in _ways(inspected, rule) for one in rules)
    for one in elements:
        if len(one.ids("right_of_way")) != 1:
            yield broken("relation", one.number, count=len(one.ids("right_of_way")))


@rule(f"{LIGHTS}-003", f"{VIRTUAL}-004", f"{PLAIN}-002")
def _referrer_not_first(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, rules in _ways(inspected, rule):
        for one in rules:
            crosswalk = any(number in inspected.lanes and inspected.lanes[number].subtype == "crosswalk"
                            for number in one.ids("right_of_way"))
            if lane.number not in one.ids("right_of_way") and not crosswalk:
                yield broken("relation", one.number, other=lane.number)


def _heading(inspected: MapInspection, lane: CheckedLane) -> np.ndarray:
    """Unit direction (2,) in which a lanelet begins."""
    step = np.diff(inspected.places(lane.left[:2])[:, :2], axis=0)[0]
    return step / max(np.linalg.norm(step), LEAST_DIVISOR)


def _turns_across(inspected: MapInspection, lane: CheckedLane, other: CheckedLane) -> bool:
    """Whether another lanelet turns across one that comes from the opposite direction and does not turn so itself."""
    turns = lane.tags.get("turn_direction"), other.tags.get("turn_direction")
    oncoming = _heading(inspected, lane) @ _heading(inspected, other) < OPPOSITE
    return bool(oncoming and turns[0] in ("straight", "left") and turns[1] == "right")


@rule(f"{LIGHTS}-004", f"{PLAIN}-003", f"{VIRTUAL}-005")
def _conflicting_does_not_yield(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, rules in _ways(inspected, rule):
        for one in rules if len(rules) == 1 and lane.number in rules[0].ids("right_of_way") else ():
            wanted = _expected(inspected, lane) if rule.code.startswith(LIGHTS) else [
                number for number, share in _conflicting(inspected, lane).items() if share > HARD]
            for number in wanted:
                if number not in one.ids("yield"):
                    yield broken("relation", one.number, other=number)


def _needless(inspected: MapInspection, rule: MapRule) -> Iterator[tuple[CheckedRule, list[int]]]:
    """Elements with lanelets that yield without meeting one that has the right of way."""
    for one in dict.fromkeys(one for _, rules in _ways(inspected, rule) for one in rules if len(rules) == 1):
        first = [inspected.lanes[number] for number in one.ids("right_of_way") if number in inspected.lanes]
        met = set().union(*(inspected.conflicts(lane, together=True) for lane in first)) if first else set()
        extra = [number for number in one.ids("yield") if number not in met and number in inspected.lanes]
        if extra and not any(lane.subtype == "crosswalk" for lane in first):
            yield one, extra


@rule(f"{LIGHTS}-005", f"{VIRTUAL}-006")
def _needless_yield(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one, extra in _needless(inspected, rule):
        for number in extra:
            yield broken("relation", one.number, other=number)


@rule(f"{PLAIN}-004")
def _needless_yields(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one, extra in _needless(inspected, rule):
        yield broken("relation", one.number, others=", ".join(map(str, extra)))


@rule(f"{LIGHTS}-006", f"{VIRTUAL}-007", f"{PLAIN}-006")
def _slight_conflict(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, rules in _ways(inspected, rule):
        for one in rules:
            for number, share in _conflicting(inspected, lane).items():
                if share <= HARD and number not in one.ids("yield"):
                    yield broken("relation", one.number, other=number, share=f"{100 * share:.1f}")


@rule(f"{PLAIN}-005")
def _nobody_yields(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    by_area: dict[str, list[CheckedLane]] = {}
    for lane in _turning(inspected):
        by_area.setdefault(lane.tags.get("intersection_area", ""), []).append(lane)
    for way in inspected.ways_of("intersection_area"):
        lanes = by_area.get(str(way), [])
        regulated = any(inspected.lane_rules(lane, "right_of_way") for lane in lanes)
        plain = all(_group(inspected, lane) == PLAIN for lane in lanes)
        meet = any(_turns_across(inspected, lane, inspected.lanes[number]) and share > HARD
                   for lane in lanes for number, share in _conflicting(inspected, lane).items())
        if lanes and plain and not regulated and meet:
            yield broken("way", way)
