"""From roof polygons that overlap and leave gaps to an exact partition of a building's plan (J 5.3.4).

Roofs are put on the plan from top to bottom, as J segments them: where two overlap, the plan belongs to the
higher one. All lines are noded by snap rounding on one grid, so that neighbouring cells share their edges
node by node and walls raised on them close exactly.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from ...errors import InputError, InsufficientDataError
from ...geometry.tolerances import GRID
from ...wording import say
from .half_edges import HalfEdges, half_edges, trace_rings, whole_metre_origin

_GAP = -1
MIN_AREA, MIN_WIDTH = 1.0, 0.3
"""A cell smaller than this (m2) or everywhere narrower than this (m) goes to the neighbour with the longest common
edge."""

_STRAIGHT = 1.5
"""Rounding to the grid moves a node by up to 0.71 grid steps, so a node of a straight line lies within 1.42."""


@dataclass(frozen=True)
class Cell:
    """A piece of the plan under one roof: polygon (m), the roof's id, height of the roof (m)."""

    polygon: shapely.Polygon
    roof_id: Any
    height: float


def partition_plan(outline: shapely.Geometry | None, roof_polygons: Sequence[shapely.Geometry],
                   roof_heights: Sequence[float], roof_ids: Sequence[Hashable]) -> tuple[Cell, ...]:
    """Cut the plan under a building's roofs into cells of one roof each, edge by edge beside each other, from the
    highest roof down.

    Parameters
    ----------
    outline : Polygon or MultiPolygon of the building, m, courtyards as its holes: holes between the roofs are filled
        where they lie in it. May be None; then only slivers are.
    roof_polygons : polygons of the roofs, m; they may overlap, leave gaps or be invalid.
    roof_heights, roof_ids : height (m) and id of each roof.

    Raises
    ------
    InputError : lengths differ, or a height is not finite.
    InsufficientDataError : there is no roof, or none with an area.
    """
    _check_input(roof_polygons, roof_heights, roof_ids)
    order = _top_to_bottom(roof_polygons, roof_heights, roof_ids)
    geometries = np.array([roof_polygons[i] for i in order] + ([outline] if outline is not None else []), dtype=object)
    origin = whole_metre_origin(shapely.total_bounds(geometries))
    geometries = _cleaned(geometries, origin)
    roofs = geometries[:len(order)]
    lines = shapely.union_all(shapely.boundary(roofs), grid_size=GRID)
    faces = shapely.get_parts(shapely.polygonize([lines]))
    edges = half_edges(faces, (0.0, 0.0), GRID) if len(faces) else None
    regions = _Regions(edges, shapely.area(faces), _labels(faces, roofs)) if edges else None
    if regions:
        _close_courtyards(regions, faces, geometries[-1] if outline is not None else None)
        _fill_gaps(regions)
        _merge_slivers(regions, faces)
    if not regions or not regions.label:
        raise InsufficientDataError(say("No roof of the building has an area: check outline and roofs."))
    return _cells(regions, edges, origin, order, roof_heights, roof_ids)


def _check_input(roof_polygons, roof_heights, roof_ids) -> None:
    """Refuse what cannot be partitioned."""
    if not len(roof_polygons) == len(roof_heights) == len(roof_ids):
        raise InputError(say("Roof polygons, heights and ids differ in number: give one height and id for each roof."))
    if len(roof_polygons) == 0:
        raise InsufficientDataError(say("The building has no roof: give at least one."))
    if not np.all(np.isfinite(np.asarray(roof_heights, dtype=float))):
        raise InputError(say("A roof has no height: give a finite height for each roof."))


def _top_to_bottom(roof_polygons, roof_heights, roof_ids) -> list[int]:
    """Order of the roofs from the highest down; larger area, then id, decide among equals."""
    areas = shapely.area(np.asarray(roof_polygons, dtype=object))
    return sorted(range(len(areas)), key=lambda i: (-roof_heights[i], -round(areas[i], 6), str(roof_ids[i])))


def _cleaned(geometries: np.ndarray, origin: tuple[float, float]) -> np.ndarray:
    """Valid, flat geometries on a local origin."""
    moved = shapely.transform(shapely.force_2d(geometries), lambda c: c - origin)
    bad = ~shapely.is_valid(moved)
    moved[bad] = [_areas_of(geometry) for geometry in shapely.make_valid(moved[bad])]
    return moved


def _areas_of(geometry: shapely.Geometry) -> shapely.MultiPolygon:
    """The polygons of a repaired geometry, without the lines and points that repairing leaves."""
    parts = shapely.get_parts(shapely.get_parts(geometry))
    return shapely.MultiPolygon([part for part in parts if part.geom_type == "Polygon"])


