"""Is a solid valid? Own checks under the codes of val3dity and the OGC's QIE (ISO 19107).

Knows nothing of how a solid was made: it judges vertices and faces only, sloped or horizontal, so it also
serves to check other programs' models. As in val3dity, a level is judged only when the level below is
sound: rings (1xx), polygons (2xx), the shell (3xx), the solid (4xx).
Source of the codes: https://val3dity.readthedocs.io/en/latest/errors/
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...errors import InputError
from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import SAME_PLACE
from ...wording import say
from .self_intersection import crossing_pairs

NAMES = {
    101: "TOO_FEW_POINTS",
    102: "CONSECUTIVE_POINTS_SAME",
    104: "RING_SELF_INTERSECTION",
    201: "INTERSECTION_RINGS",
    202: "DUPLICATED_RINGS",
    203: "NON_PLANAR_POLYGON_DISTANCE_PLANE",
    204: "NON_PLANAR_POLYGON_NORMALS_DEVIATION",
    205: "POLYGON_INTERIOR_DISCONNECTED",
    206: "INNER_RING_OUTSIDE",
    207: "INNER_RINGS_NESTED",
    208: "ORIENTATION_RINGS_SAME",
    301: "TOO_FEW_POLYGONS",
    302: "SHELL_NOT_CLOSED",
    303: "NON_MANIFOLD_CASE",
    305: "MULTIPLE_CONNECTED_COMPONENTS",
    306: "SHELL_SELF_INTERSECTION",
    307: "POLYGON_WRONG_ORIENTATION",
    405: "WRONG_ORIENTATION_SHELL",
}


class FacedBody(Protocol):
    """What can be checked: vertices (V, 3) in m, and faces as rings of vertex indices, outer ring first."""

    vertices: np.ndarray
    faces: Sequence[Sequence[Sequence[int]]]


@dataclass(frozen=True)
class Problem:
    """One thing wrong: val3dity's code and name, the place (x, y, z in m), and a sentence."""

    code: int
    name: str
    where: tuple[float, float, float]
    text: str


def check_solid(solid: FacedBody, planarity: float = 0.001, snap: float = 0.001,
                normals: float = 20.0) -> tuple[Problem, ...]:
    """Everything wrong with the outer shell of a solid; empty if it is valid.

    Parameters
    ----------
    solid : vertices (V, 3), m, and faces (rings of vertex indices, not closed, outer ring first).
    planarity : largest distance of a point from its face's plane, m (203).
    snap : vertices as near to each other as this (m) count as one.
    normals : largest angle between a face's plane and a triangle of the face, degrees (204).

    Raises
    ------
    InputError : a vertex is not finite, or a face names a vertex that does not exist.
    """
    mesh = _Mesh.of(solid, snap)
    if mesh is None:
        return (Problem(301, NAMES[301], (0.0, 0.0, 0.0), say("The solid has no faces.")),)
    for level in (_ring_problems, _polygon_problems, _shell_problems, _solid_problems):
        problems = level(mesh, planarity, normals)
        if problems:
            return tuple(problems)
    return ()


