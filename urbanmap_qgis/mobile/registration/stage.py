"""From a survey's files to its corrected trajectory: markings, windows, one smooth correction (J 3.2.4, chapter 4)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor

from ...errors import InsufficientDataError
from ...io.points.pointcloud import open_cloud
from ...progress import SILENT, Progress
from ...wording import say
from ..calibration import Calibration
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .corrected_path import corrected_path
from .correction.patch_status import DISTRUSTED, REGISTERED
from .register import register_windows
from .registered_survey import RegisteredSurvey, tell_result
from .run import RegistrationRun
from .start.reference import Reference
from .survey_markings import survey_markings
from .walls.witness import WallWitness


def register_survey(paths: Sequence[str | os.PathLike], trajectory: Trajectory, reference: Reference,
                    run: RegistrationRun | None = None, calibration: Calibration | None = None,
                    progress: Progress = SILENT, executor: Executor | None = None,
                    walls: WallWitness | None = None) -> RegisteredSurvey:
    """Register a survey, or the marking points of one, to the reference markings.

    Parameters
    ----------
    paths : LAS, LAZ or COPC files: a survey, or markings as “Road markings of a mobile survey” writes them.
    trajectory : with which the points were placed.
    calibration : of the survey's scanners; not needed for markings.
    walls : a second witness, see `walls_of`.

    Raises
    ------
    InputError : no GPS time, times that do not overlap, or heights of another datum.
    InsufficientDataError : no markings in the survey or near it in the reference, or none that fit.
    """
    run = run or RegistrationRun()
    cloud = open_cloud(paths)
    markings = survey_markings(cloud, trajectory, run.extraction, calibration, progress.part(0.0, 0.6), executor)
    return register_markings(markings, trajectory, reference, run, progress.part(0.6, 1.0), executor, walls)


def register_markings(markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                      run: RegistrationRun | None = None, progress: Progress = SILENT,
                      executor: Executor | None = None, walls: WallWitness | None = None) -> RegisteredSurvey:
    """The same from marking points in the trajectory's time."""
    run = run or RegistrationRun()
    progress.message(say("Registering {markings_count:,} marking points.", markings_count=len(markings)))
    windows = register_windows(markings, trajectory, reference, run.windows, progress.part(0.0, 0.8), executor)
    corrected, correction = corrected_path(windows, markings, trajectory, reference, run, progress.part(0.8, 1.0),
                                           walls)
    survey = RegisteredSurvey(corrected, trajectory, markings, windows, correction)
    by_walls = walls is not None and survey.share(DISTRUSTED) < 1.0
    smooth = run.windows.shared_windows  # the paper moves patches whatever they say: they are told as not to be trusted
    if smooth and not survey.share(REGISTERED) and not correction.steps and not by_walls:
        raise InsufficientDataError(say("No part of the survey could be registered to the reference markings, so "
                                        "that there is no result: check that both show the same roads, and the "
                                        "maximum error."))
    tell_result(survey, progress)
    return survey