def _labels(faces: np.ndarray, roofs: np.ndarray) -> np.ndarray:
    """The highest roof over each face, or gap."""
    roof, face = shapely.STRtree(shapely.point_on_surface(faces)).query(roofs, predicate="contains")
    highest = np.full(len(faces), len(roofs))
    np.minimum.at(highest, face, roof)
    return np.where(highest < len(roofs), highest, _GAP)


class _Regions:
    """Faces grown together to regions of one label, with the lengths of their common edges.

    A region is known by the number of one of its faces.
    """

    def __init__(self, edges: HalfEdges, areas: np.ndarray, labels: np.ndarray):
        self.label = dict(enumerate(labels.tolist()))
        self.area = dict(enumerate(areas.tolist()))
        self.faces = {i: [i] for i in self.label}
        self.perimeter = dict.fromkeys(self.label, 0.0)
        self.shared: dict[int, dict[int, float]] = {i: {} for i in self.label}
        for (a, b), face in edges.cell.items():
            length = edges.length(a, b)
            self.perimeter[face] += length
            other = edges.cell.get((b, a))
            if other is not None and other != face:
                self.shared[face][other] = self.shared[face].get(other, 0.0) + length
        for face in list(self.label):
            if face in self.label:
                self.relabel(face, self.label[face])

    def relabel(self, region: int, label: int) -> None:
        """Give a region a label and grow it together with its neighbours of that label."""
        self.label[region] = label
        while True:
            same = [other for other in self.shared[region] if self.label[other] == label]
            if not same:
                return
            for other in same:
                self._absorb(region, other)

    def _absorb(self, region: int, other: int) -> None:
        """Add `other` to `region`."""
        common = self.shared[region].pop(other)
        self.perimeter[region] += self.perimeter.pop(other) - 2 * common
        self.area[region] += self.area.pop(other)
        self.faces[region] += self.faces.pop(other)
        del self.label[other]
        for third, length in self.shared.pop(other).items():
            if third != region:
                self.shared[region][third] = self.shared[third][region] = (
                    self.shared[region].get(third, 0.0) + length)
                del self.shared[third][other]

    def best_neighbour(self, region: int) -> int | None:
        """Label of the roof with the longest edge in common with a region, the higher of equals."""
        lengths: dict[int, float] = {}
        for other, length in self.shared[region].items():
            label = self.label[other]
            if label >= 0:
                lengths[label] = lengths.get(label, 0.0) + length
        return min(lengths, key=lambda label: (-round(lengths[label], 6), label), default=None)

    def drop(self, region: int) -> None:
        """Take a region out of the plan."""
        for other in self.shared.pop(region):
            del self.shared[other][region]
        del self.label[region], self.faces[region]

    def is_sliver(self, region: int, faces: np.ndarray) -> bool:
        """Whether a region is smaller or everywhere narrower than wanted."""
        if self.area[region] < MIN_AREA:
            return True
        # 2 A / P is never more than the width of the widest place, so most regions need no buffer.
        if 2 * self.area[region] >= MIN_WIDTH * self.perimeter[region]:
            return False
        polygon = shapely.union_all(faces[self.faces[region]])
        return bool(shapely.buffer(polygon, -MIN_WIDTH / 2).is_empty)


def _close_courtyards(regions: _Regions, faces: np.ndarray, outline: shapely.Geometry | None) -> None:
    """Take holes between roofs out of the plan, but for slivers and those the outline calls building."""
    for region in [r for r, label in regions.label.items() if label == _GAP]:
        largest = max(regions.faces[region], key=lambda face: regions.area.get(face, 0.0))
        building = outline is not None and shapely.contains(outline, shapely.point_on_surface(faces[largest]))
        if not building and not regions.is_sliver(region, faces):
            regions.drop(region)


def _fill_gaps(regions: _Regions) -> None:
    """Give each gap to a roof beside it; one that no roof touches goes."""
    # Chosen before anything grows, so that the order of the gaps does not matter.
    chosen = {region: regions.best_neighbour(region) for region, label in regions.label.items() if label == _GAP}
    for region, label in chosen.items():
        if label is None:
            regions.drop(region)
        else:
            _grow(regions, region, label)


def _grow(regions: _Regions, region: int, label: int) -> None:
    """Relabel a region that may have been absorbed under the same label already."""
    if region in regions.label:
        regions.relabel(region, label)


