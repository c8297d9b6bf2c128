"""Autoware's rules on lanelets beside and behind each other, their tags, centre lines and coordinates."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR, LEAST_SQUARE
from ..formats.lanelet_tags import FASTEST, speed_kmh
from .inspection import CheckedLane, MapInspection
from .rule_table import Broken, MapRule, broken, rule

# A lanelet made wider by the first covers the border of one beside it; with more overlap than the second
# (area of both over that of either) they lie over each other on purpose.
EXPANDED = 1.05
OVERLAP = 0.05
# Centre lines may leave their lanelet by so much in plan and in height, m.
IN_PLAN = 0.01
IN_HEIGHT = 0.1
# Range of speed limits, km/h (the validator's parameters); outside of towns up to `FASTEST`.
SLOWEST = 10.0
USUAL_FASTEST = 50.0
WALKWAY_REACH = 3.0  # Walkways reach so far beyond the road that they cross, m.

BESIDE_VEHICLES = ("road", "road_shoulder", "pedestrian_lane", "bicycle_lane")


def _beside_unshared(inspected: MapInspection) -> dict[int, list[int]]:
    """Lanelets whose border lies within another one made wider, by that one."""
    if "beside" not in inspected.computed:
        inspected.computed["beside"] = _find_beside(inspected)
    return inspected.computed["beside"]


def _find_beside(inspected: MapInspection) -> dict[int, list[int]]:
    numbers, tree = inspected.lane_tree
    if not numbers:
        return {}
    lanes = [inspected.lanes[number] for number in numbers]
    areas = np.array([inspected.valid_areas[number] for number in numbers], object)
    borders = np.array([inspected.bounds[number] for number in numbers], object)
    width = shapely.area(areas) / np.maximum(shapely.length(borders).mean(axis=1), 0.1)
    wide = shapely.buffer(areas, np.maximum(width * (EXPANDED - 1.0), 0.02), join_style="mitre")
    one, other = tree.query(wide, predicate="intersects")
    within = shapely.covers(wide[one], borders[other, 0]) | shapely.covers(wide[one], borders[other, 1])
    found: dict[int, list[int]] = {}
    for k, j in zip(one[within & (one != other)], other[within & (one != other)]):
        if _unconnected(inspected, lanes[k], lanes[j]):
            both = shapely.area(shapely.intersection(wide[k], areas[j]))
            if both < OVERLAP * (wide[k].area + areas[j].area - both):
                found.setdefault(numbers[k], []).append(numbers[j])
    return found


def _unconnected(inspected: MapInspection, lane: CheckedLane, other: CheckedLane) -> bool:
    """Whether two lanelets share no bound, no begin and no end, and do not follow each other."""
    return not ({lane.begin, lane.end} & {other.begin, other.end}
                or {lane.begin, lane.end} & {other.begin[::-1], other.end[::-1]} or set(lane.ways) & set(other.ways))


@rule("Lane.BorderSharing-001")
def _border_of_each_other(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    found = _beside_unshared(inspected)
    for number, others in found.items():
        for other in others:
            if number in found.get(other, ()):
                yield broken("relation", number, other=other)


@rule("Lane.BorderSharing-002")
def _border_of_several(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    found = _beside_unshared(inspected)
    for number, others in found.items():
        several = [other for other in others if number not in found.get(other, ())]
        if len(several) > 1:
            yield broken("relation", number, others=", ".join(map(str, several)))


def _local(inspected: MapInspection) -> Iterator[tuple[int, bool, bool]]:
    """Nodes with whether they have local_x and local_y, where any node of the map has."""
    given = [(number, "local_x" in node.tags, "local_y" in node.tags)
             for number, node in inspected.content.nodes.items()]
    yield from given if any(x or y for _, x, y in given) else ()


@rule("Lane.LocalCoordinatesDeclaration-001", "Lane.LocalCoordinatesDeclaration-002",
      "Lane.LocalCoordinatesDeclaration-003")
def _local_coordinates(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    wanted = {"001": (False, False), "002": (True, False), "003": (False, True)}[rule.code[-3:]]
    for number, *has in _local(inspected):
        if tuple(has) == wanted:
            yield broken("node", number)


def _centre_lines(inspected: MapInspection) -> Iterator[tuple[CheckedLane, int, tuple[int, ...]]]:
    """Lanelets with the way and the nodes of a centre line drawn by hand."""
    for lane in inspected.lanes.values():
        for kind, way, role in inspected.content.relations[lane.number].members:
            if kind == "way" and role == "centerline" and inspected.line(way):
                yield lane, way, inspected.line(way)


@rule("Lane.CenterlineGeometry-001")
def _centre_line_ends(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, way, nodes in _centre_lines(inspected):
        edges = [shapely.LineString(inspected.places(pair)[:, :2]) for pair in (lane.begin, lane.end)]
        for node in (nodes[0], nodes[-1]):
            place = shapely.Point(inspected.places([node])[0, :2])
            if min(edge.distance(place) for edge in edges) > IN_PLAN:
                yield broken("way", way, point=node)
                break


@rule("Lane.CenterlineGeometry-002")
def _centre_line_outside(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, way, nodes in _centre_lines(inspected):
        distances = shapely.distance(shapely.points(inspected.places(nodes)[:, :2]), inspected.valid_areas[lane.number])
        outside = [nodes[k] for k in np.flatnonzero(distances > IN_PLAN)]
        if outside:
            yield broken("way", way, points=", ".join(map(str, outside)))


@rule("Lane.CenterlineGeometry-003")
def _centre_line_height(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, way, nodes in _centre_lines(inspected):
        left, right = (inspected.places(side) for side in (lane.left, lane.right))
        off = []
        for node, place in zip(nodes, inspected.places(nodes)):
            sides = [_nearest_on(side, place[:2]) for side in (left, right)]
            reach = [np.linalg.norm(side[:2] - place[:2]) for side in sides]
            height = (sides[0][2] * reach[1] + sides[1][2] * reach[0]) / max(sum(reach), LEAST_DIVISOR)
            off += [node] if abs(height - place[2]) > IN_HEIGHT else []
        if off:
            yield broken("way", way, points=", ".join(map(str, off)))


def _nearest_on(path: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The point (3,) of a path nearest to a place in plan."""
    step = np.diff(path[:, :2], axis=0)
    squares = np.maximum((step ** 2).sum(axis=1), LEAST_SQUARE)
    share = np.clip(((place - path[:-1, :2]) * step).sum(axis=1) / squares, 0, 1)
    points = path[:-1] + share[:, None] * np.diff(path, axis=0)
    return points[np.argmin(np.linalg.norm(points[:, :2] - place, axis=1))]