class _Mesh:
    """A solid's faces as flat arrays; a corner is one vertex's place in one ring."""

    def __init__(self, points: np.ndarray, shift: np.ndarray, vertex: np.ndarray, ring_length: np.ndarray,
                 face_rings: np.ndarray):
        self.points, self.shift, self.vertex = points, shift, vertex
        self.ring_start = np.cumsum(ring_length) - ring_length
        self.ring_of = np.repeat(np.arange(len(ring_length)), ring_length)
        self.next = np.arange(1, len(vertex) + 1)
        self.next[self.ring_start + ring_length - 1] = self.ring_start
        self.first_ring = np.cumsum(face_rings) - face_rings
        self.face_of_ring = np.repeat(np.arange(len(face_rings)), face_rings)
        self.face_of = self.face_of_ring[self.ring_of]
        self.face_count = len(face_rings)

    @classmethod
    def of(cls, solid: FacedBody, snap: float) -> _Mesh | None:
        """Mesh of a solid with near vertices joined, on a local origin; None without faces."""
        rings = [ring for face in solid.faces for ring in face]
        points = np.asarray(solid.vertices, dtype=np.float64).reshape(-1, 3)
        vertex = np.array([v for ring in rings for v in ring], dtype=np.int64)
        if len(vertex) == 0:
            return None
        if vertex.min() < 0 or vertex.max() >= len(points):
            raise InputError(say("A face of the solid names a vertex that does not exist: the model is damaged."))
        if not np.isfinite(points).all():
            raise InputError(say("A vertex of the solid is not a finite number: the model is damaged."))
        shift = points.min(axis=0)
        points = points - shift
        lengths = np.array([len(ring) for ring in rings], dtype=np.int64)
        if (lengths == 0).any() or any(len(face) == 0 for face in solid.faces):
            raise InputError(say("A face of the solid has an empty ring: the model is damaged."))
        return cls(points, shift, _joined(points, snap)[vertex], lengths,
                   np.array([len(face) for face in solid.faces], dtype=np.int64))

    def problem(self, code: int, corner: int, text: str) -> Problem:
        """A problem at the place of a corner."""
        x, y, z = (self.points[self.vertex[corner]] + self.shift).tolist()
        return Problem(code, NAMES[code], (x, y, z), text)

    def in_face(self, code: int, ring: int, text: str) -> Problem:
        """A problem of the face that a ring belongs to."""
        face = self.face_of_ring[ring]
        return self.problem(code, self.ring_start[ring], say("Face {face} {text}.", face=face, text=text))

    def planes(self) -> None:
        """Area vector of each ring and, from the outer ring, unit normal and a point of each face's plane."""
        corner, next_corner = self.points[self.vertex], self.points[self.vertex[self.next]]
        anchor = corner[self.ring_start][self.ring_of]
        self.area_vector = np.add.reduceat(np.cross(corner - anchor, next_corner - anchor), self.ring_start) / 2
        outer = self.area_vector[self.first_ring]
        size = np.linalg.norm(outer, axis=1)
        self.collapsed = size < 1e-9
        self.normal = outer / np.where(self.collapsed, 1.0, size)[:, None]
        total = np.add.reduceat(corner, self.ring_start)[self.first_ring]
        self.centre = total / np.diff(np.append(self.ring_start, len(corner)))[self.first_ring][:, None]

    def project(self) -> None:
        """Faces as flat polygons, seen along the axis nearest to their normals."""
        self.axis = np.abs(self.normal).argmax(axis=1)
        coordinates, ring = self._closed()
        self.rings2d = shapely.linearrings(coordinates, indices=ring)
        self.polygons = shapely.polygons(self.rings2d, indices=self.face_of_ring)

    def _closed(self) -> tuple[np.ndarray, np.ndarray]:
        """Flat coordinates of all rings, each closed, and the ring of each row."""
        place = np.arange(len(self.vertex)) + self.ring_of
        rows = np.empty(len(self.vertex) + len(self.ring_start), dtype=np.int64)
        rows[place] = np.arange(len(self.vertex))
        last = np.append(self.ring_start[1:], len(self.vertex)) + np.arange(len(self.ring_start))
        rows[last] = self.ring_start
        axis = self.axis[self.face_of[rows]]
        points = self.points[self.vertex[rows]]
        row = np.arange(len(rows))
        return np.column_stack([points[row, (axis + 1) % 3], points[row, (axis + 2) % 3]]), self.ring_of[rows]


def _joined(points: np.ndarray, snap: float) -> np.ndarray:
    """For each point the number of the first one that it counts as one with."""
    # As val3dity does, points just `snap` apart count as one, whatever rounding says.
    tree = cKDTree(points) if len(points) > 1 else None
    pairs = tree.query_pairs(snap * (1 + 1e-6), output_type="ndarray") if tree else np.empty((0, 2))
    if not len(pairs):
        return np.arange(len(points))
    _, group = linked_groups(*pairs.T, len(points))
    _, first, inverse = np.unique(group, return_index=True, return_inverse=True)
    return first[inverse.ravel()]


def _ring_problems(mesh: _Mesh, _planarity: float, _normals: float) -> list[Problem]:
    """101, 102, and 104 for a vertex that a ring visits twice."""
    problems = []
    step_nowhere = mesh.vertex == mesh.vertex[mesh.next]
    for corner in np.flatnonzero(step_nowhere):
        problems.append(mesh.problem(102, corner, say("Face {face_of} repeats a point.", face_of=mesh.face_of[corner])))
    order = np.lexsort((mesh.vertex, mesh.ring_of))
    vertex, ring = mesh.vertex[order], mesh.ring_of[order]
    again = np.append(False, (vertex[1:] == vertex[:-1]) & (ring[1:] == ring[:-1]))
    distinct = np.bincount(ring[~again], minlength=len(mesh.ring_start))
    for few in np.flatnonzero(distinct < 3):
        problems.append(mesh.in_face(101, few, say("has a ring of fewer than 3 points")))
    if not problems:
        for corner in order[again]:
            problems.append(mesh.problem(104, corner, say("A ring of face {face_of} visits a point twice.",
                                                          face_of=mesh.face_of[corner])))
    return problems


