"""Buildings, furniture and vehicles as flat convex faces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
import shapely

from .ground import Ground
from .model import COLOUR, Building, FaceKind, Faces, Furniture, Material, RoofPart, Vehicle

TOUCH = 1e-4
"""Walls closer than this lie on one another, m."""

_BOX = np.array([[4, 7, 3, 0], [2, 6, 5, 1], [1, 5, 4, 0], [7, 6, 2, 3], [5, 6, 7, 4]])
"""Corners of the faces of a box (back, front, right, left, top); corner 4k.. counts right-left, back-front."""


@dataclass(frozen=True)
class Boxes:
    """Upright boxes of vehicles, two a vehicle.

    Attributes
    ----------
    x, y, z : (n,) middle of the vehicle on the ground.
    heading : (n,) degrees clockwise from grid north.
    low, high : (n, 3) reach forward, left and up, m.
    colour : (n, 3) uint8.
    vehicle : (n,) number in the list of vehicles that was asked for.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    heading: np.ndarray
    low: np.ndarray
    high: np.ndarray
    colour: np.ndarray
    vehicle: np.ndarray

    def __len__(self) -> int:
        return len(self.x)

    def faces(self) -> Faces:
        """Their sides and tops."""
        return box_faces(self)


def join(parts: Sequence[Faces]) -> Faces:
    """All faces of the parts, in order."""
    return Faces(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(Faces)))


class FaceList:
    """Collects faces one after another."""

    def __init__(self):
        self._rows: list[tuple] = []

    def add(self, corners: np.ndarray, material: Material, kind: FaceKind, colour=None, building=-1, part=-1) -> None:
        """Add a face given by three or four corners (k, 3)."""
        corners = np.asarray(corners, float)
        if len(corners) == 3:
            corners = corners[[0, 1, 2, 2]]
        self._rows.append((corners, int(material), int(kind),
                           COLOUR[material] if colour is None else colour, building, part))

    def add_prism(self, ring: np.ndarray, low, high, material: Material, kind: FaceKind, colour=None,
                  building=-1, part=-1, bottom: bool = False) -> None:
        """Add the sides and the top (and the bottom) over an anticlockwise ring (n, 2); heights are numbers or (n,)."""
        low, high = (np.broadcast_to(np.asarray(z, float), len(ring)) for z in (low, high))
        for i in range(len(ring)):
            j = (i + 1) % len(ring)
            self.add([[*ring[i], low[i]], [*ring[j], low[j]], [*ring[j], high[j]], [*ring[i], high[i]]],
                     material, kind, colour, building, part)
        for piece in convex_pieces(ring):
            self.add(np.column_stack([ring[piece], high[piece]]), material, kind, colour, building, part)
            if bottom:
                self.add(np.column_stack([ring[piece], low[piece]])[::-1], material, kind, colour, building, part)

    def faces(self) -> Faces:
        """The faces as arrays."""
        if not self._rows:
            empty = np.zeros(0)
            return Faces(np.zeros((0, 4, 3)), np.zeros((0, 3)), empty, empty.astype(np.uint8), empty.astype(np.uint8),
                         np.zeros((0, 3), np.uint8), empty.astype(np.int32), empty.astype(np.int32))
        corners, material, kind, colour, building, part = zip(*self._rows)
        corners = np.stack(corners)
        return Faces(corners, *planes(corners), np.array(material, np.uint8), np.array(kind, np.uint8),
                     np.array(colour, np.uint8), np.array(building, np.int32), np.array(part, np.int32))


