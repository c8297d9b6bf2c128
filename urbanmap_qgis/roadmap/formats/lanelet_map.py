"""A lane map as Lanelet2 elements.

The library itself makes five kinds of regulatory elements; stop lines and crosswalks as Autoware has them are others,
with which it refuses a map unless Autoware's extension is loaded. So there are two dialects. "lanelet2", which every
reader takes: a stop line is the place of a traffic sign (sign 294 of the German catalogue, a stop line, as in our
OpenDRIVE files: not a stop sign, which nobody saw), a crosswalk has the right of way over the lanes that cross it.
"autoware": elements road_marking and crosswalk, as Autoware's vector map requirements ask.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ...io.osm import OsmFile, OsmNode, OsmRelation, OsmWay
from ..map_records import Bound, MapLane, VectorMap
from .lanelet_objects import add_objects
from .lanelet_tags import defaults
from .map_projection import MapCoordinates, map_coordinates

THICK = 0.27
"""Lines wider than this are line_thick, m: paint 0.15 m wide seen by pixels of 0.12 m grows by up to a pixel."""

UNSEEN = 1.0
"""Bounds that were not seen over more than this tell so by a tag of their own, m."""

DIALECTS = ("lanelet2", "autoware")

STOP_LINE_SIGN = "de294"
"""A stop line in a catalogue of signs that Lanelet2's traffic rules know."""

STOP_BEFORE = 15.0
"""A stop line belongs to a crosswalk so far behind it, m."""

META = {"format_version": "1", "map_version": "1"}


@dataclass
class _Elements:
    """Elements under construction; ids count up over all kinds."""

    places: list[np.ndarray] = field(default_factory=list)
    node_ids: list[int] = field(default_factory=list)
    ways: dict[int, OsmWay] = field(default_factory=dict)
    members: dict[int, list[tuple[str, int, str]]] = field(default_factory=dict)
    tags: dict[int, dict[str, str]] = field(default_factory=dict)
    last: int = 0

    def next_id(self) -> int:
        self.last += 1
        return self.last

    def node(self, place: np.ndarray) -> int:
        self.places.append(place)
        self.node_ids.append(self.next_id())
        return self.node_ids[-1]

    def way(self, nodes: list[int], tags: dict[str, str]) -> int:
        number = self.next_id()
        self.ways[number] = OsmWay(number, tuple(nodes), tags)
        return number

    def relation(self, members: list[tuple[str, int, str]], tags: dict[str, str]) -> int:
        number = self.next_id()
        self.members[number], self.tags[number] = list(members), tags
        return number

    def rule(self, members: list[tuple[str, int, str]], subtype: str, lanelets: list[int], **tags: str) -> int:
        """A regulatory element that lanelets refer to."""
        number = self.relation(members, {"type": "regulatory_element", "subtype": subtype, **tags})
        for lanelet in lanelets:
            self.members[lanelet].append(("relation", number, "regulatory_element"))
        return number

    def relations(self) -> dict[int, OsmRelation]:
        return {number: OsmRelation(number, tuple(members), self.tags[number])
                for number, members in self.members.items()}


