"""A lane map as Lanelet2 elements, with the tags that Lanelet2 and Autoware expect."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import shapely

from ...io.osm import OsmFile, OsmNode, OsmRelation, OsmWay
from ..map_records import Bound, VectorMap
from .map_projection import MapCoordinates, map_coordinates

THICK = 0.22
"""Lines wider than this are line_thick, m."""

UNSEEN = 1.0
"""Bounds that were not seen over more than this tell so by a tag of their own, m."""

META = {"format_version": "1", "map_version": "1"}


@dataclass
class _Elements:
    """Elements under construction; ids count up over all kinds."""

    places: list[np.ndarray] = field(default_factory=list)
    node_ids: list[int] = field(default_factory=list)
    ways: dict[int, OsmWay] = field(default_factory=dict)
    relations: dict[int, OsmRelation] = field(default_factory=dict)
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
        self.relations[number] = OsmRelation(number, tuple(members), tags)
        return number


def lanelet_elements(built: VectorMap, crs_wkt: str, projector: str = "TransverseMercator",
                     speed_limit: float | None = None) -> tuple[OsmFile, MapCoordinates]:
    """A lane map as OSM elements, and the coordinates of its nodes.

    Nodes whose height is not known have no ``ele``.

    Parameters
    ----------
    speed_limit : km/h, for lanes that have none of their own.
    """
    made = _Elements()
    numbers = [made.node(place) for place in built.nodes]
    bounds = [made.way([numbers[n] for n in bound.nodes], _bound_tags(bound)) for bound in built.bounds]
    # Stop lines and crosswalks that no lane refers to would only break the validators' rules.
    used = sorted({k for lane in built.lanes for k in lane.stop_lines})
    stops = {k: made.way([made.node(place) for place in built.stop_lines[k]],
                         {"type": "stop_line", "subtype": "solid"}) for k in used}
    rules = {("stop", k): made.relation([("way", way, "refers")], {"type": "regulatory_element",
                                                                   "subtype": "road_marking"})
             for k, way in stops.items()}
    for k in sorted({k for lane in built.lanes for k in lane.crosswalks}):
        _add_crosswalk(made, built, k, built.crosswalks[k], stops, rules)
    for lane in built.lanes:
        _add_lane(made, lane, bounds, rules, speed_limit)
    places = np.array(made.places).reshape(-1, 3)
    coordinates = map_coordinates(places[:, :2], crs_wkt, projector)
    nodes = {}
    for k, number in enumerate(made.node_ids):
        height = {"ele": f"{places[k, 2]:.4f}"} if np.isfinite(places[k, 2]) else {}
        nodes[number] = OsmNode(number, float(coordinates.latitude[k]), float(coordinates.longitude[k]), {
            "local_x": f"{coordinates.local[k, 0]:.4f}", "local_y": f"{coordinates.local[k, 1]:.4f}",
            **height})
    return OsmFile(nodes, made.ways, made.relations), coordinates


def _bound_tags(bound: Bound) -> dict[str, str]:
    """Type and subtype as Lanelet2 names them, with colour, width, sigma and the length not seen where known."""
    if bound.kind == "virtual":
        return {"type": "virtual"}
    if bound.kind == "road border":
        return {"type": "road_border"}
    thick = np.isfinite(bound.width) and bound.width > THICK
    subtype = "solid_solid" if bound.double and bound.kind == "solid" else bound.kind
    tags = {"type": "line_thick" if thick else "line_thin", "subtype": subtype}
    tags |= {"color": bound.colour} if bound.colour else {}
    tags |= {"width": f"{bound.width:.3f}"} if np.isfinite(bound.width) else {}
    tags |= {"unseen": f"{bound.unseen:.1f}"} if bound.unseen > UNSEEN else {}
    return tags | ({"sigma": f"{bound.sigma:.3f}"} if np.isfinite(bound.sigma) else {})


def _add_lane(made: _Elements, lane, bounds: list[int], rules: dict, speed_limit: float | None) -> None:
    """A lanelet; Lanelet2 turns bounds round by itself where they run against each other's lanelets."""
    tags = {"type": "lanelet", "subtype": "road", "location": "urban", "one_way": "yes", "participant:vehicle": "yes"}
    limit = lane.speed_limit if np.isfinite(lane.speed_limit) else speed_limit
    if limit is not None:
        tags["speed_limit"] = f"{limit:g}"
    if lane.turn:
        tags["turn_direction"] = lane.turn
    members = [("way", bounds[lane.left], "left"), ("way", bounds[lane.right], "right")]
    members += [("relation", rules[key], "regulatory_element")
                for key in [*(("stop", k) for k in lane.stop_lines), *(("crosswalk", k) for k in lane.crosswalks)]]
    made.relation(members, tags)


def _add_crosswalk(made: _Elements, built: VectorMap, number: int, area, stops: dict[int, int],
                   rules: dict) -> None:
    """A crosswalk as lanelet across the traffic, and the rule that the lanes across it refer to."""
    ring = shapely.get_coordinates(area.polygon.exterior, include_z=True)[:4]
    walk = np.array([-area.heading[1], area.heading[0]])
    across, along = ring[:, :2] @ walk, ring[:, :2] @ area.heading
    order = np.lexsort((across, along > np.median(along)))
    corners = [made.node(ring[k]) for k in order]  # near side from right to left, then far side
    left = made.way(corners[:2], {"type": "pedestrian_marking"})
    right = made.way(corners[2:], {"type": "pedestrian_marking"})
    if _turned(ring[order]):
        left, right = right, left
    lanelet = made.relation([("way", left, "left"), ("way", right, "right")], {
        "type": "lanelet", "subtype": "crosswalk", "location": "urban", "one_way": "no",
        "participant:pedestrian": "yes"})
    crossing = [lane for lane in built.lanes if number in lane.crosswalks]
    members = [("relation", lanelet, "refers")]
    members += [("way", stops[k], "ref_line") for k in sorted({k for lane in crossing for k in lane.stop_lines})]
    rules["crosswalk", number] = made.relation(members, {"type": "regulatory_element", "subtype": "crosswalk"})


def _turned(corners: np.ndarray) -> bool:
    """Whether the first of two parallel ways (two corners each) lies to the right of the second."""
    course = corners[1, :2] - corners[0, :2]
    apart = corners[2:, :2].mean(axis=0) - corners[:2, :2].mean(axis=0)
    return bool(course[0] * apart[1] - course[1] * apart[0] > 0)
