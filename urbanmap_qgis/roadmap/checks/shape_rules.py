"""Rules on shapes: points of lines, bounds of lanelets, widths, twins, and how lanelets are connected."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_SQUARE
from ..formats.lanelet_tags import VEHICLE_SUBTYPES
from .inspection import CheckedLane, MapInspection
from .rule_table import Broken, MapRule, broken, rule

TOO_CLOSE = 0.05  # Points of one line so near are one point drawn twice, m.
# Widths of a lane for vehicles beyond which it is told, m.
NARROW = 1.5
WIDE = 8.0
BACK = -0.966  # Cosine of the turn at a point by which a bound turns back, 165 degrees.
SHARPEST = 0.5  # Largest curvature of a bound, 1/m (lanelet2_validation).

ROADS = (*VEHICLE_SUBTYPES, "pedestrian_lane")


def _steps(inspected: MapInspection) -> Iterator[tuple[int, tuple[int, ...], np.ndarray]]:
    """Ways with their nodes and the distances (m) between them."""
    for number in inspected.content.ways:
        nodes = inspected.line(number)
        if nodes:
            yield number, nodes, np.linalg.norm(np.diff(inspected.places(nodes)[:, :2], axis=0), axis=1)


@rule("mapping.duplicated_points")
def _duplicated(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for number, way in inspected.content.ways.items():
        twice = next((one for one, other in zip(way.nodes, way.nodes[1:]) if one == other), None)
        if twice is not None:
            yield broken("way", number, node=twice)


@rule("mapping.points_too_close")
def _too_close(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    upright = {"traffic_light", "light_bulbs", "traffic_sign", "pole", "post"}
    for number, nodes, steps in _steps(inspected):
        near = [k for k in np.flatnonzero(steps < TOO_CLOSE) if nodes[k] != nodes[k + 1]]
        if near and inspected.way_type(number) not in upright:
            yield broken("way", number, apart=f"{steps[near].min():.3f}")


@rule("mapping.curvature_too_big")
def _curvature(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        for nodes in (lane.left, lane.right):
            places = inspected.places(nodes)[:, :2]
            one, other, chord = places[1:-1] - places[:-2], places[2:] - places[1:-1], places[2:] - places[:-2]
            area = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
            sides = np.prod([np.linalg.norm(side, axis=1) for side in (one, other, chord)], axis=0)
            kinks = np.flatnonzero(2.0 * area > SHARPEST * np.maximum(sides, LEAST_SQUARE))
            if len(kinks):
                yield broken("relation", lane.number, node=nodes[kinks[0] + 1])
                break


@rule("Shape.Bounds-001")
def _crossing(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        left, right = inspected.bounds[lane.number]
        if lane.ways[0] == lane.ways[1] or left.crosses(right):
            yield broken("relation", lane.number)


@rule("Shape.Bounds-002")
def _crossing_itself(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if not shapely.is_simple(inspected.bounds[lane.number]).all() or any(
                _turns_back(inspected.places(side)[:, :2]) for side in (lane.left, lane.right)):
            yield broken("relation", lane.number)


def _turns_back(places: np.ndarray) -> bool:
    """Whether a line (n, 2) turns back on its own course at a point, which need not make it cross itself."""
    steps = np.diff(places, axis=0)
    length = np.linalg.norm(steps, axis=1)
    steps, length = steps[length > TOO_CLOSE], length[length > TOO_CLOSE]
    return bool(((steps[1:] * steps[:-1]).sum(axis=1) < BACK * length[1:] * length[:-1]).any())


@rule("Shape.Bounds-003")
def _no_length(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if min(side.length for side in inspected.bounds[lane.number]) < 1e-3:
            yield broken("relation", lane.number)


@rule("Shape.Width-001")
def _width(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    shares = np.linspace(0.1, 0.9, 9)
    for lane in inspected.lanes.values():
        left, right = inspected.bounds[lane.number]
        if lane.subtype not in ROADS or min(left.length, right.length) == 0:
            continue
        width = shapely.distance(shapely.line_interpolate_point(left, shares, normalized=True), right)
        narrow = NARROW if lane.subtype in ("road", "highway", "bus_lane") else 0.0
        if width.min() < narrow or width.max() > WIDE:
            yield broken("relation", lane.number, narrowest=f"{width.min():.2f}", widest=f"{width.max():.2f}")


@rule("Shape.Twin-001")
def _twins(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    by_bounds: dict[tuple, list[int]] = defaultdict(list)
    for lane in inspected.lanes.values():
        by_bounds[lane.left, lane.right].append(lane.number)
    for numbers in by_bounds.values():
        for number in numbers[1:]:
            yield broken("relation", number, other=numbers[0])


def _links(inspected: MapInspection) -> Iterator[tuple[CheckedLane, bool, bool]]:
    """Roads with whether something follows and precedes."""
    for lane in inspected.lanes.values():
        if lane.subtype in ROADS and lane.tags.get("one_way") != "no":
            yield lane, bool(inspected.followers(lane)), bool(inspected.before(lane))


@rule("routing.graph-001")
def _alone(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, follows, precedes in _links(inspected):
        if not (follows or precedes):
            yield broken("relation", lane.number)


@rule("routing.graph-002")
def _leads_nowhere(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, follows, precedes in _links(inspected):
        if precedes and not follows:
            yield broken("relation", lane.number)


@rule("routing.graph-003")
def _comes_from_nowhere(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, follows, precedes in _links(inspected):
        if follows and not precedes:
            yield broken("relation", lane.number)
