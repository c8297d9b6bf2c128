"""Autoware's rules on areas: detection, no parking, no stopping, bus stops, buffer zones."""

from __future__ import annotations

from collections.abc import Iterator

import shapely

from .inspection import MapInspection
from .rule_table import Broken, MapRule, broken, rule

AREAS = {"Area.DetectionArea": "detection_area", "Area.NoParkingArea": "no_parking_area",
         "Area.NoStoppingArea": "no_stopping_area",
         "Area.MissingRegulatoryElementsForBusStopAreas": "bus_stop_area"}
"""Type of the polygons and subtype of the elements by the begin of the rules' codes."""

SHARED = 0.01
"""Overlaps smaller than this are shared borders, m2."""


def _kind(rule: MapRule) -> str:
    return AREAS[rule.code[:-4]]


@rule("Area.DetectionArea-001", "Area.NoParkingArea-001", "Area.NoStoppingArea-001",
      "Area.MissingRegulatoryElementsForBusStopAreas-001")
def _area_unreferred(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    referred = {number for one in inspected.rules_of(_kind(rule)) for number in one.ids("refers")}
    for way in inspected.ways_of(_kind(rule)):
        if way not in referred:
            yield broken("way", way)


@rule("Area.DetectionArea-002", "Area.NoParkingArea-002", "Area.NoStoppingArea-002")
def _not_one_area(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(_kind(rule)):
        if len(one.ids("refers")) != 1:
            yield broken("relation", one.number, count=len(one.ids("refers")))


@rule("Area.DetectionArea-003", "Area.NoParkingArea-003", "Area.NoStoppingArea-003")
def _other_area(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(_kind(rule)):
        if any(inspected.way_type(way) != _kind(rule) for way in one.ids("refers")):
            yield broken("relation", one.number)


@rule("Area.DetectionArea-004")
def _detection_stop_line(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("detection_area"):
        if [inspected.way_type(way) for way in one.ids("ref_line")] != ["stop_line"]:
            yield broken("relation", one.number)


@rule("Area.NoStoppingArea-004")
def _several_stop_lines(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("no_stopping_area"):
        if len(one.ids("ref_line")) > 1:
            yield broken("relation", one.number, count=len(one.ids("ref_line")))


@rule("Area.NoStoppingArea-005")
def _no_stop_line(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("no_stopping_area"):
        if any(inspected.way_type(way) != "stop_line" for way in one.ids("ref_line")):
            yield broken("relation", one.number)


@rule("Area.DetectionArea-005", "Area.NoParkingArea-004", "Area.NoStoppingArea-006")
def _no_road_refers(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(_kind(rule)):
        if not inspected.referrers.get(one.number):
            yield broken("relation", one.number)


@rule("Area.DetectionArea-006", "Area.NoParkingArea-005", "Area.NoStoppingArea-007")
def _others_refer(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of(_kind(rule)):
        others = [lane.number for lane in inspected.referrers.get(one.number, ()) if lane.subtype != "road"]
        if others:
            yield broken("relation", one.number, other=others[0])


@rule("Area.BufferZoneValidity-001")
def _buffer_points(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    lane_nodes = {node for lane in inspected.lanes.values() for node in (*lane.left, *lane.right)}
    for way in inspected.ways_of("hatched_road_markings"):
        loose = [node for node in inspected.line(way) if node not in lane_nodes]
        if loose:
            yield broken("way", way, points=", ".join(map(str, dict.fromkeys(loose))))


@rule("Area.BufferZoneValidity-002", "Intersection.IntersectionAreaValidity-001")
def _invalid_polygon(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    kind = "hatched_road_markings" if rule.code.startswith("Area") else "intersection_area"
    for way in inspected.ways_of(kind):
        polygon = inspected.polygon(way)
        if polygon is None or not polygon.is_valid:
            yield broken("way", way, reason=shapely.is_valid_reason(polygon) if polygon else "< 3")


@rule("Area.BufferZoneValidity-003")
def _buffer_overlaps(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in inspected.ways_of("hatched_road_markings"):
        polygon = inspected.polygon(way)
        if polygon is None:
            continue
        zone = shapely.make_valid(polygon)
        for lane in inspected.meeting(zone):
            common = zone.intersection(inspected.valid_areas[lane.number]).area
            if lane.subtype in ("road", "road_shoulder") and common > max(SHARED, 1e-3 * zone.area):
                yield broken("way", way, other=lane.number, value=lane.subtype)
                break
