"""From several drives to one adjusted network: ties, control and reference in, a correction for each drive out."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...errors import InsufficientDataError
from ...progress import SILENT, Progress
from ...wording import say
from ..calibration import Calibration
from ..control import ControlPoints
from ..registration.start.reference import Reference
from ..trajectory import Trajectory
from .control_ties import control_observations
from .drive_clouds import read_drives
from .network import NetworkObservations
from .plane_observations import plane_observations
from .records import AdjustedSurvey, AdjustmentRun
from .ties import reference_observations, tie_drives
from .wall_observations import BuildingWalls, adjust_with_walls, walls_of_drives


def adjust_surveys(clouds: Sequence[Sequence[str | os.PathLike]], trajectories: Sequence[Trajectory],
                   names: Sequence[str], control: ControlPoints | None = None, reference: Reference | None = None,
                   run: AdjustmentRun | None = None, calibration: Calibration | None = None,
                   progress: Progress = SILENT, buildings: BuildingWalls | None = None) -> AdjustedSurvey:
    """Adjust several drives at once.

    Parameters
    ----------
    clouds : the files of each drive: surveys, or markings as “Road markings of a mobile survey” writes them.
    control : points of any of the drives; each is taken to be of the drive that was nearest at its time.
    buildings : on whose walls the facades that the drives saw are laid too.

    Raises
    ------
    InsufficientDataError : nothing ties the drives to each other, to control, a reference or walls.
    """
    run = run or AdjustmentRun()
    drives = read_drives(clouds, trajectories, names, run, calibration, progress.part(0.0, 0.5))
    progress.message(say("Looking for markings that drives share."))
    found = [tie_drives(drives, run.registration, progress.part(0.5, 0.8))]
    if run.planes and buildings is None:
        found.append(plane_observations(clouds, drives, found[0], run, progress.part(0.8, 0.9)))
    if reference is not None:
        found.append(reference_observations(drives, reference, run.registration, progress.part(0.9, 0.95)))
    if control is not None:
        found.append(control_observations(drives, control, run))
    observations = NetworkObservations.joined(found)
    if buildings is None and not len(observations):
        raise InsufficientDataError(say("The drives share no markings and planes, and no control point or reference "
                                        "marking fits them: nothing can be adjusted."))
    walls = None if buildings is None else walls_of_drives(buildings, clouds, drives, run, progress.part(0.95, 1.0))
    return adjust_with_walls(walls, clouds, drives, observations, run, progress)
