"""Building models as they are delivered: blocks whose walls stand about a metre off, wall by wall (J 5.6).

A roof-based model has its walls where the parapets are. All walls of a building on one line move together, and so
do the facets of a curved wall; corners are where the moved lines meet, so that the parts of a building stay valid
polygons that touch without gaps. Walls that touch a neighbour stay; those close to one move inwards only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..scene.faces import ring_of
from ..scene.model import Building, FaceKind, Faces, RoofPart

OFFSET = (0.7, 1.3)  # Minimum and maximum displacement, m.
# Share of the walls that stand where they are, and of the others that are moved outwards.
UNMOVED = 0.12
OUTWARDS = 0.75
CLOSE = 3.0  # A wall with a neighbour in front of it within this distance is moved inwards, m.
TOUCHING = 0.05
MIN_EDGE = 0.1  # Length that is left at least of a wall whose neighbours are moved, m.
ON_LINE = 2e-3

SMOOTH = np.radians(30.0)
"""Walls that meet at a flatter angle are facets of one curved wall."""


@dataclass(frozen=True)
class DisplacedWall:
    """A wall of a part of a building.

    Attributes
    ----------
    number : from 1.
    building : id.
    part : number of the part.
    true, delivered : (2, 2) its ends in plan, anticlockwise around the part.
    normal : (2,) outwards.
    offset : m along the normal from the delivered wall to the true one.
    z_low, z_top : heights between which it is free to the air; both NaN within a building or against a neighbour.
    """

    number: int
    building: int
    part: int
    true: np.ndarray
    delivered: np.ndarray
    normal: np.ndarray
    offset: float
    z_low: float
    z_top: float


@dataclass(frozen=True)
class Block:
    """A delivered model of a part of a building: its plan and heights."""

    building: int
    part: int
    plan: shapely.Polygon
    z_base: float
    z_top: float


def deliver(buildings: tuple[Building, ...], faces: Faces,
            rng: np.random.Generator) -> tuple[list[Block], list[DisplacedWall], np.ndarray]:
    """Models with displaced walls.

    Returns the blocks, all walls, and for each of the true `faces` the number of its wall (0 for other faces).
    """
    blocks, walls = [], []
    lookup = np.zeros(len(faces), np.int64)
    outlines = [shapely.union_all([part.plan for part in building.parts]) for building in buildings]
    tree = shapely.STRtree(outlines)
    for index, building in enumerate(buildings):
        near = [outlines[other] for other in tree.query(outlines[index], predicate="dwithin", distance=2 * CLOSE)
                if other != index]
        lines = _Lines(building, shapely.union_all(near) if near else shapely.Polygon(), rng)
        rings = [np.round(lines.delivered(number), 3) for number in range(len(building.parts))]
        for number, part in enumerate(building.parts):
            plan = shapely.Polygon(_with_corners_of(np.vstack(rings), rings[number]))
            blocks.append(Block(building.id, number, plan, building.z_base, block_top(part)))
            walls += _walls(building, number, lines, rings[number], faces, lookup, len(walls))
    return blocks, walls, lookup


def block_top(part: RoofPart) -> float:
    """Height of the block that stands for a part: its parapet, or halfway up the gable, m."""
    return part.z_top if part.z_ridge is None else (part.z_roof + part.z_ridge) / 2


class _Lines:
    """The wall lines of a building and how far each of them is moved.

    `normal` (k, 2), `at` (k,) with normal . point = at on the line; `shift` (k,) along that normal; `rings` the true
    corners of each part, `line` the line of each of its edges.
    """

    def __init__(self, building: Building, near: shapely.Geometry, rng: np.random.Generator):
        self.rings = [ring_of(part.plan) for part in building.parts]
        self.normal, self.at, self.line = np.zeros((0, 2)), np.zeros(0), []
        self._outline = shapely.union_all([part.plan for part in building.parts])
        for ring in self.rings:
            self.line.append(np.array([self._number(ring[i], ring[(i + 1) % len(ring)]) for i in range(len(ring))]))
        self._facing = self._facings()
        self.shift = self._shifts(near, rng)
        self._restore_invalid_parts()

    def edges(self, part: int) -> tuple[np.ndarray, np.ndarray]:
        """Ends (n, 2, 2) and outward normals (n, 2) of the true edges of a part."""
        ring = self.rings[part]
        ends = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
        edge = ends[:, 1] - ends[:, 0]
        return ends, np.column_stack([edge[:, 1], -edge[:, 0]]) / np.linalg.norm(edge, axis=1, keepdims=True)

    def delivered(self, part: int) -> np.ndarray:
        """Corners (n, 2) of a part with its lines moved; corner i begins edge i."""
        return np.array([self._corner(before, after, corner) for before, after, corner in zip(
            np.roll(self.line[part], 1), self.line[part], self.rings[part])])

    def outward_shift(self, part: int) -> np.ndarray:
        """(n,) by how much each edge of a part is moved along its own outward normal, m."""
        _, normal = self.edges(part)
        line = self.line[part]
        return self.shift[line] * np.sign(np.einsum("ij,ij->i", normal, self.normal[line]))

    def _number(self, start: np.ndarray, end: np.ndarray) -> int:
        edge = end - start
        normal = np.array([edge[1], -edge[0]]) / np.hypot(*edge)
        off = np.maximum(np.abs(self.normal @ start - self.at), np.abs(self.normal @ end - self.at))
        known = np.flatnonzero(off < ON_LINE)
        if len(known):
            return int(known[0])
        self.normal = np.vstack([self.normal, normal])
        self.at = np.append(self.at, normal @ (start + end) / 2)
        return len(self.at) - 1

    def _corner(self, before: int, after: int, corner: np.ndarray) -> np.ndarray:
        pair = [before, after]
        matrix, at = self.normal[pair], self.at[pair] + self.shift[pair]
        if abs(np.linalg.det(matrix)) < 1e-3:
            return corner + self.shift[before] * self.normal[before]
        return np.linalg.solve(matrix, at)

    def _facings(self) -> np.ndarray:
        """(k,) length of each line's edges on the building's outline: positive where the line's normal points
        outwards there, negative where it points inwards, 0 for a line within the building."""
        facing = np.zeros(len(self.at))
        for part in range(len(self.rings)):
            ends, normal = self.edges(part)
            sense = np.sign(np.einsum("ij,ij->i", normal, self.normal[self.line[part]]))
            length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            np.add.at(facing, self.line[part], sense * length * self._on_outline(ends, normal))
        return facing

    def _shifts(self, near: shapely.Geometry, rng: np.random.Generator) -> np.ndarray:
        count = len(self.at)
        size = rng.uniform(*OFFSET, count)
        moved, outwards = rng.random(count) >= UNMOVED, rng.random(count) < OUTWARDS
        stays, inwards = np.zeros(count, bool), np.zeros(count, bool)
        surface = np.arange(count)
        for part in range(len(self.rings)):
            ends, normal = self.edges(part)
            line = self.line[part]
            room = self._room(ends, normal, near)
            stays[line[room < TOUCHING]] = True
            inwards[line[room < CLOSE]] = True
            bend = np.einsum("ij,ij->i", normal, np.roll(normal, 1, axis=0))
            for i in np.flatnonzero(bend > np.cos(SMOOTH)):
                surface[surface == surface[line[i]]] = surface[line[i - 1]]
        signed = size * moved * np.where(outwards & ~inwards, 1.0, -1.0) * np.where(self._facing < 0, -1.0, 1.0)
        signed = np.where(stays, 0.0, signed)
        return signed[surface]

    def _restore_invalid_parts(self) -> None:
        """Leave walls of thin parts where they are if moving them would invert the part: inner walls first."""
        for stay in (self._facing == 0, np.ones(len(self.at), bool)):
            for _ in self.rings:
                for part in range(len(self.rings)):
                    if not self._is_sound(part):
                        line = self.line[part]
                        self.shift[line[stay[line]]] = 0.0

    def _is_sound(self, part: int) -> bool:
        """Whether a moved part is valid, each of its edges still runs its way and half of its area is left."""
        moved, ring = self.delivered(part), self.rings[part]
        edge, true_edge = np.roll(moved, -1, axis=0) - moved, np.roll(ring, -1, axis=0) - ring
        along = np.einsum("ij,ij->i", edge, true_edge) / np.linalg.norm(true_edge, axis=1)
        plan = shapely.Polygon(moved)
        return bool(along.min() > MIN_EDGE and plan.is_valid and plan.area > 0.5 * shapely.Polygon(ring).area)

    def _room(self, ends: np.ndarray, normal: np.ndarray, near: shapely.Geometry) -> np.ndarray:
        """(n,) distance from each edge to the neighbours in front of it, without what is just beside its ends."""
        middle = ends.mean(axis=1, keepdims=True)
        ahead = middle + (ends - middle) * 0.98
        fronts = np.concatenate([ahead, (ahead + CLOSE * normal[:, None])[:, ::-1]], axis=1)
        seen = shapely.intersection(shapely.polygons(fronts), near)
        room = shapely.distance(shapely.linestrings(ahead), seen)
        touching = shapely.length(shapely.intersection(shapely.buffer(near, TOUCHING),
                                                       shapely.linestrings(ahead)))
        return np.where(touching > 0.5, 0.0, np.where(np.isnan(room), np.inf, room))

    def _on_outline(self, ends: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Whether the outside of the edges (tried at their middles) is outside of the building."""
        outside = ends.mean(axis=1) + 0.02 * normal
        return ~shapely.contains_xy(self._outline, outside)


