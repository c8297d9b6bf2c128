"""Ties between drives by planes that they share, found after markings have brought them together."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...progress import SILENT, Progress
from ...wording import say
from ..trajectory import Trajectory
from .drive_network import adjust_drives
from .network import NetworkObservations
from .planes import plane_ties, planes_of
from .records import AdjustmentRun
from .steps import away_from_steps
from .ties import Drive, pairs_of

_STEP_REACH = 30.0
"""m of path on both sides of a step within which no plane ties."""


def plane_observations(clouds: Sequence[Sequence[str | os.PathLike]], drives: Sequence[Drive],
                       ties: NetworkObservations, run: AdjustmentRun, progress: Progress,
                       placed: Sequence[Trajectory] | None = None) -> NetworkObservations:
    """Ties by planes; drives that share markings are brought together by these first.

    `placed` : trajectories that walls have brought together already, with or without shared markings.
    """
    progress.message(say("Looking for planes that drives share."))
    reported = [drive.trajectory for drive in drives]
    planes = planes_of(clouds, reported, progress)
    adjusted = reported if placed is None else placed
    if placed is None and len(ties):
        preliminary = adjust_drives(drives, ties, run, SILENT)
        adjusted = [drive.corrected for drive in preliminary.drives]
    # Walls place drives in plan only: where nothing else ties two of them, their roads may lie a metre apart.
    level = None if placed is None else set(pairs_of(ties))
    found = plane_ties(planes, reported, adjusted, run.registration.correction.time_weight, level)
    # Beside a step the drives are not together well enough to tell which planes are the same.
    return found.select(away_from_steps(found, ties, _STEP_REACH))
