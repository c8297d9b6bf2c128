"""Solids cut at a height: level prisms on measured walls below, the sloped model from the air untouched above.

The lower part is made as if every roof above the cut were level; what of it lies above the cut is then taken away and
the sloped solids over the cut are put in its place, on the same nodes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...geometry.solid import GROUND, Solid
from ...geometry.tolerances import GRID, LEAST_DIVISOR, UNITS
from ..solids.sloped_solid import SlopedCell, sloped_solids
from .model_parts import ModelParts

MARGIN = 0.2
"""The cut lies so far (m) below the lowest place of the roofs above it."""

LEAST_SHARE = 0.5
"""Share of the wanted height below which no cut is made: too little of the walls would be measured."""

LEVEL = 0.03
"""A roof below the cut that rises by no more than this (m) is taken as level, at its highest place."""

def cut_height(parts: ModelParts, wanted: float) -> float | None:
    """Height of the cut (m, absolute): `wanted`, or lower where a roof reaches below; None where none can be made.

    All roofs lie wholly below the cut, level, or wholly above it.
    """
    low = [_lowest(parts, number) for number in range(len(parts.cells))]
    cut = wanted
    while True:
        tall = [number for number, cell in enumerate(parts.cells) if cell.height > cut]
        lower = min([cut, *(low[number] - MARGIN for number in tall)])
        if lower == cut:
            break
        cut = lower
    sloped_below = any(parts.cells[number].height - low[number] > LEVEL for number in range(len(low))
                       if number not in tall)
    if not tall or sloped_below or cut - parts.base < LEAST_SHARE * (wanted - parts.base):
        return None
    return cut


def _lowest(parts: ModelParts, number: int) -> float:
    """Lowest height of a roof, m."""
    corners = shapely.get_coordinates(parts.cells[number].polygon) - parts.origin
    a, b, c = parts.planes[number]
    return float((a * corners[:, 0] + b * corners[:, 1] + c).min())


def on_the_grid(polygon: shapely.Geometry) -> shapely.Geometry:
    """A plan with its corners on the grid of layered solids."""
    return shapely.transform(shapely.force_2d(polygon), lambda c: np.round(c / GRID) * GRID)


def with_sloped_top(lower: Sequence[Solid], cells: Sequence[SlopedCell], cut: float) -> tuple[Solid, ...]:
    """Solids of layers with what lies above the cut (m) put under sloped roofs.

    Parameters
    ----------
    lower : their roofs above the cut are level and stand for the sloped ones.
    cells : the sloped roofs over the cut; corners on the grid.
    """
    nodes = np.unique(np.concatenate([solid.vertices[solid.vertices[:, 2] > cut - 0.5 / UNITS, :2]
                                      for solid in lower]).round(4), axis=0)
    upper = sloped_solids([SlopedCell(_with_nodes(cell.polygon, nodes), cell.roof_id, cell.plane, cell.origin)
                           for cell in cells], cut)
    faces: list[tuple] = []
    for solid in lower:
        faces += _below(solid, cut)
    for solid in upper:
        faces += [(_rings(solid.vertices, face), kind, roof)
                  for face, kind, roof in zip(solid.faces, solid.surface_type, solid.roof_id) if kind != GROUND]
    return _joined(faces)


def _with_nodes(polygon: shapely.Polygon, nodes: np.ndarray) -> shapely.Polygon:
    """A polygon with the nodes (n, 2) that lie on its edges, to the grid, as corners of it."""
    def filled(ring: shapely.LinearRing) -> np.ndarray:
        xy = shapely.get_coordinates(ring)
        vertices = [xy[0]]
        for start, end in zip(xy[:-1], xy[1:]):
            length = float(np.hypot(*(end - start)))
            unit = (end - start) / max(length, LEAST_DIVISOR)
            along = (nodes - start) @ unit
            away = np.abs((nodes - start) @ np.array([-unit[1], unit[0]]))
            on = np.flatnonzero((away < GRID) & (along > GRID / 2) & (along < length - GRID / 2))
            vertices += [*nodes[on[np.argsort(along[on])]], end]
        return np.array(vertices)

    return shapely.Polygon(filled(polygon.exterior), [filled(ring) for ring in polygon.interiors])


def _rings(vertices: np.ndarray, face: Sequence[Sequence[int]]) -> list[list[tuple[int, int, int]]]:
    """Rings of a face as places on a lattice of 0.1 mm."""
    whole = np.rint(vertices * UNITS).astype(np.int64)
    return [list(map(tuple, whole[list(ring)].tolist())) for ring in face]


def _below(solid: Solid, cut: float) -> list[tuple]:
    """Faces of a solid of layers up to the cut, walls that go on above it ended there."""
    limit = round(cut * UNITS)
    lower = []
    for face, kind, roof in zip(solid.faces, solid.surface_type, solid.roof_id):
        rings = _rings(solid.vertices, face)
        heights = [node[2] for ring in rings for node in ring]
        if max(heights) > limit:
            if min(heights) >= limit:
                continue  # a roof, or a wall wholly above
            rings = [_without_repeats([(x, y, min(z, limit)) for x, y, z in ring]) for ring in rings]
        lower.append((rings, kind, roof))
    return lower


def _without_repeats(ring: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    return [node for node, before in zip(ring, [ring[-1], *ring[:-1]]) if node != before]


def _joined(faces: list[tuple]) -> tuple[Solid, ...]:
    """Solids of faces (rings of places, type, roof), one for all faces that hang together."""
    owner: dict[tuple[int, int, int], int] = {}
    links = [(number, owner.setdefault(node, number)) for number, (rings, _, _) in enumerate(faces)
             for ring in rings for node in ring]
    solids = []
    for group in linked_members(*np.array(links, np.int64).reshape(-1, 2).T, len(faces)):
        members_of = [faces[number] for number in group.tolist()]
        index: dict[tuple[int, int, int], int] = {}
        shells = tuple(tuple(tuple(index.setdefault(node, len(index)) for node in ring) for ring in rings)
                       for rings, _, _ in members_of)
        solids.append(Solid(np.array(list(index), float) / UNITS, shells, tuple(kind for _, kind, _ in members_of),
                            tuple(roof for _, _, roof in members_of)))
    return tuple(solids)
