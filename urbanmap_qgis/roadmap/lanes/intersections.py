"""Intersections: virtual lanes that meet, the area that covers them, and who yields by the rule of the road."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...wording import known, say
from ..map_records import Finding, Intersection, VectorMap
from .right_of_way import complete_rights, rights_of_way

AROUND = 25.0
"""Ends of lanes so near belong to an intersection too, m."""

DRAWN = 0.6
"""Inner points of virtual bounds may be drawn inwards so far to lie within the area, m: no paint tells their place."""

ON_EDGE = 0.02
"""Ends of lanes so near to the area's edge are corners of it, m."""


def add_intersections(built: VectorMap) -> None:
    """Group the virtual lanes that overlap or begin or end together, with an area from the ends of lanes about them.

    The corners are ends of lanes only. A way that bulges beyond such an area by more than `DRAWN` stays out of it, and
    so does the longest one of a group about lanes that are no ways: it goes past a whole street.
    """
    virtual = [number for number, lane in enumerate(built.lanes) if lane.kind == "virtual"]
    groups = _groups(built, virtual)
    while (joined := _joined(built, groups)) != groups:
        groups = joined
    for group in groups:
        ring, covered = _area(built, _without_lanes_about(built, group))
        if covered:
            built.intersections.append(Intersection(ring, covered, _yields(built, covered)))


def _yields(built: VectorMap, covered: list[int]) -> dict[int, list[int]]:
    """Lanes that let others pass, by the lane that has the way; what is inferred for it goes to the lanes and into a
    finding."""
    decided = rights_of_way(built, covered)
    for (last, first), reason in decided.items():
        built.lanes[last].yields_to[first] = reason
    inferred = sorted({known(reason) for reason in decided.values()})
    if inferred:
        x, y = np.mean([built.lanes[number].centre[0, :2] for number in covered], axis=0)
        built.findings.append(Finding("right of way inferred", say(
            "No light or sign is known here: who yields is inferred ({reasons}) for {pairs} pairs of ways. Check it "
            "before anything drives by it.", reasons=", ".join(inferred), pairs=len(decided)), float(x), float(y)))
    return complete_rights(built, covered, decided)


def _groups(built: VectorMap, virtual: list[int]) -> list[list[int]]:
    areas = [built.area(number) for number in virtual]
    one, other = shapely.STRtree(areas).query(areas, predicate="intersects") if areas else ((), ())
    return [[virtual[k] for k in group] for group in linked_members(one, other, len(areas))]


def _joined(built: VectorMap, groups: list[list[int]]) -> list[list[int]]:
    """Two groups made one where the area about one holds a way of the other."""
    for k, group in enumerate(groups):
        ring = _ring_about(built, group)
        for other in groups[:k] + groups[k + 1:]:
            if _within(built, ring, other, 0.0):
                return [one for one in groups if one not in (group, other)] + [sorted(group + other)]
    return groups


def _end_nodes(built: VectorMap, lanes: Iterable[int]) -> set[int]:
    """Nodes at the begins and ends of lanes."""
    return {built.bounds[side].nodes[tip] for number in lanes
            for side in (built.lanes[number].left, built.lanes[number].right) for tip in (0, -1)}


def _without_lanes_about(built: VectorMap, group: list[int]) -> list[int]:
    """The group without its longest ways, until no lane that is no way lies within its ring; none where one of those
    left out stays there."""
    plain = [number for number, lane in enumerate(built.lanes) if lane.kind == "lane"]
    left = sorted(group, key=lambda number: built.area(number).length)
    while left and _within(built, _ring_about(built, left), plain, 0.0):
        left.pop()
    out = [number for number in group if number not in left]
    return [] if out and _within(built, _ring_about(built, left), out, 0.0) else sorted(left)


def _ring_about(built: VectorMap, group: list[int]) -> list[int]:
    """Ring of node numbers about a group: ends of its ways, with those of lanes near where that holds more of them."""
    if not group:
        return []
    ends = _end_nodes(built, group)
    ring = _ring(built, ends)
    held = _within(built, ring, group, DRAWN)
    if held != group:
        plain = [number for number, lane in enumerate(built.lanes) if lane.kind == "lane"]
        places = np.array(built.nodes)
        hull = shapely.Polygon(places[ring][:, :2]).buffer(AROUND)
        near = {node for node in _end_nodes(built, plain) if shapely.contains_xy(hull, *places[node, :2])}
        wide = _ring(built, ends | near)
        if len(_within(built, wide, group, DRAWN)) > len(held) and not _within(built, wide, plain, 0.0):
            return wide
    return ring


def _area(built: VectorMap, group: list[int]) -> tuple[list[int], list[int]]:
    """Ring of node numbers about a group, and the lanes of it that lie within."""
    ring = _ring_about(built, group)
    covered = _within(built, ring, group, DRAWN)
    _draw_inwards(built, ring, covered)
    return ring, [number for number in covered if _within(built, ring, [number], ON_EDGE)]


def _ring(built: VectorMap, nodes: set[int]) -> list[int]:
    """Nodes on the convex hull, with those at its edge, in their order."""
    numbers = np.array(sorted(nodes))
    places = np.array(built.nodes)[numbers, :2]
    edge = shapely.MultiPoint(places).convex_hull
    if edge.geom_type != "Polygon":
        return numbers.tolist()
    edge = edge.exterior
    points = shapely.points(places)
    on = shapely.distance(points, edge) <= ON_EDGE
    return numbers[on][np.argsort(shapely.line_locate_point(edge, points[on]))].tolist()


def _within(built: VectorMap, ring: list[int], lanes: list[int], reach: float) -> list[int]:
    """Lanes that lie in the area of a ring, or leave it by no more than `reach`."""
    if len(ring) < 3:
        return []
    area = shapely.Polygon(np.array(built.nodes)[ring][:, :2])
    if not area.is_valid:
        return []
    wide = area.buffer(reach + 1e-6, join_style="mitre")
    return [number for number in lanes if wide.covers(built.area(number))]


def _draw_inwards(built: VectorMap, ring: list[int], lanes: list[int]) -> None:
    """Move inner points of the lanes' bounds that lie outside the area to its inside."""
    if not lanes:
        return
    area = shapely.Polygon(np.array(built.nodes)[ring][:, :2])
    inside = area.buffer(-ON_EDGE)
    end_nodes = _end_nodes(built, range(len(built.lanes)))
    for number in lanes:
        for side in (built.lanes[number].left, built.lanes[number].right):
            for node in built.bounds[side].nodes:
                place = shapely.Point(built.nodes[node][:2])
                if node not in end_nodes and not inside.covers(place) and not inside.is_empty:
                    near = shapely.get_coordinates(shapely.shortest_line(place, inside))[1]
                    built.nodes[node] = np.array([*near, built.nodes[node][2]])
