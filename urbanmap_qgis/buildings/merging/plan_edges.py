"""Straight edges of a plan's outside, and the plan with some of them moved."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.alpha_shape import signed_area
from ...geometry.tolerances import GRID, LEAST_DIVISOR
from ..solids.half_edges import HalfEdges, half_edges, trace_rings, whole_metre_origin
from ..solids.plan_partition import Cell

_STRAIGHT = 0.03
"""Nodes this near to the line between an edge's ends (m) lie on the edge."""

_PARALLEL = math.sin(math.radians(20.0))
"""Edges at less than this angle to one another keep a step between them when one moves."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line in plan: a point (2,) on it and its unit direction (2,), the building at its left."""

    point: np.ndarray
    along: np.ndarray

    @property
    def outward(self) -> np.ndarray:
        """Unit vector (2,) away from the building."""
        return np.array([self.along[1], -self.along[0]])

    def foot(self, place: np.ndarray) -> np.ndarray:
        """The nearest place on the line."""
        return self.point + ((place - self.point) @ self.along) * self.along


@dataclass(frozen=True, eq=False)
class OuterEdge:
    """A straight piece of a plan's outside: its nodes in order (the building at the left), its ends (2, 2), m."""

    nodes: tuple[int, ...]
    ends: np.ndarray

    @property
    def length(self) -> float:
        return float(np.hypot(*(self.ends[1] - self.ends[0])))

    @property
    def line(self) -> Line:
        return Line(self.ends[0], (self.ends[1] - self.ends[0]) / max(self.length, LEAST_DIVISOR))


class PlanEdges:
    """A plan's cells as a graph of nodes, with the edges of its outside.

    `breaks` (k, 2) are places on the outside, m, at which edges are cut although they run straight on.
    """

    def __init__(self, cells: Sequence[Cell], breaks: np.ndarray | None = None):
        self.cells = tuple(cells)
        self.breaks = np.zeros((0, 2)) if breaks is None else np.round(np.asarray(breaks, float) / GRID) * GRID
        plans = [_with_nodes(shapely.force_2d(cell.polygon), self.breaks) for cell in cells]
        polygons = shapely.set_precision(plans, GRID)
        origin = whole_metre_origin(shapely.total_bounds(polygons))
        local = shapely.transform(polygons, lambda c: c - origin)
        noded = shapely.get_parts(shapely.polygonize([shapely.union_all(shapely.boundary(local), grid_size=GRID)]))
        inside = shapely.point_on_surface(noded)
        cell, face = shapely.STRtree(inside).query(local, predicate="contains")
        owner = np.full(len(noded), -1)
        owner[face[::-1]] = cell[::-1]
        owned = np.flatnonzero(owner >= 0)
        self.graph: HalfEdges = half_edges(noded[owned], (0.0, 0.0), GRID)
        self.graph.origin = origin
        self.owner = {edge: int(owner[owned[number]]) for edge, number in self.graph.cell.items()}
        self.piece = dict(self.graph.cell)
        outside = [edge for edge in self.piece if edge[::-1] not in self.piece]
        self.rings = trace_rings(self.graph, outside)
        self.xy = self.graph.coordinates(range(len(self.graph.x)))
        self.edges = [edge for ring in self.rings for edge in self._straight(ring)]

    def _straight(self, ring: list[int]) -> list[OuterEdge]:
        """The ring cut at the nodes where it bends."""
        corners = _corners(self.xy[ring])
        if len(self.breaks):
            away = np.hypot(*(self.xy[ring][:, None] - self.breaks).transpose(2, 0, 1)).min(axis=1)
            corners = sorted({*corners, *np.flatnonzero(away < GRID).tolist()})
        straight = []
        for first, last in zip(corners, [*corners[1:], corners[0] + len(ring)]):
            nodes = tuple(ring[place % len(ring)] for place in range(first, last + 1))
            straight.append(OuterEdge(nodes, self.xy[[nodes[0], nodes[-1]]]))
        return straight

    def moved_polygons(self, lines: Mapping[int, Line]) -> list[shapely.Polygon] | None:
        """Polygons of the cells with some outer edges on new lines; None where the plan would fold.

        Parameters
        ----------
        lines : new line of each edge to move, by its number in `edges`.
        """
        if not lines:
            return [cell.polygon for cell in self.cells]
        places = self._new_places(lines)
        pieces: dict[int, list[shapely.Polygon]] = {}
        total = 0.0
        for cell, rings in self._cell_rings().items():
            shapes = [self._placed(ring, places) for ring in rings]
            if any(shape is None for shape in shapes):
                return None
            outer = max(shapes, key=lambda shape: shapely.Polygon(shape).area)
            polygon = shapely.Polygon(outer, [shape for shape in shapes if shape is not outer])
            if not polygon.is_valid or signed_area(outer) <= 0:
                return None
            pieces.setdefault(cell[0], []).append(polygon)
            total += polygon.area
        plans = [shapely.union_all(pieces[cell]) for cell in sorted(pieces)]
        whole = shapely.union_all(plans, grid_size=GRID)
        # Cells that slid over one another would cover less together than one by one.
        if abs(whole.area - total) > 0.02 + 0.0005 * total:
            return None
        return plans if len(plans) == len(self.cells) else None

    def ends_after(self, lines: Mapping[int, Line]) -> list[tuple[np.ndarray, np.ndarray]]:
        """Start and end (2,) of each outer edge when some have moved."""
        places = self._new_places(lines)
        return [(places.get(edge.nodes[0], (None, edge.ends[0]))[1], places.get(edge.nodes[-1], (edge.ends[1],))[0])
                for edge in self.edges]

    def _new_places(self, lines: Mapping[int, Line]) -> dict[int, tuple[np.ndarray, np.ndarray]]:
        """For each node on a moved edge its place at the end of one edge and at the start of the next."""
        places: dict[int, tuple[np.ndarray, np.ndarray]] = {}
        start_of = {edge.nodes[0]: number for number, edge in enumerate(self.edges)}
        for number, edge in enumerate(self.edges):
            if number in lines:
                for node in edge.nodes[1:-1]:
                    foot = lines[number].foot(self.xy[node])
                    places[node] = foot, foot
            following = start_of[edge.nodes[-1]]
            if number in lines or following in lines:
                node = edge.nodes[-1]
                one = lines.get(number, edge.line)
                two = lines.get(following, self.edges[following].line)
                places[node] = _intersection(one, two, self.xy[node])
        return places

    def _cell_rings(self) -> dict[tuple[int, int], list[list[tuple[int, bool, bool]]]]:
        """Rings of each piece of each cell: nodes, and whether the edges to and from them lie outside."""
        by_piece: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for edge, cell in self.owner.items():
            by_piece.setdefault((cell, self.piece[edge]), []).append(edge)
        by_cell = {}
        for key, directed in by_piece.items():
            rings = []
            for ring in trace_rings(self.graph, directed):
                outside = [(a, b)[::-1] not in self.piece for a, b in zip(ring, [*ring[1:], ring[0]])]
                rings.append([(node, outside[place - 1], outside[place]) for place, node in enumerate(ring)])
            by_cell[key] = rings
        return by_cell

    def _placed(self, ring: list[tuple[int, bool, bool]], places) -> np.ndarray | None:
        """Coordinates of a ring with its nodes at their new places."""
        corners: list[np.ndarray] = []
        for node, _before, after in ring:
            if node not in places:
                corners.append(self.xy[node])
                continue
            first, second = places[node]
            corners.append(first)
            if after:
                corners.append(second)
        snapped = np.round(np.array(corners) / GRID) * GRID
        different = (snapped != np.roll(snapped, 1, axis=0)).any(axis=1)
        snapped = snapped[different]
        return snapped if len(snapped) > 2 else None


