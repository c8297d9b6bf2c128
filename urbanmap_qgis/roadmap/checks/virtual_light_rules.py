"""Autoware's rules on virtual traffic lights: that their lines lie on the way in their order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from .inspection import CheckedLane, CheckedRule, MapInspection
from .rule_table import Broken, MapRule, broken, rule

ORDER = "Intersection.VirtualTrafficLightLineOrder"
COORDINATED = ("intersection_coordination",)
"""Types of what a virtual traffic light refers to."""

LONGEST_WAY = 30
"""Lanelets between a start line and an end line at most."""

ON_WAY = 0.1
"""A stop line lies on a lanelet by more than this, m."""


@dataclass(frozen=True)
class _Section:
    """What a virtual traffic light holds: lanes of its start line, and for each referrer its end line and the way."""

    element: CheckedRule
    start: shapely.LineString
    begins: list[CheckedLane]
    ends: dict[int, int | None]
    ways: dict[int, list[CheckedLane]]


def _sections(inspected: MapInspection) -> Iterator[_Section]:
    """Virtual traffic lights of intersections that have a start line."""
    for one in inspected.rules_of("virtual_traffic_light"):
        starts = [inspected.shape(way) for way in one.ids("start_line") if inspected.shape(way) is not None]
        if not starts or not all(inspected.way_type(way) in COORDINATED for way in one.ids("refers")):
            continue
        begins = [lane for lane in inspected.meeting(starts[0]) if lane.subtype == "road"]
        lanes = inspected.referrers.get(one.number, [])
        ends = {lane.number: _end_line(inspected, one, lane) for lane in lanes}
        ways = {lane.number: _way(inspected, begins, lane) for lane in lanes}
        yield _Section(one, starts[0], begins, ends, ways)


def _end_line(inspected: MapInspection, one: CheckedRule, lane: CheckedLane) -> int | None:
    """The end line on a lanelet: one that crosses it and none of the other referrers, or nearly its end."""
    others = [other for other in inspected.referrers.get(one.number, ()) if other is not lane]
    for way in one.ids("end_line"):
        line = inspected.shape(way)
        if line is None or not line.intersects(inspected.areas[lane.number]):
            continue
        shares = {other.number: line.intersection(inspected.valid_areas[other.number]).length
                  for other in (lane, *others)}
        if shares[lane.number] >= max(shares.values()) - 1e-6:
            return way
    return None


def _way(inspected: MapInspection, begins: list[CheckedLane], goal: CheckedLane) -> list[CheckedLane]:
    """Lanelets from one of the start line to a referrer; empty where there is no way."""
    reached = [[lane] for lane in begins]
    seen = {lane.number for lane in begins}
    while reached:
        way = reached.pop(0)
        if way[-1] is goal:
            return way
        for onward in inspected.followers(way[-1]) if len(way) < LONGEST_WAY else ():
            if onward.number not in seen:
                seen.add(onward.number)
                reached.append([*way, onward])
    return []


@rule(f"{ORDER}-001")
def _start_off_lanes(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section in _sections(inspected):
        if not section.begins:
            yield broken("way", section.element.ids("start_line")[0])


@rule(f"{ORDER}-002")
def _no_end_line(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section in _sections(inspected):
        for number, end in section.ends.items():
            if end is None:
                yield broken("relation", section.element.number, other=number)


@rule(f"{ORDER}-003")
def _start_on_referrer(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section in _sections(inspected):
        for number in section.ends:
            if section.start.intersects(inspected.areas[number]):
                yield broken("way", section.element.ids("start_line")[0], other=number)
                break


@rule(f"{ORDER}-004")
def _no_way(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section in _sections(inspected):
        for number, way in section.ways.items():
            if not way and section.begins and section.ends[number] is not None:
                yield broken("relation", section.element.number, end=section.ends[number])


def _with_stop(inspected: MapInspection) -> Iterator[tuple[_Section, int, int, shapely.LineString, bool]]:
    """Sections with each end line, the stop line, and whether this lies on the way."""
    for section in _sections(inspected):
        stop = next(iter(section.element.ids("ref_line")), None)
        line = inspected.shape(stop) if stop is not None else None
        for number, way in section.ways.items() if line is not None else ():
            if way and section.ends[number] is not None:
                on = any(line.intersection(inspected.valid_areas[lane.number]).length > ON_WAY for lane in way)
                yield section, number, stop, line, on


@rule(f"{ORDER}-005")
def _stop_off_way(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section, number, stop, _, on in _with_stop(inspected):
        if not on:
            yield broken("way", stop, end=section.ends[number])


@rule(f"{ORDER}-006")
def _wrong_order(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for section, number, _, line, on in _with_stop(inspected):
        if not on:
            continue
        left = np.vstack([inspected.places(lane.left)[:, :2] for lane in section.ways[number]])
        right = np.vstack([inspected.places(lane.right)[:, :2] for lane in section.ways[number]])
        end = inspected.shape(section.ends[number])
        sides = [[side.project(one.interpolate(0.5, normalized=True)) for one in (section.start, line, end)]
                 for side in (shapely.LineString(left), shapely.LineString(right))]
        at = np.mean(sides, axis=0)
        if not at[0] < at[1] < at[2]:
            yield broken("relation", section.element.number, end=section.ends[number])


@rule("Intersection.VirtualTrafficLightSectionOverlap-001")
def _sections_overlap(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    """Ways between start and end lines that share a lanelet other than the one of the start line."""
    lanes_of = {section.element.number: {lane.number for way in section.ways.values() for lane in way[1:]}
                for section in _sections(inspected)}
    firsts = {section.element.number: {way[1].number if len(way) > 1 else -1 for way in section.ways.values()}
              for section in _sections(inspected)}
    numbers = list(lanes_of)
    for k, one in enumerate(numbers):
        for other in numbers[k + 1:]:
            if lanes_of[one] & lanes_of[other] and not firsts[one] & firsts[other]:
                yield broken("relation", one, other=other)
