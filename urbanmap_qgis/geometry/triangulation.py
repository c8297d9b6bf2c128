"""Triangles of a flat face with holes, on the face's own vertices."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely.errors import GEOSException

from .ring_products import cross_with_next

Triangle = tuple[int, int, int]
_CROSSING = "The face cannot be cut into triangles: its rings cross each other."


def triangulate_face(vertices: np.ndarray, face: Sequence[Sequence[int]]) -> list[Triangle]:
    """Cut a planar face into triangles that turn as the face does and use only its vertices.

    Parameters
    ----------
    vertices : (V, 3) coordinates of the solid.
    face : rings of vertex indices, not closed, outer ring first, holes turning the other way.

    Raises
    ------
    ValueError : its rings cross each other.
    """
    if len(face) == 1 and len(face[0]) == 3:
        a, b, c = face[0]
        return [(a, b, c)]
    points = np.asarray(vertices)[[vertex for ring in face for vertex in ring]]
    points = points - points.min(axis=0)
    outer = points[:len(face[0])]
    normal = cross_with_next(outer).sum(axis=0)
    axis = int(np.abs(normal).argmax())
    flat = points[:, [(axis + 1) % 3, (axis + 2) % 3]] * (1.0, np.sign(normal[axis]))
    names = [vertex for ring in face for vertex in ring]
    place = {vertex: (float(x), float(y)) for vertex, (x, y) in zip(names, flat)}
    if hasattr(shapely, "constrained_delaunay_triangles"):
        return _delaunay(place, face)
    return clip_ears(place, face)


def _delaunay(place: dict[int, tuple[float, float]], face: Sequence[Sequence[int]]) -> list[Triangle]:
    """Constrained Delaunay triangles, counterclockwise, each from its lowest vertex, in order."""
    polygon = shapely.Polygon([place[v] for v in face[0]], [[place[v] for v in ring] for ring in face[1:]])
    name = {point: vertex for vertex, point in place.items()}
    try:
        cut = shapely.constrained_delaunay_triangles(polygon)
    except GEOSException as error:
        raise ValueError(_CROSSING) from error
    corners = shapely.get_coordinates(cut).reshape(-1, 4, 2)
    triangles = []
    for a, b, c in corners[:, :3].tolist():
        triangle = [name[tuple(a)], name[tuple(b)], name[tuple(c)]]
        if _turn(tuple(a), tuple(b), tuple(c)) < 0:
            triangle.reverse()
        first = triangle.index(min(triangle))
        triangles.append(tuple(triangle[first:] + triangle[:first]))
    return sorted(triangles)


def clip_ears(place: dict[int, tuple[float, float]], face: Sequence[Sequence[int]]) -> list[Triangle]:
    """Triangles by cutting ears, for a shapely without constrained triangles.

    Parameters
    ----------
    place : x and y of each vertex, the outer ring counterclockwise.
    face : rings of vertices, outer ring first.
    """
    ring = _bridged(place, face)
    triangles = []
    while len(ring) > 2:
        ear = next((i for i in range(len(ring)) if _is_ear(place, ring, i)), None)
        if ear is None:
            raise ValueError(_CROSSING)
        triangles.append((ring[ear - 1], ring[ear], ring[(ear + 1) % len(ring)]))
        del ring[ear]
    return triangles


def _turn(a, b, c) -> float:
    """Twice the signed area of a triangle: positive if it turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_ear(place, ring: list[int], i: int) -> bool:
    """Whether the triangle at a ring's place lies inside, with no other vertex in it or on its cut."""
    names = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
    a, b, c = (place[name] for name in names)
    if _turn(a, b, c) <= 0:
        return False
    for other in ring:
        p = place[other]
        if p in (a, b, c):
            continue
        if _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0:
            return False
    return True


def _bridged(place, face: Sequence[Sequence[int]]) -> list[int]:
    """One ring through all rings: holes that touch it join it there, the others by an edge to what they see."""
    ring = list(face[0])
    waiting = [list(hole) for hole in face[1:]]
    while waiting:
        waiting.sort(key=lambda hole: (not set(ring).isdisjoint(hole), max(place[v] for v in hole)))
        hole = waiting.pop()
        common = [i for i, vertex in enumerate(hole) if vertex in ring]
        start = common[0] if common else max(range(len(hole)), key=lambda i: place[hole[i]])
        turned = hole[start:] + hole[:start]
        if common:
            at = next(i for i, vertex in enumerate(ring)
                      if vertex == turned[0] and _in_corner(place, ring, i, place[turned[1]]))
            ring[at + 1:at + 1] = [*turned[1:], turned[0]]
        else:
            at = _visible(place, ring, turned[0], [ring, turned, *waiting])
            ring[at + 1:at + 1] = [*turned, turned[0], ring[at]]
    return ring


def _visible(place, ring: list[int], vertex: int, rings: list[list[int]]) -> int:
    """Place in the ring of the nearest vertex that can be joined to `vertex` without crossing an edge."""
    p = place[vertex]

    def distance(i: int) -> float:
        q = place[ring[i]]
        return (q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2

    edges = [(place[a], place[b]) for r in rings for a, b in zip(r, [*r[1:], r[0]])]
    for i in sorted(range(len(ring)), key=distance):
        q = place[ring[i]]
        if _in_corner(place, ring, i, p) and not any(_cross(p, q, a, b) for a, b in edges):
            return i
    raise ValueError("The face's rings cross each other.")


def _in_corner(place, ring: list[int], i: int, p) -> bool:
    """Whether a point lies in the inside angle of a ring's corner."""
    a, q, b = place[ring[i - 1]], place[ring[i]], place[ring[(i + 1) % len(ring)]]
    before, after = _turn(a, q, p) > 0, _turn(q, b, p) > 0
    return (before and after) if _turn(a, q, b) > 0 else (before or after)


def _cross(p, q, a, b) -> bool:
    """Whether the segment pq meets ab elsewhere than in a common end."""
    if p in (a, b) or q in (a, b):
        return False
    return (_turn(p, q, a) > 0) != (_turn(p, q, b) > 0) and (_turn(a, b, p) > 0) != (_turn(a, b, q) > 0)