def _with_nodes(polygon: shapely.Polygon, places: np.ndarray) -> shapely.Polygon:
    """A polygon with more nodes at places (k, 2) that lie on its edges."""
    if not len(places):
        return polygon
    rings = []
    for ring in (polygon.exterior, *polygon.interiors):
        xy = shapely.get_coordinates(ring)
        noded = []
        for start, end in zip(xy[:-1], xy[1:]):
            line, length = end - start, max(float(np.hypot(*(end - start))), LEAST_DIVISOR)
            at = (places - start) @ line / length
            off = np.abs((places - start) @ np.array([line[1], -line[0]])) / length
            on = np.flatnonzero((off < _STRAIGHT) & (at > 2 * GRID) & (at < length - 2 * GRID))
            noded += [start, *places[on[np.argsort(at[on], kind="stable")]]]
        rings.append(np.array(noded))
    return shapely.Polygon(rings[0], rings[1:])


def _corners(xy: np.ndarray) -> list[int]:
    """Places of a ring's corners: nodes off the line between the corners beside them."""
    n = len(xy)
    before, after = np.roll(xy, 1, axis=0), np.roll(xy, -1, axis=0)
    a, b = xy - before, after - xy
    bend = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / (np.hypot(*a.T) * np.hypot(*b.T))
    back = (a * b).sum(axis=1) < 0
    start = int(np.argmax(bend + back))
    corners = [start]
    anchor = start
    for step in range(start + 1, start + n):
        following = xy[(step + 1) % n]
        between = xy[[place % n for place in range(anchor + 1, step + 1)]]
        chord = following - xy[anchor % n]
        length = np.hypot(*chord)
        away = between - xy[anchor % n]
        off = np.abs(away[:, 0] * chord[1] - away[:, 1] * chord[0]) / max(length, LEAST_DIVISOR)
        along = away @ chord / max(length, LEAST_DIVISOR)
        if length < 1e-9 or off.max() > _STRAIGHT or (along > length + 1e-6).any() or (np.diff(along) < -1e-6).any():
            corners.append(step % n)
            anchor = step
    return sorted(corners)


def _intersection(one: Line, two: Line, node: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where two lines meet, twice; for lines that run nearly alike their feet from the node: a step between them."""
    across = one.along[0] * two.along[1] - one.along[1] * two.along[0]
    if abs(across) < _PARALLEL:
        return one.foot(node), two.foot(node)
    away = two.point - one.point
    share = (away[0] * two.along[1] - away[1] * two.along[0]) / across
    place = one.point + share * one.along
    return place, place
