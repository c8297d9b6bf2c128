"""Facades of several drives on the walls of buildings: a second witness beside markings and control (J 6.2).

A facade that a drive saw stands inside the outline of its building by eaves and what the outline is off by. The mean of
it is one unknown of all drives; what a building differs from it by, and a wall from its building, are unknowns too: a
wall that was passed often tells of its place once, but ties all that saw it. Their size is found from the walls.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import InsufficientDataError
from ...io.points.pointcloud import PointCloud
from ...progress import SILENT, Progress
from ...wording import say
from ..registration.walls.facade_planes import FacadePlanes, facade_planes
from ..registration.walls.laser_walls import laser_walls
from ..registration.walls.outline_walls import LIMITS as OUTLINES
from ..registration.walls.outline_walls import WallEdges
from ..registration.walls.witness import LIMITS as WITNESS
from .drive_network import adjust_drives
from .network import NONE, REFERENCE, WALL, NetworkObservations
from .plane_observations import plane_observations
from .records import AdjustedDrive, AdjustedSurvey, AdjustmentRun
from .ties import Drive


@dataclass(frozen=True)
class WallObservationLimits:
    """Limits of walls as observations of drives, each with its unit."""

    piece: float = 10.0  # m of path between observations of one wall
    rounds: int = 8  # at most, in which walls are matched anew, until the drives move by less than `settled` m
    settled: float = 0.02
    unknown: float = 10.0  # m, along a wall
    differ: tuple[float, float] = (0.3, 0.1)  # m, of buildings, and of walls from their building, at first
    least: tuple[float, float] = (0.03, 0.03)


LIMITS = WallObservationLimits()


@dataclass(frozen=True)
class BuildingWalls:
    """Walls of buildings that drives are laid on.

    Attributes
    ----------
    edges : of their outlines; None where they are looked for in airborne points.
    alone : whether walls place the drives without the reference markings, which give the start only.
    laser : airborne points, where no outlines are given.
    """

    edges: WallEdges | None
    alone: bool = False
    laser: PointCloud | None = None


@dataclass(frozen=True)
class DriveWalls:
    """The walls of buildings, and the facades that each drive saw.

    Attributes
    ----------
    buildings : with their edges.
    planes : of each drive, as reported.
    """

    buildings: BuildingWalls
    planes: tuple[FacadePlanes, ...]

    def adjusted(self, drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun,
                 progress: Progress) -> AdjustedSurvey:
        """The drives adjusted with walls beside other observations, matched anew until the drives stay.

        Raises
        ------
        InsufficientDataError : no facade belongs to a building, and nothing else is left.
        """
        survey = adjust_drives(drives, observations, run, SILENT) if len(observations) else None
        others = observations.select(observations.kind != REFERENCE) if self.buildings.alone else observations
        corrections = [_reported] * len(drives) if survey is None else [_Course(item, run) for item in survey.drives]
        eaves, differ, seen = OUTLINES.inside[0], LIMITS.differ, others
        for _ in range(LIMITS.rounds):
            seen = NetworkObservations.joined([others, *self._observations(corrections, eaves)])
            if not len(seen):
                raise InsufficientDataError(say("No facade of the drives belongs to a building, and nothing else ties "
                                                "them: check that buildings and drives show the same streets."))
            last, survey = survey, adjust_drives(drives, seen, run, SILENT, differ)
            corrections = [_Course(item, run) for item in survey.drives]
            eaves = float(np.clip(OUTLINES.inside[0] + survey.network.offset, *OUTLINES.possible))
            differ = _within(survey.network.differ)
            if last is not None and _moved(last, survey) < LIMITS.settled:
                break
        progress.message(say("Facades stand {eaves:.2f} m inside the outlines in the mean, and differ from it by "
                             "{differ:.2f} m.", eaves=eaves, differ=float(np.hypot(*differ))))
        return adjust_drives(drives, seen, run, progress, differ)

    def _observations(self, corrections: Sequence, eaves: float) -> list[NetworkObservations]:
        """What walls say about courses of the drives."""
        facades = [_MatchedFacades.of(number, planes, correction, self.buildings.edges, eaves)
                   for number, (planes, correction) in enumerate(zip(self.planes, corrections))]
        return [item.rows(self.buildings.edges) for item in facades]


def _within(differ: tuple[float, float]) -> tuple[float, float]:
    """m, by which buildings and their walls differ, within what is possible."""
    buildings, walls = (float(np.clip(size, least, WITNESS.differ[2])) for size, least in zip(differ, LIMITS.least))
    return buildings, walls


def walls_of_drives(buildings: BuildingWalls, clouds: Sequence[Sequence[str | os.PathLike]], drives: Sequence[Drive],
                    run: AdjustmentRun, progress: Progress) -> DriveWalls:
    """The walls with the facades that the drives' files show.

    Raises
    ------
    InsufficientDataError : no drive shows a facade.
    """
    progress.message(say("Looking for facades on the walls of buildings."))
    planes = tuple(facade_planes(paths, drive.trajectory, run.path_parameters(drive.trajectory),
                                 progress.part(number / len(drives), (number + 1) / len(drives)))
                   for number, (paths, drive) in enumerate(zip(clouds, drives)))
    if not any(len(item) for item in planes):
        raise InsufficientDataError(say("The drives show no facade near the vehicle: give all their points, not "
                                        "the markings alone, or adjust them without buildings."))
    if buildings.edges is None:
        buildings = replace(buildings, edges=_laser_walls(planes, buildings.laser, [drive.name for drive in drives],
                                                          progress))
    return DriveWalls(buildings, planes)


def _laser_walls(planes: Sequence[FacadePlanes], laser: PointCloud, names: Sequence[str],
                 progress: Progress) -> WallEdges:
    """The walls that airborne points show beside the facades of any drive, each once: of the first drive that saw it.

    The drives without one are told by their names.

    Raises
    ------
    InsufficientDataError : there is none.
    """
    found: list[WallEdges] = []
    bare: list[str] = []
    missing = None
    for item, name in zip(planes, names):
        try:
            edges = laser_walls(item, laser) if len(item) else None
        except InsufficientDataError as error:
            edges, missing = None, error
        if edges is None:
            bare.append(name)
        else:
            found.append(edges.select(~np.any([edges.on(other) for other in found], axis=0)) if found else edges)
    if not found:
        raise missing
    if bare:
        progress.warn(say("No wall of the airborne laser points beside {drives}: the other drives' walls are used.",
                          drives=", ".join(bare)))
    return found[0].with_others(found[1:])


def adjust_with_walls(walls: DriveWalls | None, clouds: Sequence[Sequence[str | os.PathLike]],
                      drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun,
                      progress: Progress) -> AdjustedSurvey:
    """The drives adjusted, with walls where given: these bring drives together that share no markings, so that planes
    tie them.
    """
    if walls is None:
        return adjust_drives(drives, observations, run, progress)
    if run.planes:
        placed = [drive.corrected for drive in walls.adjusted(drives, observations, run, SILENT).drives]
        observations = NetworkObservations.joined([
            observations, plane_observations(clouds, drives, observations, run, progress, placed)])
    return walls.adjusted(drives, observations, run, progress)


def _reported(path_parameter: np.ndarray) -> np.ndarray:
    """No correction (n, 6) at path parameters (n,)."""
    return np.zeros((len(path_parameter), 6))


class _Course:
    """The correction (n, 6), m and degrees, of an adjusted drive at path parameters (n,)."""

    def __init__(self, drive: AdjustedDrive, run: AdjustmentRun):
        before, after = drive.reported, drive.corrected
        self.parameter = run.path_parameters(before)
        self.correction = np.column_stack([after.place - before.place, after.angles - before.angles])

    def __call__(self, path_parameter: np.ndarray) -> np.ndarray:
        return np.column_stack([np.interp(path_parameter, self.parameter, axis) for axis in self.correction.T])


def _moved(before: AdjustedSurvey, after: AdjustedSurvey) -> float:
    """m in plan, largest change of the drives' corrections."""
    return max(float(np.hypot(*(new.correction - old.correction)[:, :2].T).max())
               for old, new in zip(before.drives, after.drives))


