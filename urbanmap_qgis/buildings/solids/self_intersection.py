"""Do the faces of a closed shell run into each other? Each edge against each face, in arrays.

Two planar faces that meet elsewhere than along their common vertices and edges do so where an edge of one
touches or pierces the other, or, in one plane, where an edge of one runs through the other's inside.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...execution import checkpoint
from ...geometry.tolerances import SAME_PLACE

_PAIRS_AT_ONCE = 2_000_000


def crossing_pairs(points: np.ndarray, edges: np.ndarray, owners: np.ndarray, vertex: np.ndarray,
                   face_of: np.ndarray, polygons: np.ndarray, normal: np.ndarray, centre: np.ndarray,
                   axis: np.ndarray) -> list[tuple[int, int]]:
    """Pairs (edge, face) that meet where they must not.

    Parameters
    ----------
    points : (V, 3) vertices, m.
    edges, owners : (E, 2) vertices of each edge, and the two faces it bounds.
    vertex, face_of : vertex and face of each corner, ordered by face.
    polygons : faces seen along `axis`: x, y of a polygon are axes axis + 1, axis + 2 (modulo 3).
    normal, centre : (F, 3) unit normal and a point of each face's plane.
    """
    shapely.prepare(polygons)
    member = np.unique(vertex * len(polygons) + face_of)
    found: list[tuple[int, int]] = []
    for edge, face in _near_pairs(points, edges, owners, vertex, face_of):
        a, b = edges[edge].T
        a_shared, b_shared = (_among(v * len(polygons) + face, member) for v in (a, b))
        side_a, side_b = (np.einsum("ij,ij->i", points[v] - centre[face], normal[face]) for v in (a, b))
        side_a[a_shared | (np.abs(side_a) <= SAME_PLACE)] = 0.0
        side_b[b_shared | (np.abs(side_b) <= SAME_PLACE)] = 0.0
        flat = (side_a == 0) & (side_b == 0)
        pierces = (side_a * side_b < 0) | ((side_a == 0) & ~a_shared & ~flat) | ((side_b == 0) & ~b_shared & ~flat)
        hit = np.zeros(len(edge), dtype=bool)
        hit[pierces] = _pierced(points[a[pierces]], points[b[pierces]], side_a[pierces], side_b[pierces],
                                polygons[face[pierces]], axis[face[pierces]])
        hit[flat] = _run_through(points[a[flat]], points[b[flat]], (a_shared | b_shared)[flat],
                                 polygons[face[flat]], axis[face[flat]])
        found.extend(zip(edge[hit].tolist(), face[hit].tolist()))
    return found


def _near_pairs(points, edges, owners, vertex, face_of) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Blocks of (edge, face) whose boxes touch, without the faces that an edge bounds."""
    starts = np.flatnonzero(np.append(True, face_of[1:] != face_of[:-1]))
    corners = points[vertex]
    face_low = np.minimum.reduceat(corners, starts) - SAME_PLACE
    face_high = np.maximum.reduceat(corners, starts) + SAME_PLACE
    ends = points[edges]
    edge_low, edge_high = ends.min(axis=1), ends.max(axis=1)
    block = max(1, _PAIRS_AT_ONCE // len(face_low))
    for first in range(0, len(edges), block):
        checkpoint()
        part = slice(first, first + block)
        near = np.ones((len(edges[part]), len(face_low)), dtype=bool)
        for k in range(3):
            near &= edge_low[part, None, k] <= face_high[:, k]
            near &= edge_high[part, None, k] >= face_low[:, k]
        rows = np.arange(len(near))
        near[rows, owners[part, 0]] = near[rows, owners[part, 1]] = False
        edge, face = np.nonzero(near)
        if len(edge):
            yield edge + first, face


def _among(values: np.ndarray, ordered: np.ndarray) -> np.ndarray:
    """Whether each value is one of the ordered ones."""
    place = np.minimum(np.searchsorted(ordered, values), len(ordered) - 1)
    return ordered[place] == values


def _seen_along(points: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Points (n, 3) as (n, 2), each seen along its axis."""
    row = np.arange(len(points))
    return np.column_stack([points[row, (axis + 1) % 3], points[row, (axis + 2) % 3]])


def _pierced(a, b, side_a, side_b, polygons, axis) -> np.ndarray:
    """Whether the edge from a to b meets the polygon where it meets the polygon's plane."""
    if len(a) == 0:
        return np.zeros(0, dtype=bool)
    place = a + (side_a / (side_a - side_b))[:, None] * (b - a)
    return shapely.dwithin(shapely.points(_seen_along(place, axis)), polygons, SAME_PLACE)


def _run_through(a, b, joined, polygons, axis) -> np.ndarray:
    """Whether an edge in a polygon's plane runs through its inside, or touches it without a common vertex."""
    if len(a) == 0:
        return np.zeros(0, dtype=bool)
    ends = np.stack([_seen_along(a, axis), _seen_along(b, axis)], axis=1)
    lines, bounds = shapely.linestrings(ends), shapely.bounds(polygons)
    through = np.zeros(len(lines), dtype=bool)
    through[~joined] = shapely.intersects(polygons[~joined], lines[~joined])
    # the relation is dear, and one whose boxes share no more than a border has no place inside
    inside = joined & (ends.min(axis=1) < bounds[:, 2:]).all(axis=1) & (ends.max(axis=1) > bounds[:, :2]).all(axis=1)
    through[inside] = shapely.relate_pattern(lines[inside], polygons[inside], "T********")
    return through
