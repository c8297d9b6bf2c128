"""Ties: where two drives, or one drive twice, saw the same markings, and how far apart they put them.

Each drive is cut into passes on which it visits no place twice. A pass is registered to the marking points of an
earlier one as to any reference (J 3.2.4): where that is sure, the difference of the two corrections is known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InsufficientDataError
from ...progress import SILENT, Progress
from ...wording import say
from ..markings.records import MarkingPoints
from ..passes import BlockPositions
from ..registration.correction.patch_status import REGISTERED
from ..registration.registered_survey import RegisteredSurvey
from ..registration.run import RegistrationRun
from ..registration.stage import register_markings
from ..registration.start.reference import Reference
from ..registration.trajectory_stops import path_parameters_of
from ..trajectory import Trajectory, interpolate
from .network import NONE, REFERENCE, RELATIVE_KINDS, TIE, NetworkObservations
from .point_reference import PointReference

SPACING = 10.0
"""m of path between ties."""


@dataclass(frozen=True)
class TiesLimits:
    """Limits of ties, each with its unit."""

    window: float = 30.0  # m over which neighbouring patches share their markings (J Table 3-2: 60 patches of 0.5 m)
    near: float = 12.0  # m from the vehicle to the markings by which it is found when the other drive passed
    fewest: int = 20  # marking points there
    shared: float = 0.02  # of a pass's cells that must be near another pass's to compare the two
    cell: float = 5.0  # m, of that comparison


LIMITS = TiesLimits()

_ACTIVE = [0, 1, 2, 5]


@dataclass(frozen=True)
class Drive:
    """A drive as reported.

    Attributes
    ----------
    name : for messages.
    trajectory : reported.
    markings : its marking points, as reported, in the trajectory's time.
    """

    name: str
    trajectory: Trajectory
    markings: MarkingPoints


@dataclass(frozen=True)
class DrivePass:
    """A part of a drive on which it comes to no place twice: number of the drive, and its marking points."""

    drive: int
    markings: MarkingPoints


def passes_of(drives: Sequence[Drive]) -> list[DrivePass]:
    """The passes of all drives that have marking points, in the order driven."""
    found = []
    for number, drive in enumerate(drives):
        markings = drive.markings
        places = BlockPositions()
        places.add(markings.x, markings.y, markings.time)
        number_of = places.passes().of(markings.time)
        found += [DrivePass(number, markings.select(number_of == k)) for k in np.unique(number_of)]
    return found


def tie_drives(drives: Sequence[Drive], run: RegistrationRun, progress: Progress = SILENT) -> NetworkObservations:
    """Ties between all passes that saw the same streets.

    A pass of a few metres, or one whose markings do not meet another's, gives none; that is no error.
    """
    passes = passes_of(drives)
    pairs = [(a, b) for a, b in combinations(range(len(passes)), 2) if _share_streets(passes[a], passes[b], run)]
    found = []
    for number, (a, b) in enumerate(pairs):
        part = progress.part(number / len(pairs), (number + 1) / len(pairs))
        found.append(_tie(drives, passes[a], passes[b], run, part))
    return NetworkObservations.joined(found)


def reference_observations(drives: Sequence[Drive], reference: Reference, run: RegistrationRun,
                           progress: Progress = SILENT) -> NetworkObservations:
    """Corrections of the drives by the reference markings, where they are registered."""
    run = replace(run, windows=replace(run.windows, three_d=reference.has_heights))
    found = []
    for number, drive in enumerate(drives):
        part = progress.part(number / len(drives), (number + 1) / len(drives))
        registration = _registered(drive.markings, drive.trajectory, reference, run, part)
        if registration is None:
            progress.warn(say("No marking of {drive} could be registered to the reference markings.", drive=drive.name))
            continue
        patches = _chosen(registration)
        found.append(_observations(registration, patches, number, drive, NONE, np.zeros(len(patches)),
                                   np.zeros((len(patches), 2)), REFERENCE, run.correction.time_weight))
    return NetworkObservations.joined(found)


def _share_streets(first: DrivePass, second: DrivePass, run: RegistrationRun) -> bool:
    """Whether the passes' markings lie near each other, as far as the reported places tell."""
    cells = [np.unique(np.floor(np.column_stack([item.markings.x, item.markings.y]) / LIMITS.cell), axis=0)
             for item in (first, second)]
    near = cKDTree(cells[0]).query(cells[1], distance_upper_bound=run.windows.search / LIMITS.cell + 1.0)[0]
    return float(np.isfinite(near).mean()) > LIMITS.shared


