"""A closed mesh: triangulated surfaces, upright walls between them, a level ground."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...geometry.solid import GROUND, INNER_WALL, OUTER_WALL, ROOF, Solid
from ...geometry.tolerances import UNITS
from ...geometry.triangulation import triangulate_face
from ..solids.half_edges import trace_rings
from .node_heights import Heights
from .surface_plan import SurfacePlan
from .tin import Tin


def build_mesh(plan: SurfacePlan, heights: Heights, cells: Sequence[np.ndarray], base: float,
               tolerance: float) -> Solid:
    """The mesh as a solid of triangles.

    Parameters
    ----------
    heights : of each surface at the nodes of its border.
    cells : (k, 3) places and heights of each surface, m.
    base : height of the ground, m.
    tolerance : farthest distance of a surface from its cells, m.
    """
    builder = _Builder(plan, heights, round(base * UNITS))
    for surface in range(len(plan.label)):
        builder.add_surface(surface, cells[surface], tolerance)
    builder.add_walls()
    builder.add_ground()
    return builder.solid()


class _Builder:
    def __init__(self, plan: SurfacePlan, heights: Heights, base: int):
        self.plan, self.edges, self.heights, self.base = plan, plan.edges, heights, base
        self.index: dict[tuple[int, int], int] = {}
        self.places: list[tuple[float, float, float]] = []
        self.faces: list[tuple[tuple[int, ...], ...]] = []
        self.types: list[str] = []
        self.ids: list[int | None] = []
        self.xy = self.edges.coordinates(range(len(self.edges.x)))

    def solid(self) -> Solid:
        return Solid(np.array(self.places), tuple(self.faces), tuple(self.types), tuple(self.ids))

    def _vertex(self, node: int, level: int) -> int:
        """Number of the vertex over a node at a height."""
        key = node, level
        if key not in self.index:
            self.index[key] = len(self.places)
            self.places.append((*self.xy[node].tolist(), level / UNITS))
        return self.index[key]

    def _add(self, triangle: tuple[int, int, int], kind: str, surface: int | None) -> None:
        self.faces.append((triangle,))
        self.types.append(kind)
        self.ids.append(surface)

    def add_surface(self, surface: int, cells: np.ndarray, tolerance: float) -> None:
        """Triangles of one surface, refined until its cells lie within tolerance."""
        rings = self.plan.rings(surface)
        nodes = list(dict.fromkeys(node for ring in rings for node in ring))
        number = {node: place for place, node in enumerate(nodes)}
        levels = [self.heights[surface, node] for node in nodes]
        tin = Tin(self.xy[nodes], np.array(levels) / UNITS, [[number[node] for node in ring] for ring in rings])
        tin.refine(cells[:, :2], cells[:, 2], tolerance, len(cells))
        vertices = [self._vertex(node, level) for node, level in zip(nodes, levels)]
        for place, z in zip(tin.xy[len(nodes):], tin.z[len(nodes):]):
            vertices.append(len(self.places))
            self.places.append((*place, z))
        for triangle in tin.triangles.values():
            self._add(tuple(vertices[corner] for corner in triangle), ROOF, surface)

    def add_walls(self) -> None:
        """Walls from the higher to the lower surface at each border edge, or to the ground."""
        stops: dict[int, set[int]] = {}
        for (_surface, node), level in self.heights.items():
            stops.setdefault(node, set()).add(level)
        outside = {node for pair in self.edges.cell if pair[::-1] not in self.edges.cell for node in pair}
        for node in outside:
            stops.setdefault(node, set()).add(self.base)
        ordered = {node: sorted(levels) for node, levels in stops.items()}
        for (a, b), surface in sorted(self.edges.cell.items()):
            other = self.edges.cell.get((b, a))
            sides = []
            for node in (a, b):
                low = self.base if other is None else self.heights[other, node]
                high = self.heights[surface, node]
                sides.append([level for level in ordered[node] if low <= level <= high] if high > low
                             else [high] if high == low else [])
            if all(sides) and sum(map(len, sides)) > 2:
                self._add_strip(a, b, *sides, OUTER_WALL if other is None else INNER_WALL, surface)

    def _add_strip(self, a: int, b: int, at_a: list[int], at_b: list[int], kind: str, surface: int) -> None:
        """Triangles between two upright chains of vertices, from below."""
        left = [self._vertex(a, level) for level in at_a]
        right = [self._vertex(b, level) for level in at_b]
        i = j = 0
        while i < len(left) - 1 or j < len(right) - 1:
            up_left = i < len(left) - 1 and (j == len(right) - 1 or at_a[i + 1] <= at_b[j + 1])
            if up_left:
                self._add((left[i], right[j], left[i + 1]), kind, surface)
                i += 1
            else:
                self._add((left[i], right[j], right[j + 1]), kind, surface)
                j += 1

    def add_ground(self) -> None:
        """The ground under all surfaces, seen from below."""
        border = [pair for pair in self.edges.cell if pair[::-1] not in self.edges.cell]
        rings = trace_rings(self.edges, border)
        outer = [ring for ring in rings if self.edges.twice_area(ring) > 0]
        holes = [ring for ring in rings if self.edges.twice_area(ring) < 0]
        owner = _owners(self.xy, outer, holes)
        for number, ring in enumerate(outer):
            face = [ring, *(hole for hole, place in zip(holes, owner) if place == number)]
            flat = np.column_stack([self.xy, np.zeros(len(self.xy))])
            for triangle in triangulate_face(flat, [tuple(nodes) for nodes in face]):
                self._add(tuple(self._vertex(node, self.base) for node in reversed(triangle)), GROUND, None)


def _owners(xy: np.ndarray, outer: list[list[int]], holes: list[list[int]]) -> list[int]:
    """The smallest outer ring round each hole."""
    shapes = [shapely.Polygon(xy[ring]) for ring in outer]
    owners = []
    for hole in holes:
        inside = shapely.point_on_surface(shapely.Polygon(xy[hole]))
        around = [number for number, shape in enumerate(shapes) if shape.contains(inside)]
        owners.append(min(around, key=lambda number: shapes[number].area))
    return owners
