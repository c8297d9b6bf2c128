"""The plan of a building cut into its surfaces along simplified lines, edge by edge beside each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import GRID
from ...wording import say
from ..solids.half_edges import HalfEdges, half_edges, trace_rings, whole_metre_origin
from .height_grid import HeightGrid


@dataclass(frozen=True, eq=False)
class SurfacePlan:
    """Directed edges between nodes; `edges.cell` names the surface (0, 1, ...) at the left of each.

    `label` (surfaces,) is the number of each one on the height grid. Edges with one surface at both sides are left out.
    """

    edges: HalfEdges
    label: np.ndarray

    def rings(self, surface: int) -> list[list[int]]:
        """Rings of nodes of a surface, the outer one first; it is one connected piece."""
        directed = [edge for edge, cell in self.edges.cell.items() if cell == surface]
        return sorted(trace_rings(self.edges, directed), key=lambda ring: self.edges.twice_area(ring) < 0)


def surface_plan(heights: HeightGrid, tolerance: float) -> SurfacePlan:
    """Cut the plan along the borders of the surfaces, simplified to `tolerance` (m).

    Raises
    ------
    InsufficientDataError : nothing of the plan is left.
    """
    origin = whole_metre_origin(heights.plan.bounds)
    outline = shapely.transform(shapely.force_2d(heights.plan), lambda c: c - origin)
    outline = shapely.make_valid(shapely.set_precision(outline, GRID))
    borders = shapely.transform(_borders(heights), lambda c: c - origin)
    simple = [shapely.simplify(line, tolerance) for line in shapely.get_parts(shapely.line_merge(borders))]
    lines = shapely.union_all([shapely.boundary(outline), *simple], grid_size=GRID)
    faces = shapely.get_parts(shapely.polygonize([lines]))
    faces = faces[shapely.contains(outline, shapely.point_on_surface(faces))]
    if not len(faces):
        raise InsufficientDataError(say("its outline has no area"))
    inside = shapely.point_on_surface(faces)
    row, column, _ = heights.grid.cells(shapely.get_x(inside) + origin[0], shapely.get_y(inside) + origin[1])
    label = heights.label[row, column]
    edges = half_edges(faces, (0.0, 0.0), GRID)
    edges.origin = origin
    return _surfaces(edges, label)


def _borders(heights: HeightGrid) -> shapely.MultiLineString:
    """The sides of cells between different surfaces."""
    grid, label = heights.grid, heights.label
    pieces = []
    row, column = np.nonzero(label[:, :-1] != label[:, 1:])
    x, y = grid.x_min + (column + 1) * grid.cell, grid.y_max - row * grid.cell
    pieces.append(np.stack([np.stack([x, y], 1), np.stack([x, y - grid.cell], 1)], 1))
    row, column = np.nonzero(label[:-1] != label[1:])
    x, y = grid.x_min + column * grid.cell, grid.y_max - (row + 1) * grid.cell
    pieces.append(np.stack([np.stack([x, y], 1), np.stack([x + grid.cell, y], 1)], 1))
    segments = np.round(np.concatenate(pieces), 6)
    return shapely.multilinestrings(shapely.linestrings(segments))


def _surfaces(edges: HalfEdges, label: np.ndarray) -> SurfacePlan:
    """Faces of one label that are connected as one surface, without the edges inside."""
    links = [(face, other) for (a, b), face in edges.cell.items()
             if (other := edges.cell.get((b, a))) is not None and label[face] == label[other]]
    _, number = linked_groups(*np.array(links, np.int64).reshape(-1, 2).T, len(label))
    owner = {edge: int(number[face]) for edge, face in edges.cell.items()}
    edges.cell = {edge: surface for edge, surface in owner.items() if owner.get(edge[::-1]) != surface}
    return SurfacePlan(edges, label[np.unique(number, return_index=True)[1]])
