"""Rules that a Lanelet2 map must keep, as Lanelet2's and Autoware's validators have them; what breaks one is told."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import pyproj
import shapely

from ...io.osm import OsmFile, OsmRelation
from ...wording import say

TOO_CLOSE = 0.05
"""Points of one line so near are one point drawn twice, m."""

NARROW, WIDE = 1.5, 8.0
"""Widths of a lane for vehicles beyond which it is told, m."""

SAME_BORDER = 0.1
"""Borders of two lanelets that lie so near all along should be one way, m."""

ROADS = {"road", "highway", "play_street", "emergency_lane", "bus_lane", "bicycle_lane", "road_shoulder"}
AUTOWARE_REFERRED = {"crosswalk", "traffic_light", "road_marking", "traffic_sign", "no_stopping_area",
                     "detection_area"}


@dataclass(frozen=True)
class MapFault:
    """A rule that is broken.

    Attributes
    ----------
    rule, severity ("error", "warning" or "info"), text : what. element : such as "way 12".
    longitude, latitude : where, degrees; NaN where it has no place.
    """

    rule: str
    severity: str
    text: str
    element: str
    longitude: float
    latitude: float


@dataclass(frozen=True)
class CheckedLane:
    """A lanelet of the file whose bounds could be read: node ids of both in its direction."""

    relation: OsmRelation
    left: tuple[int, ...]
    right: tuple[int, ...]
    ways: tuple[int, int]


class MapInspection:
    """A file, its places in metres, and the lanelets in it."""

    def __init__(self, content: OsmFile):
        self.content = content
        nodes = list(content.nodes.values())
        place = np.array([(node.longitude, node.latitude) for node in nodes]).reshape(-1, 2)
        self.degrees = dict(zip(content.nodes, place))
        middle = place.mean(axis=0) if len(place) else np.zeros(2)
        plane = pyproj.Proj(proj="tmerc", lat_0=middle[1], lon_0=middle[0], ellps="WGS84")
        metres = np.column_stack(plane(place[:, 0], place[:, 1])) if len(place) else place
        local = [(node.tags.get("local_x"), node.tags.get("local_y")) for node in nodes]
        if local and all(x is not None and y is not None for x, y in local):
            metres = np.array(local, float)  # maps of Autoware may hold placeholders for latitude and longitude
        self.metres = dict(zip(content.nodes, metres))
        self.lanes = [lane for lane in map(self._lane, content.relations.values()) if lane is not None]

    def _lane(self, relation: OsmRelation) -> CheckedLane | None:
        if relation.tags.get("type") != "lanelet":
            return None
        sides = [[number for kind, number, role in relation.members if kind == "way" and role == side]
                 for side in ("left", "right")]
        if any(len(side) != 1 or not self.line(side[0]) for side in sides):
            return None
        left, right = (self.line(side[0]) for side in sides)
        left, right = self._aligned(left, right)
        return CheckedLane(relation, left, right, (sides[0][0], sides[1][0]))

    def line(self, way: int) -> tuple[int, ...]:
        """Node ids of a way that are there; empty where there are fewer than two or the way is missing."""
        held = self.content.ways.get(way)
        nodes = tuple(number for number in held.nodes if number in self.content.nodes) if held else ()
        return nodes if len(nodes) >= 2 else ()

    def _aligned(self, left: tuple[int, ...], right: tuple[int, ...]) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Both bounds in the direction in which the left one lies on the left."""
        ends = [self.metres[side[k]] for side in (left, right) for k in (0, -1)]
        straight = np.linalg.norm(ends[0] - ends[2]) + np.linalg.norm(ends[1] - ends[3])
        crossed = np.linalg.norm(ends[0] - ends[3]) + np.linalg.norm(ends[1] - ends[2])
        right = right if straight <= crossed else right[::-1]
        ring = self.points((*left, *right[::-1]))
        area = np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - np.roll(ring[:, 0], -1) * ring[:, 1])
        return (left, right) if area <= 0 else (left[::-1], right[::-1])

    def points(self, nodes: tuple[int, ...]) -> np.ndarray:
        """Places (n, 2) in metres."""
        return np.array([self.metres[number] for number in nodes])

    def fault(self, rule: str, severity: str, text: str, element: str, nodes: tuple[int, ...] = ()) -> MapFault:
        """A fault at the middle node of those given."""
        held = [number for number in nodes if number in self.degrees]
        longitude, latitude = self.degrees[held[len(held) // 2]] if held else (np.nan, np.nan)
        return MapFault(rule, severity, text, element, float(longitude), float(latitude))


def check_map(content: OsmFile) -> list[MapFault]:
    """All faults of a Lanelet2 file, errors first."""
    inspected = MapInspection(content)
    found = [fault for rule in RULES for fault in rule(inspected)]
    order = ("error", "warning", "info")
    return sorted(found, key=lambda fault: order.index(fault.severity))


def _identity(inspected: MapInspection) -> Iterator[MapFault]:
    for kind, number in inspected.content.repeated:
        yield inspected.fault("repeated id", "error", say("More than one {kind} has the id {number}.", kind=kind,
                                                          number=number), f"{kind} {number}")


def _references(inspected: MapInspection) -> Iterator[MapFault]:
    content = inspected.content
    held = {"node": content.nodes, "way": content.ways, "relation": content.relations}
    for number, way in content.ways.items():
        missing = [node for node in way.nodes if node not in content.nodes]
        if missing:
            yield inspected.fault("missing reference", "error", say("The way refers to node {missing}, which is not "
                                                                    "in the file.",
                                                                    missing=missing[0]), f"way {number}", way.nodes)
        elif len(way.nodes) < 2:
            yield inspected.fault("missing reference", "error", say("The way has fewer than two "
                                                                    "nodes."), f"way {number}",
                                  way.nodes)
    for number, relation in content.relations.items():
        for kind, member, _ in relation.members:
            if member not in held.get(kind, {}):
                yield inspected.fault("missing reference", "error", say("The relation refers to {kind} {member}, "
                                                                        "which is not in the file.", kind=kind,
                                                                        member=member), f"relation {number}")


def _tags(inspected: MapInspection) -> Iterator[MapFault]:
    content = inspected.content
    members = {number for relation in content.relations.values() for kind, number, _ in relation.members
               if kind == "way"}
    for number, way in content.ways.items():
        if "type" not in way.tags and number in members:
            yield inspected.fault("mandatory tag", "error", say("The way has no tag type."), f"way {number}", way.nodes)
        elif way.tags.get("type") in ("line_thin", "line_thick") and "subtype" not in way.tags:
            yield inspected.fault("mandatory tag", "warning", say("The painted line has no tag subtype (solid, "
                                                                  "dashed)."),
                                  f"way {number}", way.nodes)
    for lane in inspected.lanes:
        for tag, severity in (("subtype", "error"), ("location", "warning")):
            if tag not in lane.relation.tags:
                yield inspected.fault("mandatory tag", severity, say("The lanelet has no tag {tag}.",
                                                                     tag=tag), _name(lane),
                                      lane.left)
        if lane.relation.tags.get("subtype") in ROADS and "speed_limit" not in lane.relation.tags:
            yield inspected.fault("speed limit", "info", say("The lanelet has no speed limit: that of the traffic "
                                                             "rules will hold, or none."), _name(lane), lane.left)


def _name(lane: CheckedLane) -> str:
    return f"lanelet {lane.relation.identifier}"


def _sides(inspected: MapInspection) -> Iterator[MapFault]:
    readable = {lane.relation.identifier for lane in inspected.lanes}
    for number, relation in inspected.content.relations.items():
        if relation.tags.get("type") == "lanelet" and number not in readable:
            roles = Counter(role for kind, _, role in relation.members if kind == "way")
            yield inspected.fault("bounds", "error", say("The lanelet has {left} left and {right} right ways that "
                                                         "can be read; it needs one of each.", left=roles["left"],
                                                         right=roles["right"]), f"lanelet {number}")


def _points(inspected: MapInspection) -> Iterator[MapFault]:
    for number in inspected.content.ways:
        nodes = inspected.line(number)
        if not nodes:
            continue
        places = inspected.points(nodes)
        steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        for k in np.flatnonzero(steps < TOO_CLOSE):
            same = nodes[k] == nodes[k + 1]
            yield inspected.fault("duplicated point" if same or steps[k] == 0 else "points too close", "warning",
                                  say("Two points of the line follow each other within {steps:.3f} m.",
                                      steps=steps[k]), f"way {number}",
                                  nodes[k:k + 1])


def _shape(inspected: MapInspection) -> Iterator[MapFault]:
    for lane in inspected.lanes:
        left, right = (shapely.LineString(inspected.points(side)) for side in (lane.left, lane.right))
        if left.length == 0 or right.length == 0:
            continue
        shared = set(lane.left) & set(lane.right)
        if left.crosses(right) or (shared and lane.ways[0] == lane.ways[1]):
            yield inspected.fault("geometry", "error", say("The lanelet's bounds cross or are the same "
                                                           "way."), _name(lane),
                                  lane.left)
            continue
        if not (left.is_simple and right.is_simple):
            yield inspected.fault("geometry", "error", say("A bound of the lanelet crosses "
                                                           "itself."), _name(lane), lane.left)
        if lane.relation.tags.get("subtype") not in ROADS:
            continue
        width = shapely.distance(shapely.line_interpolate_point(left, np.linspace(0.1, 0.9, 9), normalized=True), right)
        if width.min() < NARROW or width.max() > WIDE:
            yield inspected.fault("width", "warning", say("The lanelet is {min:.2f} to {max:.2f} m wide.",
                                                          min=width.min(), max=width.max()),
                                  _name(lane), lane.left)


def _borders(inspected: MapInspection) -> Iterator[MapFault]:
    """Lanelets side by side whose borders coincide but are two ways: no lane change would be known."""
    sides = [(lane, way, shapely.LineString(inspected.points(side))) for lane in inspected.lanes
             for way, side in zip(lane.ways, (lane.left, lane.right))]
    tree = shapely.STRtree([line for *_, line in sides])
    for k, (lane, way, line) in enumerate(sides):
        for other in tree.query(line, predicate="dwithin", distance=SAME_BORDER):
            other_lane, other_way, other_line = sides[other]
            if other <= k or way == other_way or lane is other_lane or min(line.length, other_line.length) < 2.0:
                continue
            shorter, longer = sorted((line, other_line), key=lambda one: one.length)
            inner = shapely.line_interpolate_point(shorter, np.linspace(0.15, 0.85, 7), normalized=True)
            if shapely.distance(inner, longer).max() < SAME_BORDER:
                yield inspected.fault("border not shared", "warning", say("The bounds of lanelets {identifier} and "
                                                                          "{identifier_2} coincide but are two ways "
                                                                          "({way}, {other_way}).",
                                                                          identifier=lane.relation.identifier,
                                                                          identifier_2=other_lane.relation.identifier,
                                                                          way=way,
                                                                          other_way=other_way), _name(lane), lane.left)


def _rules_referred(inspected: MapInspection) -> Iterator[MapFault]:
    content = inspected.content
    used = {number for lane in inspected.lanes for kind, number, role in lane.relation.members
            if kind == "relation" and role == "regulatory_element"}
    stops: set[int] = set()
    crosswalks: set[int] = set()
    for number, relation in content.relations.items():
        if relation.tags.get("type") != "regulatory_element":
            continue
        ways = tuple(member for kind, member, _ in relation.members if kind == "way")
        stops |= set(ways)
        crosswalks |= {member for kind, member, role in relation.members if kind == "relation" and role == "refers"}
        nodes = inspected.line(ways[0]) if ways else ()
        if "subtype" not in relation.tags:
            yield inspected.fault("mandatory tag", "error", say("The regulatory element has no tag subtype."),
                                  f"regulatory element {number}", nodes)
        elif number not in used:
            yield inspected.fault("not referred to", "error", say("No lanelet refers to this regulatory element."),
                                  f"regulatory element {number}", nodes)
        if relation.tags.get("subtype") in AUTOWARE_REFERRED and not any(
                role == "refers" for *_, role in relation.members):
            yield inspected.fault("missing reference", "error", say("The regulatory element refers to nothing (role "
                                                                    "refers)."), f"regulatory element {number}", nodes)
    for number, way in content.ways.items():
        if way.tags.get("type") == "stop_line" and number not in stops:
            yield inspected.fault("not referred to", "warning", say("No regulatory element refers to this stop line."),
                                  f"way {number}", way.nodes)
    for lane in inspected.lanes:
        if lane.relation.tags.get("subtype") == "crosswalk" and lane.relation.identifier not in crosswalks:
            yield inspected.fault("not referred to", "warning", say("No regulatory element refers to this crosswalk."),
                                  _name(lane), lane.left)


def _routing(inspected: MapInspection) -> Iterator[MapFault]:
    roads = [lane for lane in inspected.lanes if lane.relation.tags.get("subtype") in ROADS]
    begins = Counter((lane.left[0], lane.right[0]) for lane in roads)
    ends = Counter((lane.left[-1], lane.right[-1]) for lane in roads)
    for lane in roads:
        if lane.relation.tags.get("one_way") == "no":
            continue
        follows = begins[lane.left[-1], lane.right[-1]]
        precedes = ends[lane.left[0], lane.right[0]]
        if not follows and not precedes:
            yield inspected.fault("routing graph", "warning", say("The lanelet has neither a next nor a previous one."),
                                  _name(lane), lane.left)
        elif not follows or not precedes:
            told = say("The lanelet is an end of the map: no other follows it.") if not follows else say(
                "The lanelet is an end of the map: none leads to it.")
            yield inspected.fault("routing graph", "info", told, _name(lane), lane.left)


def _autoware(inspected: MapInspection) -> Iterator[MapFault]:
    nodes = inspected.content.nodes
    local = [number for number, node in nodes.items() if "local_x" in node.tags and "local_y" in node.tags]
    if local and len(local) < len(nodes):
        missing = next(number for number in nodes if number not in set(local))
        yield inspected.fault("local coordinates", "error", f"{len(nodes) - len(local)} of {len(nodes)} nodes have no "
                              "local_x and local_y: all must have them or none.", f"node {missing}", (missing,))
    low = [number for number, node in nodes.items() if "ele" not in node.tags]
    if low:
        yield inspected.fault("height", "warning", say("{low_count} of {nodes_count} nodes have no height (ele).",
                                                       low_count=len(low), nodes_count=len(nodes)),
                              f"node {low[0]}", (low[0],))


RULES: tuple[Callable[[MapInspection], Iterator[MapFault]], ...] = (
    _identity, _references, _tags, _sides, _points, _shape, _borders, _rules_referred, _routing, _autoware)