def planes(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals (n, 3) and offsets (n,) of faces (n, 4, 3)."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return normal, np.einsum("ij,ij->i", normal, corners.mean(axis=1))


def ring_of(plan: shapely.Polygon) -> np.ndarray:
    """Corners (n, 2) of a plan without holes, anticlockwise, the first not repeated."""
    ring = shapely.get_coordinates(plan.exterior)[:-1]
    return ring if plan.exterior.is_ccw else ring[::-1]


def inset(ring: np.ndarray, width: float) -> np.ndarray:
    """The anticlockwise ring (n, 2) with each edge moved inwards by `width`, corner for corner."""
    edge = np.roll(ring, -1, axis=0) - ring
    inward = np.column_stack([-edge[:, 1], edge[:, 0]]) / np.linalg.norm(edge, axis=1, keepdims=True)
    before = np.roll(inward, 1, axis=0)
    return ring + width * (before + inward) / (1 + np.einsum("ij,ij->i", before, inward))[:, None]


def convex_pieces(ring: np.ndarray) -> list[list[int]]:
    """An anticlockwise ring without holes cut into triangles, or one quadrilateral, as corner numbers."""
    left = list(range(len(ring)))
    if len(left) == 4 and all(_turn(ring, i, (i + 1) % 4, (i + 2) % 4) > 0 for i in range(4)):
        return [left]
    pieces = []
    while len(left) > 3:
        ears = [k for k in range(len(left)) if _is_ear(ring, left, k)]
        best = max(ears, key=lambda k: _turn(ring, left[k - 1], left[k], left[(k + 1) % len(left)]))
        pieces.append([left[best - 1], left[best], left[(best + 1) % len(left)]])
        del left[best]
    return [*pieces, left]


def _turn(ring: np.ndarray, a: int, b: int, c: int) -> float:
    (ax, ay), (bx, by), (cx, cy) = ring[a], ring[b], ring[c]
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def _is_ear(ring: np.ndarray, left: list[int], k: int) -> bool:
    a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
    if _turn(ring, a, b, c) <= 1e-9:
        return False
    triangle = np.array([a, b, c])
    others = np.array([i for i in left if i not in (a, b, c)], np.intp)
    inside = np.ones(len(others), bool)
    for p, q in zip(ring[triangle], ring[np.roll(triangle, -1)]):
        inside &= (q[0] - p[0]) * (ring[others, 1] - p[1]) - (q[1] - p[1]) * (ring[others, 0] - p[0]) >= -1e-9
    return not inside.any()


def building_faces(buildings: Sequence[Building]) -> Faces:
    """Walls, roofs, parapets and roof structures. A wall reaches down to the ground or to the roof it stands on."""
    faces = FaceList()
    edges = _Edges(buildings)
    for building in buildings:
        for number, part in enumerate(building.parts):
            ring = ring_of(part.plan)
            for i in range(len(ring)):
                _add_wall(faces, edges, building, number, part, ring[i], ring[(i + 1) % len(ring)])
            if part.z_ridge is None:
                _add_flat_roof(faces, building, number, part, ring)
            else:
                _add_gable(faces, building, number, part, ring)
    return faces.faces()


class _Edges:
    """The wall lines of all parts, to find those that touch a wall."""

    def __init__(self, buildings: Sequence[Building]):
        self.owner, self.top, lines = [], [], []
        for building in buildings:
            for number, part in enumerate(building.parts):
                ring = ring_of(part.plan)
                for i in range(len(ring)):
                    lines.append([ring[i], ring[(i + 1) % len(ring)]])
                    self.owner.append((building.id, number))
                    self.top.append(part.z_top)
        self.ends = np.array(lines).reshape(-1, 2, 2)
        self.tree = shapely.STRtree(shapely.linestrings(self.ends))

    def along(self, start: np.ndarray, end: np.ndarray, owner: tuple[int, int]) -> list[tuple[float, float, float]]:
        """(from, to, top) of other parts' walls that lie on the wall; from and to in metres from its start."""
        direction = end - start
        length = float(np.hypot(*direction))
        direction = direction / length
        touching = []
        for number in self.tree.query(shapely.LineString([start, end]), predicate="dwithin", distance=TOUCH):
            offset = self.ends[number] - start
            across = np.abs(offset[:, 0] * direction[1] - offset[:, 1] * direction[0])
            reach = np.sort(offset @ direction)
            if self.owner[number] != owner and across.max() < TOUCH and reach[1] > TOUCH and reach[0] < length - TOUCH:
                touching.append((max(reach[0], 0.0), min(reach[1], length), self.top[number]))
        return touching


def _add_wall(faces: FaceList, edges: _Edges, building: Building, number: int, part: RoofPart,
              start: np.ndarray, end: np.ndarray) -> None:
    length = float(np.hypot(*(end - start)))
    touching = edges.along(start, end, (building.id, number))
    cuts = np.unique(np.round([0.0, length, *(cut for low, high, _ in touching for cut in (low, high))], 4))
    cuts[-1] = length
    for low, high in zip(cuts[:-1], cuts[1:]):
        middle = (low + high) / 2
        foot = max([building.z_base, *(top for a, b, top in touching if a < middle < b)])
        if foot >= part.z_top or high - low < TOUCH:
            continue
        p, q = start + (end - start) * low / length, start + (end - start) * high / length
        faces.add([[*p, foot], [*q, foot], [*q, part.z_top], [*p, part.z_top]],
                  Material.FACADE, FaceKind.WALL, building.wall_colour, building.id, number)


def _add_flat_roof(faces: FaceList, building: Building, number: int, part: RoofPart, ring: np.ndarray) -> None:
    owner = {"building": building.id, "part": number}
    inner = ring
    if part.parapet_height:
        inner = inset(ring, part.parapet_width)
        for i in range(len(ring)):
            j = (i + 1) % len(ring)
            a, b, c, d = ring[i], ring[j], inner[j], inner[i]
            faces.add([[*p, part.z_top] for p in (a, b, c, d)], Material.PARAPET, FaceKind.PARAPET_TOP, **owner)
            faces.add([[*c, part.z_roof], [*d, part.z_roof], [*d, part.z_top], [*c, part.z_top]],
                      Material.PARAPET, FaceKind.PARAPET_INSIDE, **owner)
    for piece in convex_pieces(inner):
        faces.add(np.column_stack([inner[piece], np.full(len(piece), part.z_roof)]),
                  Material.ROOF, FaceKind.ROOF, building.roof_colour, **owner)
    for structure in part.structures:
        faces.add_prism(ring_of(structure.plan), part.z_roof, part.z_roof + structure.height,
                        Material.STRUCTURE, FaceKind.STRUCTURE, None, **owner)


def _add_gable(faces: FaceList, building: Building, number: int, part: RoofPart, ring: np.ndarray) -> None:
    owner = {"building": building.id, "part": number}
    if np.hypot(*(ring[1] - ring[0])) < np.hypot(*(ring[2] - ring[1])):
        ring = np.roll(ring, -1, axis=0)
    a, b, c, d = (np.array([*p, part.z_roof]) for p in ring)
    ridge_d, ridge_b = ((p + q) / 2 + (0, 0, part.z_ridge - part.z_roof) for p, q in ((d, a), (b, c)))
    for slope in ([a, b, ridge_b, ridge_d], [c, d, ridge_d, ridge_b]):
        faces.add(slope, Material.ROOF, FaceKind.ROOF, building.roof_colour, **owner)
    for gable in ([b, c, ridge_b], [d, a, ridge_d]):
        faces.add(gable, Material.FACADE, FaceKind.WALL, building.wall_colour, **owner)


def furniture_faces(furniture: Sequence[Furniture]) -> Faces:
    """Boxes of the street's furniture; those of a bridge and before fronts with their bottom."""
    faces = FaceList()
    for thing in furniture:
        ring = ring_of(thing.plan)
        tilt = (ring - ring.mean(axis=0)) @ np.array(thing.slope)
        faces.add_prism(ring, thing.z_low + tilt, thing.z_high + tilt, thing.material, thing.kind,
                        bottom=thing.kind in (FaceKind.BRIDGE, FaceKind.FRONT))
    return faces.faces()


def vehicle_boxes(vehicles: Sequence[Vehicle], time: float, ground: Ground) -> Boxes:
    """Boxes of the vehicles where they are at the time."""
    x, y = (np.array([vehicle.position(time)[axis] for vehicle in vehicles], float) for axis in (0, 1))
    boxes = np.array([vehicle.boxes() for vehicle in vehicles]).reshape(-1, 2, 3)
    twice = np.repeat(np.arange(len(vehicles)), 2)
    heading = np.array([vehicle.lane.heading for vehicle in vehicles], float)
    colour = np.array([vehicle.colour for vehicle in vehicles], np.uint8).reshape(-1, 3)
    z = ground.height(x, y)
    return Boxes(x[twice], y[twice], z[twice], heading[twice], boxes[:, 0], boxes[:, 1], colour[twice], twice)


def box_faces(boxes: Boxes) -> Faces:
    """Back, front, right and left sides and tops of vehicles' boxes."""
    if not len(boxes):
        return FaceList().faces()
    low, high = boxes.low, boxes.high
    forward = np.stack([low[:, 0], high[:, 0], high[:, 0], low[:, 0]] * 2, axis=1)
    left = np.stack([low[:, 1], low[:, 1], high[:, 1], high[:, 1]] * 2, axis=1)
    up = np.stack([low[:, 2]] * 4 + [high[:, 2]] * 4, axis=1)
    sin, cos = np.sin(np.radians(boxes.heading))[:, None], np.cos(np.radians(boxes.heading))[:, None]
    corners = np.stack([boxes.x[:, None] + sin * forward - cos * left,
                        boxes.y[:, None] + cos * forward + sin * left, boxes.z[:, None] + up], axis=2)
    corners = corners[:, _BOX].reshape(-1, 4, 3)
    n, each = len(corners), len(_BOX)
    return Faces(corners, *planes(corners), np.full(n, Material.VEHICLE, np.uint8),
                 np.full(n, FaceKind.VEHICLE, np.uint8), np.repeat(boxes.colour, each, axis=0),
                 np.full(n, -1, np.int32), np.full(n, -1, np.int32))
