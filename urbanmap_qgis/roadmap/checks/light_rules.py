"""Autoware's rules on traffic lights, signs, stop lines, road markings and crosswalks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ..formats.lanelet_tags import as_number
from .inspection import CheckedLane, CheckedRule, MapInspection
from .member_rules import signs_of
from .rule_table import Broken, MapRule, broken, rule

LOWEST, HIGHEST = 0.2, 2.0
"""Height of a traffic light's body, m."""

DIVERGENT = 0.707
"""Cosine between the starting lines of lanelets that refer to one traffic light."""


@rule("StopLine.RegulatoryElementDetailsForTrafficSigns-002")
def _board_no_stop_sign(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in signs_of(inspected):
        for way in one.ids("refers"):
            tags = inspected.content.ways[way].tags if way in inspected.content.ways else {}
            if (tags.get("type"), tags.get("subtype")) != ("traffic_sign", "stop_sign"):
                yield broken("way", way)


@rule("StopLine.RegulatoryElementDetailsForTrafficSigns-004")
def _sign_line_subtype(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in signs_of(inspected):
        for way in one.ids("ref_line"):
            if way in inspected.content.ways and inspected.content.ways[way].tags.get("subtype") != "stop_line":
                yield broken("way", way)


@rule("TrafficLight.RegulatoryElementDetails-005")
def _bulbs_without_light(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in sorted({way for one in inspected.rules_of("traffic_light") for way in one.ids("light_bulbs")}):
        if way in inspected.content.ways and "traffic_light_id" not in inspected.content.ways[way].tags:
            yield broken("way", way)


@rule("TrafficLight.RegulatoryElementDetails-006")
def _bulbs_by_number(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("traffic_light"):
        lights, bulbs = len(one.ids("refers")), len(one.ids("light_bulbs"))
        if bulbs and lights != bulbs:
            yield broken("relation", one.number, lights=lights, bulbs=bulbs)


@rule("TrafficLight.RegulatoryElementDetails-007")
def _bulbs_one_by_one(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("traffic_light"):
        bulbs = [inspected.content.ways[way].tags.get("traffic_light_id", "") for way in one.ids("light_bulbs")
                 if way in inspected.content.ways]
        lights = sorted(map(str, one.ids("refers")))
        if bulbs and len(bulbs) == len(lights) and sorted(bulbs) != lights:
            yield broken("relation", one.number)


@rule("TrafficLight.LightBulbTagging-001", "TrafficLight.LightBulbTagging-002", "TrafficLight.LightBulbTagging-003")
def _bulb_tags(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    key, allowed = ("arrow", ("up", "left", "right", "up_left", "up_right")) if rule.code.endswith("003") else (
        "color", ("red", "yellow", "green"))
    missing = rule.code.endswith("001")
    for node in dict.fromkeys(node for way in inspected.ways_of("light_bulbs") for node in inspected.line(way)):
        value = inspected.content.nodes[node].tags.get(key)
        if missing and value is None:
            yield broken("node", node)
        elif not missing and value is not None and value not in allowed:
            yield broken("node", node, value=value)


@rule("TrafficLight.BodyHeight-001")
def _no_body_height(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in inspected.ways_of("traffic_light"):
        if "height" not in inspected.content.ways[way].tags:
            yield broken("way", way)


@rule("TrafficLight.BodyHeight-002")
def _body_height(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in inspected.ways_of("traffic_light"):
        value = inspected.content.ways[way].tags.get("height")
        if value is not None and not LOWEST <= as_number(value) <= HIGHEST:
            yield broken("way", way, value=value, low=f"{LOWEST:g}", high=f"{HIGHEST:g}")


def _facing(inspected: MapInspection) -> Iterator[tuple[int, bool, list[float]]]:
    """Three-coloured lights with whether they face the traffic that refers to them, and the cosines between the
    starting lines of those lanelets."""
    for one in inspected.rules_of("traffic_light"):
        lanes = inspected.referrers.get(one.number, ())
        stop = next((inspected.line(way) for way in one.ids("ref_line") if inspected.line(way)), ())
        if not lanes:
            continue
        starts = [_starting_line(inspected, lane, stop) for lane in lanes]
        for way in one.ids("refers"):
            tags = inspected.content.ways[way].tags if way in inspected.content.ways else {}
            nodes = inspected.line(way)
            if (tags.get("type"), tags.get("subtype")) == ("traffic_light", "red_yellow_green") and nodes:
                drawn = np.diff(inspected.places((nodes[0], nodes[-1]))[:, :2], axis=0)[0]
                yield way, bool(drawn @ starts[0] > 0), [_cosine(starts[0], start) for start in starts[1:]]


def _starting_line(inspected: MapInspection, lane: CheckedLane, stop: tuple[int, ...]) -> np.ndarray:
    """From left to right at the lanelet's end that lies nearer to the stop line, at its begin where there is none."""
    ends = [inspected.places(pair)[:, :2] for pair in (lane.begin, lane.end)]
    if stop:
        line = inspected.places((stop[0], stop[-1]))[:, :2]
        distances = [min(np.linalg.norm(end - line, axis=1).sum(), np.linalg.norm(end - line[::-1], axis=1).sum())
                     for end in ends]
        ends = ends if distances[0] <= distances[1] else ends[::-1]
    return ends[0][1] - ends[0][0]


def _cosine(one: np.ndarray, other: np.ndarray) -> float:
    return float(one @ other / max(np.linalg.norm(one) * np.linalg.norm(other), LEAST_DIVISOR))


@rule("TrafficLight.CorrectFacing-001")
def _starts_diverge(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in sorted({way for way, _, cosines in _facing(inspected) if cosines and min(cosines) < DIVERGENT}):
        yield broken("way", way)


@rule("TrafficLight.CorrectFacing-002", "TrafficLight.CorrectFacing-003")
def _faces_away(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    judged: dict[int, set[bool]] = {}
    for way, right, _ in _facing(inspected):
        judged.setdefault(way, set()).add(right)
    wanted = {False} if rule.code.endswith("002") else {True, False}
    for way, found in judged.items():
        if found == wanted:
            yield broken("way", way)


@rule("Crosswalk.MissingRegulatoryElements-001")
def _crosswalk_unreferred(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    referred = {number for one in inspected.rules_of("crosswalk") for number in one.ids("refers")}
    referred |= {number for one in inspected.rules_of("right_of_way") for number in one.ids("right_of_way")}
    for lane in inspected.lanes.values():
        if lane.subtype == "crosswalk" and lane.number not in referred:
            yield broken("relation", lane.number)


def _crosswalk_lanes(inspected: MapInspection) -> Iterator[tuple[CheckedRule, CheckedLane]]:
    """Crosswalk elements with the lanelets that they refer to."""
    for one in inspected.rules_of("crosswalk"):
        for number in one.ids("refers"):
            if number in inspected.lanes:
                yield one, inspected.lanes[number]


@rule("Crosswalk.RegulatoryElementDetails-006")
def _no_crosswalk_lanelet(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for number in dict.fromkeys(lane.number for _, lane in _crosswalk_lanes(inspected) if lane.subtype != "crosswalk"):
        yield broken("relation", number)


@rule("Crosswalk.RegulatoryElementDetails-010", "Crosswalk.RegulatoryElementDetails-011")
def _crosswalk_participant(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    missing = rule.code.endswith("010")
    for lane in dict.fromkeys(lane for _, lane in _crosswalk_lanes(inspected)):
        value = lane.tags.get("participant:pedestrian")
        if missing and value is None:
            yield broken("relation", lane.number)
        elif not missing and value is not None and value not in ("yes", "true"):
            yield broken("relation", lane.number, value=value)


@rule("Crosswalk.RegulatoryElementDetails-012")
def _crosswalk_apart(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one, walk in _crosswalk_lanes(inspected):
        for lane in inspected.referrers.get(one.number, ()):
            if lane.subtype == "road" and not inspected.areas[lane.number].intersects(inspected.areas[walk.number]):
                yield broken("relation", one.number, other=lane.number, crosswalk=walk.number)
