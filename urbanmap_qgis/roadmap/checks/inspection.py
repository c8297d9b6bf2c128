"""A Lanelet2 file as the rules look at it: places in metres, lanelets with their neighbours, regulatory elements."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyproj
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ...io.osm import OsmFile, OsmRelation
from ..formats.lanelet_tags import VEHICLE_SUBTYPES


@dataclass(frozen=True, eq=False)
class CheckedLane:
    """A lanelet whose bounds could be read: node ids of both in its direction, and the ids of their ways."""

    number: int
    tags: Mapping[str, str]
    left: tuple[int, ...]
    right: tuple[int, ...]
    ways: tuple[int, int]
    rules: tuple[int, ...]

    @property
    def subtype(self) -> str:
        """Its subtype, "road" where there is none, as Lanelet2 reads it."""
        return self.tags.get("subtype", "road")

    @property
    def begin(self) -> tuple[int, int]:
        """First nodes, left and right."""
        return self.left[0], self.right[0]

    @property
    def end(self) -> tuple[int, int]:
        """Last nodes, left and right."""
        return self.left[-1], self.right[-1]


@dataclass(frozen=True, eq=False)
class CheckedRule:
    """A regulatory element with its members by role, as (kind, id)."""

    number: int
    tags: Mapping[str, str]
    roles: Mapping[str, tuple[tuple[str, int], ...]]

    @property
    def subtype(self) -> str:
        """Its subtype, "" where there is none."""
        return self.tags.get("subtype", "")

    def ids(self, role: str) -> tuple[int, ...]:
        """Ids of the members with a role."""
        return tuple(number for _, number in self.roles.get(role, ()))


class MapInspection:
    """A file with all that rules ask of it more than once.

    Attributes
    ----------
    content : the file.
    numbers : node ids in their order.
    degrees : (n, 2) longitude and latitude.
    metres : (n, 3) places with heights, NaN where unknown; local coordinates where all nodes have them.
    computed : what more than one rule has to find out, by a name.
    """

    def __init__(self, content: OsmFile):
        self.content = content
        nodes = list(content.nodes.values())
        self.row = {number: k for k, number in enumerate(content.nodes)}
        self.degrees = np.array([(node.longitude, node.latitude) for node in nodes], float).reshape(-1, 2)
        self.local = np.array([[float(node.tags.get(key, "nan")) for key in ("local_x", "local_y")]
                               for node in nodes]).reshape(-1, 2)
        height = np.array([float(node.tags.get("ele", "nan")) for node in nodes])
        self.projected = _projected(self.degrees)
        whole = len(nodes) > 0 and bool(np.isfinite(self.local).all())
        self.metres = np.column_stack([self.local if whole else self.projected, height])
        off = ~np.isfinite(self.metres[:, :2]).all(axis=1)
        self._off_the_earth = frozenset(np.array(list(self.row))[off].tolist() if off.any() and not off.all() else ())
        self.lanes = {lane.number: lane for lane in map(self._lane, content.relations.values()) if lane is not None}
        self.computed: dict[str, dict] = {}
        self._conflicts: dict[tuple[int, bool], dict[int, float]] = {}
        self.rules = {number: _checked_rule(relation) for number, relation in content.relations.items()
                      if relation.tags.get("type") == "regulatory_element"}

    def _lane(self, relation: OsmRelation) -> CheckedLane | None:
        if relation.tags.get("type") != "lanelet":
            return None
        sides = [[number for kind, number, role in relation.members if kind == "way" and role == side]
                 for side in ("left", "right")]
        if any(len(side) != 1 or not self.line(side[0]) for side in sides):
            return None
        left, right = self._aligned(*(self.line(side[0]) for side in sides))
        rules = tuple(number for kind, number, role in relation.members
                      if kind == "relation" and role == "regulatory_element")
        return CheckedLane(relation.identifier, relation.tags, left, right, (sides[0][0], sides[1][0]), rules)

    def line(self, way: int) -> tuple[int, ...]:
        """Node ids of a way that are there and on the earth; empty where they are fewer than two, or it is missing."""
        element = self.content.ways.get(way)
        nodes = tuple(number for number in element.nodes
                      if number in self.row and number not in self._off_the_earth) if element else ()
        return nodes if len(nodes) >= 2 else ()

    def _aligned(self, left: tuple[int, ...], right: tuple[int, ...]) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Both bounds in the direction in which the left one lies on the left."""
        ends = [self.places(side)[[0, -1], :2] for side in (left, right)]
        straight = np.linalg.norm(ends[0] - ends[1], axis=1).sum()
        crossed = np.linalg.norm(ends[0] - ends[1][::-1], axis=1).sum()
        right = right if straight <= crossed else right[::-1]
        ring = self.places((*left, *right[::-1]))
        area = np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - np.roll(ring[:, 0], -1) * ring[:, 1])
        return (left, right) if area <= 0 else (left[::-1], right[::-1])

    def places(self, nodes: Iterable[int]) -> np.ndarray:
        """Places (n, 3) of nodes in metres."""
        return self.metres[[self.row[number] for number in nodes]]

    def shape(self, way: int) -> shapely.LineString | None:
        """A way in plan, where it can be read."""
        nodes = self.line(way)
        return shapely.LineString(self.places(nodes)[:, :2]) if nodes else None

    def polygon(self, way: int) -> shapely.Polygon | None:
        """A way as polygon, where it has three nodes."""
        nodes = tuple(dict.fromkeys(self.line(way)))
        return shapely.Polygon(self.places(nodes)[:, :2]) if len(nodes) >= 3 else None

    def way_type(self, way: int) -> str:
        """The type of a way, "" where there is none."""
        element = self.content.ways.get(way)
        return element.tags.get("type", "") if element else ""

    def ways_of(self, *types: str) -> list[int]:
        """Ids of the ways of some types."""
        return [number for kind in types for number in self._ways_by_type.get(kind, ())]

    @cached_property
    def _ways_by_type(self) -> dict[str, list[int]]:
        found = defaultdict(list)
        for number, way in self.content.ways.items():
            found[way.tags.get("type", "")].append(number)
        return found

    def rules_of(self, subtype: str) -> list[CheckedRule]:
        """Regulatory elements of a subtype."""
        return [one for one in self.rules.values() if one.subtype == subtype]

    def lane_rules(self, lane: CheckedLane, subtype: str) -> list[CheckedRule]:
        """Regulatory elements of a subtype that a lanelet refers to."""
        return [self.rules[number] for number in lane.rules if number in self.rules
                and self.rules[number].subtype == subtype]

    @cached_property
    def referrers(self) -> Mapping[int, list[CheckedLane]]:
        """Lanelets that refer to each regulatory element."""
        found = defaultdict(list)
        for lane in self.lanes.values():
            for number in lane.rules:
                found[number].append(lane)
        return found

    @cached_property
    def bounds(self) -> dict[int, tuple[shapely.LineString, shapely.LineString]]:
        """Left and right bounds of the lanelets in plan."""
        sides = [side for lane in self.lanes.values() for side in (lane.left, lane.right)]
        if not sides:
            return {}
        rows = [self.row[node] for side in sides for node in side]
        owner = np.repeat(np.arange(len(sides)), [len(side) for side in sides])
        lines = shapely.linestrings(self.metres[rows, :2], indices=owner)
        return dict(zip(self.lanes, zip(lines[::2], lines[1::2])))

    @cached_property
    def areas(self) -> dict[int, shapely.Polygon]:
        """The lanelets' areas in plan."""
        return {number: shapely.Polygon(np.vstack([self.places(lane.left), self.places(lane.right)[::-1]])[:, :2])
                for number, lane in self.lanes.items()}

    @cached_property
    def lane_tree(self) -> tuple[list[int], shapely.STRtree]:
        """Ids of the lanelets and a tree of their areas."""
        return list(self.areas), shapely.STRtree(list(self.areas.values()))

    @cached_property
    def valid_areas(self) -> dict[int, shapely.Geometry]:
        """The lanelets' areas made valid, for overlays."""
        return dict(zip(self.areas, shapely.make_valid(np.array(list(self.areas.values()), object))))

    @cached_property
    def _by_begin(self) -> dict[tuple[int, int], list[CheckedLane]]:
        found = defaultdict(list)
        for lane in self.lanes.values():
            found[lane.begin].append(lane)
        return found

    @cached_property
    def _by_end(self) -> dict[tuple[int, int], list[CheckedLane]]:
        found = defaultdict(list)
        for lane in self.lanes.values():
            found[lane.end].append(lane)
        return found

    def followers(self, lane: CheckedLane) -> list[CheckedLane]:
        """Lanelets that begin where one ends."""
        return self._by_begin.get(lane.end, [])

    def before(self, lane: CheckedLane) -> list[CheckedLane]:
        """Lanelets that end where one begins."""
        return self._by_end.get(lane.begin, [])

    @cached_property
    def _by_way(self) -> dict[tuple[int, int], list[CheckedLane]]:
        found = defaultdict(list)
        for lane in self.lanes.values():
            for side in (0, 1):
                found[lane.ways[side], side].append(lane)
        return found

    def beside(self, lane: CheckedLane, side: int) -> list[CheckedLane]:
        """Lanelets of one direction that share the left (0) or right (1) bound."""
        return [other for other in self._by_way.get((lane.ways[side], 1 - side), ()) if other is not lane]

    def across(self, lane: CheckedLane, side: int) -> list[CheckedLane]:
        """Lanelets that share a bound from its other side, of either direction."""
        shared = [*self._by_way.get((lane.ways[side], 1 - side), ()), *self._by_way.get((lane.ways[side], side), ())]
        return [other for other in shared if other is not lane and other.begin != lane.begin]

    def meeting(self, shape: shapely.Geometry) -> list[CheckedLane]:
        """Lanelets whose areas a shape meets."""
        numbers, tree = self.lane_tree
        return [self.lanes[numbers[k]] for k in tree.query(shape, predicate="intersects")]

    def conflicts(self, lane: CheckedLane, together: bool = False) -> dict[int, float]:
        """Vehicles' lanelets whose area overlaps one's, with the share of its area; those before and behind do not, and
        those that begin at the same place only where asked (`together`)."""
        if (lane.number, together) not in self._conflicts:
            self._conflicts[lane.number, together] = self._overlapping(lane, together)
        return self._conflicts[lane.number, together]

    def _overlapping(self, lane: CheckedLane, together: bool) -> dict[int, float]:
        area = self.valid_areas[lane.number]
        linked = {one.number for one in (*self.followers(lane), *self.before(lane), lane)}
        found = {}
        for other in self.meeting(area):
            same = other.begin == lane.begin and not together
            if other.number in linked or other.subtype not in VEHICLE_SUBTYPES or same:
                continue
            share = area.intersection(self.valid_areas[other.number]).area / max(area.area, LEAST_DIVISOR)
            if share > 1e-4:
                found[other.number] = share
        return found

    def extent(self, members: Iterable[tuple[str, int]]) -> float:
        """Diagonal of the box about members (kind, id), m."""
        nodes: list[int] = []
        for kind, number in members:
            if kind == "way":
                nodes += self.line(number)
            elif number in self.lanes:
                nodes += [*self.lanes[number].left, *self.lanes[number].right]
        return float(np.linalg.norm(np.ptp(self.places(nodes)[:, :2], axis=0))) if nodes else 0.0

    def nodes_of(self, kind: str, number: int) -> tuple[int, ...]:
        """Nodes that show where an element lies."""
        if kind == "node":
            return (number,) if number in self.row else ()
        if kind == "way":
            return self.line(number)
        if number in self.lanes:
            return self.lanes[number].left
        members = self.content.relations[number].members if number in self.content.relations else ()
        shown = (self.nodes_of(one, member) for one, member, _ in members if (one, member) != (kind, number)
                 and (one != "relation" or member in self.lanes))
        return next((nodes for nodes in shown if nodes), ())


def _checked_rule(relation: OsmRelation) -> CheckedRule:
    roles = defaultdict(list)
    for kind, number, role in relation.members:
        roles[role].append((kind, number))
    return CheckedRule(relation.identifier, relation.tags, {role: tuple(members) for role, members in roles.items()})


def _projected(degrees: np.ndarray) -> np.ndarray:
    """Places (n, 2) in metres about the middle one; NaN where latitude or longitude are none on the earth."""
    known = np.isfinite(degrees).all(axis=1) & (np.abs(degrees[:, 1]) <= 90.0) & (np.abs(degrees[:, 0]) <= 180.0)
    places = np.full(degrees.shape, math.nan)
    if known.any():
        middle = np.median(degrees[known], axis=0)
        plane = pyproj.Proj(proj="tmerc", lat_0=middle[1], lon_0=middle[0], ellps="WGS84")
        places[known] = np.column_stack(plane(degrees[known, 0], degrees[known, 1]))
        places[~np.isfinite(places).all(axis=1)] = math.nan
    return places
