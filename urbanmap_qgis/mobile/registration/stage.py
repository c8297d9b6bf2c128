"""From a survey's files to its corrected trajectory: markings, windows, one smooth correction (J 3.2.4, chapter 4)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.points.pointcloud import PointCloud, iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ...wording import say
from ..apply_correction import survey_time_shift
from ..calibration import Calibration
from ..markings.extraction import WEIGHT, ExtractionSettings
from ..markings.marking_stage import extract_markings
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
from .start.reference import Reference
from .walls.facade_planes import facade_planes
from .walls.outline_walls import WallEdges
from .walls.witness import WallWitness

_SHORTEST = 1.0  # m: shorter sections are joined to what is around them when they are listed


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


@dataclass(frozen=True)
class RegisteredSurvey:
    """What came out.

    Attributes
    ----------
    trajectory : corrected, with the reported one's epochs.
    reported : the trajectory as it was given.
    markings : the marking points used, as reported.
    windows : result of each patch's window.
    correction : the smooth one.
    """

    trajectory: Trajectory
    reported: Trajectory
    markings: MarkingPoints
    windows: WindowResults
    correction: Correction

    def share(self, status: int) -> float:
        """Share of the patches with a status, 0 to 1."""
        return float(np.mean(self.correction.status == status))

    def plan_accuracy(self) -> tuple[float, float]:
        """Median and maximum of the standard deviation in plan over the whole path, m; NaN where it is not known.

        The one figure that log, report and results tell: of registered, bridged and distrusted patches alike.
        """
        return middle_and_largest(self.correction.plan_sigma())


def middle_and_largest(sigma: np.ndarray) -> tuple[float, float]:
    """Median and maximum of standard deviations (n,), those that are known; NaN where none is."""
    known = sigma[np.isfinite(sigma)]
    return (float(np.median(known)), float(known.max())) if len(known) else (np.nan, np.nan)


@dataclass(frozen=True)
class UnregisteredSection:
    """A part of the path that is not registered throughout.

    Attributes
    ----------
    start, end : chainage, m.
    start_time, end_time : s.
    status, reason : of its patches.
    sigma : largest standard deviation in plan, m.
    """

    start: float
    end: float
    start_time: float
    end_time: float
    status: str
    reason: str
    sigma: float


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


def walls_of(paths: Sequence[str | os.PathLike], trajectory: Trajectory, run: RegistrationRun,
             edges: WallEdges | None = None, alone: bool = False, progress: Progress = SILENT) -> WallWitness:
    """The facades of a survey as a second witness beside its markings.

    Parameters
    ----------
    edges : of buildings; without them walls say only whether they stay straight.
    alone : the markings give the start only, the walls the correction.

    Raises
    ------
    InsufficientDataError : the survey shows no facade.
    """
    along = path_parameters_of(trajectory, run.correction.time_weight)
    planes = facade_planes(paths, trajectory, along, progress)
    if not len(planes):
        raise InsufficientDataError(say("The survey shows no facade near the vehicle: give all its points, not the "
                                        "markings alone, or register it by its markings."))
    return WallWitness(planes, edges, alone)


def survey_markings(cloud: PointCloud, trajectory: Trajectory, settings: ExtractionSettings,
                    calibration: Calibration | None, progress: Progress = SILENT,
                    executor: Executor | None = None) -> MarkingPoints:
    """Marking points of a cloud in the trajectory's time: the cloud's own, or extracted from a survey."""
    if cloud.has_dimension(WEIGHT):
        return _read_markings(cloud, trajectory, progress)
    progress.message(say("Taking road markings out of the survey."))
    extraction = extract_markings(cloud, trajectory, calibration, settings, progress, executor)
    if not len(extraction.points):
        raise InsufficientDataError(say("No road marking was found in the survey: check its intensities with “Road "
                                        "markings of a mobile survey”."))
    return extraction.points


def _read_markings(cloud: PointCloud, trajectory: Trajectory, progress: Progress) -> MarkingPoints:
    shift = survey_time_shift(cloud, trajectory)
    columns: dict[str, list[np.ndarray]] = {name: [] for name in ("x", "y", "z", "gps_time", WEIGHT, "point_source_id")}
    for chunk in iter_chunks(cloud, progress):
        for name, pieces in columns.items():
            pieces.append(np.asarray(chunk[name], np.float64))
    x, y, z, time, weight, source = (np.concatenate(pieces) for pieces in columns.values())
    if not np.isfinite(weight).all() or (weight < 0).any():
        raise InputError(say("The attribute {weight} of {paths} holds values below 0: give markings as “Road "
                             "markings of a mobile survey” writes them, or the survey itself.", weight=WEIGHT,
                             paths=cloud.paths[0].name))
    return MarkingPoints(x, y, z, time + shift, weight, source.astype(np.int64))


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


def unregistered_sections(survey: RegisteredSurvey) -> list[UnregisteredSection]:
    """Parts of the path that are not registered, in the order driven."""
    correction, sigma = survey.correction, survey.correction.plan_sigma()
    half = 0.5 * float(np.median(np.diff(correction.chainage))) if len(correction) > 1 else 0.0
    label = np.where(correction.status == REGISTERED, -1, correction.status)
    code = np.array([f"{number}{reason}" if number >= 0 else "" for number, reason in zip(label, correction.reason)])
    starts = np.flatnonzero(np.r_[True, code[1:] != code[:-1]])
    found = []
    for first, end in zip(starts, np.r_[starts[1:], len(code)]):
        part = slice(first, end)
        if code[first] and correction.chainage[end - 1] - correction.chainage[first] + 2 * half >= _SHORTEST:
            found.append(UnregisteredSection(
                float(correction.chainage[first] - half), float(correction.chainage[end - 1] + half),
                float(correction.time[first]), float(correction.time[end - 1]),
                STATUS_NAMES[correction.status[first]], str(correction.reason[first]),
                float(np.fmax.reduce(sigma[part]))))
    return found


def step_table(survey: RegisteredSurvey) -> tuple[dict[str, object], np.ndarray]:
    """Columns of the layer of steps between reference and survey, and their places on the corrected path (n, 3)."""
    steps = survey.correction.steps
    columns = {"way": [item.place for item in steps], "time": [item.time for item in steps],
               "kind": [item.kind for item in steps], "size": [item.size for item in steps],
               "direction": [item.direction for item in steps], "east": [item.east for item in steps],
               "north": [item.north for item in steps], "sigma": [item.sigma for item in steps]}
    time = np.array(columns["time"], float)
    places = np.column_stack([np.interp(time, survey.trajectory.time, axis) for axis in survey.trajectory.place.T])
    return columns, places


def patch_table(survey: RegisteredSurvey) -> tuple[dict[str, object], np.ndarray]:
    """Columns of the patches' layer, and their corrected places (n, 3)."""
    correction, windows = survey.correction, survey.windows
    sigma = correction.sigma()
    estimated = np.isfinite(sigma)
    value = np.where(estimated, correction.value, np.nan)
    names = ("east", "north", "up", "roll", "pitch", "heading")
    columns: dict[str, object] = {
        "patch": np.arange(len(correction)), "way": correction.chainage, "time": correction.time,
        "status": [STATUS_NAMES[number] for number in correction.status], "reason": list(correction.reason),
        "sigma": correction.plan_sigma(), "correction": np.hypot(value[:, 0], value[:, 1])}
    columns.update({name: value[:, k] for k, name in enumerate(names)})
    columns.update({f"sigma_{name}": sigma[:, k] for k, name in enumerate(names)})
    columns.update({
        "window": windows.window_length, "features": windows.features, "points": windows.points,
        "score": windows.score, "overlap": windows.overlap, "margin": np.where(np.isfinite(windows.margin),
                                                                              windows.margin, np.nan),
        "weight": correction.weight, "residual": np.hypot(correction.residual[:, 0], correction.residual[:, 1])})
    if correction.walls is not None:
        columns.update({"paint": 1.0 - correction.walls, "walls": correction.walls})
    return columns, windows.place + correction.value[:, :3]
