"""Nodes that fall together made one, and bounds that cross themselves made plain."""

from __future__ import annotations

import numpy as np
import shapely

from .lanes.lane_assembly import centre_line
from .map_records import VectorMap

TOGETHER = 0.05
"""Nodes nearer than this are one, m: Lanelet2's validator calls them too close."""

LEVELS = 0.5
"""Nodes whose heights differ by more lie on different roads, m."""


def clean_map(built: VectorMap) -> None:
    """Join nodes that lie within `TOGETHER` and take loops out of bounds; centre lines follow."""
    before = [list(bound.nodes) for bound in built.bounds]
    _join_nodes(built)
    for bound in built.bounds:
        bound.nodes = _without_loops(built, bound.nodes)
    _drop_unused(built)
    changed = {k for k, (old, bound) in enumerate(zip(before, built.bounds)) if len(old) != len(bound.nodes)}
    for number, lane in enumerate(built.lanes):
        if changed & {lane.left, lane.right}:
            lane.centre = centre_line(built.coordinates(number, "left"), built.coordinates(number, "right"))


def _join_nodes(built: VectorMap) -> None:
    """Let bounds refer to one node where two lie together; a bound keeps two nodes, a lane its sides apart."""
    places = np.array(built.nodes, float).reshape(-1, 3)
    if len(places) < 2:
        return
    points = shapely.points(places[:, :2])
    pairs = shapely.STRtree(points).query(points, predicate="dwithin", distance=TOGETHER).T
    tips = {node for bound in built.bounds for node in (bound.nodes[0], bound.nodes[-1])}
    across = {frozenset((a, b)) for lane in built.lanes for a in built.bounds[lane.left].nodes
              for b in built.bounds[lane.right].nodes if np.abs(places[a, :2] - places[b, :2]).max() < TOGETHER}
    stands_for = list(range(len(places)))

    def root(node: int) -> int:
        while stands_for[node] != node:
            node = stands_for[node]
        return node

    for one, other in pairs[pairs[:, 0] < pairs[:, 1]].tolist():
        keep, drop = (one, other) if one in tips or other not in tips else (other, one)
        keep, drop = root(keep), root(drop)
        levels = abs(places[keep, 2] - places[drop, 2])
        if keep != drop and frozenset((one, other)) not in across and not levels > LEVELS:
            stands_for[drop] = keep
    for bound in built.bounds:
        joined = [root(node) for node in bound.nodes]
        joined = [node for k, node in enumerate(joined) if k == 0 or node != joined[k - 1]]
        bound.nodes = joined if len(joined) >= 2 else bound.nodes


def _without_loops(built: VectorMap, nodes: list[int]) -> list[int]:
    """Node numbers of a bound without the stretch between two of its segments that cross."""
    while len(nodes) > 3:
        path = np.array([built.nodes[node] for node in nodes])[:, :2]
        if shapely.LineString(path).is_simple:
            return nodes
        crossing = _crossing(path)
        if crossing is None:
            return nodes
        nodes = nodes[:crossing[0] + 1] + nodes[crossing[1] + 1:]
    return nodes


def _crossing(path: np.ndarray) -> tuple[int, int] | None:
    """Numbers of two segments that are no neighbours and meet, those with the shortest way between them."""
    segments = shapely.linestrings(np.stack([path[:-1], path[1:]], axis=1))
    one, other = shapely.STRtree(segments).query(segments, predicate="intersects")
    met = [(other_k - k, int(k), int(other_k)) for k, other_k in zip(one, other) if other_k - k >= 2]
    return min(met)[1:] if met else None


def _drop_unused(built: VectorMap) -> None:
    """Number the nodes anew without those that no bound refers to."""
    used = sorted({node for bound in built.bounds for node in bound.nodes})
    new = {old: number for number, old in enumerate(used)}
    built.nodes = [built.nodes[node] for node in used]
    for bound in built.bounds:
        bound.nodes = [new[node] for node in bound.nodes]
