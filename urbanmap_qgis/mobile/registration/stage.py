"""From a survey's files to its corrected trajectory: markings, windows, one smooth correction (J 3.2.4, chapter 4)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

import numpy as np

from ...errors import InsufficientDataError
from ...io.points.pointcloud import open_cloud
from ...progress import SILENT, Progress
from ...wording import say
from ..calibration import Calibration
from ..markings.extraction import ExtractionSettings
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .correction.adjustment import Correction, CorrectionSettings, adjust_correction, correct_trajectory
from .correction.gauss_markov import path_parameters_of
from .correction.moved_markings import LEAST_BELIEVED, moved_markings, with_moved
from .correction.patch_status import BRIDGED, DISTRUSTED, REGISTERED, STATUS_NAMES
from .correction.patchwise import correct_patchwise, patchwise_correction
from .correction.point_observations import PointObservations
from .records import RegistrationSettings, WindowResults
from .register import register_windows
from .registered_survey import RegisteredSurvey, unregistered_sections
from .start.reference import Reference
from .survey_markings import survey_markings
from .walls.witness import WallWitness


@dataclass(frozen=True)
class RegistrationRun:
    """How a survey is registered.

    Attributes
    ----------
    windows : of the windows.
    correction : of the adjustment.
    extraction : of markings, where a survey is given.
    """

    windows: RegistrationSettings = field(default_factory=RegistrationSettings)
    correction: CorrectionSettings = field(default_factory=CorrectionSettings)
    extraction: ExtractionSettings = field(default_factory=ExtractionSettings)


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
    if run.windows.shared_windows:
        correction = _smooth_correction(windows, markings, trajectory, reference, run, progress.part(0.8, 1.0), walls)
        corrected = correct_trajectory(trajectory, correction)
    else:
        correction = patchwise_correction(windows, run.correction)
        corrected = correct_patchwise(trajectory, windows, run.windows.patch_length)
    survey = RegisteredSurvey(corrected, trajectory, markings, windows, correction)
    held = walls is not None and survey.share(DISTRUSTED) < 1.0
    if not survey.share(REGISTERED) and not correction.steps and not held:
        raise InsufficientDataError(say("No part of the survey could be registered to the reference markings, so "
                                        "that there is no result: check that both show the same roads, and the "
                                        "maximum error."))
    _tell(survey, progress)
    return survey


def _smooth_correction(windows: WindowResults, markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                       run: RegistrationRun, progress: Progress, walls: WallWitness | None) -> Correction:
    """One smooth correction from the windows' results and the points themselves."""
    path_parameter = path_parameters_of(trajectory, run.correction.time_weight)
    points = None
    if run.windows.refinement:
        points = PointObservations.of(markings, trajectory, path_parameter, run.correction.node_length, reference,
                                      run.windows)
    settings = replace(run.correction, search=windows.search) if run.windows.start else run.correction
    if points is None:
        return adjust_correction(windows, trajectory, settings, None, progress)
    correction = adjust_correction(windows, trajectory, settings, points.about, progress, walls)
    believed = np.interp(points.path_parameter, np.interp(windows.time, trajectory.time, path_parameter),
                         np.nan_to_num(correction.weight)) > LEAST_BELIEVED
    return with_moved(correction, moved_markings(points, correction.along, believed))


def _tell(survey: RegisteredSurvey, progress: Progress) -> None:
    """Say what was reached, and warn of what must not be trusted."""
    correction = survey.correction
    middle, _ = survey.plan_accuracy()
    spread = (say("standard deviation in plan over the whole path {sigma:.1f} cm (median)", sigma=100 * middle)
              if np.isfinite(middle) else say("how accurate it is is not known"))
    progress.message(say("{share:.0f} % of the path is registered, {share_2:.0f} % bridged; {spread}.",
                         share=100 * survey.share(REGISTERED), share_2=100 * survey.share(BRIDGED), spread=spread))
    if correction.heading_factor > 1.0:
        progress.warn(say("The reported heading contradicts the markings by {correction:.1f} degrees (median), much "
                          "more than its accuracy: it was corrected; check the calibration and the trajectory.",
                          correction=abs(np.median(correction.value[:, 5]))))
    if correction.steps:
        first = correction.steps[0]
        progress.warn(say("Reference and survey disagree at {count} places, the first at {place:.0f} m by {size:.2f} m "
                          "({kind}): see the steps' layer and the report.", count=len(correction.steps),
                          place=first.place, size=first.size, kind=say(first.kind)))
    if survey.share(DISTRUSTED) > 0:
        spans = [item for item in unregistered_sections(survey) if item.status == STATUS_NAMES[DISTRUSTED]]
    else:
        spans = []
    if spans:  # those shorter than a metre are not listed
        longest = max(spans, key=lambda item: item.end - item.start)
        progress.warn(say("{share:.0f} % of the path is not to be trusted, the longest section from "
                          "{longest_start:.0f} to {end:.0f} m ({reason}): see the patches' layer.",
                          share=100 * survey.share(DISTRUSTED), longest_start=longest.start, end=longest.end,
                          reason=longest.reason))