def _tie(drives: Sequence[Drive], first: DrivePass, second: DrivePass, run: RegistrationRun,
         progress: Progress) -> NetworkObservations:
    """Ties of the second pass to the first."""
    drive = drives[second.drive]
    run = replace(run, windows=replace(run.windows, three_d=True),
                  correction=replace(run.correction, reference_steps=False))
    registration = _registered(second.markings, _cut(drive.trajectory, second.markings),
                               PointReference.of(first.markings), run, progress)
    if registration is None:
        return NetworkObservations.none()
    patches = _chosen(registration)
    place = (registration.windows.place + registration.correction.value[:, :3])[patches]
    time = _times_of_passing(first.markings, place)
    patches, place, time = (values[np.isfinite(time)] for values in (patches, place, time))
    other = drives[first.drive]
    parameter = np.interp(time, other.trajectory.time, path_parameters_of(other.trajectory, run.correction.time_weight))
    arm = place[:, :2] - interpolate(other.trajectory, time).place[:, :2]
    return _observations(registration, patches, second.drive, drive, first.drive, parameter, arm, TIE,
                         run.correction.time_weight)


def _registered(markings: MarkingPoints, trajectory: Trajectory, reference, run: RegistrationRun,
                progress: Progress) -> RegisteredSurvey | None:
    """The registration, or None where the two have no marking in common."""
    silent = replace(progress, message=_ignored, warn=_ignored)
    try:
        return register_markings(markings, trajectory, reference, run, silent)
    except InsufficientDataError:
        return None


def _ignored(_text: str) -> None:
    """What is said of a single pair tells the user nothing of the whole."""


def _cut(trajectory: Trajectory, markings: MarkingPoints) -> Trajectory:
    """The part of a trajectory in which markings were measured, with an epoch to either side."""
    first, last = np.searchsorted(trajectory.time, [markings.time.min(), markings.time.max()])
    part = slice(max(first - 1, 0), last + 2)
    return Trajectory(trajectory.time[part], trajectory.place[part], trajectory.angles[part])


def _chosen(registration: RegisteredSurvey) -> np.ndarray:
    """Numbers of registered patches, one in each `SPACING` of the path."""
    registered = np.flatnonzero(registration.correction.status == REGISTERED)
    piece = np.floor(registration.correction.chainage[registered] / SPACING).astype(int)
    _, first, count = np.unique(piece, return_index=True, return_counts=True)
    return registered[first + count // 2]


def _observations(registration: RegisteredSurvey, patches: np.ndarray, number: int, drive: Drive, other: int,
                  other_parameter: np.ndarray, other_arm: np.ndarray, kind: int,
                  standing: float) -> NetworkObservations:
    """Rows for patches of a registration; those of one window share markings, which widens them."""
    correction, n = registration.correction, len(patches)
    value = correction.value[patches][:, _ACTIVE]
    covariance = correction.covariance[patches][:, _ACTIVE][:, :, _ACTIVE] * (LIMITS.window / SPACING)
    if not correction.three_d:
        value[:, 2] = np.nan
    parameter = np.interp(correction.time[patches], drive.trajectory.time,
                          path_parameters_of(drive.trajectory, standing))
    return NetworkObservations(np.full(n, number), parameter, np.zeros((n, 2)), np.full(n, other), other_parameter,
                               other_arm, value, covariance, np.full(n, kind))


def _times_of_passing(markings: MarkingPoints, place: np.ndarray) -> np.ndarray:
    """When a pass measured the markings around places (n, 3); NaN where it measured too few."""
    tree = cKDTree(np.column_stack([markings.x, markings.y]))
    return np.array([np.median(markings.time[near]) if len(near) >= LIMITS.fewest else np.nan
                     for near in tree.query_ball_point(place[:, :2], LIMITS.near)])


def pairs_of(observations: NetworkObservations) -> Iterator[tuple[int, int]]:
    """Pairs of drives that are tied, each once."""
    tied = np.isin(observations.kind, RELATIVE_KINDS)
    yield from sorted({tuple(sorted(pair)) for pair in zip(observations.drive[tied].tolist(),
                                                           observations.other[tied].tolist())})
