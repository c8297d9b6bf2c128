"""Solids read back from the faces of a layer's MultiPolygonZ, as `solid.multipolygon` writes them."""

from __future__ import annotations

import numpy as np
import shapely

from .linked_groups import linked_groups
from .polygon_rings import polygon_rings
from .ring_products import cross_with_next
from .solid import GROUND, OUTER_WALL, ROOF, Face, Solid
from .tolerances import MILLIMETRE

_UPRIGHT = 0.1
"""Faces whose normal's vertical part is smaller are walls."""


def solids_of(faces: shapely.Geometry) -> list[Solid]:
    """The solids of a building from its faces: those that hang together by edges make one.

    Faces are told by their normals: roofs look up, walls to the side, the ground down. Whether a solid is closed
    is for `validity` to say.

    Parameters
    ----------
    faces : MultiPolygon with z of all faces, counterclockwise seen from outside.
    """
    polygons = shapely.get_parts(faces)
    vertices, faces_of_all = _indexed(polygons)
    if not faces_of_all:
        return []
    normals = np.array([face_normal(vertices, face) for face in faces_of_all])
    group = _groups(faces_of_all)
    return [_solid(vertices, [faces_of_all[face] for face in np.flatnonzero(group == number)],
                   normals[group == number]) for number in range(group.max() + 1)]


def face_normal(vertices: np.ndarray, face: Face) -> np.ndarray:
    """Unit normal (3,) of a face by its outer ring (Newell); zeros where it has no area."""
    ring = vertices[list(face[0])] - vertices[face[0][0]]
    normal = cross_with_next(ring).sum(axis=0)
    length = np.linalg.norm(normal)
    return normal / length if length > 0 else normal


def area_vector(vertices: np.ndarray, face: Face) -> np.ndarray:
    """Vector (3,) along the normal of a plane face with holes, as long as the face's area (Newell)."""
    total = np.zeros(3)
    for ring in face:
        x, y, z = (vertices[list(ring)] - vertices[face[0][0]]).T
        x_next, y_next, z_next = (values[[*range(1, len(values)), 0]] for values in (x, y, z))
        total += (y @ z_next - z @ y_next, z @ x_next - x @ z_next, x @ y_next - y @ x_next)
    return total / 2.0


def _indexed(polygons: np.ndarray) -> tuple[np.ndarray, list[Face]]:
    """Shared vertices (V, 3) and the faces as rings of their numbers."""
    rings, owner = polygon_rings(polygons)
    coordinates, ring_of = shapely.get_coordinates(rings, include_z=True, return_index=True)
    if not len(coordinates):
        return np.empty((0, 3)), []
    corner = coordinates.min(axis=0)
    _, first, number = np.unique(np.rint((coordinates - corner) / MILLIMETRE).astype(np.int64), axis=0,
                                 return_index=True, return_inverse=True)
    number = number.ravel()
    faces: list[list[tuple[int, ...]]] = [[] for _ in polygons]
    ends = np.searchsorted(ring_of, np.arange(len(rings) + 1))
    for ring, (start, end) in enumerate(zip(ends[:-1], ends[1:])):
        loop = number[start:end - 1]
        loop = loop[loop != np.roll(loop, 1)]
        if len(loop) > 2:
            faces[owner[ring]].append(tuple(loop.tolist()))
    return coordinates[first], [tuple(face) for face in faces if face]


def _groups(faces: list[Face]) -> np.ndarray:
    """Number (F,) of the connected group of each face: faces that share an edge belong together."""
    edges = [(min(pair), max(pair), face) for face, rings in enumerate(faces) for ring in rings
             for pair in zip(ring, (*ring[1:], ring[0]))]
    table = np.array(edges)
    _, edge = np.unique(table[:, :2], axis=0, return_inverse=True)
    group = linked_groups(table[:, 2], len(faces) + edge.ravel(), len(faces) + int(edge.max()) + 1)[1][:len(faces)]
    return np.unique(group, return_inverse=True)[1]


def _solid(vertices: np.ndarray, faces: list[Face], normals: np.ndarray) -> Solid:
    """A solid on its own vertices."""
    used = np.unique([vertex for face in faces for ring in face for vertex in ring])
    renumbered = [tuple(tuple(np.searchsorted(used, ring).tolist()) for ring in face) for face in faces]
    kinds = [OUTER_WALL if abs(z) < _UPRIGHT else ROOF if z > 0 else GROUND for z in normals[:, 2]]
    return Solid(vertices[used], tuple(renumbered), tuple(kinds), (None,) * len(renumbered))