def _with_corners_of(corners: np.ndarray, ring: np.ndarray) -> np.ndarray:
    """The ring (n, 2) with those of the corners (k, 2) added that lie on its edges, so that parts meet exactly."""
    full = []
    for start, end in zip(ring, np.roll(ring, -1, axis=0)):
        edge = end - start
        along = (corners - start) @ edge / (edge @ edge)
        across = np.abs((corners - start) @ np.array([edge[1], -edge[0]])) / np.hypot(*edge)
        on = ((across < ON_LINE) & (along * np.hypot(*edge) > ON_LINE)
              & ((1 - along) * np.hypot(*edge) > ON_LINE))
        between = corners[on][np.argsort(along[on], kind="stable")]
        full += [start, *between]
    return np.array(full)


def _walls(building: Building, number: int, lines: _Lines, ring: np.ndarray, faces: Faces, lookup: np.ndarray,
           before: int) -> list[DisplacedWall]:
    """Walls of a part; enters their numbers in the `lookup` of the faces."""
    true, normal = lines.edges(number)
    shift = lines.outward_shift(number)
    of_part = np.flatnonzero((faces.kind == FaceKind.WALL) & (faces.building == building.id) & (faces.part == number))
    middle = faces.corners[of_part].mean(axis=1)[:, :2]
    walls = []
    for i, ends in enumerate(true):
        edge = ends[1] - ends[0]
        across, along = (middle - ends[0]) @ normal[i], (middle - ends[0]) @ edge / (edge @ edge)
        mine = of_part[(np.abs(across) < ON_LINE) & (along > 0) & (along < 1)
                       & (faces.normal[of_part, :2] @ normal[i] > 0.999)]
        lookup[mine] = before + i + 1
        heights = faces.corners[mine, :, 2]
        low, top = (heights.min(), heights.max()) if len(mine) else (np.nan, np.nan)
        walls.append(DisplacedWall(before + i + 1, building.id, number, ends, ring[[i, (i + 1) % len(ring)]], normal[i],
                                   -float(shift[i]) + 0.0, float(low), float(top)))
    return walls