@rule("Lane.LongitudinalSubtypeConnection-001")
def _walkway_goes_on(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if lane.subtype in ("crosswalk", "walkway"):
            for other in inspected.followers(lane)[:1]:
                yield broken("relation", lane.number, other=other.number)


@rule("Lane.LongitudinalSubtypeConnection-002")
def _subtype_changes(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        for other in inspected.followers(lane):
            if other.subtype != lane.subtype and lane.subtype not in ("crosswalk", "walkway"):
                yield broken("relation", lane.number, other=other.number)
                break


@rule("Lane.LateralSubtypeConnection-001")
def _subtype_beside(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        for side in (0, 1):
            for other in inspected.beside(lane, side):
                if lane.subtype in BESIDE_VEHICLES and other.subtype not in BESIDE_VEHICLES:
                    yield broken("relation", lane.number, other=other.number, value=other.subtype)


def _between_lanes(inspected: MapInspection) -> list[int]:
    """Ways between two roads of one direction."""
    return sorted({lane.ways[0] for lane in inspected.lanes.values() if lane.subtype == "road"
                   and any(other.subtype == "road" for other in inspected.beside(lane, 0))})


@rule("Lane.LaneChangeAttribute-001")
def _lane_change_missing(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in _between_lanes(inspected):
        if "lane_change" not in inspected.content.ways[way].tags:
            yield broken("way", way)


@rule("Lane.LaneChangeAttribute-002")
def _lane_change_value(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for way in _between_lanes(inspected):
        value = inspected.content.ways[way].tags.get("lane_change", "no")
        if value not in ("yes", "no"):
            yield broken("way", way, value=value)


@rule("Lane.SpeedLimitValidity-002")
def _speed_out_of_range(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        value = lane.tags.get("speed_limit", "")
        high = FASTEST if lane.tags.get("location") == "nonurban" else USUAL_FASTEST
        speed = speed_kmh(value) if value else np.nan
        if lane.subtype in ("road", "private") and speed > 0.0 and not SLOWEST <= speed <= high:
            yield broken("relation", lane.number, value=value, low=f"{SLOWEST:g}", high=f"{high:g}")


def _by_sides(inspected: MapInspection, subtype: str) -> Iterator[tuple[CheckedLane, list[CheckedLane], list[int]]]:
    """Lanelets of a subtype with those beside them and the ways of their free sides."""
    for lane in inspected.lanes.values():
        if lane.tags.get("subtype") == subtype:
            sides = [inspected.across(lane, side) for side in (0, 1)]
            yield lane, sides[0] + sides[1], [way for way, others in zip(lane.ways, sides) if not others]


@rule("Lane.RoadShoulder-001", "Lane.PedestrianLane-001")
def _nothing_beside(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    subtype = "road_shoulder" if "Shoulder" in rule.code else "pedestrian_lane"
    for lane, others, _ in _by_sides(inspected, subtype):
        if not others:
            yield broken("relation", lane.number)


@rule("Lane.RoadShoulder-003", "Lane.PedestrianLane-003")
def _free_side(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    subtype = "road_shoulder" if "Shoulder" in rule.code else "pedestrian_lane"
    for _, others, free in _by_sides(inspected, subtype):
        for way in free if others else ():
            if inspected.way_type(way) != "road_border":
                yield broken("way", way)


@rule("Lane.PedestrianLane-002")
def _beside_no_road(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane, others, _ in _by_sides(inspected, "pedestrian_lane"):
        if len(others) == 1 and others[0].subtype != "road":
            yield broken("relation", lane.number)


def _roads_crossed(inspected: MapInspection, lane: CheckedLane) -> list[CheckedLane]:
    area = inspected.valid_areas[lane.number]
    return [other for other in inspected.meeting(area) if other.subtype in ("road", "private")
            and area.intersection(inspected.valid_areas[other.number]).area > 0.0]


@rule("Lane.WalkwayIntersection-001")
def _walkway_alone(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if lane.subtype == "walkway" and not _roads_crossed(inspected, lane):
            yield broken("relation", lane.number)


@rule("Lane.WalkwayIntersection-002")
def _walkway_short(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for lane in inspected.lanes.values():
        if lane.subtype != "walkway":
            continue
        edges = [shapely.LineString(inspected.places(pair)[:, :2]) for pair in (lane.begin, lane.end)]
        for other in _roads_crossed(inspected, lane):
            common = inspected.valid_areas[lane.number].intersection(inspected.valid_areas[other.number])
            extension = min(common.distance(edge) for edge in edges)
            if extension < WALKWAY_REACH:
                yield broken("relation", lane.number, other=other.number, extension=f"{extension:.2f}")
                break
