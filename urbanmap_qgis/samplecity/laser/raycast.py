"""Where beams end: exact intersections of rays with the ground, faces, moving vehicles and crowns of trees.

Faces are sorted into the cells of a plan grid. All rays of a chunk walk through the grid together, each from cell
to cell, and meet only the faces of the cells that they cross.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from enum import IntEnum
from functools import partial

import numpy as np

from ...execution import in_order
from ..scene.model import Crowns, Faces, Vehicle
from ..scene.world import Scene
from .raycast_ground import ground_distance, ground_normal

CELL = 4.0
"""Side of the grid's cells, m."""

CHUNK = 32_768
"""Rays that walk together: few enough for the processor's cache."""

_HAIR = 1e-6
"""Play at borders of cells and faces, m."""


class Hit(IntEnum):
    """What a beam met."""

    NOTHING = 0
    GROUND = 1
    FACE = 2
    VEHICLE = 3
    CROWN = 4


@dataclass(frozen=True)
class Hits:
    """Where n beams ended.

    Attributes
    ----------
    distance : (n,) m, infinite where a beam met nothing.
    source : (n,) `Hit`.
    index : (n,) number of the face (`Scene.static_faces`), moving vehicle (`Scene.moving`) or tree; else -1.
    normal : (n, 3) unit normal of the surface towards the beam's origin.
    cosine : (n,) of the angle of incidence, 0 to 1.
    """

    distance: np.ndarray
    source: np.ndarray
    index: np.ndarray
    normal: np.ndarray
    cosine: np.ndarray


class RayCaster:
    """The city of one epoch, ready to be scanned."""

    def __init__(self, scene: Scene, epoch: str):
        self.ground = scene.ground
        self.grid = FaceGrid(scene.static_faces(epoch))
        self.vehicles = scene.moving(epoch)
        self.crowns = scene.crowns

    def cast(self, origin: np.ndarray, direction: np.ndarray, time: np.ndarray, max_range: float,
             leaf: np.ndarray | None = None, executor: Executor | None = None) -> Hits:
        """Find where beams end.

        Parameters
        ----------
        origin : (n, 3) or (3,), m, above the ground.
        direction : (n, 3) unit vectors.
        time : (n,) or a number, GPS seconds: when each beam is sent.
        max_range : m.
        leaf : (n,) how many mean free paths of leaves each beam passes before it meets one (exponential random numbers
            of mean 1); without it, crowns are solid.

        The result does not depend on the executor.
        """
        direction = np.ascontiguousarray(direction, dtype=float)
        n = len(direction)
        leaf = np.zeros(n) if leaf is None else leaf
        columns = (np.broadcast_to(origin, (n, 3)), direction, np.broadcast_to(time, n), leaf)
        pieces = (tuple(column[i:i + CHUNK] for column in columns) for i in range(0, n, CHUNK))
        parts = list(in_order(partial(self._cast_chunk, max_range=max_range), pieces, executor))
        if not parts:
            return Hits(np.zeros(0), np.zeros(0, np.uint8), np.zeros(0, np.int32), np.zeros((0, 3)), np.zeros(0))
        return Hits(*(np.concatenate([getattr(part, name) for part in parts])
                      for name in ("distance", "source", "index", "normal", "cosine")))

    def _cast_chunk(self, piece: tuple, max_range: float) -> Hits:
        origin, direction, time, leaf = piece
        n = len(direction)
        best = ground_distance(self.ground, origin, direction, max_range)
        source = np.where(np.isfinite(best), Hit.GROUND, Hit.NOTHING).astype(np.uint8)
        index = np.full(n, -1, np.int32)
        best = np.minimum(best, max_range)
        normal = np.zeros((n, 3))
        for number, (rays, distance, outward) in self._meet_vehicles(origin, direction, time, best):
            best[rays], source[rays], index[rays], normal[rays] = distance, Hit.VEHICLE, number, outward
        for number, (rays, distance) in _meet_crowns(self.crowns, origin, direction, leaf, best):
            # Leaves hang every way: the beam is taken to meet one squarely.
            best[rays], source[rays], index[rays], normal[rays] = distance, Hit.CROWN, number, -direction[rays]
        face = self.grid.walk(origin, direction, best)
        met = face >= 0
        source[met], index[met], normal[met] = Hit.FACE, face[met], self.grid.faces.normal[face[met]]
        low = source == Hit.GROUND
        normal[low] = ground_normal(self.ground, origin[low] + best[low, None] * direction[low])
        cosine = -np.einsum("ij,ij->i", normal, direction)
        normal[cosine < 0] *= -1.0
        best[source == Hit.NOTHING] = np.inf
        return Hits(best, source, index, normal, np.abs(cosine))

    def _meet_vehicles(self, origin, direction, time, best) -> Iterator[tuple]:
        """(number, (rays, distance, normal)) of moving vehicles that are nearer than `best`, one after another."""
        if not len(time):
            return
        reach = _plan_reach(origin, direction, best)
        for number, vehicle in enumerate(self.vehicles):
            span = np.array([vehicle.position(t) for t in (time.min(), time.max())])
            margin = vehicle.length
            wraps = vehicle.speed * np.ptp(time) > np.hypot(*np.diff(span, axis=0)[0]) + 1.0
            if not wraps and ((span.max(axis=0) < reach[0] - margin) | (span.min(axis=0) > reach[1] + margin)).any():
                continue
            yield number, _meet_vehicle(vehicle, self.ground, origin, direction, time, best)


