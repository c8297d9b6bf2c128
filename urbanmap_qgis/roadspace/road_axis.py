"""The skeleton of road surfaces: middle lines with the boundary points on their left and right, and where they meet.

Source: R. L. Ogniewicz and O. Kübler, "Hierarchic Voronoi skeletons" (1995): points of the boundary, the edges of their
Voronoi diagram inside of it, and pruning by how far apart along the boundary the two points of an edge lie.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from scipy.spatial import Voronoi

from ..geometry.tolerances import LEAST_SQUARE

# What the skeleton goes by.
POINTS_A_WIDTH = 8.0  # points of the boundary on each side in one mean width of the road.
LONGEST_STEP = 0.5  # farthest distance of two points, m.
SHORTEST_STEP = 0.25  # nearest distance of two points, m: half of the narrowest road that map level 1000 asks for.
DEPTH = 2.2  # a strip is a road of its own where the way around its end is that many times its width.


@dataclass(frozen=True, eq=False)
class Ring:
    """One ring of a surface, the surface on its left.

    Attributes
    ----------
    points : (n, 2), not closed, m.
    """

    points: np.ndarray

    @cached_property
    def lengths(self) -> np.ndarray:
        """Lengths (n,) of the edges from each point to the next, m."""
        return np.hypot(*(np.roll(self.points, -1, axis=0) - self.points).T)

    @cached_property
    def places(self) -> np.ndarray:
        """Places (n + 1,) of the points along the ring, m, the first again at the end."""
        return np.concatenate([[0.0], np.cumsum(self.lengths)])

    @property
    def length(self) -> float:
        """Of the whole ring, m."""
        return float(self.places[-1])

    @cached_property
    def turns(self) -> np.ndarray:
        """Turns (n,) at the points, radians, positive to the left."""
        edges = np.roll(self.points, -1, axis=0) - self.points
        angles = np.arctan2(edges[:, 1], edges[:, 0])
        turns = angles - np.roll(angles, 1)
        return (turns + np.pi) % (2 * np.pi) - np.pi

    def points_at(self, places: np.ndarray | float) -> np.ndarray:
        """Points (..., 2) at places along the ring, which may run over its ends."""
        within = np.mod(places, self.length)
        number = np.clip(np.searchsorted(self.places, within, side="right") - 1, 0, len(self.points) - 1)
        share = ((within - self.places[number]) / np.maximum(self.lengths[number], LEAST_SQUARE))[..., None]
        return self.points[number] * (1 - share) + self.points[(number + 1) % len(self.points)] * share


@dataclass(frozen=True, eq=False)
class Branch:
    """A middle line between two ends or meeting points.

    Attributes
    ----------
    points : (n, 2), m.
    clearance : (n,) distance to the boundary, m.
    left, right : (n - 1, 2) ring and place along it of the nearest boundary on each side, by steps of the line.
    start, end : numbers of the nodes.
    """

    points: np.ndarray
    clearance: np.ndarray
    left: np.ndarray
    right: np.ndarray
    start: int
    end: int

    @cached_property
    def length(self) -> float:
        """Of the line, m."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())

    def turned(self) -> Branch:
        """The same line from its end."""
        return Branch(self.points[::-1], self.clearance[::-1], self.right[::-1], self.left[::-1], self.end, self.start)


@dataclass(frozen=True, eq=False)
class Skeleton:
    """The middle lines of one surface.

    Attributes
    ----------
    rings : of the surface, the outer one first.
    branches : all lines.
    nodes : branches that end at a node, by its number; those of a line that starts and ends there come twice.
    """

    rings: tuple[Ring, ...]
    branches: tuple[Branch, ...]
    nodes: dict[int, list[int]]


def skeleton_of(surface: shapely.Polygon) -> Skeleton:
    """The skeleton of a valid polygon, m."""
    oriented = shapely.geometry.polygon.orient(surface)
    rings = tuple(Ring(shapely.get_coordinates(ring)[:-1]) for ring in (oriented.exterior, *oriented.interiors))
    width = 2 * surface.area / surface.length
    step = float(np.clip(width / POINTS_A_WIDTH, SHORTEST_STEP, LONGEST_STEP))
    points, owners = _samples(rings, step)
    if len(points) < 4:
        return Skeleton(rings, (), {})
    middle = points.mean(axis=0)
    diagram = Voronoi(points - middle)
    corners = diagram.vertices + middle
    ends, pairs = np.array(diagram.ridge_vertices), np.asarray(diagram.ridge_points)
    shapely.prepare(surface)
    inside = shapely.contains_xy(surface, corners[:, 0], corners[:, 1])
    finite = (ends >= 0).all(axis=1)
    finite[finite] = inside[ends[finite]].all(axis=1)
    ends, pairs = ends[finite], pairs[finite]
    clearance = np.zeros(len(corners))
    clearance[ends] = np.hypot(*np.moveaxis(corners[ends] - points[pairs[:, :1]], -1, 0))
    alive = _pruned(ends, _deep(pairs, points, owners, rings, DEPTH))
    return _branches(rings, corners, clearance, owners, points, ends[alive], pairs[alive])


