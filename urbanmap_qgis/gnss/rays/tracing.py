"""Rays of satellite signals among walls: what stops them, and which wall reflects them (J 5.6).

Signals are plane waves that come from above; walls are upright and stop them from both sides. A ray is followed
through a plan grid whose cells know their walls and the highest of them, all rays one cell at a time: rays that
have risen above the walls or met one drop out, so that thousands of walls cost little more than tens.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...progress import SILENT, Progress
from .wall_faces import WallPieces

SKIN = 1e-3
"""Rays begin this far off the wall that reflects them, m."""

MIN_INCIDENCE_COSINE = 0.02
"""Signals that graze a wall more flatly (cosine to its normal) are not reflected by it."""

_CELL = 12.0
_LARGEST_GRID = 2_000_000
_PAIRS = 1_500_000
"""Places times walls looked at at once."""

_TESTED = 100_000
"""Walls tested at once: what is known of so many stays near the processor."""


@dataclass(frozen=True)
class WallObstacles:
    """Walls in the cells of a plan grid.

    Attributes
    ----------
    walls : the pieces; their coordinates are local to `origin`.
    origin : (2,) lower left corner of the grid, m.
    cell : width of a cell, m.
    shape : rows, columns.
    first : (cells + 1,) where each cell's walls begin in `member`.
    member : numbers of pieces.
    highest : (cells,) height of the highest wall in each cell, m; -inf without walls.
    """

    walls: WallPieces
    origin: np.ndarray
    cell: float
    shape: tuple[int, int]
    first: np.ndarray
    member: np.ndarray
    highest: np.ndarray

    @classmethod
    def of(cls, walls: WallPieces) -> WallObstacles:
        """Grid of walls; a cell lists the pieces whose boxes touch it and whose lines pass through it."""
        corners = np.concatenate([walls.start, walls.end])
        origin = corners.min(axis=0) - 1.0
        size = corners.max(axis=0) + 1.0 - origin
        cell = max(_CELL, float(np.sqrt(size.prod() / _LARGEST_GRID)))
        columns, rows = (np.floor(size / cell) + 1).astype(np.int64)
        local = _shifted(walls, origin)
        number, member = _cells_of(local, cell, int(columns))
        highest = np.full(rows * columns, -np.inf)
        np.maximum.at(highest, number, local.top.max(axis=1)[member])
        order = np.argsort(number, kind="stable")
        member = member[order]
        first = np.searchsorted(number[order], np.arange(rows * columns + 1))
        return cls(local, origin, cell, (int(rows), int(columns)), first, member, highest)

    def first_hit(self, start: np.ndarray, direction: np.ndarray, length: np.ndarray | float = np.inf,
                  progress: Progress = SILENT) -> tuple[np.ndarray, np.ndarray]:
        """The first wall that stops each ray.

        Parameters
        ----------
        start : (n, 3) m.
        direction : (n, 3) unit vectors.
        length : (n,) length of the rays, m.

        Returns
        -------
        piece : (n,) number of the piece, -1 where the ray is free.
        distance : (n,) m along the ray, inf where it is free.
        """
        march = _March(self, np.asarray(start, float), np.asarray(direction, float), length)
        while march.step():
            progress.check()
        return march.piece, march.distance

    def free(self, start: np.ndarray, direction: np.ndarray, length: np.ndarray | float = np.inf,
             progress: Progress = SILENT) -> np.ndarray:
        """(n,) whether rays meet no wall."""
        return self.first_hit(start, direction, length, progress)[0] < 0

    def inside(self, place: np.ndarray) -> np.ndarray:
        """(n,) whether places (n, 3) lie within a building.

        From within, level rays meet the first wall from behind; three rays decide by majority, so that one
        damaged corner does not.
        """
        behind = np.zeros(len(place), np.int64)
        for angle in np.radians([11.0, 131.0, 251.0]):
            level = np.array([np.sin(angle), np.cos(angle), 0.0])
            piece, _ = self.first_hit(place, np.broadcast_to(level, place.shape))
            behind += (piece >= 0) & (self.walls.normal[piece] @ level[:2] > 0)
        return behind >= 2


class _March:
    """Rays marching through the cells of a grid."""

    def __init__(self, grid: WallObstacles, start: np.ndarray, direction: np.ndarray, length: np.ndarray | float):
        count = len(start)
        self.grid = grid
        self.piece, self.distance = np.full(count, -1), np.full(count, np.inf)
        self._normals = np.ascontiguousarray(grid.walls.normal.T)
        self._columns: tuple[np.ndarray, ...] = ()
        flat = start[:, :2] - grid.origin
        rows, columns = grid.shape
        size = np.array([columns, rows]) * grid.cell
        with np.errstate(divide="ignore", invalid="ignore"):
            one, other = (0.0 - flat) / direction[:, :2], (size - flat) / direction[:, :2]
        # A ray along a grid line divides 0 by 0: between the lines it is inside for all of its length.
        within = (flat >= 0) & (flat <= size)
        still = direction[:, :2] == 0
        near = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(one, other)).max(axis=1)
        far = np.where(still, np.inf, np.maximum(one, other)).min(axis=1)
        self.end = np.minimum(far, length)
        enter = np.maximum(near, 0.0)
        rays = np.flatnonzero(enter < self.end)
        self.ray, self.enter = rays, enter[rays]
        self.flat, self.direction, self.z = flat[rays], direction[rays], start[rays, 2]
        at = self.flat + self.enter[:, None] * self.direction[:, :2]
        self.column, self.row = np.clip((at / grid.cell).astype(np.int64), 0, [columns - 1, rows - 1]).T

    def step(self) -> bool:
        """Test the walls of the cells that the rays are in, and go on to the next; False when all are done."""
        if not len(self.ray):
            return False
        grid = self.grid
        leave, axis = self._leaving()
        number = self.row * grid.shape[1] + self.column
        lowest = self.z + np.minimum(self.enter * self.direction[:, 2], leave * self.direction[:, 2])
        look = np.flatnonzero(lowest <= grid.highest[number])
        self._test(look, number[look])
        sign = np.where(self.direction[np.arange(len(axis)), axis] > 0, 1, -1)
        self.column = self.column + np.where(axis == 0, sign, 0)
        self.row = self.row + np.where(axis == 1, sign, 0)
        on = leave < np.minimum(self.end[self.ray], self.distance[self.ray])
        on &= (self.column >= 0) & (self.column < grid.shape[1]) & (self.row >= 0) & (self.row < grid.shape[0])
        self.enter = leave
        for name in ("ray", "enter", "flat", "direction", "z", "column", "row"):
            setattr(self, name, getattr(self, name)[on])
        return True

    def _leaving(self) -> tuple[np.ndarray, np.ndarray]:
        """Where (m along the ray) and across which axis rays leave their cells."""
        cell = np.column_stack([self.column, self.row])
        edge = (cell + (self.direction[:, :2] > 0)) * self.grid.cell
        with np.errstate(divide="ignore", invalid="ignore"):
            at = np.where(self.direction[:, :2] == 0, np.inf, (edge - self.flat) / self.direction[:, :2])
        axis = at.argmin(axis=1)
        return at[np.arange(len(axis)), axis], axis

    def _test(self, look: np.ndarray, number: np.ndarray) -> None:
        """Find the nearest wall among those of the cells `number` for the rays `look`."""
        count = self.grid.first[number + 1] - self.grid.first[number]
        ends = np.cumsum(count)
        self._columns = (*np.ascontiguousarray(self.flat.T), *np.ascontiguousarray(self.direction[:, :2].T),
                         np.minimum(self.end[self.ray], self.distance[self.ray]))
        begin = 0
        while begin < len(look):
            done = ends[begin - 1] if begin else 0
            stop = max(int(np.searchsorted(ends, done + _TESTED, side="right")), begin + 1)
            block = slice(begin, stop)
            ray = np.repeat(look[block], count[block])
            within = np.arange(len(ray)) - np.repeat(ends[block] - count[block] - done, count[block])
            member = self.grid.member[np.repeat(self.grid.first[number[block]], count[block]) + within]
            self._hits(ray, member)
            begin = stop

    def _hits(self, ray: np.ndarray, member: np.ndarray) -> None:
        walls = self.grid.walls
        # Column by column: taking pairs of numbers from all over the memory is most of the work.
        flat_x, flat_y, along_x, along_y, nearest = self._columns
        normal_x, normal_y = (values[member] for values in self._normals)
        at = walls.offset[member]
        at -= normal_x * flat_x[ray]
        at -= normal_y * flat_y[ray]
        normal_x *= along_x[ray]
        normal_y *= along_y[ray]
        normal_x += normal_y  # how fast the ray comes nearer
        with np.errstate(divide="ignore", invalid="ignore"):
            at /= normal_x
        hit = np.flatnonzero((at > 1e-9) & (at < nearest[ray]))
        at, member, ray = at[hit], member[hit], ray[hit]
        target = self.ray[ray]
        # An earlier block of the same cells may have met a nearer wall.
        hit = np.flatnonzero(at < self.distance[target])
        at, member, target, ray = at[hit], member[hit], target[hit], ray[hit]
        share = _share(walls, member, self.flat[ray] + at[:, None] * self.direction[ray, :2])
        z = self.z[ray] + at * self.direction[ray, 2]
        low = walls.low[member, 0] + _part(share, walls.low[member])
        top = walls.top[member, 0] + _part(share, walls.top[member])
        hit = np.flatnonzero((share >= 0) & (share <= 1) & (z >= low) & (z <= top))
        # The nearest is written last.
        hit = hit[np.argsort(-at[hit], kind="stable")]
        self.distance[target[hit]], self.piece[target[hit]] = at[hit], member[hit]


@dataclass(frozen=True)
class WallReflections:
    """Places where walls could reflect signals once, before looking at what obstructs them.

    Attributes
    ----------
    ray : (n,) number of the ray.
    piece : (n,) number of the piece of wall.
    place : (n, 3) point of reflection, m.
    length : (n,) m from the antenna to it.
    arriving : (n, 3) unit vector from the antenna to it.
    distance : (n,) m from the antenna to the plane of the wall.
    cosine : (n,) cosine between the signal and the normal of the wall, cos(elevation) cos(difference of azimuth).
    inside : (n,) m by which the point lies within the edges of the wall, negative outside.
    """

    ray: np.ndarray
    piece: np.ndarray
    place: np.ndarray
    length: np.ndarray
    arriving: np.ndarray
    distance: np.ndarray
    cosine: np.ndarray
    inside: np.ndarray

    @property
    def excess(self) -> np.ndarray:
        """(n,) excess path of the reflected signal, m: 2 D cos(elevation) cos(difference of azimuth)."""
        return 2 * self.distance * self.cosine

    def select(self, rows: np.ndarray) -> WallReflections:
        """Some of them."""
        return WallReflections(*(getattr(self, name)[rows] for name in WallReflections.__dataclass_fields__))


def mirror_reflections(walls: WallPieces, place: np.ndarray, place_of_ray: np.ndarray, direction: np.ndarray,
                       max_range: float, margin: float = 0.0, progress: Progress = SILENT) -> WallReflections:
    """Single reflections by the law of the mirror, whatever obstructs them.

    Seen from the antenna's mirror image behind a wall, the satellites that the wall reflects are those whose
    azimuth lies between the azimuths of its ends: the rays of each place are sorted by azimuth and found in one
    search for all walls.

    Parameters
    ----------
    place : (m, 3) antennas.
    place_of_ray : (n,) row in `place`.
    direction : (n, 3) unit vectors to the satellites.
    max_range : walls farther than this from the antenna in plan reflect nothing, m.
    margin : walls are taken larger by this at all edges, m.
    """
    middle = walls.start.mean(axis=0)
    local = _shifted(walls, middle)
    xy = place[:, :2] - middle
    azimuth = np.arctan2(*np.ascontiguousarray(direction[:, :2].T)) % (2 * np.pi)
    order = np.lexsort((azimuth, place_of_ray))
    # Twice round, so that an interval over north is one interval.
    key = np.concatenate([place_of_ray[order] * 16.0 + azimuth[order],
                          place_of_ray[order] * 16.0 + azimuth[order] + 2 * np.pi])
    resort = np.argsort(key, kind="stable")
    key, key_ray = key[resort], np.concatenate([order, order])[resort]
    along = np.column_stack([-local.normal[:, 1], local.normal[:, 0]])
    ends = np.einsum("ij,ij->i", local.start, along), np.einsum("ij,ij->i", local.end, along)
    found = []
    block = max(1, _PAIRS // (4 * max(len(walls), 1)))
    for begin in range(0, len(place), block):
        progress.step(begin / len(place))
        row, piece = _facing(local, xy[begin:begin + block], along, ends, max_range)
        ray, piece = _between(local, xy, row + begin, piece, along, margin, key, key_ray)
        found.append(_mirrored(local, xy[place_of_ray[ray]], place[place_of_ray[ray], 2], ray, piece, direction,
                               along, ends, margin))
    columns = [np.concatenate([getattr(part, name) for part in found]) for name in WallReflections.__dataclass_fields__]
    reflections = WallReflections(*columns)
    reflections.place[:, :2] += middle
    return reflections


def legs_in_line_of_sight(obstacles: WallObstacles, place: np.ndarray, direction: np.ndarray, found: WallReflections,
                          progress: Progress = SILENT) -> np.ndarray:
    """Whether both legs of reflections are free, (k,).

    Parameters
    ----------
    place, direction : (n, 3) antenna and unit vector to the satellite of each ray that `found` speaks of.
    """
    free = obstacles.free(place[found.ray], found.arriving, found.length - SKIN, progress)
    rows = np.flatnonzero(free)
    normal = obstacles.walls.normal[found.piece[rows]]
    off = found.place[rows].copy()
    off[:, :2] += SKIN * normal
    free[rows] = obstacles.free(off, direction[found.ray[rows]], progress=progress)
    return free


def rotated_directions(direction: np.ndarray, azimuth: float, elevation: float) -> np.ndarray:
    """Unit vectors (n, 3) rotated clockwise and raised, both in degrees; not beyond the zenith."""
    east, north, up = np.ascontiguousarray(direction.T)
    az = np.arctan2(east, north) + np.radians(azimuth)
    el = np.clip(np.arctan2(up, np.hypot(east, north)) + np.radians(elevation), 1e-3, np.pi / 2)
    return np.column_stack([np.cos(el) * np.sin(az), np.cos(el) * np.cos(az), np.sin(el)])


def _facing(walls: WallPieces, xy: np.ndarray, along: np.ndarray, ends, max_range: float
            ) -> tuple[np.ndarray, np.ndarray]:
    """Rows of places and numbers of the pieces that they see from in front, not too far away."""
    distance = xy @ walls.normal.T - walls.offset
    beside = xy @ along.T
    beyond = np.maximum(np.maximum(ends[0] - beside, beside - ends[1]), 0.0)
    return np.nonzero((distance > 0.05) & (distance**2 + beyond**2 < max_range**2))


def _between(walls: WallPieces, xy: np.ndarray, row: np.ndarray, piece: np.ndarray, along: np.ndarray, margin: float,
             key: np.ndarray, key_ray: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rays that the mirror images of places see through the pieces, and those pieces."""
    normal = walls.normal[piece]
    image = xy[row] - 2 * (np.einsum("ij,ij->i", xy[row], normal) - walls.offset[piece])[:, None] * normal
    a = walls.start[piece] - margin * along[piece] - image
    b = walls.end[piece] + margin * along[piece] - image
    one, other = (np.arctan2(*np.ascontiguousarray(end.T)) for end in (a, b))
    width = (other - one + np.pi) % (2 * np.pi) - np.pi
    first = np.where(width < 0, other, one) % (2 * np.pi)
    low = np.searchsorted(key, row * 16.0 + first - 1e-12)
    high = np.searchsorted(key, row * 16.0 + first + np.abs(width) + 1e-12)
    count = high - low
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return key_ray[np.repeat(low, count) + within], np.repeat(piece, count)


