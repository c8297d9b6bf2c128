"""Ties between drives by planes that they share, found after markings have brought them together."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...progress import SILENT, Progress
from ...wording import say
from ..registration.trajectory_stops import stilled
from ..trajectory import Trajectory
from .drive_network import adjust_drives
from .network import NetworkObservations
from .planes import LIMITS, DrivePlanes, plane_ties, planes_of
from .records import AdjustmentRun
from .steps import away_from_steps
from .ties import Drive, pairs_of

_STEP_REACH = 30.0
"""m of path on both sides of a step within which no plane ties."""


def plane_observations(clouds: Sequence[Sequence[str | os.PathLike]], drives: Sequence[Drive],
                       ties: NetworkObservations, run: AdjustmentRun, progress: Progress,
                       placed: Sequence[Trajectory] | None = None) -> NetworkObservations:
    """Ties by planes; drives that share markings are brought together by these first, others by planes themselves.

    Drives as reported lie metres apart: compared within decimetres, planes would tie them where they happen to lie on
    each other. So they are compared from farther first, and the drives brought together by that.

    `placed` : trajectories that walls have brought together already, with or without shared markings.
    """
    progress.message(say("Looking for planes that drives share."))
    reported = [drive.trajectory for drive in drives]
    planes = planes_of(clouds, reported, progress)
    # In a stop planes are seen from places that the trajectory wanders through, while the vehicle does not.
    adjusted = [stilled(trajectory) for trajectory in reported] if placed is None else placed
    if placed is None and len(ties):
        adjusted = _adjusted(drives, ties, run)
    tied, weight = set(pairs_of(ties)), run.registration.correction.time_weight
    level, together = None, tied
    if placed is not None:
        adjusted, level = _levelled(planes, drives, ties, run, adjusted)
        together = None
    if placed is None and len(tied) < len(drives) * (len(drives) - 1) // 2:
        for reach in LIMITS.apart:
            found = plane_ties(planes, reported, adjusted, weight, level, together, reach)
            adjusted = _adjusted(drives, NetworkObservations.joined([ties, found]), run)
    found = plane_ties(planes, reported, adjusted, weight, level, together)
    # Beside a step the drives are not together well enough to tell which planes are the same.
    return found.select(away_from_steps(found, ties, _STEP_REACH))


def _levelled(planes: DrivePlanes, drives: Sequence[Drive], ties: NetworkObservations, run: AdjustmentRun,
              placed: Sequence[Trajectory]) -> tuple[list[Trajectory], set[tuple[int, int]]]:
    """Trajectories that walls have placed in plan, brought together in height by the roads that the drives share, and
    the pairs of drives that are so. Where nothing else ties two drives, their roads may lie a metre apart.
    """
    level = set(pairs_of(ties))
    for reach in LIMITS.apart:
        found = plane_ties(planes, [drive.trajectory for drive in drives], placed,
                           run.registration.correction.time_weight, None, None, reach)
        pairs = np.sort(np.column_stack([found.drive, found.other]), axis=1)
        apart = np.array([tuple(pair) not in level for pair in pairs.tolist()], bool)
        found = found.select(apart & np.isfinite(found.value[:, 2]))
        if not len(found):
            break
        value = found.value.copy()
        value[:, :2] = np.nan
        heights = _adjusted(drives, NetworkObservations.joined([ties, replace(found, value=value)]), run)
        placed = [replace(old, place=np.column_stack([old.place[:, :2], new.place[:, 2]]))
                  for old, new in zip(placed, heights)]
        known = set(pairs_of(found))
    else:
        level |= known
    return list(placed), level


def _adjusted(drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun) -> list[Trajectory]:
    """The drives' trajectories by observations."""
    return [drive.corrected for drive in adjust_drives(drives, observations, run, SILENT).drives]
