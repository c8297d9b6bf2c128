"""Plane ties: facades and road that two passes saw, where they are told apart by their markings' adjustment already.

Small planes (cells of 0.8 m) of two passes that lie on each other must coincide along their normal. Over each piece of
a pass they give one observation of the difference of two corrections: well known across the facades and in height,
hardly along a street of even walls.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from ...io.points.pointcloud import iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ..boresight.plane_patches import PatchSearch, PlanePatches, group_pairs
from ..gps_time import time_shift
from ..markings.extraction import WEIGHT
from ..passes import BlockPositions
from ..registration.trajectory_stops import path_parameters_of, standing_variance
from ..trajectory import Trajectory, interpolate, move_points
from .network import PLANE, NetworkObservations


@dataclass(frozen=True)
class AdjustmentPlanesLimits:
    """Limits of adjustment planes, each with its unit."""

    piece: float = 10.0  # m of path between plane ties.
    reach: float = 25.0  # m from the vehicle; farther planes turn with its heading
    # m between middles of two planes that are compared, and along the normal, where more is another plane
    together: tuple[float, float] = (0.6, 0.25)  # of drives that lie on each other
    apart: tuple[tuple[float, float], ...] = ((3.0, 2.5), (1.5, 0.8))  # of drives as reported, in turn
    passes: int = 8
    of_kind: int = 6  # planes of one direction from which their scatter can be told
    candidates: int = 12  # nearest planes among which the first parallel one is taken
    fewest: int = 12  # planes of a tie
    upright: float = 0.12  # of a facade's normal, at most upwards: 7 degrees
    sigma: float = 0.015  # m, of two planes against each other: structure of facades, and their normals
    # m east, north, up of a tie, however many planes it has: facades turn with roll and pitch
    floor: tuple[float, ...] = 0.03, 0.03, 0.01
    unknown: float = 10.0  # m, along what the planes say nothing about


LIMITS = AdjustmentPlanesLimits()

_PARALLEL = np.cos(np.radians(8.0))
_ALIKE = np.cos(np.radians(10.0))  # of facades that face one way


@dataclass(frozen=True)
class DrivePlanes:
    """Planes of all drives as the reported trajectories place them.

    Attributes
    ----------
    patches : their group is the number of the pass, over all drives.
    drive : (passes,) number of each pass's drive.
    """

    patches: PlanePatches
    drive: np.ndarray


def planes_of(clouds: Sequence[Sequence[str | os.PathLike]], trajectories: Sequence[Trajectory],
              progress: Progress = SILENT) -> DrivePlanes:
    """The planes that each pass of each drive saw near it; none of clouds that hold markings alone."""
    search, drive = PatchSearch(trajectories[0].place[0]), []
    for number, (paths, trajectory) in enumerate(zip(clouds, trajectories)):
        cloud = open_cloud(paths)
        if cloud.has_dimension(WEIGHT):
            continue
        positions = BlockPositions()
        positions.add(trajectory.place[:, 0], trajectory.place[:, 1], trajectory.time)
        passes, shift = positions.passes(), time_shift(cloud, trajectory)
        step = progress.part(number / len(clouds), (number + 1) / len(clouds))
        for chunk in iter_chunks(cloud, step):
            time = np.asarray(chunk.gps_time) + shift
            points = np.column_stack([chunk.x, chunk.y, chunk.z])
            usable = trajectory.within(time) & np.isfinite(points).all(axis=1)
            place = interpolate(trajectory, time[usable]).place
            usable[usable] = np.linalg.norm(points[usable] - place, axis=1) <= LIMITS.reach
            search.add(points[usable], time[usable], len(drive) + passes.of(time[usable]))
        drive += [number] * passes.count
    return DrivePlanes(search.patches(), np.array(drive, int))


def plane_ties(planes: DrivePlanes, reported: Sequence[Trajectory], adjusted: Sequence[Trajectory],
               time_weight: float, level: Collection[tuple[int, int]] | None = None,
               together: Collection[tuple[int, int]] | None = None,
               reach: tuple[float, float] = LIMITS.together) -> NetworkObservations:
    """Ties by planes between all pairs of passes.

    Parameters
    ----------
    adjusted : trajectories by which the drives agree to better than `reach`.
    time_weight : of the path's parameter, see `gauss_markov`.
    level : pairs of drives, the lower number first, that agree in height too; of others only facades are compared.
        None for all.
    together : pairs of drives that something else than planes has brought together. Of others only what lies across
        most of their facades counts: along a street one pillar or front looks like the next. None for all.
    reach : m between middles of two planes that are compared, and along their normal.
    """
    patches, moved = planes.patches, planes.patches.centroid.copy()
    for number, (before, after) in enumerate(zip(reported, adjusted)):
        of_drive = planes.drive[patches.group] == number if len(patches) else np.zeros(0, bool)
        # A mean of times may be rounded beyond the last one.
        time = np.clip(patches.time[of_drive], before.time[0], before.time[-1])
        moved[of_drive] = move_points(patches.centroid[of_drive], time, before, after)
    parameters = [path_parameters_of(trajectory, time_weight) for trajectory in reported]
    parts = []
    for first, second in group_pairs(patches.group):
        pair = _Pair(planes, moved, first, second, reported, adjusted, parameters, level, together, reach)
        parts += [pair.tie(piece) for piece in pair.pieces()]
    return NetworkObservations.joined([part for part in parts if part is not None])


def _directions(normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) 0, 1, 2: facades that face as most of them do, facades across these, and road, by unit vectors (n, 3); and
    the direction in plan (2,) along which the first ones run.

    At a corner as many face one way as the other: the mean of all would lie between both, so the largest set counts.
    """
    upright = np.abs(normal[:, 2]) <= LIMITS.upright
    kind = np.where(upright, 1, 2)
    if not upright.any():
        return kind, np.array([1.0, 0.0])
    plan = normal[upright, :2]
    alike = np.abs(plan @ plan.T) > _ALIKE
    most = plan[alike[np.argmax(alike.sum(axis=1))]]
    along, facing = np.linalg.eigh(most.T @ most)[1].T
    kind[upright] = (np.abs(plan @ facing) <= np.sqrt(0.5)).astype(int)
    return kind, along