@dataclass(frozen=True)
class _MatchedFacades:
    """Planes of the drive `number` that belong to outlines.

    Attributes
    ----------
    edge : (n,) number of the edge.
    outward : (n, 2) of it.
    outside : (n,) m that the plane lies outside of it, about the course.
    value : (n,) m, by which it must move outwards for the mean offset: `outside` is taken out of what the course moves.
    """

    number: int
    planes: FacadePlanes
    edge: np.ndarray
    outward: np.ndarray
    outside: np.ndarray
    value: np.ndarray

    @classmethod
    def of(cls, number: int, planes: FacadePlanes, course, edges: WallEdges, eaves: float) -> _MatchedFacades:
        """About a course, with facades `eaves` m inside."""
        place = planes.translated(course)
        edge, outside = edges.matched(place, planes.normal, eaves)
        known = edge >= 0
        known[known] = np.bincount(edge[known], minlength=len(edges))[edge[known]] >= WITNESS.fewest
        outward = edges.outward[edge[known]]
        moved = ((place - planes.place[:, :2])[known] * outward).sum(axis=1)
        return cls(number, planes.select(known), edge[known], outward, outside[known],
                   moved - outside[known] - OUTLINES.inside[0])

    def rows(self, edges: WallEdges) -> NetworkObservations:
        """One observation a piece of a wall; with their edges."""
        if not len(self.edge):
            return NetworkObservations.none()
        key = np.column_stack([self.edge, (self.planes.path_parameter // LIMITS.piece).astype(int)])
        _, first, piece, size = np.unique(key, axis=0, return_index=True, return_inverse=True, return_counts=True)
        piece, n, outward, nothing = piece.ravel(), len(size), self.outward[first], np.zeros((len(size), 2))

        def mean(values: np.ndarray) -> np.ndarray:
            return np.bincount(piece, values) / size

        value = np.full((n, 4), np.nan)
        value[:, :2] = mean(self.value)[:, None] * outward
        covariance = np.tile(np.eye(4), (n, 1, 1))
        along = np.column_stack([-outward[:, 1], outward[:, 0]])
        covariance[:, :2, :2] = (WITNESS.floor**2 * outward[:, :, None] * outward[:, None, :]
                                 + LIMITS.unknown**2 * along[:, :, None] * along[:, None, :])
        arm = np.column_stack([mean(axis) for axis in self.planes.lever_arm[:, :2].T])
        return NetworkObservations(np.full(n, self.number), mean(self.planes.path_parameter), arm, np.full(n, NONE),
                                   np.zeros(n), nothing, value, covariance, np.full(n, WALL), outward,
                                   np.column_stack([edges.building[self.edge[first]], self.edge[first]]),
                                   edges.sigma[self.edge[first]])
