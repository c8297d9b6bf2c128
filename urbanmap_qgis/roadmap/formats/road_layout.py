"""Lanes as roads and junctions in the sense of ASAM OpenDRIVE: lanes side by side about one reference line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ..map_records import Bound, MapLane, VectorMap

ON_LINE = 0.05
"""Nodes that lie so near to a road's end or beyond it fall away when it is made straight, m."""

ROUNDS = 8
"""The end of a road may hang on a node that straightening the road beside it moves: so often all are gone through."""

BESIDE = 0.3
"""Sine of the least angle at which a bound meets the end of its road."""


@dataclass
class LaneRoad:
    """Lanes side by side between two cross-sections, or one virtual lane of a junction.

    Attributes
    ----------
    lanes : numbers of the map's lanes, from right to left.
    bounds : numbers (n + 1,) of theirs in that order.
    axis : place in `bounds` of the one that is the reference line.
    ahead : (n,) whether each lane leads along the road.
    junction : number of the junction it belongs to, or -1.
    before, behind : ("road", number) or ("junction", number) at the begin and at the end, or None.
    """

    lanes: list[int]
    bounds: list[int]
    axis: int
    ahead: list[bool]
    junction: int = -1
    before: tuple[str, int] | None = None
    behind: tuple[str, int] | None = None

    def lane_id(self, place: int) -> int:
        """OpenDRIVE's id of a lane: positive to the left of the reference line, negative to its right."""
        return place - self.axis + 1 if place >= self.axis else place - self.axis


@dataclass
class RoadLayout:
    """A lane map as roads and junctions.

    Attributes
    ----------
    roads : see there.
    of_lane : road and place in it of each lane.
    junctions : numbers of each one's connecting roads.
    untold : pairs of lanes whose connection cannot be told beside those of the lanes beside them.
    """

    roads: list[LaneRoad]
    of_lane: dict[int, tuple[int, int]]
    junctions: list[list[int]] = field(default_factory=list)
    untold: list[tuple[int, int]] = field(default_factory=list)


def road_layout(built: VectorMap) -> RoadLayout:
    """Roads of the map's lanes, each about the bound between its two directions, and junctions of its virtual lanes."""
    left_hand = built.left_hand is not False
    groups = [part for group in _side_by_side(built) for part in _about_one_axis(built, group, left_hand)]
    groups = _of_one_connection(built, groups)
    roads = [_road(built, group, left_hand) for group in groups]
    virtual = [number for number, lane in enumerate(built.lanes) if lane.kind == "virtual"]
    roads += [_road(built, [number], left_hand) for number in virtual]
    of_lane = {lane: (road, place) for road, one in enumerate(roads) for place, lane in enumerate(one.lanes)}
    layout = RoadLayout(roads, of_lane)
    _join_junctions(built, layout)
    _join_roads(built, layout)
    return layout


def bounds_along_ways(built: VectorMap) -> VectorMap:
    """The map whose virtual lanes have both bounds in their direction: OpenDRIVE draws each as a road of its own.

    Of a bound shared with a way of the other direction they get a turned one of their own.
    """
    bounds, lanes = list(built.bounds), list(built.lanes)
    for number, lane in enumerate(lanes):
        if lane.kind != "virtual" or (lane.left_forward and lane.right_forward):
            continue
        sides = {}
        for side, bound, forward in (("left", lane.left, lane.left_forward), ("right", lane.right, lane.right_forward)):
            sides[side] = bound
            if not forward:
                sides[side] = len(bounds)
                bounds.append(replace(bounds[bound], nodes=bounds[bound].nodes[::-1]))
        lanes[number] = replace(lane, **sides, left_forward=True, right_forward=True)
    return replace(built, bounds=bounds, lanes=lanes)