def lanelet_elements(built: VectorMap, crs_wkt: str, projector: str = "TransverseMercator",
                     speed_limit: float | None = None, dialect: str = "lanelet2") -> tuple[OsmFile, MapCoordinates]:
    """A lane map as OSM elements, and the coordinates of its nodes.

    Nodes whose height is not known have no ``ele``.

    Parameters
    ----------
    speed_limit : km/h, for lanes that have none of their own.
    dialect : of the regulatory elements, one of `DIALECTS`.
    """
    elements = _Elements()
    numbers = [elements.node(place) for place in built.nodes]
    shared = _shared_bounds(built)
    bounds = [elements.way([numbers[n] for n in bound.nodes], _bound_tags(bound, k in shared))
              for k, bound in enumerate(built.bounds)]
    lanelets = [elements.relation([("way", bounds[lane.left], "left"), ("way", bounds[lane.right], "right")],
                                  _lane_tags(lane, speed_limit)) for lane in built.lanes]
    _add_intersections(elements, built, numbers, lanelets)
    stops = _add_stop_lines(elements, built, lanelets, dialect)
    for k in sorted({k for lane in built.lanes for k in lane.crosswalks}):
        _add_crosswalk(elements, built, k, stops, lanelets, dialect)
    add_objects(elements, built, stops, lanelets)
    places = np.array(elements.places).reshape(-1, 3)
    coordinates = map_coordinates(places[:, :2], crs_wkt, projector)
    nodes = {}
    for k, number in enumerate(elements.node_ids):
        tags = {"local_x": f"{coordinates.local[k, 0]:.4f}", "local_y": f"{coordinates.local[k, 1]:.4f}"}
        tags |= {"ele": f"{places[k, 2]:.4f}"} if np.isfinite(places[k, 2]) else {}
        tags |= {"ele_sigma": f"{built.height_sigmas[k]:.2f}"} if k in built.height_sigmas else {}
        nodes[number] = OsmNode(number, float(coordinates.latitude[k]), float(coordinates.longitude[k]), tags)
    return OsmFile(nodes, elements.ways, elements.relations()), coordinates


def _shared_bounds(built: VectorMap) -> set[int]:
    """Bounds between two lanes of one direction, across which lanes may be changed or not."""
    sides = {True: set(), False: set()}
    for lane in built.lanes:
        sides[True].add((lane.left, lane.left_forward))
        sides[False].add((lane.right, lane.right_forward))
    return {bound for bound, _ in sides[True] & sides[False]}


def _bound_tags(bound: Bound, shared: bool) -> dict[str, str]:
    """Type and subtype as Lanelet2 names them, with colour, width, sigma and the length not seen where known."""
    change = {"lane_change": "yes" if bound.kind == "dashed" and shared else defaults("linestring")["lane_change"]}
    if bound.kind in ("virtual", "road border"):
        return {"type": bound.kind.replace(" ", "_"), **change}
    thick = np.isfinite(bound.width) and bound.width > THICK
    subtype = "solid_solid" if bound.double and bound.kind == "solid" else bound.kind
    tags = {"type": "line_thick" if thick else "line_thin", "subtype": subtype, **change}
    tags |= {"color": bound.colour} if bound.colour else {}
    tags |= {"width": f"{bound.width:.3f}"} if np.isfinite(bound.width) else {}
    tags |= {"unseen": f"{bound.unseen:.1f}"} if bound.unseen > UNSEEN else {}
    return tags | ({"sigma": f"{bound.sigma:.3f}"} if np.isfinite(bound.sigma) else {})


def _lane_tags(lane: MapLane, speed_limit: float | None) -> dict[str, str]:
    """Tags of a lanelet; Lanelet2 turns bounds round by itself where they run against each other's lanelets."""
    tags = {"type": "lanelet", **defaults("lanelet"), "participant:vehicle": "yes"}
    limit = lane.speed_limit if np.isfinite(lane.speed_limit) else speed_limit
    return tags | ({"speed_limit": f"{limit:g}"} if limit is not None else {})


def _add_intersections(elements: _Elements, built: VectorMap, numbers: list[int], lanelets: list[int]) -> None:
    """Areas of intersections, the turns of the ways in them, and who yields.

    A way that no area of ends of lanes covers has no turn_direction: Autoware asks for both or none.
    """
    for one in built.intersections:
        area = elements.way([numbers[node] for node in one.ring], {"type": "intersection_area", "area": "yes"})
        for lane in one.lanes:
            elements.tags[lanelets[lane]] |= {"turn_direction": built.lanes[lane].turn, "intersection_area": str(area)}
        for lane, waiting in one.yields.items():
            members = [("relation", lanelets[lane], "right_of_way")]
            members += [("relation", lanelets[other], "yield") for other in waiting]
            elements.rule(members, "right_of_way", [lanelets[lane]], inferred="yes")


