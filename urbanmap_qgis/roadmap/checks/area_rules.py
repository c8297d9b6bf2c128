"""Autoware's rules on areas: the stop line of detection areas, buffer zones, polygons of intersections."""

from __future__ import annotations

from collections.abc import Iterator

import shapely

from .inspection import MapInspection
from .rule_table import Broken, MapRule, broken, rule

SHARED = 0.01
"""Overlaps smaller than this are shared borders, m2."""


@rule("Area.DetectionArea-004")
def _detection_stop_line(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("detection_area"):
        if [inspected.way_type(way) for way in one.ids("ref_line")] != ["stop_line"]:
            yield broken("relation", one.number)


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