def with_straight_ends(built: VectorMap, layout: RoadLayout) -> VectorMap:
    """The map whose roads end at one straight cross-section, as OpenDRIVE knows no other: there lanes of roads that
    meet have no gap. Ends of inner bounds move along them onto the line between those of the outer bounds."""
    nodes = [np.array(place, float) for place in built.nodes]
    bounds = list(built.bounds)
    roads = sorted((road for road in layout.roads if len(road.lanes) > 1), key=lambda one: -len(one.lanes))
    for _ in range(ROUNDS):
        moved: set[int] = set()
        for road in roads:
            for tip in (0, -1):
                _straighten(nodes, bounds, road, tip, moved)
    return replace(built, nodes=nodes, bounds=bounds)


def _straighten(nodes: list[np.ndarray], bounds: list[Bound], road: LaneRoad, tip: int, moved: set[int]) -> None:
    """Move the inner bounds' ends at one end of a road onto the line between the outer ones; note which were."""
    outer = [nodes[bounds[bound].nodes[tip]][:2] for bound in (road.bounds[0], road.bounds[-1])]
    across = outer[1] - outer[0]
    normal = np.array([-across[1], across[0]]) / max(np.linalg.norm(across), LEAST_DIVISOR)
    for bound in road.bounds[1:-1]:
        node = bounds[bound].nodes[tip]
        if node not in moved and _end_on(nodes, bounds, bound, tip, outer[0], normal):
            moved.add(node)


def _end_on(nodes: list[np.ndarray], bounds: list[Bound], number: int, tip: int, place: np.ndarray,
            normal: np.ndarray) -> bool:
    """Move the end of a bound along it onto the line through a place; False where it runs beside that line."""
    chain = bounds[number].nodes[::-1] if tip else bounds[number].nodes
    end = nodes[chain[0]]
    offsets = [float((nodes[node][:2] - place) @ normal) for node in chain]
    inwards = np.sign(offsets[-1])
    # Nodes beyond the line fall away; the end and what lies well within stay.
    inner = (node for node, offset in zip(chain[1:-1], offsets[1:-1]) if offset * inwards > ON_LINE)
    remaining = [chain[0], *inner, chain[-1]]
    course = nodes[remaining[1]][:2] - end[:2]
    slope = float(course @ normal) / max(np.linalg.norm(course), LEAST_DIVISOR)
    if abs(slope) < BESIDE:
        return False
    step = course / max(np.linalg.norm(course), LEAST_DIVISOR)
    nodes[chain[0]] = np.array([*(end[:2] - offsets[0] / slope * step), end[2]])
    bounds[number] = replace(bounds[number], nodes=remaining[::-1] if tip else remaining)
    return True


def _ahead(lane: MapLane) -> bool:
    """Whether a lane leads in the direction of its bounds' nodes."""
    return lane.left_forward


def _sides(lane: MapLane) -> tuple[int, int]:
    """The bounds to the right and to the left in the direction of the bounds' nodes."""
    return (lane.right, lane.left) if _ahead(lane) else (lane.left, lane.right)


def _side_by_side(built: VectorMap) -> list[list[int]]:
    """Lanes that share bounds, from right to left."""
    plain = [number for number, lane in enumerate(built.lanes) if lane.kind == "lane"]
    by_right = {_sides(built.lanes[number])[0]: number for number in plain}
    lefts = {_sides(built.lanes[number])[1] for number in plain}
    groups = []
    for number in plain:
        if _sides(built.lanes[number])[0] in lefts:
            continue
        group = [number]
        while (onward := by_right.get(_sides(built.lanes[group[-1]])[1])) is not None:
            group.append(onward)
        groups.append(group)
    return groups


def _about_one_axis(built: VectorMap, group: Sequence[int], left_hand: bool) -> list[list[int]]:
    """The group cut where its directions are not those of one road: with traffic on the left, those ahead lie left."""
    parts: list[list[int]] = [[group[0]]]
    for before, lane in zip(group[:-1], group[1:]):
        turned = _ahead(built.lanes[before]) != _ahead(built.lanes[lane])
        if turned and _ahead(built.lanes[lane]) != left_hand:
            parts.append([])
        parts[-1].append(lane)
    return parts


