"""Closed solids from prisms that lie over, under and beside each other, overhangs and ledges included.

The plans of all prisms cut the plane into faces; over each face the solid fills some intervals of height. Tops and
bottoms of intervals are level faces, what one face fills and its neighbour does not is an upright wall.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.linked_groups import linked_members
from ...geometry.short_sides import without_short_edges
from ...geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF, Solid
from ...geometry.tolerances import GRID, UNITS
from ...wording import say
from ..solids.face_collector import FaceCollector
from ..solids.half_edges import HalfEdges, connected_cells, half_edges, trace_rings, whole_metre_origin

Interval = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Prism:
    """A plan filled between two heights, m; `roof_id` names the roof on top, None where the top is none."""

    plan: shapely.Polygon
    bottom: float
    top: float
    roof_id: Hashable = None


def layered_solids(prisms: Sequence[Prism], lift: float = 0.0, short_sides: bool = True) -> tuple[Solid, ...]:
    """The union of prisms as solids, one for each connected piece.

    Parameters
    ----------
    lift : undersides that hang free are put this much higher (m). Where a ledge and an overhang of one height meet in
        an edge, four faces meet there; a centimetre between them repairs that.
    short_sides : whether corners of the plan may lie nearer than `SHORTEST`, as where a wall moved by a centimetre.

    Raises
    ------
    InputError : a height is not finite, or there is no prism with a volume.
    """
    heights = np.array([(prism.bottom, prism.top) for prism in prisms], float).reshape(-1, 2)
    if not np.isfinite(heights).all():
        raise InputError(say("A part of the model has no height: give finite heights."))
    levels = np.rint(heights * UNITS).astype(np.int64)
    plans = np.array([prism.plan for prism in prisms], object)
    if not len(plans):
        raise InputError(say("The model has no parts."))
    origin = whole_metre_origin(shapely.total_bounds(plans))
    local = shapely.transform(shapely.force_2d(plans), lambda c: c - origin)
    lines = shapely.union_all(shapely.boundary(local), grid_size=GRID)
    faces = shapely.get_parts(shapely.polygonize([lines]))
    inside = shapely.point_on_surface(faces)
    prism, face = shapely.STRtree(inside).query(local, predicate="contains")
    filled: list[list[Interval]] = [[] for _ in faces]
    roof_of: list[dict[int, Hashable]] = [{} for _ in faces]
    for p, f in zip(prism.tolist(), face.tolist()):
        bottom, top = levels[p].tolist()
        if top > bottom:
            filled[f].append((bottom, top))
            if prisms[p].roof_id is not None:
                roof_of[f].setdefault(top, prisms[p].roof_id)
    if not short_sides:
        faces = np.array(without_short_edges(faces), object)
    filled_faces = [f for f in range(len(faces)) if filled[f] and faces[f] is not None]
    if not filled_faces:
        raise InputError(say("The model has no part with a volume."))
    edges = half_edges(faces[filled_faces], (0.0, 0.0), GRID)
    edges.origin = origin
    intervals = [merged_intervals(filled[f]) for f in filled_faces]
    if lift:
        base, up = min(layers[0][0] for layers in intervals), round(lift * UNITS)
        intervals = [[(bottom + up if base < bottom < top - up else bottom, top) for bottom, top in layers]
                     for layers in intervals]
    return _Builder(edges, intervals, [roof_of[f] for f in filled_faces]).solids()


def merged_intervals(intervals: Iterable[Interval]) -> list[Interval]:
    """Intervals in order, those that touch or overlap joined."""
    result: list[Interval] = []
    for bottom, top in sorted(intervals):
        if result and bottom <= result[-1][1]:
            result[-1] = result[-1][0], max(result[-1][1], top)
        else:
            result.append((bottom, top))
    return result


def subtracted_intervals(intervals: Sequence[Interval], taken: Sequence[Interval]) -> list[Interval]:
    """What is left of intervals when others are taken away; both in order."""
    left = []
    for bottom, top in intervals:
        for low, high in taken:
            if high <= bottom or low >= top:
                continue
            if low > bottom:
                left.append((bottom, low))
            bottom = max(bottom, high)
        if bottom < top:
            left.append((bottom, top))
    return left


class _Builder:
    """Collects the faces; every vertex is a plan node at a height."""

    def __init__(self, edges: HalfEdges, intervals: list[list[Interval]], roof_of: list[dict[int, Hashable]]):
        self.edges, self.intervals, self.roof_of = edges, intervals, roof_of
        self.base = min(pieces[0][0] for pieces in intervals)

    def solids(self) -> tuple[Solid, ...]:
        """One solid for each piece of the whole that hangs together."""
        pieces = [(cell, number) for cell, layers in enumerate(self.intervals) for number in range(len(layers))]
        number_of = {piece: place for place, piece in enumerate(pieces)}
        links = []
        for (a, b), cell in self.edges.cell.items():
            other = self.edges.cell.get((b, a))
            if other is None or other < cell:
                continue
            links += [(number_of[cell, i], number_of[other, j])
                      for i, layers in enumerate(self.intervals[cell]) for j, beside in enumerate(self.intervals[other])
                      if layers[0] < beside[1] and beside[0] < layers[1]]
        built = []
        for group in linked_members(*np.array(links, np.int64).reshape(-1, 2).T, len(pieces)):
            layers: dict[int, list[Interval]] = {}
            for place in group.tolist():
                cell, number = pieces[place]
                layers.setdefault(cell, []).append(self.intervals[cell][number])
            built.append(self._solid(layers))
        return tuple(built)

    def _solid(self, layers: dict[int, list[Interval]]) -> Solid:
        made = FaceCollector(self.edges, self.base)
        for level, upper, cells in self._levels(layers):
            self._add_level(level, upper, cells, made.add)
        self._add_walls(layers, made.add)
        return Solid(made.vertices(), tuple(made.faces), tuple(made.types), tuple(made.ids))

    def _levels(self, layers: dict[int, list[Interval]]):
        """(level, whether it is a top, cells) of all level faces, from below."""
        cells_at: dict[tuple[int, bool], list[int]] = {}
        for cell, intervals in layers.items():
            for bottom, top in intervals:
                cells_at.setdefault((bottom, False), []).append(cell)
                cells_at.setdefault((top, True), []).append(cell)
        for (level, upper), cells in sorted(cells_at.items()):
            yield level, upper, cells

    def _add_level(self, level: int, upper: bool, cells: list[int], add) -> None:
        """The level faces of one height, cells of one roof joined."""
        by_roof: dict[Hashable, set[int]] = {}
        for cell in cells:
            name = self.roof_of[cell].get(level) if upper else None
            by_roof.setdefault(name, set()).add(cell)
        for name in sorted(by_roof, key=str):
            kind = ROOF if upper else GROUND if level == self.base else OVERHANG
            for rings in self._shapes(by_roof[name]):
                add([[(node, level) for node in (ring if upper else reversed(ring))] for ring in rings], kind, name)

    def _shapes(self, cells: set[int]) -> list[list[list[int]]]:
        """Rings of the union of cells, piece by piece, the outer ring first."""
        owner = self.edges.cell
        borders = [[edge for edge, cell in owner.items() if cell in piece and owner.get(edge[::-1]) not in piece]
                   for piece in connected_cells(self.edges, cells)]
        return [sorted(trace_rings(self.edges, directed), key=lambda ring: self.edges.twice_area(ring) < 0)
                for directed in borders]

    def _add_walls(self, layers: dict[int, list[Interval]], add) -> None:
        """One upright face for each plan edge and stretch of height that only one side fills."""
        walls = []
        stops: dict[int, set[int]] = {}
        for (a, b), cell in sorted(self.edges.cell.items()):
            if cell not in layers:
                continue
            other = self.edges.cell.get((b, a))
            beside = layers.get(other, []) if other is not None else []
            for bottom, top in subtracted_intervals(layers[cell], beside):
                walls.append((a, b, bottom, top, cell, OUTER_WALL if not beside else INNER_WALL))
                for node in (a, b):
                    stops.setdefault(node, set()).update((bottom, top))
        ordered = {node: sorted(levels) for node, levels in stops.items()}
        for a, b, bottom, top, cell, kind in walls:
            rising = [(b, level) for level in ordered[b] if bottom <= level <= top]
            falling = [(a, level) for level in reversed(ordered[a]) if bottom <= level <= top]
            add([[*rising, *falling]], kind, self.roof_of[cell].get(top))


def solid_volume(solid: Solid) -> float:
    """Volume of any closed solid, m3, from the areas of its faces (Gauss)."""
    origin = solid.vertices.min(axis=0)
    total = 0.0
    for face in solid.faces:
        for ring in face:
            corners = solid.vertices[list(ring)] - origin
            area = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0) / 2
            total += float(area @ corners[0]) / 3
    return total
