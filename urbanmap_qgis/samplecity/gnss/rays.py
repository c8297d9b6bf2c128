"""Traces satellite signals through the true city: free, behind an edge, reflected once by a wall, through trees.

Signals are plane waves: over the extent of the city the direction to a satellite changes by less than 0.00001
rad. Poles, signs and vehicles are left out: they are thinner than a signal's first Fresnel zone or lower than the
antenna.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..scene.model import Crowns, FaceKind, Faces

OPAQUE = (FaceKind.WALL, FaceKind.ROOF, FaceKind.STRUCTURE, FaceKind.BRIDGE)
WAVE_LENGTH = 0.1903
"""Of the carrier at 1575.42 MHz, m."""

SKIN = 1e-3
"""Rays start this far off the face that reflected them, m."""

MIN_INCIDENCE_COSINE = 0.02
"""Signals that graze a wall more flatly (cosine to its normal) are not reflected by it."""

_CHUNK = 2_000_000


@dataclass(frozen=True)
class OpaqueFaces:
    """The faces that stop signals, found by the plan of a ray."""

    faces: Faces
    tree: shapely.STRtree
    top: float

    @classmethod
    def of(cls, faces: Faces) -> OpaqueFaces:
        """Those of the faces that stop signals."""
        opaque = _taken(faces, np.isin(faces.kind, [int(kind) for kind in OPAQUE]))
        low, high = opaque.corners.min(axis=1), opaque.corners.max(axis=1)
        plans = shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
        return cls(opaque, shapely.STRtree(plans), float(high[:, 2].max(initial=0.0)))

    def crossings(self, start: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Numbers of rays and of faces whose plans may meet; rays from `start` (n, 3) to `end` (n, 3)."""
        return self.tree.query(shapely.linestrings(np.stack([start[:, :2], end[:, :2]], axis=1)))

    def far_end(self, start: np.ndarray, direction: np.ndarray) -> np.ndarray:
        """(n, 3) where rays that rise from `start` along the unit vectors `direction` leave the city's top."""
        length = np.maximum(self.top - start[:, 2], 0.1) / direction[:, 2] + 1.0
        return start + length[:, None] * direction

    def stop(self, start: np.ndarray, end: np.ndarray) -> np.ndarray:
        """(n,) number of a face that stops the path from `start` to `end` (n, 3 each), -1 if it is free."""
        stopped = np.full(len(start), -1)
        ray, face = self.crossings(start, end)
        for first in range(0, len(ray), _CHUNK):
            r, f = ray[first:first + _CHUNK], face[first:first + _CHUNK]
            hit = _meets(self.faces, f, start[r], end[r])
            stopped[r[hit]] = f[hit]
        return stopped

    def over_edge(self, start: np.ndarray, direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far blocked signals pass below the edge of what blocks them.

        Returns (n,) height of the edge above the straight path (m, infinite below a bridge), and (n,) its distance
        in plan from the antenna (m).
        """
        end = self.far_end(start, direction)
        ray, face = self.crossings(start, end)
        above, away = np.zeros(len(start)), np.ones(len(start))
        hit = _meets(self.faces, face, start[ray], end[ray])
        bridge = self.faces.kind[face] == FaceKind.BRIDGE
        above[ray[hit & bridge]] = np.inf
        upright = np.abs(self.faces.normal[face, 2]) < 1e-6
        ray, face = ray[upright & ~bridge], face[upright & ~bridge]
        distance, crosses = _plan_crossing(self.faces.corners[face, 0, :2], self.faces.corners[face, 1, :2],
                                           start[ray, :2], direction[ray, :2])
        slope = direction[ray, 2] / np.hypot(*direction[ray, :2].T)
        clear = self.faces.corners[face][:, :, 2].max(axis=1) - (start[ray, 2] + slope * distance)
        for number in np.flatnonzero(crosses & (clear > 0)):
            if clear[number] > above[ray[number]]:
                above[ray[number]], away[ray[number]] = clear[number], distance[number]
        return above, away


@dataclass(frozen=True)
class SimulatedReflections:
    """Single reflections with both legs free, one each.

    Attributes
    ----------
    ray : number of the ray.
    face : number of the reflecting face among `Mirrors.faces`.
    place : (n, 3) point of reflection.
    excess : excess path, m.
    cosine : cosine between signal and wall normal.
    """

    ray: np.ndarray
    face: np.ndarray
    place: np.ndarray
    excess: np.ndarray
    cosine: np.ndarray


@dataclass(frozen=True)
class Mirrors:
    """The walls that reflect signals; `number` (n,) are their numbers among the faces they were taken from."""

    faces: Faces
    number: np.ndarray

    @classmethod
    def of(cls, faces: Faces) -> Mirrors:
        """Those of the faces that are walls."""
        wall = (faces.kind == FaceKind.WALL) & (np.abs(faces.normal[:, 2]) < 1e-6)
        return cls(_taken(faces, wall), np.flatnonzero(wall))

    def reflect(self, obstacles: OpaqueFaces, start: np.ndarray, direction: np.ndarray,
                max_range: float) -> SimulatedReflections:
        """Reflections that arrive at the antennas.

        `start` (n, 3) antennas, `direction` (n, 3) unit vectors to the satellites; walls farther than `max_range` m
        from the antenna are left out. For a wall at the distance D the excess path is 2 D times the cosine to the
        wall's normal.
        """
        faces = self.faces
        pieces = []
        for first in range(0, len(start), 200):
            block = slice(first, first + 200)
            distance = start[block] @ faces.normal.T - faces.offset
            slope = direction[block] @ faces.normal.T
            ray, face = np.nonzero((distance > 0.05) & (distance < max_range) & (slope > MIN_INCIDENCE_COSINE))
            normal, cosine = faces.normal[face], slope[ray, face]
            arriving = direction[block][ray] - 2 * cosine[:, None] * normal
            path = distance[ray, face] / cosine
            place = start[block][ray] + path[:, None] * arriving
            inside = _inside(faces, face, place)
            excess = path * (1 - np.einsum("ij,ij->i", arriving, direction[block][ray]))
            pieces.append((ray[inside] + first, face[inside], place[inside], excess[inside], cosine[inside]))
        ray, face, place, excess, slope = (np.concatenate(column) for column in zip(*pieces))
        off = place + SKIN * faces.normal[face]
        free = obstacles.stop(start[ray], off) < 0
        free[free] = obstacles.stop(off[free], obstacles.far_end(off[free], direction[ray[free]])) < 0
        return SimulatedReflections(ray[free], face[free], place[free], excess[free], slope[free])


def path_through_crowns(crowns: Crowns, start: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(n,) metres that rays from `start` (n, 3) along unit vectors `direction` (n, 3) run through crowns of trees."""
    through = np.zeros(len(start))
    for centre, radii in zip(crowns.centre, crowns.radii):
        origin, step = (start - centre) / radii, direction / radii
        a, b = np.einsum("ij,ij->i", step, step), np.einsum("ij,ij->i", step, origin)
        root = np.sqrt(np.maximum(b**2 - a * (np.einsum("ij,ij->i", origin, origin) - 1), 0.0))
        through += np.maximum((root - b) / a, 0.0) - np.maximum((-root - b) / a, 0.0)
    return through


def edge_loss(above: np.ndarray, away: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Loss of signals diffracted over an edge, dB (single knife edge, ITU-R P.526, 4.1); arguments as `over_edge`
    gives."""
    flat = np.hypot(direction[:, 0], direction[:, 1])
    v = above * flat * np.sqrt(2 * flat / (WAVE_LENGTH * away))
    return 6.9 + 20 * np.log10(np.sqrt((v - 0.1) ** 2 + 1) + v - 0.1)


def edge_excess(above: np.ndarray, away: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Excess path over an edge, m: from the antenna straight to the edge and on to the satellite."""
    flat = np.hypot(direction[:, 0], direction[:, 1])
    reachable = np.isfinite(above)
    height = np.where(reachable, above, 0.0)
    below, along = height * flat, away / flat + height * direction[:, 2]
    return np.where(reachable, np.hypot(along, below) - along, np.inf)


def _taken(faces: Faces, chosen: np.ndarray) -> Faces:
    return Faces(*(getattr(faces, name)[chosen] for name in Faces.__dataclass_fields__))


def _meets(faces: Faces, face: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Whether the segments from `start` to `end` (n, 3) pass through the faces of the numbers `face` (n,)."""
    normal, offset = faces.normal[face], faces.offset[face]
    before = np.einsum("ij,ij->i", normal, start) - offset
    after = np.einsum("ij,ij->i", normal, end) - offset
    meets = before * after < 0
    candidates = np.flatnonzero(meets)
    share = before[candidates] / (before[candidates] - after[candidates])
    place = start[candidates] + share[:, None] * (end[candidates] - start[candidates])
    meets[candidates] = _inside(faces, face[candidates], place)
    return meets


def _inside(faces: Faces, face: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Whether places (n, 3) in the planes of the faces of the numbers `face` (n,) lie within those faces."""
    inside = np.ones(len(face), bool)
    normal = faces.normal[face]
    for k in range(4):
        corner = faces.corners[face, k]
        edge = faces.corners[face, (k + 1) % 4] - corner
        inside &= np.einsum("ij,ij->i", np.cross(edge, place - corner), normal) >= 0
    return inside


def _plan_crossing(a: np.ndarray, b: np.ndarray, start: np.ndarray,
                   direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance in plan from `start` (n, 2) along `direction` (n, 2) to the lines a-b (n, 2 each), and whether it
    crosses them between their ends."""
    unit = direction / np.hypot(direction[:, 0], direction[:, 1])[:, None]
    edge, offset = b - a, a - start
    crossing = unit[:, 0] * edge[:, 1] - unit[:, 1] * edge[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (offset[:, 0] * edge[:, 1] - offset[:, 1] * edge[:, 0]) / crossing
        share = (offset[:, 0] * unit[:, 1] - offset[:, 1] * unit[:, 0]) / crossing
        return distance, (distance > 0) & (share >= 0) & (share <= 1)