def _mirrored(walls: WallPieces, xy: np.ndarray, z: np.ndarray, ray: np.ndarray, piece: np.ndarray,
              direction: np.ndarray, along: np.ndarray, ends, margin: float) -> WallReflections:
    """Reflections of rays by pieces, as far as the point lies within the piece grown by the margin."""
    normal, to_satellite = walls.normal[piece], direction[ray]
    distance = np.einsum("ij,ij->i", xy, normal) - walls.offset[piece]
    cosine = np.einsum("ij,ij->i", to_satellite[:, :2], normal)
    steep = cosine > MIN_INCIDENCE_COSINE
    xy, z, ray, piece, normal, to_satellite, distance, cosine = (
        values[steep] for values in (xy, z, ray, piece, normal, to_satellite, distance, cosine))
    arriving = to_satellite.copy()
    arriving[:, :2] -= 2 * cosine[:, None] * normal
    length = distance / cosine
    place = np.column_stack([xy, z]) + length[:, None] * arriving
    beside = np.einsum("ij,ij->i", place[:, :2], along[piece])
    share = _share(walls, piece, place[:, :2])
    low = walls.low[piece, 0] + _part(share, walls.low[piece])
    top = walls.top[piece, 0] + _part(share, walls.top[piece])
    inside = np.minimum.reduce([beside - ends[0][piece], ends[1][piece] - beside, place[:, 2] - low,
                                top - place[:, 2]])
    on_piece = inside >= -margin
    return WallReflections(*(values[on_piece] for values in (ray, piece, place, length, arriving, distance, cosine,
                                                             inside)))