def _ends(built: VectorMap, owner: dict[int, int], lane: int) -> list[set[int]]:
    """What is connected at the begin and at the end of a lane's road: -1 for a junction, else numbers of groups."""
    forward = built.lanes[lane].successors
    back = [number for number, one in enumerate(built.lanes) if lane in one.successors]
    met = [{owner.get(one, -1) for one in linked} for linked in (back, forward)]
    return met if _ahead(built.lanes[lane]) else met[::-1]


def _of_one_connection(built: VectorMap, groups: list[list[int]]) -> list[list[int]]:
    """Groups cut until every one leads to one road or junction at each of its ends, as far as its lanes do."""
    while True:
        owner = {lane: number for number, group in enumerate(groups) for lane in group}
        split: list[list[int]] = []
        for group in groups:
            connected: list[set[int]] = [set(), set()]
            part: list[int] = []
            for lane in group:
                met = [one | other for one, other in zip(connected, _ends(built, owner, lane))]
                if part and max(map(len, met)) > 1:
                    split.append(part)
                    part, met = [], _ends(built, owner, lane)
                part.append(lane)
                connected = met
            split.append(part)
        if len(split) == len(groups):
            return groups
        groups = split


def _road(built: VectorMap, group: list[int], left_hand: bool) -> LaneRoad:
    ahead = [_ahead(built.lanes[lane]) for lane in group]
    sides = [_sides(built.lanes[lane]) for lane in group]
    # Lanes to the right of the reference line: those that lead back where traffic keeps to the left.
    right = sum(one != left_hand for one in ahead)
    return LaneRoad(list(group), [sides[0][0], *(left for _, left in sides)], right, ahead)


def _join_junctions(built: VectorMap, layout: RoadLayout) -> None:
    """Number the junctions: connecting roads that begin or end at one road's end are of one."""
    parent: dict[tuple[int, bool], tuple[int, bool]] = {}

    def root(end):
        while parent.setdefault(end, end) != end:
            end = parent[end]
        return end

    links = []
    for road, one in enumerate(layout.roads):
        lane = one.lanes[0]
        if built.lanes[lane].kind == "virtual":
            before = [number for number, other in enumerate(built.lanes) if lane in other.successors]
            ends = [_end_of(layout, number, False) for number in before]
            ends += [_end_of(layout, number, True) for number in built.lanes[lane].successors]
            links.append((road, ends))
            for end in ends[1:]:
                parent[root(ends[0])] = root(end)
    numbers: dict[tuple[int, bool], int] = {}
    for road, ends in links:
        number = numbers.setdefault(root(ends[0]), len(numbers))
        if number == len(layout.junctions):
            layout.junctions.append([])
        layout.junctions[number].append(road)
        layout.roads[road].junction = number
        for at, behind in ends:
            setattr(layout.roads[at], "behind" if behind else "before", ("junction", number))
        first = built.lanes[layout.roads[road].lanes[0]]
        layout.roads[road].behind = ("road", layout.of_lane[first.successors[0]][0])
        layout.roads[road].before = ("road", ends[0][0])


def _end_of(layout: RoadLayout, lane: int, begin: bool) -> tuple[int, bool]:
    """The end of the road (number, whether it is the far one) at which a lane begins or ends."""
    road, place = layout.of_lane[lane]
    return road, layout.roads[road].ahead[place] != begin


def _join_roads(built: VectorMap, layout: RoadLayout) -> None:
    """Link roads that continue each other without a junction; what a junction leaves no room for is untold."""
    for number, lane in enumerate(built.lanes):
        for follower in lane.successors if lane.kind == "lane" else ():
            if built.lanes[follower].kind == "virtual":
                continue
            ends = _end_of(layout, number, False), _end_of(layout, follower, True)
            names = ["behind" if behind else "before" for _, behind in ends]
            wanted = [("road", ends[1][0]), ("road", ends[0][0])]
            links = [getattr(layout.roads[road], name) for (road, _), name in zip(ends, names)]
            if any(have not in (None, want) for have, want in zip(links, wanted)):
                layout.untold.append((number, follower))
                continue
            for (road, _), name, want in zip(ends, names, wanted):
                setattr(layout.roads[road], name, want)
