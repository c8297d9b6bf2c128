"""Strokes of paint: the centre lines and widths of which a marking's polygon is made."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
import shapely
from scipy.spatial import QhullError, Voronoi

from ...geometry.tolerances import LEAST_DIVISOR

BOUNDARY_STEP = 0.06
"""Distance of the boundary points whose Voronoi edges make the medial axis, m: half a pixel of the images used."""

STRAIGHT_FILL, STRAIGHT_ASPECT = 0.72, 3.0
"""A polygon that fills so much of its smallest rectangle, so much longer than wide, is one straight stroke."""

CORNER = np.radians(30.0)
"""A stroke that turns by more is two."""

LARGEST, WIDEST = 60.0, 1.0
"""Paint larger than the first (m2) whose mean width is larger than the second (m) is no line, such as a bright yard; a
long line, or lines that hang together, are large but narrow."""


@dataclass(frozen=True)
class Stroke:
    """A piece of a marking between two tips, corners or forks.

    Attributes
    ----------
    polygon : number of the polygon that it is part of.
    axis : (n, 2) centre line from tip to tip, m.
    width : of the paint across it, m (median).
    whole : the polygon is this stroke alone.
    """

    polygon: int
    axis: np.ndarray
    width: float
    whole: bool = True

    @property
    def length(self) -> float:
        """Along the axis, m."""
        return float(np.linalg.norm(np.diff(self.axis, axis=0), axis=1).sum())

    @property
    def direction(self) -> np.ndarray:
        """Unit vector (2,) from the first tip to the last."""
        chord = self.axis[-1] - self.axis[0]
        return chord / max(np.linalg.norm(chord), LEAST_DIVISOR)


def polygon_strokes(polygon: shapely.Polygon, number: int = 0) -> list[Stroke]:
    """Strokes of one polygon, longest first.

    A nearly rectangular polygon gives the axis of its smallest rectangle. Others are taken apart by their medial axis
    (the Voronoi edges of boundary points that lie inside), cut where it forks and where it turns by more than 30°.
    """
    straight = _straight_stroke(polygon, number)
    if straight is not None:
        return [straight]
    if polygon.area > LARGEST and 2.0 * polygon.area > WIDEST * polygon.length:
        return []
    paths = [piece for path in _axis_paths(polygon) for piece in _cut_at_corners(path)]
    if not paths:
        return []
    lines = shapely.linestrings(np.concatenate(paths), indices=np.repeat(np.arange(len(paths)), [len(path) for path in
                                                                                                 paths]))
    middles = shapely.line_interpolate_point(lines[:, None], np.linspace(0.2, 0.8, 7), normalized=True)
    widths = 2.0 * np.median(shapely.distance(middles, polygon.boundary), axis=1)
    axes = _to_boundary(paths, polygon, widths)
    found = [Stroke(number, axis, float(width), len(paths) == 1) for axis, width in zip(axes, widths)]
    return sorted(found, key=lambda stroke: -stroke.length)


def all_strokes(polygons: Sequence[shapely.Polygon]) -> list[Stroke]:
    """Strokes of many polygons; `Stroke.polygon` is the place in the sequence."""
    return [stroke for number, polygon in enumerate(polygons) for stroke in polygon_strokes(polygon, number)]


def _straight_stroke(polygon: shapely.Polygon, number: int) -> Stroke | None:
    """The polygon as one straight stroke, where it is one."""
    frame = shapely.minimum_rotated_rectangle(polygon)
    if frame.geom_type != "Polygon":
        return None
    corners = shapely.get_coordinates(frame.exterior)[:4]
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    if sides[0] < sides[1]:
        corners, sides = np.roll(corners, -1, axis=0), np.roll(sides, -1)
    if sides[0] < STRAIGHT_ASPECT * sides[1] or polygon.area < STRAIGHT_FILL * sides[0] * sides[1]:
        return None
    axis = np.array([corners[0] + corners[3], corners[1] + corners[2]]) / 2.0
    return Stroke(number, axis, polygon.area / sides[0])


def _axis_paths(polygon: shapely.Polygon) -> list[np.ndarray]:
    """Paths (n, 2) of the medial axis between its tips and forks; short spurs to the boundary are left out."""
    dense = shapely.segmentize(polygon.simplify(0.02), BOUNDARY_STEP)
    points = np.unique(np.round(shapely.get_coordinates(dense), 6), axis=0)
    origin = points.mean(axis=0)
    try:
        voronoi = Voronoi(points - origin)
    except QhullError:
        return []
    nodes = voronoi.vertices + origin
    ridges = np.fromiter(chain.from_iterable(voronoi.ridge_vertices), np.int64).reshape(-1, 2)
    ridges = ridges[ridges[:, 0] >= 0]
    shapely.prepare(polygon)
    within = shapely.contains_xy(polygon, nodes[:, 0], nodes[:, 1])
    ridges = ridges[within[ridges].all(axis=1)]
    ends = np.flatnonzero(~np.isin(np.bincount(ridges.ravel(), minlength=len(nodes)), (0, 2)))
    radius = np.zeros(len(nodes))
    radius[ends] = shapely.distance(shapely.points(nodes[ends]), polygon.boundary)
    return [nodes[path] for path in _pruned_paths(ridges, nodes, radius)]


def _pruned_paths(edges: np.ndarray, nodes: np.ndarray, radius: np.ndarray) -> list[list[int]]:
    """Paths of node numbers in a graph, after spurs hardly longer than the paint's half width were taken off;
    `radius` (n,) is that half width at tips and forks."""
    near: dict[int, set[int]] = {}
    for a, b in edges.tolist():
        near.setdefault(a, set()).add(b)
        near.setdefault(b, set()).add(a)
    _SpurPruning(near, nodes, radius).run()
    near = {node: others for node, others in near.items() if others}
    return [path for path in _paths(near) if _length(nodes[path]) > 0.1]


class _SpurPruning:
    """Takes spurs off a graph, the shortest first. Each joins two other paths at most: all others stay known."""

    def __init__(self, near: dict[int, set[int]], nodes: np.ndarray, radius: np.ndarray):
        self._near, self._nodes, self._radius = near, nodes, radius
        self._rank = {node: place for place, node in enumerate(near)}
        self._paths: list[list[int]] = []
        self._at: dict[int, set[int]] = {}  # numbers of the paths at each tip or fork
        self._spurs: list[tuple[float, int, int, int]] = []  # length, what decides between equal ones, number
        for path in _paths(near):
            self._add(path)

    def run(self) -> None:
        """Take them off the graph."""
        while self._spurs:
            number = heapq.heappop(self._spurs)[-1]
            if number in self._at[self._paths[number][0]]:  # else it has become part of another one
                self._take_off(number)

    def _add(self, path: list[int]) -> None:
        """Know a path, and whether it is a spur."""
        if self._rank[path[-1]] < self._rank[path[0]]:
            path = path[::-1]
        number, ends = len(self._paths), (path[0], path[-1])
        self._paths.append(path)
        for end in ends:
            self._at.setdefault(end, set()).add(number)
        if (len(self._near[path[0]]) == 1) == (len(self._near[path[-1]]) == 1):
            return
        length = _length(self._nodes[path])
        if length < 1.6 * max(self._radius[end] for end in ends) + 0.1:
            turn = list(self._near[path[0]]).index(path[1])
            heapq.heappush(self._spurs, (length, self._rank[path[0]], turn, number))

    def _take_off(self, number: int) -> None:
        """Take a spur off; where its fork is none any more, its other two paths become one."""
        path = self._paths[number]
        for a, b in zip(path[:-1], path[1:]):
            self._near[a].discard(b)
            self._near[b].discard(a)
        for end in (path[0], path[-1]):
            self._at[end].discard(number)
        fork = path[-1] if self._near[path[-1]] else path[0]
        if len(self._near[fork]) != 2:
            return
        others = [self._paths[other] for other in self._at[fork]]
        for met in tuple(self._at[fork]):
            for end in (self._paths[met][0], self._paths[met][-1]):
                self._at[end].discard(met)
        if len(others) == 2:  # one that comes back to the fork is a ring now
            one, other = others
            self._add((one if one[-1] == fork else one[::-1]) + (other if other[0] == fork else other[::-1])[1:])


def _paths(near: dict[int, set[int]]) -> list[list[int]]:
    """Chains of nodes between those that have not exactly two neighbours; a ring is one path."""
    seen: set[tuple[int, int]] = set()
    paths = []
    ends = [node for node, others in near.items() if len(others) != 2]
    for start in ends or list(near)[:1]:
        for step in near[start]:
            if (start, step) in seen:
                continue
            path = [start, step]
            before, node = start, step
            while len(near[node]) == 2 and node != start:
                one, other = near[node]
                before, node = node, one if one != before else other
                path.append(node)
            seen |= {(path[0], path[1]), (path[-1], path[-2])}
            paths.append(path)
    return paths


def _length(path: np.ndarray) -> float:
    step = path[1:] - path[:-1]
    return float(np.hypot(step[:, 0], step[:, 1]).sum())


def _cut_at_corners(path: np.ndarray) -> list[np.ndarray]:
    """The path smoothed to a few centimetres and cut where it turns by more than `CORNER`."""
    line = shapely.linestrings(path)
    coarse = shapely.get_coordinates(shapely.simplify(line, 0.12))
    corners = np.zeros((0, 2))
    if len(coarse) > 2:
        steps = np.diff(coarse, axis=0)
        turn = np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))))
        corners = coarse[1:-1][turn > CORNER]
    if not len(corners):
        return [shapely.get_coordinates(shapely.simplify(line, 0.04))]
    cuts = [int(np.argmin(np.linalg.norm(path - corner, axis=1))) for corner in corners]
    borders = sorted({0, *cuts, len(path) - 1})
    pieces = [path[a:b + 1] for a, b in zip(borders[:-1], borders[1:])]
    return [shapely.get_coordinates(shapely.simplify(shapely.linestrings(piece), 0.04)) for piece in pieces
            if _length(piece) > 0.2]


def _to_boundary(axes: Sequence[np.ndarray], polygon: shapely.Polygon, widths: np.ndarray) -> list[np.ndarray]:
    """Axes prolonged at both tips to where the paint ends; the medial axis stops half a width before."""
    edges, ring = shapely.get_coordinates(shapely.get_rings(polygon), return_index=True)
    goes_on = ring[1:] == ring[:-1]
    start, end = edges[:-1][goes_on], edges[1:][goes_on]
    tips = np.array([(axis[0], axis[-1]) for axis in axes])
    along = tips - np.array([(axis[1], axis[-2]) for axis in axes])
    along /= np.maximum(np.linalg.norm(along, axis=2, keepdims=True), LEAST_DIVISOR)
    within = shapely.contains_xy(polygon, tips[..., 0], tips[..., 1])
    prolonged = []
    for axis, tip, way, inside, width in zip(axes, tips, along, within, widths):
        ends = [place + direction * min(_to_edges(place, direction, start, end) if paint else 0.0, 0.75 * width)
                for place, direction, paint in zip(tip, way, inside)]
        prolonged.append(np.vstack([ends[0], axis, ends[1]]))
    return prolonged


def _to_edges(place: np.ndarray, along: np.ndarray, start: np.ndarray, end: np.ndarray) -> float:
    """How far it is from a place (2,) in a direction to the first of straight edges (n, 2), infinite where none is in
    the way."""
    across = np.array([-along[1], along[0]])
    side, other = (start - place) @ across, (end - place) @ across
    met = (side > 0) != (other > 0)
    start, end, side, other = start[met], end[met], side[met], other[met]
    first = (start - place) @ along
    distance = first + side / (side - other) * ((end - start) @ along)
    return float(distance[distance >= 0].min(initial=np.inf))