def _share(walls: WallPieces, piece: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """(n,) how far from start (0) to end (1) of their pieces places lie."""
    edge = walls.end[piece] - walls.start[piece]
    return np.einsum("ij,ij->i", xy - walls.start[piece], edge) / np.einsum("ij,ij->i", edge, edge)


def _part(share: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """(n,) height at a share of the length above that at the start; 0 where the edge is at infinity."""
    known = np.isfinite(heights[:, 0])
    return np.where(known, np.clip(share, 0.0, 1.0) * (np.where(known, heights[:, 1], 0.0)
                                                       - np.where(known, heights[:, 0], 0.0)), 0.0)


def _shifted(walls: WallPieces, origin: np.ndarray) -> WallPieces:
    """The walls in coordinates from `origin`, small numbers for exact distances."""
    return WallPieces(walls.start - origin, walls.end - origin, walls.low, walls.top, walls.normal,
                      walls.offset - walls.normal @ origin, walls.building, walls.wall)


def _cells_of(walls: WallPieces, cell: float, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of cells and of the pieces in them, in the order of the pieces."""
    low = np.floor(np.minimum(walls.start, walls.end) / cell - 1e-6).astype(np.int64)
    high = np.floor(np.maximum(walls.start, walls.end) / cell + 1e-6).astype(np.int64)
    low = np.maximum(low, 0)
    width, height = (high - low + 1).T
    count = width * height
    piece = np.repeat(np.arange(len(walls)), count)
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    column = low[piece, 0] + within % width[piece]
    row = low[piece, 1] + within // width[piece]
    middle = (np.column_stack([column, row]) + 0.5) * cell
    normal = walls.normal[piece]
    off = np.abs(np.einsum("ij,ij->i", normal, middle) - walls.offset[piece])
    near = off <= np.abs(normal).sum(axis=1) * cell / 2 + 1e-6 * cell
    return row[near] * columns + column[near], piece[near]
