"""Rules on one lanelet or one regulatory element by itself, as tables of what breaks them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..formats.lanelet_tags import (
    AUTOWARE_RULES,
    FASTEST,
    LANELET2_RULES,
    VEHICLE_SUBTYPES,
    as_number,
    speed_kmh,
    tag_rule,
)
from ..map_records import TURNS
from .inspection import CheckedLane, CheckedRule, MapInspection
from .rule_table import Broken, MapRule, broken, rule

WALKED = ("crosswalk", "walkway")

ASKED = ({"traffic_light"} | set(AUTOWARE_RULES)) - {"speed_bump", "roundabout"}
"""Subtypes of elements that refer to something."""

LANES: dict[str, Callable[[CheckedLane], bool]] = {
    "Lane.LaneletGeometry-001": lambda lane: bool(set(lane.left) & set(lane.right)),
    "Lane.RoadLaneletAttribute-001": lambda lane: (
        lane.tags.get("subtype") == "road" and lane.tags.get("location") not in ("urban", "private")),
    "Lane.RoadLaneletAttribute-002": lambda lane: (
        lane.tags.get("subtype") == "road" and lane.tags.get("one_way") != "yes"),
    "Lanelet2.SpeedLimit-001": lambda lane: lane.subtype in VEHICLE_SUBTYPES and "speed_limit" not in lane.tags,
    "Lanelet2.Participants-003": lambda lane: (
        lane.subtype in (*WALKED, "stairs") and any(key.startswith("participant:") for key in lane.tags)
        and not any(key.startswith("participant:pedestrian") for key in lane.tags))}

VALUES: dict[str, tuple[str, Callable[[CheckedLane, str], bool]]] = {
    "Lane.SpeedLimitValidity-001": ("speed_limit", lambda lane, value: (
        lane.subtype in ("road", "private") and not speed_kmh(value) > 0.0)),
    "Lanelet2.SpeedLimit-002": ("speed_limit", lambda lane, value: (
        value != "" and not 0.0 < speed_kmh(value) <= FASTEST)),
    **{f"Crosswalk.SafetyAttributes-{number}": (f"safety_slow_down_{what}", lambda lane, value: (
        lane.subtype == "crosswalk" and not as_number(value) > 0.0))
       for number, what in (("001", "speed"), ("002", "distance"))},
    "Intersection.TurnDirectionTagging-002": ("turn_direction", lambda lane, value: value not in TURNS),
    "Intersection.IntersectionAreaTagging-004": ("turn_direction", lambda lane, _: (
        "intersection_area" not in lane.tags))}
"""Key of a lanelet's tag, and what breaks the rule where it has one."""

ELEMENTS: dict[str, Callable[[MapInspection, CheckedRule], bool]] = {
    "Lanelet2.Load-001": lambda _, one: "subtype" not in one.tags,
    "Lanelet2.Load-005": lambda _, one: (
        one.subtype != "" and not tag_rule("regulatory element", "subtype").allows(one.subtype)),
    "Lanelet2.Load-007": lambda _, one: one.subtype in ASKED and not one.ids("refers"),
    "Lanelet2.Unused-001": lambda inspected, one: (
        one.subtype in (*LANELET2_RULES, *AUTOWARE_RULES) and one.number not in inspected.referrers),
    "Lanelet2.Yield-001": lambda _, one: (
        one.subtype == "right_of_way" and one.ids("right_of_way") != () and one.ids("yield") == ()),
    "Intersection.RoadMarkings-001": lambda _, one: (
        one.subtype == "road_marking" and (len(one.ids("refers")) != 1 or one.ids("ref_line") != ())),
    "TrafficLight.RegulatoryElementDetails-001": lambda inspected, one: (
        one.subtype == "traffic_light" and not one.ids("ref_line")
        and any(lane.subtype not in WALKED for lane in inspected.referrers.get(one.number, ())))}


@rule(*LANES)
def _lane(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if LANES[rule.code](lane):
            yield broken("relation", lane.number)


@rule(*VALUES)
def _value(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    key, breaks = VALUES[rule.code]
    for lane in inspected.lanes.values():
        value = lane.tags.get(key)
        if value is not None and breaks(lane, value):
            yield broken("relation", lane.number, value=value)


@rule(*ELEMENTS)
def _element(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules.values():
        if ELEMENTS[rule.code](inspected, one):
            yield broken("relation", one.number, value=one.subtype)