def _add_stop_lines(elements: _Elements, built: VectorMap, lanelets: list[int], dialect: str) -> dict[int, int]:
    """Stop lines by their numbers; those that no lane refers to would only break the validators' rules."""
    stops = {}
    for k in sorted({k for lane in built.lanes for k in lane.stop_lines}):
        stops[k] = elements.way([elements.node(place) for place in built.stop_lines[k]],
                                {"type": "stop_line", "subtype": "solid"})
        before = [lanelets[number] for number, lane in enumerate(built.lanes) if k in lane.stop_lines]
        if dialect == "autoware":
            elements.rule([("way", stops[k], "refers")], "road_marking", before)
        else:
            elements.rule([("way", stops[k], "ref_line")], "traffic_sign", before, sign_type=STOP_LINE_SIGN)
    return stops


def _add_crosswalk(elements: _Elements, built: VectorMap, number: int, stops: dict[int, int], lanelets: list[int],
                   dialect: str) -> None:
    """A crosswalk as lanelet across the traffic and as polygon, and a rule for each stop line before it."""
    area, ring = built.crosswalks[number], built.crosswalk_ring(number)[:4]
    walk = np.array([-area.heading[1], area.heading[0]])
    across, along = ring[:, :2] @ walk, ring[:, :2] @ area.heading
    order = np.lexsort((across, along > np.median(along)))
    corners = [elements.node(ring[k]) for k in order]  # near side from right to left, then far side
    sides = [elements.way(pair, {"type": "pedestrian_marking"}) for pair in (corners[:2], corners[2:])]
    left, right = sides[::-1] if _turned(ring[order]) else sides
    lanelet = elements.relation([("way", left, "left"), ("way", right, "right")], {
        "type": "lanelet", **defaults("lanelet"), "subtype": "crosswalk", "one_way": "no",
        "participant:pedestrian": "yes"})
    outline = elements.way([corners[k] for k in (0, 1, 3, 2)], {"type": "crosswalk_polygon", "area": "yes"})
    for stop, lanes in _stops_before(built, number).items():
        line = [("way", stops[stop], "ref_line")] if stop is not None else []
        crossing = [lanelets[lane] for lane in lanes]
        if dialect == "autoware":
            elements.rule([("relation", lanelet, "refers"), *line, ("way", outline, "crosswalk_polygon")], "crosswalk",
                          crossing)
        else:
            elements.rule([("relation", lanelet, "right_of_way"), *(("relation", one, "yield") for one in crossing),
                           *line],
                          "right_of_way", [lanelet, *crossing])


def _stops_before(built: VectorMap, crosswalk: int) -> dict[int | None, list[int]]:
    """Lanes across a crosswalk by the stop line before it, None where there is none."""
    middle = np.asarray(built.crosswalks[crosswalk].polygon.centroid.coords[0])
    found: dict[int | None, list[int]] = {}
    for number, lane in enumerate(built.lanes):
        if crosswalk not in lane.crosswalks:
            continue
        ahead = lane.centre[1:, :2] - lane.centre[:-1, :2]
        course = ahead[np.argmin(np.linalg.norm(lane.centre[:-1, :2] - middle, axis=1))]
        course = course / max(np.linalg.norm(course), LEAST_DIVISOR)
        near = []
        for other in built.lanes:
            for stop in other.stop_lines if other is lane or number in other.successors else ():
                way = (middle - built.stop_lines[stop][:, :2].mean(axis=0)) @ course
                near += [(way, stop)] if 0.0 < way < STOP_BEFORE else []
        found.setdefault(min(near)[1] if near else None, []).append(number)
    return found


def _turned(corners: np.ndarray) -> bool:
    """Whether the first of two parallel ways (two corners each) lies to the right of the second."""
    course = corners[1, :2] - corners[0, :2]
    across = corners[2:, :2].mean(axis=0) - corners[:2, :2].mean(axis=0)
    return bool(course[0] * across[1] - course[1] * across[0] > 0)
