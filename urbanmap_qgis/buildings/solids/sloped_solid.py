"""Closed solids under sloped roofs: every roof on its plane, walls where heights differ, one level ground (LoD2.2)."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.solid import INNER_WALL, OUTER_WALL, ROOF, Solid
from ...geometry.tolerances import UNITS
from ...geometry.triangulation import triangulate_face
from .face_collector import FaceCollector, edges_of_cells
from .half_edges import HalfEdges, connected_cells
from .manifold import Height, cut_corners

LEAST_STEP = 0.05
"""Roofs whose heights at a node differ by less than this (m) meet there."""

LEAST_HEIGHT = 0.1
"""No roof is lower than this above the base (m)."""

FLAT = 0.0008
"""A roof whose nodes all lie this near to its plane (m) is one face; others are cut into triangles."""

_NEAREST_NODE = 0.02


@dataclass(frozen=True)
class SlopedCell:
    """A part of a plan under one roof plane z = plane[0] x + plane[1] y + plane[2], x and y from `origin`."""

    polygon: shapely.Polygon
    roof_id: Hashable
    plane: tuple[float, float, float]
    origin: tuple[float, float] = (0.0, 0.0)


def sloped_solids(cells: Sequence[SlopedCell], base_height: float) -> tuple[Solid, ...]:
    """Raise the cells of a plan to solids, one for each part whose cells are connected by edges.

    Parameters
    ----------
    cells : cells of one building, edge by edge beside each other.
    base_height : height of the ground face, m; no roof is lower than `LEAST_HEIGHT` above it.

    Raises
    ------
    InputError : the base height is not finite, or cells overlap.
    """
    edges = edges_of_cells(cells, base_height)
    if edges is None:
        return ()
    solids = []
    for part in connected_cells(edges, range(len(cells))):
        directed = {edge: cell for edge, cell in edges.cell.items() if cell in part}
        piece = HalfEdges(edges.origin, edges.resolution, list(edges.x), list(edges.y), directed)
        solids.append(_SlopedFaces(piece, cells, round(base_height * UNITS)).solid())
    return tuple(solids)


class _SlopedFaces(FaceCollector):
    """The faces under sloped roofs."""

    def __init__(self, edges: HalfEdges, cells: Sequence[SlopedCell], base: int):
        super().__init__(edges, base)
        self.roofs, self.lowest = cells, base + round(LEAST_HEIGHT * UNITS)
        self.heights: dict[tuple[int, int], int] = {}
        self.areas = [cell.polygon.area for cell in cells]

    def solid(self) -> Solid:
        """The finished solid: ground, roofs, walls."""
        self._insert_crossings()
        cut, unrepaired = cut_corners(self.edges, self._met_heights(), self.base)
        self._insert_crossings()
        raised = self._meet()
        self.add_ground()
        self._roofs()
        self._walls()
        vertices = self.vertices()
        faces, types, ids = self._flat_faces(vertices)
        return Solid(vertices, tuple(faces), tuple(types), tuple(ids), cut, len(unrepaired), raised)

    def _height(self, cell: int, node: int) -> int:
        """Height of a cell's plane at a node, lattice units."""
        roof, plane = self.roofs[cell], self.roofs[cell].plane
        x = self.edges.origin[0] - roof.origin[0] + self.edges.x[node] / UNITS
        y = self.edges.origin[1] - roof.origin[1] + self.edges.y[node] / UNITS
        return round((plane[0] * x + plane[1] * y + plane[2]) * UNITS)

    def _insert_crossings(self) -> None:
        """Put a node where two roofs beside an edge change places in height."""
        edges, step = self.edges, round(LEAST_STEP * UNITS)
        for a, b in sorted({(min(pair), max(pair)) for pair in edges.cell}):
            left, right = edges.cell.get((a, b)), edges.cell.get((b, a))
            if left is None or right is None or left == right:
                continue
            start = self._height(left, a) - self._height(right, a)
            end = self._height(left, b) - self._height(right, b)
            if start * end >= 0 or (abs(start) < step and abs(end) < step):
                continue
            share = start / (start - end)
            length = edges.length(a, b)
            if min(share, 1 - share) * length < _NEAREST_NODE:
                continue
            node = edges.add_node(round(edges.x[a] + (edges.x[b] - edges.x[a]) * share),
                                  round(edges.y[a] + (edges.y[b] - edges.y[a]) * share))
            for one, two in ((a, b), (b, a)):
                cell = edges.cell.pop((one, two))
                edges.cell[one, node] = edges.cell[node, two] = cell

    def _around(self) -> dict[int, set[int]]:
        """Cells round each node."""
        around: dict[int, set[int]] = {}
        for (a, b), cell in self.edges.cell.items():
            around.setdefault(a, set()).add(cell)
            around.setdefault(b, set()).add(cell)
        return around

    def _met_heights(self) -> Height:
        """Height of a cell at a node, nearly equal ones made equal."""
        met: dict[int, dict[int, int]] = {}
        around = self._around()

        def height(cell: int, node: int) -> int:
            if node not in around:
                return self._height(cell, node)
            if node not in met:
                met[node] = self._levels(node, around[node])
            return met[node][cell] if cell in met[node] else self._height(cell, node)

        return height

    def _levels(self, node: int, cells: set[int]) -> dict[int, int]:
        """Height of each cell at a node: at least the lowest, nearly equal ones made equal."""
        step, levels = round(LEAST_STEP * UNITS), {}
        found = sorted((max(self._height(cell, node), self.lowest), cell) for cell in cells)
        group = [found[0]]
        for item in [*found[1:], None]:
            if item is not None and item[0] - group[-1][0] < step:
                group.append(item)
                continue
            # The largest roof stays flat; where that bends a smaller one, its triangles are few.
            level = max(group, key=lambda entry: (self.areas[entry[1]], -entry[1]))[0]
            levels.update((cell, level) for _, cell in group)
            group = [item]
        return levels

    def _meet(self) -> int:
        """Heights of all cells at their nodes; the number of roofs raised to the least height."""
        raised = set()
        for node, cells in self._around().items():
            raised.update(cell for cell in cells if self._height(cell, node) < self.lowest)
            for cell, level in self._levels(node, cells).items():
                self.heights[cell, node] = level
        return len(raised)

    def _roofs(self) -> None:
        """One face for each cell."""
        for cell, directed in self.cells().items():
            for rings in self.shapes(directed):
                self.add([[(node, self.heights[cell, node]) for node in ring] for ring in rings], ROOF,
                         self.roofs[cell].roof_id)

    def _walls(self) -> None:
        """One upright face for each plan edge with a step, its sides split where other walls end at the same node."""
        cell, heights = self.edges.cell, self.heights
        stops: dict[int, set[int]] = {}
        for (_, node), height in heights.items():
            stops.setdefault(node, set()).add(height)
        for a, b in cell:
            if (b, a) not in cell:
                stops[a].add(self.base)
                stops[b].add(self.base)
        ordered = {node: sorted(levels) for node, levels in stops.items()}
        for (a, b), high in sorted(cell.items()):
            low = cell.get((b, a))
            if low == high:
                continue
            sides = []
            for node in (b, a):
                bottom = self.base if low is None else heights[low, node]
                top = heights[high, node]
                sides.append([(node, level) for level in ordered[node] if bottom <= level <= top]
                             if top > bottom else [(node, top)] if top == bottom else None)
            if None in sides or len(sides[0]) + len(sides[1]) < 3:
                continue
            self.add([[*sides[0], *reversed(sides[1])]], OUTER_WALL if low is None else INNER_WALL,
                      self.roofs[high].roof_id)

    def _flat_faces(self, vertices: np.ndarray) -> tuple[list, list, list]:
        """Faces with those roofs cut into triangles that are not flat."""
        faces, types, ids = [], [], []
        for face, kind, roof_id in zip(self.faces, self.types, self.ids):
            whole = kind != ROOF or _is_flat(vertices[[v for ring in face for v in ring]])
            for piece in [face] if whole else [(triangle,) for triangle in triangulate_face(vertices, face)]:
                faces.append(piece)
                types.append(kind)
                ids.append(roof_id)
        return faces, types, ids


def _is_flat(corners: np.ndarray) -> bool:
    """Whether corners (n, 3) lie within `FLAT` of one plane."""
    if len(corners) < 4:
        return True
    away = corners - corners.mean(axis=0)
    normal = np.linalg.svd(away, full_matrices=False)[2][2]
    return bool(np.abs(away @ normal).max() <= FLAT)
