"""A building's plan cut by straight lines into pieces that share exact edges, and pieces joined again."""

from __future__ import annotations

import numpy as np
import shapely

from ...geometry.polygon_rings import polygon_rings

GRID = 1e-4
"""Metres; nodes are rounded to it, so that lines along an outline edge make no slivers."""


def ring_segments(polygons: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Distinct vertices (m, 2), and for each ring segment the vertex numbers of its ends and its polygon."""
    rings, polygon_of_ring = polygon_rings(polygons)
    xy, ring = shapely.get_coordinates(rings, return_index=True)
    vertices, number = np.unique(xy[:, 0] + 1j * xy[:, 1], return_inverse=True)
    same = ring[1:] == ring[:-1]
    return (np.column_stack([vertices.real, vertices.imag]), number[:-1][same], number[1:][same],
            polygon_of_ring[ring[:-1][same]])


def common_borders(pieces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (m, 2) of neighbours, the lower first, and the ends (m, 2, 2) of each straight border between them."""
    xy, start, end, piece = ring_segments(pieces)
    key = np.minimum(start, end) * len(xy) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    twins = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    one, two = order[twins], order[twins + 1]
    return np.sort(np.column_stack([piece[one], piece[two]]), axis=1), np.stack([xy[start[one]], xy[end[one]]], axis=1)


def dissolve(pieces: np.ndarray, labels: np.ndarray, outline: shapely.Geometry) -> tuple[list, np.ndarray]:
    """Join pieces of one label: Polygons in the order of labels, and the label of each.

    Nodes that only cuts have left behind are dropped on both sides of an edge; nodes where a third polygon
    begins stay on all of them. Corners of the outline come back with their exact coordinates.
    """
    polygons, label_of = [], []
    for label in np.unique(labels):
        members = pieces[labels == label]
        union = shapely.coverage_union_all(members) if len(members) > 1 else members[0]
        if not union.is_valid:  # GEOS leaves a ring that touches itself in a node whole: make it shell and hole
            union = shapely.make_valid(union)
        parts = shapely.get_parts(union)
        polygons.extend(parts)
        label_of += [int(label)] * len(parts)
    return _clean(np.array(polygons, object), outline), np.array(label_of, np.int64)


def _clean(polygons: np.ndarray, outline: shapely.Geometry) -> list:
    corners = shapely.get_coordinates(outline)
    exact = {(round(x / GRID), round(y / GRID)): (x, y) for x, y in corners.tolist()}
    xy, start, end, _ = ring_segments(polygons)
    needed = _nodes_needed(xy, start, end)
    rounded = np.round(xy / GRID).astype(np.int64)
    for i, key in enumerate(map(tuple, rounded.tolist())):
        if key in exact:
            needed[i] = True
            xy[i] = exact[key]
    result = []
    numbers = iter(_ring_vertices(polygons, xy, rounded))
    for polygon in polygons:
        rings = []
        for _ in range(1 + shapely.get_num_interior_rings(polygon)):
            ring = next(numbers)
            ring = ring[needed[ring]]
            if len(ring) >= 3:
                rings.append(xy[np.append(ring, ring[0])])
        result.append(shapely.Polygon(rings[0], rings[1:]))
    return result


def _ring_vertices(polygons: np.ndarray, xy: np.ndarray, rounded: np.ndarray) -> list[np.ndarray]:
    """Vertex numbers of every ring, open, in the order of `polygon_rings`."""
    coordinates, ring = shapely.get_coordinates(polygon_rings(polygons)[0], return_index=True)
    _, number = np.unique(coordinates[:, 0] + 1j * coordinates[:, 1], return_inverse=True)
    return [part[:-1] for part in np.split(number, np.flatnonzero(np.diff(ring)) + 1)]


def _nodes_needed(xy: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Mask of the vertices that are corners or junctions: not in the middle of one straight edge."""
    n = len(xy)
    key = np.unique(np.concatenate([start * n + end, end * n + start]))
    node, other = key // n, key % n
    degree = np.bincount(node, minlength=n)
    first = np.searchsorted(node, np.arange(n))
    two = degree == 2
    a, b, c = xy[other[first[two]]], xy[two], xy[other[first[two] + 1]]
    across = c - a
    doubled_area = np.abs(across[:, 0] * (b - a)[:, 1] - across[:, 1] * (b - a)[:, 0])
    distance = doubled_area / np.maximum(np.hypot(across[:, 0], across[:, 1]), GRID)
    needed = np.ones(n, bool)
    needed[two] = distance > 3.0 * GRID
    return needed