def _polygon_problems(mesh: _Mesh, planarity: float, normals: float) -> list[Problem]:
    """104, 201 to 208."""
    mesh.planes()
    problems = [mesh.in_face(104, mesh.first_ring[face], say("is collapsed to a line"))
                for face in np.flatnonzero(mesh.collapsed)]
    if problems:
        return problems
    mesh.project()
    for face in np.flatnonzero(~shapely.is_valid(mesh.polygons)):
        problems.append(_invalid_polygon(mesh, face))
    if len(mesh.ring_start) > mesh.face_count:
        same = (mesh.area_vector * mesh.normal[mesh.face_of_ring]).sum(axis=1) > 0
        same[mesh.first_ring] = False
        for ring in np.flatnonzero(same):
            problems.append(mesh.in_face(208, ring, say("has an inner ring that turns like the outer one")))
    off = ((mesh.points[mesh.vertex] - mesh.centre[mesh.face_of]) * mesh.normal[mesh.face_of]).sum(axis=1)
    corners = np.flatnonzero(np.abs(off) > planarity)
    folded = np.unique(mesh.face_of[corners])
    for face in folded:
        corner = corners[mesh.face_of[corners] == face][0]
        problems.append(mesh.problem(203, corner, say("Face {face} has a point {off:.4f} m off its plane.", face=face,
                                                      off=abs(off[corner]))))
    uneven = np.setdiff1d(mesh.face_of[np.abs(off) > SAME_PLACE], folded)
    if not problems:
        problems.extend(_folds(mesh, uneven, normals))
    return problems


def _invalid_polygon(mesh: _Mesh, face: int) -> Problem:
    """What is wrong with one flat polygon."""
    reason = shapely.is_valid_reason(mesh.polygons[face])
    ring = mesh.first_ring[face]
    rings = mesh.rings2d[mesh.face_of_ring == face]
    if not shapely.is_valid(shapely.polygons(rings)).all():
        return mesh.in_face(104, ring, say("has a ring that intersects itself"))
    shapes = shapely.polygons(rings)
    first, second = np.triu_indices(len(rings), 1)
    if shapely.equals(shapes[first], shapes[second]).any():
        return mesh.in_face(202, ring, say("has the same ring twice"))
    if "outside shell" in reason:
        return mesh.in_face(206, ring, say("has an inner ring outside the outer one"))
    if "nested" in reason:
        return mesh.in_face(207, ring, say("has an inner ring within another one"))
    if "disconnected" in reason:
        return mesh.in_face(205, ring, say("falls apart at points where its rings touch"))
    return mesh.in_face(201, ring, say("has rings that intersect"))


def _folds(mesh: _Mesh, faces: np.ndarray, normals: float) -> list[Problem]:
    """204: triangles of a face that lean away from its plane."""
    problems = []
    for face in faces:
        corners = np.flatnonzero(mesh.face_of == face)
        points = mesh.points[mesh.vertex[corners]]
        axis = mesh.axis[face]
        flat = points[:, [(axis + 1) % 3, (axis + 2) % 3]]
        triangles = _flat_triangles(mesh.polygons[face])
        place = cKDTree(flat).query(shapely.get_coordinates(triangles).reshape(-1, 4, 2)[:, :3])[1]
        a, b, c = points[place[:, 0]], points[place[:, 1]], points[place[:, 2]]
        across = np.cross(b - a, c - a)
        cosine = np.abs(across @ mesh.normal[face]) / np.maximum(np.linalg.norm(across, axis=1), 1e-300)
        angle = np.degrees(np.arccos(np.clip(cosine, 0.0, 1.0))).max(initial=0.0)
        if angle > normals:
            problems.append(mesh.in_face(204, mesh.first_ring[face], say("has a fold of {angle:.0f} degrees",
                                                                         angle=angle)))
    return problems


def _flat_triangles(polygon: shapely.Polygon) -> np.ndarray:
    """Triangles of a flat polygon, constrained to its edges where shapely can."""
    if hasattr(shapely, "constrained_delaunay_triangles"):
        return shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    triangles = shapely.get_parts(shapely.delaunay_triangles(polygon))
    return triangles[shapely.contains_properly(polygon, shapely.centroid(triangles))]


