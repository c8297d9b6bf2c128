"""The faces of one solid, collected over the edges of its plan."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.solid import GROUND, Face
from ...geometry.tolerances import UNITS
from ...wording import say
from .half_edges import HalfEdges, half_edges, trace_rings, whole_metre_origin


def edges_of_cells(cells: Sequence, base_height: float) -> HalfEdges | None:
    """Half edges of the cells' polygons in `UNITS`; None without cells.

    Raises
    ------
    InputError : the base height is not finite, or cells overlap.
    """
    if not np.isfinite(base_height):
        raise InputError(say("The building has no base height: give the ground's height in metres."))
    if not cells:
        return None
    polygons = shapely.force_2d(np.array([cell.polygon for cell in cells], dtype=object))
    try:
        return half_edges(polygons, whole_metre_origin(shapely.total_bounds(polygons)), 1 / UNITS)
    except ValueError as error:
        raise InputError(say("Cells of one building overlap: cut its plan with partition_plan first.")) from error


class FaceCollector:
    """Faces of the part of a building over connected cells; every vertex is a plan node at a height.

    Parameters
    ----------
    edges : the part's plan.
    base : height of the ground face, lattice units.
    """

    def __init__(self, edges: HalfEdges, base: int):
        self.edges, self.base = edges, base
        self.faces: list[Face] = []
        self.types: list[str] = []
        self.ids: list[Hashable] = []
        self._index: dict[tuple[int, int], int] = {}

    def add(self, rings: Iterable[Iterable[tuple[int, int]]], surface_type: str, roof_id: Hashable) -> None:
        """Add a face given by rings of (node, height in lattice units)."""
        index = self._index
        self.faces.append(tuple(tuple([index.setdefault(vertex, len(index)) for vertex in ring]) for ring in rings))
        self.types.append(surface_type)
        self.ids.append(roof_id)

    def add_ground(self) -> None:
        """Add one face under the whole part, seen from below; courtyards are its holes."""
        cell = self.edges.cell
        for outer, *holes in self.shapes([edge for edge in cell if edge[::-1] not in cell]):
            self.add([[(node, self.base) for node in reversed(ring)] for ring in (outer, *holes)], GROUND, None)

    def cells(self) -> dict[int, list[tuple[int, int]]]:
        """Directed edges of each cell, by cell in rising order; a line between two pieces of one cell bounds none."""
        by_cell: dict[int, list[tuple[int, int]]] = {}
        for edge, cell in self.edges.cell.items():
            by_cell.setdefault(cell, []).append(edge)
        return dict(sorted(by_cell.items()))

    def shapes(self, directed: list[tuple[int, int]]) -> list[list[list[int]]]:
        """Outer rings of directed edges, each followed by its holes."""
        rings = trace_rings(self.edges, directed)
        outer = [ring for ring in rings if self.edges.twice_area(ring) > 0]
        holes = [ring for ring in rings if self.edges.twice_area(ring) < 0]
        if len(outer) == 1:
            return [[outer[0], *holes]]
        shells = [shapely.Polygon(self.edges.coordinates(ring)) for ring in outer]
        shapes = [[ring] for ring in outer]
        for hole in holes:
            inside = shapely.Polygon(self.edges.coordinates(hole)).representative_point()
            home = next((place for place, shell in enumerate(shells) if shell.contains(inside)), 0)
            shapes[home].append(hole)
        return shapes

    def vertices(self) -> np.ndarray:
        """Vertices (n, 3) of all faces, m."""
        nodes, levels = zip(*self._index)
        vertices = np.empty((len(nodes), 3))
        vertices[:, :2] = self.edges.coordinates(nodes)
        vertices[:, 2] = np.array(levels) / UNITS
        return vertices