def _merge_slivers(regions: _Regions, faces: np.ndarray) -> None:
    """Give slivers to their neighbours, smallest first. One without neighbours stays."""
    judged: dict[int, float] = {}
    while True:
        slivers = []
        for region in regions.label:
            if judged.get(region) == regions.area[region]:
                continue
            if regions.shared[region] and regions.is_sliver(region, faces):
                slivers.append(region)
            else:
                judged[region] = regions.area[region]
        if not slivers:
            return
        region = min(slivers, key=lambda r: (regions.area[r], min(regions.faces[r])))
        regions.relabel(region, regions.best_neighbour(region))


def _cells(regions: _Regions, edges: HalfEdges, origin, order, heights, ids) -> tuple[Cell, ...]:
    """Polygons of the regions, without nodes that only noding or merging left behind."""
    region_of = {face: region for region, faces in regions.faces.items() for face in faces}
    owned = {edge: region_of[face] for edge, face in edges.cell.items() if face in region_of}
    outlines = {edge: region for edge, region in owned.items() if owned.get(edge[::-1]) != region}
    merged = HalfEdges(edges.origin, edges.resolution, edges.x, edges.y, outlines)
    _drop_straight_nodes(merged)
    by_region: dict[int, list[tuple[int, int]]] = {region: [] for region in regions.label}
    for edge, region in merged.cell.items():
        by_region[region].append(edge)
    cells = []
    for region, directed in by_region.items():
        roof = order[regions.label[region]]
        polygon, first = _polygon(merged, directed, origin)
        cells.append((regions.label[region], first, Cell(polygon, ids[roof], float(heights[roof]))))
    cells.sort(key=lambda item: item[:2])
    return tuple(cell for _, _, cell in cells)


def _drop_straight_nodes(edges: HalfEdges) -> None:
    """Remove nodes where only two edges meet and go straight on, at both sides of the line.

    Straight is what stays within `_STRAIGHT` grid steps of all nodes removed before and of no other node.
    """
    neighbours: dict[int, set[int]] = {}
    for a, b in edges.cell:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    removed: dict[frozenset[int], list[int]] = {}
    places = np.full((len(edges.x), 2), np.inf)
    live = list(neighbours)
    places[live] = [(edges.x[node], edges.y[node]) for node in live]
    for node in sorted(neighbours):
        if len(neighbours[node]) != 2:
            continue
        a, b = neighbours[node]
        on_line = [node, *removed.get(frozenset((a, node)), ()), *removed.get(frozenset((b, node)), ())]
        if b in neighbours[a] or not _is_straight(edges, a, b, on_line, places):
            continue
        for start, end in ((a, b), (b, a)):
            cell = edges.cell.pop((start, node), None)
            if cell is not None:
                del edges.cell[node, end]
                edges.cell[start, end] = cell
        neighbours[a].symmetric_difference_update((node, b))
        neighbours[b].symmetric_difference_update((node, a))
        places[node] = np.inf
        removed[frozenset((a, b))] = on_line


def _is_straight(edges: HalfEdges, a: int, b: int, on_line: list[int], places: np.ndarray) -> bool:
    """Whether the line from a to b passes near some nodes, and near no other of the `places`."""
    ax, ay = edges.x[a], edges.y[a]
    dx, dy = edges.x[b] - ax, edges.y[b] - ay
    length = math.hypot(dx, dy)
    if any(abs(dx * (edges.y[node] - ay) - dy * (edges.x[node] - ax)) > _STRAIGHT * length
           for node in on_line):
        return False
    x, y = places[:, 0] - ax, places[:, 1] - ay
    candidates = np.flatnonzero(np.abs(x - dx / 2) + np.abs(y - dy / 2) <= length + 2 * _STRAIGHT)
    x, y = x[candidates], y[candidates]
    along = dx * x + dy * y
    reach = _STRAIGHT * length
    near = (np.abs(dx * y - dy * x) <= reach) & (along >= -reach) & (along <= length * length + reach)
    return set(candidates[near].tolist()) <= {a, b, on_line[0]}


def _polygon(edges: HalfEdges, directed, origin) -> tuple[shapely.Polygon, int]:
    """Polygon of a region from its directed edges, and the lowest node of its outer ring."""
    rings = trace_rings(edges, directed)
    outer = [ring for ring in rings if edges.twice_area(ring) > 0]
    holes = [ring for ring in rings if edges.twice_area(ring) < 0]
    shape = [edges.coordinates(ring) + origin for ring in (outer[0], *holes)]
    return shapely.Polygon(shape[0], shape[1:]), outer[0][0]