def _samples(rings: tuple[Ring, ...], step: float) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) along all rings, their corners among them, and ring and place (n, 2) of each."""
    points, owners = [], []
    for number, ring in enumerate(rings):
        parts = np.maximum(np.ceil(ring.lengths / step).astype(int), 1)
        edge = np.repeat(np.arange(len(parts)), parts)
        share = (np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[edge]
        following = (edge + 1) % len(ring.points)
        points.append(ring.points[edge] * (1 - share)[:, None] + ring.points[following] * share[:, None])
        owners.append(np.column_stack([np.full(len(edge), number), ring.places[edge] + share * ring.lengths[edge]]))
    every, of = np.concatenate(points), np.concatenate(owners)
    _, first = np.unique(every, axis=0, return_index=True)
    first.sort()
    return every[first], of[first]


def _deep(pairs: np.ndarray, points: np.ndarray, owners: np.ndarray, rings: tuple[Ring, ...], depth: float,
          ) -> np.ndarray:
    """Whether the way along the boundary between the two points of each edge is long for their distance."""
    one, other = owners[pairs[:, 0]], owners[pairs[:, 1]]
    whole = np.array([ring.length for ring in rings])[one[:, 0].astype(int)]
    way = np.abs(one[:, 1] - other[:, 1])
    way = np.minimum(way, whole - way)
    across = np.hypot(*(points[pairs[:, 0]] - points[pairs[:, 1]]).T)
    return (one[:, 0] != other[:, 0]) | (way > depth * across)


def _pruned(ends: np.ndarray, deep: np.ndarray) -> np.ndarray:
    """Which edges stay when loose ends that are not deep are taken away one after another."""
    alive = np.ones(len(ends), dtype=bool)
    of_node = defaultdict(list)
    for number, (start, end) in enumerate(ends.tolist()):
        of_node[start].append(number)
        of_node[end].append(number)
    degree = {node: len(edges) for node, edges in of_node.items()}
    loose = [node for node, count in degree.items() if count == 1]
    while loose:
        node = loose.pop()
        edge = next((number for number in of_node[node] if alive[number]), None)
        if edge is None or deep[edge]:
            continue
        alive[edge] = False
        for end in ends[edge].tolist():
            degree[end] -= 1
            if degree[end] == 1:
                loose.append(end)
    return alive


def _branches(rings, corners, clearance, owners, points, ends, pairs) -> Skeleton:
    """Edges strung together between the nodes at which not just two meet."""
    of_node = defaultdict(list)
    for number, (start, end) in enumerate(ends.tolist()):
        of_node[start].append(number)
        of_node[end].append(number)
    used = np.zeros(len(ends), dtype=bool)
    branches: list[Branch] = []
    nodes: dict[int, list[int]] = defaultdict(list)

    def walk(node: int, edge: int) -> None:
        chain, steps = [node], []
        while True:
            used[edge] = True
            steps.append(edge)
            node = int(ends[edge].sum()) - node
            chain.append(node)
            following = [number for number in of_node[node] if not used[number]]
            if len(of_node[node]) != 2 or not following:
                break
            edge = following[0]
        branch = _branch(corners, clearance, owners, points, pairs, chain, steps)
        nodes[branch.start].append(len(branches))
        nodes[branch.end].append(len(branches))
        branches.append(branch)

    for node, edges in of_node.items():
        if len(edges) != 2:
            for edge in edges:
                if not used[edge]:
                    walk(node, edge)
    for edge in range(len(ends)):
        if not used[edge]:
            walk(int(ends[edge][0]), edge)
    return Skeleton(rings, tuple(branches), dict(nodes))


def _branch(corners, clearance, owners, points, pairs, chain, steps) -> Branch:
    line = corners[chain]
    one, other = pairs[steps].T
    along = np.diff(line, axis=0)
    across = points[one] - points[other]
    is_left = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0] > 0
    left, right = np.where(is_left, one, other), np.where(is_left, other, one)
    return Branch(line, clearance[chain], owners[left], owners[right], chain[0], chain[-1])
