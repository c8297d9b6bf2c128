"""Rules on the members of regulatory elements, as tables: how many have a role, of which type they are, who refers."""

from __future__ import annotations

from collections.abc import Iterator

from .inspection import CheckedRule, MapInspection
from .rule_table import Broken, MapRule, broken, rule

SIGNS, CROSSWALK, VIRTUAL = ("StopLine.RegulatoryElementDetailsForTrafficSigns", "Crosswalk.RegulatoryElementDetails",
                             "Intersection.RegulatoryElementDetailsForVirtualTrafficLights")

NUMBERS = {
    "Area.DetectionArea-002": ("detection_area", "refers", 1, 1),
    "Area.NoParkingArea-002": ("no_parking_area", "refers", 1, 1),
    "Area.NoStoppingArea-002": ("no_stopping_area", "refers", 1, 1),
    "Area.NoStoppingArea-004": ("no_stopping_area", "ref_line", 0, 1),
    "Lanelet2.Load-003": ("right_of_way", "right_of_way", 1, None),
    f"{SIGNS}-001": ("traffic_sign", "refers", 1, None), f"{SIGNS}-003": ("traffic_sign", "ref_line", 1, None),
    f"{CROSSWALK}-001": ("crosswalk", "refers", 1, None), f"{CROSSWALK}-002": ("crosswalk", "refers", 0, 1),
    f"{CROSSWALK}-003": ("crosswalk", "ref_line", 1, None), f"{CROSSWALK}-009": ("crosswalk", "ref_line", 0, 1),
    f"{VIRTUAL}-002": ("virtual_traffic_light", "ref_line", 1, 1),
    f"{VIRTUAL}-005": ("virtual_traffic_light", "refers", 1, None)}
"""Subtype of the element, role, and how many members have it at least and at most."""

TYPES = {
    "Intersection.RoadMarkings-002": ("road_marking", "refers", "stop_line"),
    "TrafficLight.RegulatoryElementDetails-002": ("traffic_light", "refers", "traffic_light"),
    "TrafficLight.RegulatoryElementDetails-003": ("traffic_light", "ref_line", "stop_line"),
    "TrafficLight.RegulatoryElementDetails-004": ("traffic_light", "light_bulbs", "light_bulbs"),
    f"{CROSSWALK}-007": ("crosswalk", "ref_line", "stop_line"),
    f"{VIRTUAL}-001": ("virtual_traffic_light", "start_line", "virtual"),
    f"{VIRTUAL}-003": ("virtual_traffic_light", "ref_line", "stop_line"),
    f"{VIRTUAL}-004": ("virtual_traffic_light", "end_line", "virtual"),
    f"{VIRTUAL}-006": ("virtual_traffic_light", "refers", "intersection_coordination")}
"""Subtype, role, and type of the ways that have it; each other way breaks the rule."""

TYPES_OF_ALL = {
    "Area.DetectionArea-003": ("detection_area", "refers", "detection_area"),
    "Area.NoParkingArea-003": ("no_parking_area", "refers", "no_parking_area"),
    "Area.NoStoppingArea-003": ("no_stopping_area", "refers", "no_stopping_area"),
    "Area.NoStoppingArea-005": ("no_stopping_area", "ref_line", "stop_line")}
"""The same; it is the element that breaks the rule."""

UNREFERRED = {
    "Area.DetectionArea-001": ("detection_area", ("detection_area",), ("refers",)),
    "Area.NoParkingArea-001": ("no_parking_area", ("no_parking_area",), ("refers",)),
    "Area.NoStoppingArea-001": ("no_stopping_area", ("no_stopping_area",), ("refers",)),
    "Area.MissingRegulatoryElementsForBusStopAreas-001": ("bus_stop_area", ("bus_stop_area",), ("refers",)),
    "StopLine.MissingRegulatoryElements-001": ("stop_line", (), ("refers", "ref_line")),
    "TrafficLight.MissingRegulatoryElements-001": ("traffic_light", ("traffic_light",), ("refers",))}
"""Type of ways, subtypes of the elements (none: all) and roles in which one must refer to each."""

WITHOUT_LANE = {"Area.DetectionArea-005": "detection_area", "Area.NoParkingArea-004": "no_parking_area",
                "Area.NoStoppingArea-006": "no_stopping_area", "TrafficLight.MissingReferrers-001": "traffic_light"}
"""Subtypes of elements to which a lanelet must refer."""

BY_ROADS = {"Area.DetectionArea-006": "detection_area", "Area.NoParkingArea-005": "no_parking_area",
            "Area.NoStoppingArea-007": "no_stopping_area"}
"""Subtypes of elements to which roads alone refer."""

SPREAD = {f"{SIGNS}-005": "traffic_sign", "TrafficLight.RegulatoryElementDetails-008": "traffic_light",
          f"{CROSSWALK}-013": "crosswalk", f"{VIRTUAL}-007": "virtual_traffic_light"}
"""Subtypes of elements whose members lie together."""

LARGEST = 200.0
"""Diagonal of the box about the members of one element, m."""


def signs_of(inspected: MapInspection) -> list[CheckedRule]:
    """Traffic signs that stand for a board; those with a sign_type of their own need none."""
    return [one for one in inspected.rules_of("traffic_sign") if "sign_type" not in one.tags]


@rule(*NUMBERS)
def _number(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    subtype, role, least, most = NUMBERS[rule.code]
    for one in signs_of(inspected) if subtype == "traffic_sign" else inspected.rules_of(subtype):
        count = len(one.ids(role))
        if count < least or (most is not None and count > most):
            yield broken("relation", one.number, count=count)


@rule(*TYPES)
def _type(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    subtype, role, kind = TYPES[rule.code]
    for one in inspected.rules_of(subtype):
        for way in one.ids(role):
            if inspected.way_type(way) != kind:
                yield broken("way", way)


@rule(*TYPES_OF_ALL)
def _type_of_all(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    subtype, role, kind = TYPES_OF_ALL[rule.code]
    for one in inspected.rules_of(subtype):
        if any(inspected.way_type(way) != kind for way in one.ids(role)):
            yield broken("relation", one.number)


@rule(*UNREFERRED)
def _unreferred(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    kind, subtypes, roles = UNREFERRED[rule.code]
    referred = {number for one in inspected.rules.values() if not subtypes or one.subtype in subtypes
                for role in roles for number in one.ids(role)}
    for way in inspected.ways_of(kind):
        if way not in referred:
            yield broken("way", way)


@rule(*WITHOUT_LANE)
def _without_lane(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(WITHOUT_LANE[rule.code]):
        if not inspected.referrers.get(one.number):
            yield broken("relation", one.number)


@rule(*BY_ROADS)
def _by_others(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(BY_ROADS[rule.code]):
        others = [lane.number for lane in inspected.referrers.get(one.number, ()) if lane.subtype != "road"]
        if others:
            yield broken("relation", one.number, other=others[0])


@rule(*SPREAD)
def _spread(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(SPREAD[rule.code]):
        size = inspected.extent(member for members in one.roles.values() for member in members)
        if size > LARGEST:
            yield broken("relation", one.number, size=f"{size:.0f}")
