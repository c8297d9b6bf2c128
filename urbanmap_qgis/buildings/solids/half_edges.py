"""Directed plan edges between integer nodes: the exact topology under the plan partition and the solids.

Every cell keeps its interior at the left of its edges, so an edge between two cells stands here twice,
once in each direction, and an edge on the outside once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...geometry.polygon_rings import polygon_rings

OUTSIDE = -1
"""What lies at the left of a directed edge that no cell owns."""


@dataclass
class HalfEdges:
    """Nodes on an integer lattice and, for each directed edge, the cell at its left.

    Attributes
    ----------
    origin : x and y (m) of the lattice's zero.
    resolution : step of the lattice, m.
    x, y : lattice coordinates of the nodes.
    cell : (from node, to node) -> number of the cell at the left.
    """

    origin: tuple[float, float]
    resolution: float
    x: list[int]
    y: list[int]
    cell: dict[tuple[int, int], int] = field(default_factory=dict)

    def coordinates(self, nodes: Sequence[int]) -> np.ndarray:
        """Plan coordinates (n, 2) of nodes, m."""
        lattice = np.array([(self.x[n], self.y[n]) for n in nodes], dtype=np.float64)
        return np.asarray(self.origin) + lattice * self.resolution

    def length(self, a: int, b: int) -> float:
        """Length of the edge between two nodes, m."""
        return math.hypot(self.x[b] - self.x[a], self.y[b] - self.y[a]) * self.resolution

    def direction(self, a: int, b: int) -> float:
        """Direction from node `a` to node `b`, radians counterclockwise from x."""
        return math.atan2(self.y[b] - self.y[a], self.x[b] - self.x[a])

    def twice_area(self, ring: Sequence[int]) -> int:
        """Twice the signed area of a ring of nodes, in lattice units, exact."""
        x, y = self.x, self.y
        return sum(x[a] * y[b] - x[b] * y[a] for a, b in zip(ring, [*ring[1:], ring[0]]))

    def add_node(self, x: int, y: int) -> int:
        """Number of a new node at a lattice place."""
        self.x.append(x)
        self.y.append(y)
        return len(self.x) - 1


def whole_metre_origin(bounds: Sequence[float]) -> tuple[float, float]:
    """Corner of (xmin, ymin, ...) rounded down to metres: subtracting it loses nothing and fits every grid."""
    return math.floor(bounds[0]), math.floor(bounds[1])


def half_edges(polygons: np.ndarray, origin: tuple[float, float], resolution: float) -> HalfEdges:
    """Half edges of polygons (any ring orientation), polygon i being cell i.

    Nodes are numbered by their place, so the numbering does not depend on the polygons' order.

    Raises
    ------
    ValueError : two polygons lie at the same side of an edge, so they overlap.
    """
    rings, owner = polygon_rings(polygons)
    outer = np.ones(len(rings), dtype=bool)
    outer[1:] = owner[1:] != owner[:-1]
    flip = shapely.is_ccw(rings) != outer
    coordinates, ring = shapely.get_coordinates(rings, return_index=True)
    lattice = np.rint((coordinates - origin) / resolution).astype(np.int64)
    low = lattice.min(axis=0)
    code = ((lattice[:, 0] - low[0]) << 31) + (lattice[:, 1] - low[1])
    _, first, node = np.unique(code, return_index=True, return_inverse=True)
    same = (ring[1:] == ring[:-1]) & (node[1:] != node[:-1])
    start, end, ring = node[:-1][same], node[1:][same], ring[:-1][same]
    turned = flip[ring]
    start, end = np.where(turned, end, start), np.where(turned, start, end)
    keys = list(zip(start.tolist(), end.tolist()))
    edges = HalfEdges(origin, resolution, lattice[first, 0].tolist(), lattice[first, 1].tolist(),
                      dict(zip(keys, owner[ring].tolist())))
    if len(edges.cell) != len(keys):
        raise ValueError("The polygons overlap: an edge has two of them at the same side.")
    return edges


def trace_rings(edges: HalfEdges, directed: Iterable[tuple[int, int]]) -> list[list[int]]:
    """Join directed edges to simple rings; counterclockwise ones are outer rings, clockwise ones holes.

    Where several rings meet in a node the walk stays beside the same piece of outside, so that a hole
    touching another ring in a point comes out as a ring of its own. Each ring starts at its lowest node.
    """
    following: dict[int, list[int]] = {}
    for a, b in directed:
        following.setdefault(a, []).append(b)
    rings = []
    for start in sorted(following):
        while following[start]:
            ring = [start]
            before, node = start, following[start].pop()
            while node != start:
                ring.append(node)
                before, node = node, _turn(edges, before, node, following[node])
            rings.append(ring)
    return rings


def _turn(edges: HalfEdges, before: int, node: int, choices: list[int]) -> int:
    """Take from `choices` the first node counterclockwise from the way we came."""
    if len(choices) == 1:
        return choices.pop()
    came = edges.direction(node, before)
    turns = [(edges.direction(node, target) - came) % (2 * math.pi) for target in choices]
    return choices.pop(turns.index(min(turns)))


def connected_cells(edges: HalfEdges, cells: Iterable[int]) -> list[set[int]]:
    """Cells grouped by common edges, in the order of the first cell of each group."""
    names = sorted(cells)
    place = {cell: number for number, cell in enumerate(names)}
    links = [(place[cell], place[other]) for (a, b), cell in edges.cell.items()
             if cell in place and (other := edges.cell.get((b, a))) in place]
    one, two = np.array(links, np.int64).reshape(-1, 2).T
    return [{names[number] for number in group.tolist()} for group in linked_members(one, two, len(names))]