def _scatter(off: np.ndarray) -> float:
    """m, standard deviation of planes by what is left of them (n,) m; `unknown` of too few."""
    if len(off) < LIMITS.of_kind:
        return LIMITS.unknown
    return max(SIGMA_OF_MAD * float(np.median(off)), LIMITS.sigma)


def _nearest_parallel(ones: tuple[np.ndarray, ...], others: tuple[np.ndarray, ...],
                      near: float) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of planes and of the nearest parallel ones of others, for those that have one within `near` m.

    `ones`, `others` : places and normals (n, 3), and numbers (n,).
    """
    distance, place = cKDTree(others[0]).query(ones[0], k=min(LIMITS.candidates, len(others[0])),
                                               distance_upper_bound=near)
    distance, place = (part.reshape(len(ones[0]), -1) for part in (distance, place))
    found = np.isfinite(distance)
    cosine = np.abs(np.einsum("ni,nji->nj", ones[1], others[1][np.where(found, place, 0)]))
    parallel = found & (cosine >= _PARALLEL)
    some = parallel.any(axis=1)
    first = np.argmax(parallel, axis=1)
    return ones[2][some], others[2][place[some, first[some]]]


class _Pair:
    """Planes that two passes have in common, by pieces of the first one."""

    def __init__(self, planes: DrivePlanes, moved: np.ndarray, first: int, second: int,
                 reported: Sequence[Trajectory], adjusted: Sequence[Trajectory], parameters: Sequence[np.ndarray],
                 level: Collection[tuple[int, int]] | None, together: Collection[tuple[int, int]] | None = None,
                 reach: tuple[float, float] = LIMITS.together):
        self.drives = int(planes.drive[first]), int(planes.drive[second])
        self.reported, self.adjusted = ([each[k] for k in self.drives] for each in (reported, adjusted))
        self.parameters = [parameters[k] for k in self.drives]
        patches = planes.patches
        one, other = (np.flatnonzero(patches.group == group) for group in (first, second))
        one, other = _nearest_parallel((moved[one], patches.normal[one], one), (moved[other], patches.normal[other],
                                                                                other), reach[0])
        cosine = (patches.normal[one] * patches.normal[other]).sum(axis=1)
        normal = patches.normal[one] + np.sign(cosine)[:, None] * patches.normal[other]
        normal /= np.maximum(np.linalg.norm(normal, axis=1), LEAST_DIVISOR)[:, None]
        # By so much the first pass must move more than the second, along the normal.
        gap = ((moved[other] - moved[one]) * normal).sum(axis=1)
        good = np.abs(gap) <= reach[1]
        pair = tuple(sorted(self.drives))
        self.level, tied = (some is None or pair[0] == pair[1] or pair in some for some in (level, together))
        self.apart = not tied
        if not self.level:
            good &= np.abs(normal[:, 2]) <= LIMITS.upright
        self.normal, self.gap, self.place = normal[good], gap[good], moved[one][good]
        self.time = [patches.time[some][good] for some in (one, other)]
        self.along = np.interp(self.time[0], self.reported[0].time, self.parameters[0])

    def pieces(self) -> list[np.ndarray]:
        """Numbers of the planes of each piece of the first pass."""
        piece = np.floor(self.along / LIMITS.piece)
        order = np.argsort(piece, kind="stable")
        return np.split(order, np.flatnonzero(np.diff(piece[order])) + 1) if len(order) else []

    def tie(self, some: np.ndarray) -> NetworkObservations | None:
        """One observation by some of the planes; None where they are too few."""
        normal, distance = self.normal[some], self.gap[some]
        if len(some) < LIMITS.fewest:
            return None
        kind, along = _directions(normal)
        weight = np.where((kind == 1) & self.apart, 0.0, LIMITS.sigma**-2.0)
        if self.apart or np.count_nonzero(kind == 1) < LIMITS.of_kind:  # slanting normals tell nothing along a street
            even = kind != 1
            normal[even, :2] -= np.outer(normal[even, :2] @ along, along)
        for _ in range(LIMITS.passes):
            information = (normal * weight[:, None]).T @ normal + np.eye(3) / LIMITS.unknown**2
            shift = np.linalg.solve(information, (normal * weight[:, None]).T @ distance)
            off = np.abs(distance - normal @ shift)
            scatter = np.array([_scatter(off[kind == number]) for number in range(3)])[kind]
            weight = 1.0 / (scatter**2 * (1.0 + (off / (3.0 * scatter)) ** 2))
            weight[(kind == 1) & self.apart] = 0.0
        covariance = np.eye(4)
        covariance[:3, :3] = np.linalg.inv(information) + np.diag(LIMITS.floor) ** 2
        covariance[:2, :2] += self._moved_within(some) * np.eye(2)
        return self._observation(some, shift, covariance)

    @cached_property
    def _standing(self) -> list[np.ndarray]:
        """(e,) m2 of each of the two drives, see `standing_variance`."""
        return [standing_variance(trajectory) for trajectory in self.reported]

    def _moved_within(self, some: np.ndarray) -> float:
        """m2, of what the vehicles may have moved unseen between the planes of a tie: it has one time of each."""
        variance = 0.0
        for number in (0, 1):
            time = self.time[number][some]
            seen, middle = (np.interp(at, self.reported[number].time, self._standing[number])
                            for at in (time, np.median(time)))
            variance += float(np.abs(seen - middle).mean())
        return variance

    def _observation(self, some: np.ndarray, shift: np.ndarray, covariance: np.ndarray) -> NetworkObservations:
        """The row of a tie: what the adjusted trajectories say of its place already, and the shift."""
        place, value, parameter, arm = self.place[some].mean(axis=0), shift.copy(), [], []
        for sign, number in ((1.0, 0), (-1.0, 1)):
            before, after = self.reported[number], self.adjusted[number]
            time = np.clip([np.median(self.time[number][some])], before.time[0], before.time[-1])
            parameter.append(np.interp(time, before.time, self.parameters[number]))
            body = interpolate(after, time)
            arm.append((place - body.place[0])[None, :2])
            value += sign * (body.place[0] - interpolate(before, time).place[0] + _turned(before, after, time, arm[-1]))
        if not self.level:
            value[2] = np.nan  # facades say nothing of heights
        return NetworkObservations(np.array([self.drives[0]]), parameter[0], arm[0], np.array([self.drives[1]]),
                                   parameter[1], arm[1], np.append(value, np.nan)[None], covariance[None],
                                   np.array([PLANE]))


def _turned(before: Trajectory, after: Trajectory, time: np.ndarray, arm: np.ndarray) -> np.ndarray:
    """How the change of heading (clockwise) moves a place at an arm (1, 2) from the body, (3,) m."""
    heading = np.radians(interpolate(after, time).angles[0, 2] - interpolate(before, time).angles[0, 2])
    return heading * np.array([arm[0, 1], -arm[0, 0], 0.0])