class FaceGrid:
    """Faces by the cells of a plan grid that they touch."""

    def __init__(self, faces: Faces, cell: float = CELL):
        self.faces, self.cell = faces, cell
        self.z_low, self.z_high = faces.corners[..., 2].min(axis=1), faces.corners[..., 2].max(axis=1)
        self.plane = np.column_stack([faces.normal, faces.offset])
        self.inward = _edge_planes(faces)
        low, high = faces.corners[..., :2].min(axis=1), faces.corners[..., :2].max(axis=1)
        self.corner = low.min(axis=0) - cell / 2
        self.shape = ((high.max(axis=0) - self.corner) / cell).astype(np.intp) + 2
        face, cells = _cells_touched(faces, low, high, self.corner, cell, int(self.shape[1]))
        order = np.argsort(cells, kind="stable")
        self.face = face[order]
        count = int(self.shape[0] * self.shape[1])
        self.count = np.bincount(cells, minlength=count)
        self.first = np.concatenate([[0], np.cumsum(self.count)[:-1]])
        self.cell_low, self.cell_high = np.full(count, np.inf), np.full(count, -np.inf)
        np.minimum.at(self.cell_low, cells, self.z_low[face] - _HAIR)
        np.maximum.at(self.cell_high, cells, self.z_high[face] + _HAIR)

    def walk(self, origin: np.ndarray, direction: np.ndarray, best: np.ndarray) -> np.ndarray:
        """Number of the nearest face within `best` (n,) of each ray, -1 for none; `best` becomes its distance."""
        found = np.full(len(direction), -1, np.int32)
        start, end = self._span(origin, direction, best)
        rays = np.flatnonzero(start < end)
        walk = _Walk(self, origin[rays], direction[rays], start[rays], end[rays])
        beams = np.concatenate([origin, direction], axis=1)
        while len(rays):
            leave = np.minimum(np.minimum(walk.next_x, walk.next_y), walk.end)
            z_in, z_out = walk.z + walk.at * walk.rise, walk.z + leave * walk.rise
            number = walk.column * self.shape[1] + walk.row
            busy = np.flatnonzero((np.minimum(z_in, z_out) <= self.cell_high[number])
                                  & (np.maximum(z_in, z_out) >= self.cell_low[number]))
            if len(busy):
                self._meet(number[busy], rays[busy], walk.at[busy], leave[busy], beams, best, found)
            go = np.flatnonzero((leave < walk.end) & (best[rays] > leave))
            rays = rays[go]
            walk.keep(go)
            walk.step()
        return found

    def _span(self, origin, direction, best) -> tuple[np.ndarray, np.ndarray]:
        """Stretch of each ray (distances) within the grid and between the lowest and the highest face."""
        low = np.array([*(self.corner + _HAIR), self.z_low.min() - _HAIR])
        high = np.array([*(self.corner + self.shape * self.cell - _HAIR), self.z_high.max() + _HAIR])
        a, b = _slab(origin, direction, low, high)
        start, end = np.maximum(a.max(axis=1), 0.0), np.minimum(b.min(axis=1), best)
        return start, end

    def _meet(self, cells, rays, t_in, t_out, beams, best, found) -> None:
        """Meet the faces of one cell for each ray."""
        count = self.count[cells]
        pair = np.repeat(np.arange(len(cells)), count)
        place = np.arange(len(pair)) + np.repeat(self.first[cells] - np.cumsum(count) + count, count)
        face, ray = self.face[place], rays[pair]
        plane, beam = np.take(self.plane, face, axis=0), np.take(beams, ray, axis=0)
        slant = plane[:, 0] * beam[:, 3] + plane[:, 1] * beam[:, 4] + plane[:, 2] * beam[:, 5]
        gap = plane[:, 3] - plane[:, 0] * beam[:, 0] - plane[:, 1] * beam[:, 1] - plane[:, 2] * beam[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = gap / slant
        near = np.flatnonzero((distance >= t_in[pair] - _HAIR) & (distance <= t_out[pair] + _HAIR)
                              & (distance < best[ray]) & (distance > _HAIR))
        face, ray, distance = face[near], ray[near], distance[near]
        point = beam[near, :3] + distance[:, None] * beam[near, 3:]
        inward = self.inward[face]
        inside = (np.einsum("nij,nj->ni", inward[..., :3], point) >= inward[..., 3] - _HAIR).all(axis=1)
        face, ray, distance = face[inside], ray[inside], distance[inside]
        order = np.lexsort((face, -distance))
        # The nearest comes last and stays.
        best[ray[order]], found[ray[order]] = distance[order], face[order]


class _Walk:
    """Rays on their way from cell to cell of a grid: where each is, and how far the borders ahead are.

    The grid is wider than the stretches (`start` to `end`) of the rays, so that no ray leaves it.
    """

    def __init__(self, grid: FaceGrid, origin: np.ndarray, direction: np.ndarray, start: np.ndarray, end: np.ndarray):
        self.at, self.end = start.copy(), end
        self.z, self.rise = origin[:, 2].copy(), direction[:, 2].copy()
        self.column, self.sign_x, self.each_x, self.next_x = self._axis(grid, origin, direction, start, 0)
        self.row, self.sign_y, self.each_y, self.next_y = self._axis(grid, origin, direction, start, 1)

    @staticmethod
    def _axis(grid: FaceGrid, origin, direction, start, axis: int) -> tuple[np.ndarray, ...]:
        """Cell, direction, distance between borders and distance of the next border along one axis."""
        aim = direction[:, axis]
        place = (origin[:, axis] + start * aim - grid.corner[axis]) / grid.cell
        cell = np.clip(np.floor(place).astype(np.intp), 0, grid.shape[axis] - 1)
        ahead = np.maximum(np.where(aim > 0, cell + 1 - place, place - cell), 0.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            each = grid.cell / np.abs(aim)
            border = np.where(aim == 0, np.inf, start + ahead * each)
        return cell, np.where(aim > 0, 1, -1), each, border

    def step(self) -> None:
        """Go into the next cell."""
        along_x = self.next_x <= self.next_y
        along_y = ~along_x
        self.at = np.where(along_x, self.next_x, self.next_y)
        self.column += self.sign_x * along_x
        self.row += self.sign_y * along_y
        np.add(self.next_x, self.each_x, out=self.next_x, where=along_x)
        np.add(self.next_y, self.each_y, out=self.next_y, where=along_y)

    def keep(self, rays: np.ndarray) -> None:
        """Go on with some of the rays."""
        if len(rays) < len(self.at):
            for name, column in vars(self).items():
                setattr(self, name, column[rays])


def _edge_planes(faces: Faces) -> np.ndarray:
    """(n, 4, 4): for each edge a unit vector into the face and its offset; a point of the face lies inside all four."""
    along = np.roll(faces.corners, -1, axis=1) - faces.corners
    inward = np.cross(faces.normal[:, None, :], along)
    length = np.linalg.norm(inward, axis=2, keepdims=True)
    inward = np.where(length > 0, inward / np.where(length > 0, length, 1.0), 0.0)
    return np.concatenate([inward, np.einsum("nij,nij->ni", inward, faces.corners)[..., None]], axis=2)


def _cells_touched(faces: Faces, low, high, corner, cell: float, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of face and cell that touch in plan."""
    first = np.floor((low - corner - _HAIR) / cell).astype(np.intp)
    span = np.floor((high - corner + _HAIR) / cell).astype(np.intp) - first + 1
    count = span.prod(axis=1)
    face = np.repeat(np.arange(len(faces)), count)
    place = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    column, row = first[face, 0] + place // span[face, 1], first[face, 1] + place % span[face, 1]
    middle = corner + cell * (np.column_stack([column, row]) + 0.5)
    touches = np.ones(len(face), bool)
    for i in range(4):
        # A line through two corners, with all corners on one side of it and the whole cell on the other, parts them.
        a, b = faces.corners[face, i, :2], faces.corners[face, (i + 1) % 4, :2]
        across = np.column_stack([a[:, 1] - b[:, 1], b[:, 0] - a[:, 0]])
        reach = np.einsum("nij,nj->ni", faces.corners[face][..., :2] - middle[:, None, :], across)
        half = (cell / 2 + _HAIR) * np.abs(across).sum(axis=1)
        touches &= (reach.min(axis=1) <= half) & (reach.max(axis=1) >= -half)
    return face[touches], (column * columns + row)[touches]


def _plan_reach(origin: np.ndarray, direction: np.ndarray, best: np.ndarray) -> np.ndarray:
    """Least and greatest x, y (2, 2) of the places that the rays pass within `best`."""
    ends = origin + best[:, None] * direction
    return np.array([np.minimum(origin, ends)[:, :2].min(axis=0), np.maximum(origin, ends)[:, :2].max(axis=0)])


def _slab(origin, direction, low, high) -> tuple[np.ndarray, np.ndarray]:
    """Distances at which rays enter and leave each of three slabs, (n, 3) each."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (low - origin) / direction, (high - origin) / direction
    inside = (origin >= low) & (origin <= high)
    level = direction == 0
    a = np.where(level, np.where(inside, -np.inf, np.inf), a)
    b = np.where(level, np.where(inside, np.inf, -np.inf), b)
    return np.minimum(a, b) if not level.any() else np.where(level, a, np.minimum(a, b)), (
        np.maximum(a, b) if not level.any() else np.where(level, b, np.maximum(a, b)))


def _meet_vehicle(vehicle: Vehicle, ground, origin, direction, time, best) -> tuple:
    """Rays that meet the vehicle nearer than `best`, the distances and the normals."""
    x, y = vehicle.position(time)
    away = np.column_stack([x, y]) - origin[:, :2]
    across = away[:, 0] * direction[:, 1] - away[:, 1] * direction[:, 0]
    level = np.hypot(direction[:, 0], direction[:, 1])
    near = np.flatnonzero(np.abs(across) <= (vehicle.length / 2 + vehicle.width / 2) * level + _HAIR)
    x, y = x[near], y[near]
    heading = np.radians(vehicle.lane.heading)
    axes = np.array([[np.sin(heading), np.cos(heading), 0], [-np.cos(heading), np.sin(heading), 0], [0, 0, 1.0]])
    foot = (origin[near] - np.column_stack([x, y, ground.height(x, y)])) @ axes.T
    aim = direction[near] @ axes.T
    distance, outward = np.full(len(near), np.inf), np.zeros((len(near), 3))
    for low, high in vehicle.boxes():
        enter, leave = _slab(foot, aim, low, high)
        side = enter.argmax(axis=1)
        start = enter[np.arange(len(near)), side]
        hit = (start <= leave.min(axis=1)) & (start > _HAIR) & (start < distance)
        distance[hit] = start[hit]
        outward[hit] = -np.sign(aim[hit, side[hit]])[:, None] * axes[side[hit]]
    hit = distance < best[near]
    return near[hit], distance[hit], outward[hit]


def _meet_crowns(crowns: Crowns, origin, direction, leaf, best) -> Iterator[tuple]:
    """(number, (rays, distance)) of crowns that are met nearer than `best`, one after another."""
    reach = _plan_reach(origin, direction, best)
    (east, north), (east_aim, north_aim) = origin.T[:2].copy(), direction.T[:2].copy()
    level = np.hypot(east_aim, north_aim) + _HAIR
    for number, (centre, radii, path) in enumerate(zip(crowns.centre, crowns.radii, crowns.free_path)):
        if ((centre[:2] + radii[:2] < reach[0]) | (centre[:2] - radii[:2] > reach[1])).any():
            continue
        across = (centre[0] - east) * north_aim - (centre[1] - north) * east_aim
        rays = np.flatnonzero(np.abs(across) <= radii[0] * level)
        foot, aim = (origin[rays] - centre) / radii, direction[rays] / radii
        a, b = np.einsum("ij,ij->i", aim, aim), np.einsum("ij,ij->i", foot, aim)
        root = b * b - a * (np.einsum("ij,ij->i", foot, foot) - 1.0)
        through = root > 0
        rays, a, b, half = rays[through], a[through], b[through], np.sqrt(root[through])
        enter, leave = (-b - half) / a, (-b + half) / a
        distance = np.maximum(enter, 0.0) + leaf[rays] * path
        hit = (distance < leave) & (distance < best[rays])
        yield number, (rays[hit], distance[hit])