def _shell_problems(mesh: _Mesh, _planarity: float, _normals: float) -> list[Problem]:
    """301 to 307."""
    if mesh.face_count < 4:
        return [mesh.problem(301, 0, say("The shell has {face_count} faces: the least is 4.",
                                         face_count=mesh.face_count))]
    start, end = mesh.vertex, mesh.vertex[mesh.next]
    low, high = np.minimum(start, end), np.maximum(start, end)
    _, first, edge, uses = np.unique(low * len(mesh.points) + high, return_index=True, return_inverse=True,
                                     return_counts=True)
    problems = [mesh.problem(302, first[e], say("An edge belongs to one face only: the shell has a hole."))
                for e in np.flatnonzero(uses == 1)]
    problems += [mesh.problem(303, first[e], say("{uses} faces meet in one edge.",
                                                 uses=uses[e])) for e in np.flatnonzero(uses > 2)]
    if problems:
        return problems
    one, two = np.argsort(edge.ravel(), kind="stable").reshape(-1, 2).T
    problems = _umbrellas(mesh, one, two) or _components(mesh, one, two)
    if problems:
        return problems
    for corner in one[start[one] == start[two]]:
        problems.append(mesh.problem(307, corner, say("Face {face_of} and its neighbour turn opposite ways at their "
                                                      "edge.", face_of=mesh.face_of[corner])))
    vertices = np.column_stack([start[one], end[one]])
    owners = np.column_stack([mesh.face_of[one], mesh.face_of[two]])
    for e, face in crossing_pairs(mesh.points, vertices, owners, mesh.vertex, mesh.face_of, mesh.polygons,
                                  mesh.normal, mesh.centre, mesh.axis):
        problems.append(mesh.problem(306, one[e], say("An edge of face {owners} runs into face {face}.",
                                                      owners=owners[e, 0], face=face)))
    return problems


def _umbrellas(mesh: _Mesh, one: np.ndarray, two: np.ndarray) -> list[Problem]:
    """303: the faces at a vertex do not form one closed fan. `one`, `two`: the two half edges of each edge."""
    # Linked are the ends of half edges: number h leaves the vertex of corner h, number h + n arrives there.
    n = len(mesh.vertex)
    after_one, after_two = mesh.next[one] + n, mesh.next[two] + n
    along = mesh.vertex[one] == mesh.vertex[two]
    links = (np.concatenate([np.arange(n), one, after_one]),
             np.concatenate([_arriving_beside(mesh) + n, np.where(along, two, after_two),
                             np.where(along, after_two, two)]))
    _, fan = linked_groups(*links, 2 * n)
    _, corner = np.unique(fan[:n], return_index=True)
    fans = np.bincount(mesh.vertex[corner], minlength=len(mesh.points))
    return [mesh.problem(303, np.flatnonzero(mesh.vertex == v)[0], say("Faces touch each other only in this point."))
            for v in np.flatnonzero(fans > 1)]


def _arriving_beside(mesh: _Mesh) -> np.ndarray:
    """For each corner the corner whose arriving edge bounds the same piece of the face's inside.

    That is the corner itself, but where two rings of a face touch in a vertex.
    """
    beside = np.arange(len(mesh.vertex))
    if len(mesh.ring_start) == mesh.face_count:
        return beside
    before = np.empty_like(beside)
    before[mesh.next] = beside
    _, place, times = np.unique(mesh.face_of * len(mesh.points) + mesh.vertex, return_inverse=True,
                                return_counts=True)
    for touching in np.flatnonzero(times > 1):
        corners = np.flatnonzero(place.ravel() == touching)
        face = mesh.face_of[corners[0]]
        leaving = _directions(mesh, face, corners, mesh.next[corners])
        arriving = _directions(mesh, face, corners, before[corners])
        turn = (arriving[None, :] - leaving[:, None]) % (2 * np.pi)
        beside[corners] = corners[turn.argmin(axis=1)]
    return beside


def _directions(mesh: _Mesh, face: int, corners: np.ndarray, towards: np.ndarray) -> np.ndarray:
    """Directions from corners to others in a face's plane, radians counterclockwise seen from outside."""
    axis, sign = mesh.axis[face], np.sign(mesh.normal[face, mesh.axis[face]])
    ray = mesh.points[mesh.vertex[towards]] - mesh.points[mesh.vertex[corners]]
    return np.arctan2(sign * ray[:, (axis + 2) % 3], ray[:, (axis + 1) % 3])


def _components(mesh: _Mesh, one: np.ndarray, two: np.ndarray) -> list[Problem]:
    """305: faces that do not hang together."""
    count, group = linked_groups(mesh.face_of[one], mesh.face_of[two], mesh.face_count)
    _, face = np.unique(group, return_index=True)
    return [mesh.in_face(305, mesh.first_ring[f], say("and others are not connected to the rest of the shell"))
            for f in face[1:count]]


def _solid_problems(mesh: _Mesh, _planarity: float, _normals: float) -> list[Problem]:
    """405: the shell as a whole faces inwards."""
    point = mesh.points[mesh.vertex[mesh.ring_start]]
    volume = (mesh.area_vector * point).sum() / 3
    return [] if volume > 0 else [mesh.problem(405, 0, say("The faces look inwards."))]
