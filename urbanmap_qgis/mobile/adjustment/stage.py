"""From several drives to one adjusted network: ties, control and reference in, a correction for each drive out."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.points.pointcloud import PointCloud, iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ...wording import known, say
from ..apply_correction import survey_time_shift
from ..calibration import Calibration
from ..control import ControlPoints
from ..registration.correction.gauss_markov import jump_steps, path_parameters_of, stop_steps
from ..registration.stage import RegistrationRun
from ..registration.start.reference import Reference
from ..registration.survey_markings import survey_markings
from ..trajectory import Trajectory, interpolate, path_chainage
from .network import (
    CONTROL,
    KINDS,
    NONE,
    RELATIVE_KINDS,
    DriveNodes,
    Network,
    NetworkObservations,
    NetworkSettings,
    adjust_network,
    plan_residuals,
)
from .planes import plane_ties, planes_of
from .reference_steps import ReferenceStep, reference_steps, undisputed
from .steps import away_from_steps, observed_steps
from .ties import Drive, pairs_of, reference_observations, tie_drives

PLACED, BRIDGED, RELATIVE, NOT_TIED = range(4)
STATUS_NAMES = ("placed", "bridged", "relative only", "not tied")
"""Of a node: near observations of a network with control or reference; farther from them; in a network whose place is
only what the drives report in the mean; of a drive without any observation, which stays as reported."""


@dataclass(frozen=True)
class AdjustmentStageLimits:
    """Limits of adjustment stage, each with its unit."""

    nodes: float = 5.0  # m of the drift's parameter
    step_reach: float = 30.0  # m of path
    near: float = 30.0  # m from an observation that a node is placed by
    kept: float = 0.3  # weight from which an observation counts
    belongs: float = 200.0  # m from the vehicle within which its points lie in the median
    control_reach: float = 60.0  # m from the vehicle within which it measures a control point
    sample: int = 5000  # points by which a cloud's drive is found


LIMITS = AdjustmentStageLimits()


@dataclass(frozen=True)
class AdjustmentRun:
    """How drives are adjusted.

    Attributes
    ----------
    registration : of ties and reference.
    planes : whether facades and road tie drives too.
    control_sigma, control_sigma_z : m, of control points, their measurement in the survey included.
    """

    registration: RegistrationRun = field(default_factory=RegistrationRun)
    planes: bool = True
    control_sigma: float = 0.02
    control_sigma_z: float = 0.03


@dataclass(frozen=True)
class AdjustedDrive:
    """One drive's result.

    Attributes
    ----------
    name : of the drive.
    reported, corrected : trajectories of the same epochs.
    time, chainage : (k,) s, m, of the nodes.
    place : (k, 3) m, corrected.
    correction : (k, 4) m, degrees of heading.
    covariance : (k, 4, 4).
    status : (k,) PLACED and its fellows.
    """

    name: str
    reported: Trajectory
    corrected: Trajectory
    time: np.ndarray
    chainage: np.ndarray
    place: np.ndarray
    correction: np.ndarray
    covariance: np.ndarray
    status: np.ndarray

    def plan_sigma(self) -> np.ndarray:
        """(k,) standard deviation in the worst direction in plan, m."""
        return np.sqrt(np.linalg.eigvalsh(self.covariance[:, :2, :2])[:, -1])


@dataclass(frozen=True)
class AdjustedSurvey:
    """All drives, and the observations with what is left of them.

    Attributes
    ----------
    drives : in the given order.
    observations, network : of the adjustment.
    place : (n, 3) m, where each observation lies after it.
    relative : whether no drive is tied to control or reference.
    reference_steps : of the reference markings, as several drives show them; observations of doubt are left out.
    """

    drives: tuple[AdjustedDrive, ...]
    observations: NetworkObservations
    network: Network
    place: np.ndarray
    relative: bool
    reference_steps: tuple[ReferenceStep, ...] = ()

    def median_sigma(self) -> float:
        """Median standard deviation in plan over all drives, m."""
        return float(np.median(np.concatenate([drive.plan_sigma() for drive in self.drives])))

    def residual_rows(self) -> list[tuple[str, int, int, float, float, float, float]]:
        """By kind: name, number, number that lost its weight, RMS and largest residual in plan and in height, m."""
        rows, sizes = [], plan_residuals(self.observations, self.network.residual)
        for kind, name in enumerate(KINDS):
            of_kind = self.observations.kind == kind
            if of_kind.any():
                plan = sizes[of_kind]
                up = np.abs(self.network.residual[of_kind, 2])
                known = up[np.isfinite(up)]
                rows.append((name, int(of_kind.sum()), int((self.network.weight[of_kind] < LIMITS.kept).sum()),
                             float(np.sqrt(np.mean(plan**2))), float(plan.max()),
                             float(np.sqrt(np.mean(known**2))) if len(known) else np.nan,
                             float(known.max()) if len(known) else np.nan))
        return rows


def assign_clouds(paths: Sequence[str | os.PathLike], trajectories: Sequence[Trajectory],
                  names: Sequence[str]) -> list[list[str | os.PathLike]]:
    """The files of each trajectory: a file belongs to the one along which its points were measured.

    Raises
    ------
    InputError : a file belongs to no trajectory, or a trajectory has no file.
    """
    found: list[list[str | os.PathLike]] = [[] for _ in trajectories]
    for path in paths:
        cloud = open_cloud([path])
        away = [_distance(cloud, trajectory) for trajectory in trajectories]
        nearest = int(np.argmin(away))
        if not away[nearest] < LIMITS.belongs:
            raise InputError(say("{paths} belongs to none of the trajectories: none covers its GPS times near its "
                                 "points. Give the trajectory of each drive.", paths=cloud.paths[0].name))
        found[nearest].append(path)
    for name, files in zip(names, found):
        if not files:
            raise InputError(say("No point cloud was measured along {name}: give the points of each drive.", name=name))
    return found


def _distance(cloud: PointCloud, trajectory: Trajectory) -> float:
    """Median distance, m, of some points from the vehicle when they were measured; inf where the times do not meet."""
    try:
        shift = survey_time_shift(cloud, trajectory)
    except InputError:
        return np.inf
    chunk = next(iter_chunks(cloud))
    some = slice(None, None, max(len(chunk) // LIMITS.sample, 1))
    time = np.asarray(chunk.gps_time)[some] + shift
    within = trajectory.within(time)
    if not within.any():
        return np.inf
    place = interpolate(trajectory, time[within]).place
    return float(np.median(np.hypot(np.asarray(chunk.x)[some][within] - place[:, 0],
                                    np.asarray(chunk.y)[some][within] - place[:, 1])))


def adjust_surveys(clouds: Sequence[Sequence[str | os.PathLike]], trajectories: Sequence[Trajectory],
                   names: Sequence[str], control: ControlPoints | None = None, reference: Reference | None = None,
                   run: AdjustmentRun | None = None, calibration: Calibration | None = None,
                   progress: Progress = SILENT) -> AdjustedSurvey:
    """Adjust several drives at once.

    Parameters
    ----------
    clouds : the files of each drive: surveys, or markings as “Road markings of a mobile survey” writes them.
    control : points of any of the drives; each is taken to be of the drive that was nearest at its time.

    Raises
    ------
    InsufficientDataError : nothing ties the drives to each other, to control or to a reference.
    """
    run = run or AdjustmentRun()
    count = len(trajectories)
    drives = []
    for number, (paths, trajectory, name) in enumerate(zip(clouds, trajectories, names)):
        part = progress.part(0.5 * number / count, 0.5 * (number + 1) / count)
        drives.append(Drive(name, trajectory, survey_markings(open_cloud(paths), trajectory,
                                                              run.registration.extraction, calibration, part)))
    progress.message(say("Looking for markings that drives share."))
    found = [tie_drives(drives, run.registration, progress.part(0.5, 0.8))]
    if run.planes:
        found.append(_plane_observations(clouds, drives, found[0], run, progress.part(0.8, 0.9)))
    if reference is not None:
        found.append(reference_observations(drives, reference, run.registration, progress.part(0.9, 0.95)))
    if control is not None:
        found.append(control_observations(drives, control, run))
    observations = NetworkObservations.joined(found)
    if not len(observations):
        raise InsufficientDataError(say("The drives share no markings and planes, and no control point or reference "
                                        "marking fits them: nothing can be adjusted."))
    observations, steps = _without_reference_steps(drives, observations, run, progress)
    return replace(_adjusted(drives, observations, run, progress), reference_steps=steps)


def _without_reference_steps(drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun,
                             progress: Progress) -> tuple[NetworkObservations, tuple[ReferenceStep, ...]]:
    """The observations without those by a reference that steps where no drive does, and these steps.

    Raises
    ------
    InsufficientDataError : no other observation is left.
    """
    chainage, other_chainage = np.zeros((2, len(observations)))
    for number, drive in enumerate(drives):
        parameter, way = _path_parameters(drive.trajectory, run), path_chainage(drive.trajectory)
        for of, at, found in ((observations.drive, observations.parameter, chainage),
                              (observations.other, observations.other_parameter, other_chainage)):
            found[of == number] = np.interp(at[of == number], parameter, way)
    steps = tuple(reference_steps(observations, chainage, other_chainage))
    for step in steps:
        progress.warn(step.sentence(drives[step.drive].name))
    left = observations.select(undisputed(observations, chainage, steps))
    if not len(left):
        raise InsufficientDataError(say("The reference steps where the drives do not, and nothing else ties them: "
                                        "nothing can be adjusted."))
    return left, steps


def _plane_observations(clouds: Sequence[Sequence[str | os.PathLike]], drives: Sequence[Drive],
                        ties: NetworkObservations, run: AdjustmentRun, progress: Progress) -> NetworkObservations:
    """Ties by planes; drives that share markings are brought together by these first."""
    progress.message(say("Looking for planes that drives share."))
    reported = [drive.trajectory for drive in drives]
    planes = planes_of(clouds, reported, progress)
    adjusted = reported
    if len(ties):
        preliminary = _adjusted(drives, ties, run, SILENT)
        adjusted = [drive.corrected for drive in preliminary.drives]
    found = plane_ties(planes, reported, adjusted, run.registration.correction.time_weight)
    # Beside a step the drives are not together well enough to tell which planes are the same.
    return found.select(away_from_steps(found, ties, LIMITS.step_reach))


def control_observations(drives: Sequence[Drive], control: ControlPoints, run: AdjustmentRun) -> NetworkObservations:
    """Control points as observations of the drives that measured them.

    Raises
    ------
    InputError : a point was measured by none of the drives.
    """
    away = np.stack([_away(drive.trajectory, control) for drive in drives])
    number = np.argmin(away, axis=0)
    nearest = away.min(axis=0)
    if (nearest > LIMITS.control_reach).any():
        name = control.id[int(np.argmax(nearest))]
        raise InputError(say("Control point {name} was measured by none of the drives: no trajectory passes within "
                             "{control_reach:.0f} m of it at its time.", name=name, control_reach=LIMITS.control_reach))
    n = len(control)
    parameter, arm = np.zeros(n), np.zeros((n, 2))
    for k, drive in enumerate(drives):
        of_drive = number == k
        parameter[of_drive] = np.interp(control.time[of_drive], drive.trajectory.time,
                                        _path_parameters(drive.trajectory, run))
        arm[of_drive] = (control.surveyed - interpolate(drive.trajectory, control.time, "hold").place)[of_drive, :2]
    value = np.column_stack([control.true - control.surveyed, np.full(n, np.nan)])
    variance = np.array([run.control_sigma, run.control_sigma, run.control_sigma_z, 1.0]) ** 2
    return NetworkObservations(number, parameter, arm, np.full(n, NONE), np.zeros(n), np.zeros((n, 2)), value,
                        np.tile(np.diag(variance), (n, 1, 1)), np.full(n, CONTROL))


def _away(trajectory: Trajectory, control: ControlPoints) -> np.ndarray:
    """Distance (n,) in plan, m, from the vehicle to each point in the survey at its time; inf outside the drive."""
    place = interpolate(trajectory, control.time, "hold").place
    away = np.hypot(*(control.surveyed - place)[:, :2].T)
    return np.where(trajectory.within(control.time), away, np.inf)


def _path_parameters(trajectory: Trajectory, run: AdjustmentRun) -> np.ndarray:
    return path_parameters_of(trajectory, run.registration.correction.time_weight)


def _adjusted(drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun,
              progress: Progress) -> AdjustedSurvey:
    """Solve the network and say of each node how it was placed."""
    parameters = [_path_parameters(drive.trajectory, run) for drive in drives]
    nodes, times = zip(*(_nodes(drive.trajectory, parameter, number, observations)
                         for number, (drive, parameter) in enumerate(zip(drives, parameters))))
    stepped = [drive.name for drive, of_drive in zip(drives, nodes) if of_drive.fast.any()]
    if stepped:
        progress.warn(say("Ties change by more than drift within 20 m (a step of a trajectory): {stepped} may step "
                          "there, and control or reference says which does.", stepped=", ".join(stepped)))
    progress.message(say("Adjusting {drives_count} drives with {observations_count} observations.",
                         drives_count=len(drives), observations_count=len(observations)))
    network = adjust_network(nodes, observations, NetworkSettings(run.registration.correction.model()))
    inlier = network.weight >= LIMITS.kept
    placed = _networks(len(drives), observations, inlier)
    results = tuple(
        _drive_result(drives[k], parameters[k], nodes[k], times[k], network.state[k], network.covariance[k],
                      _node_status(nodes[k], k, observations, inlier, placed[k]))
        for k in range(len(drives)))
    times_of = [np.interp([c], parameters[d], results[d].reported.time)
                for d, c in zip(observations.drive, observations.parameter)]
    place = np.array([interpolate(results[d].corrected, time).place[0] + np.append(arm, 0.0)
                      for d, time, arm in zip(observations.drive, times_of, observations.arm)]).reshape(-1, 3)
    survey = AdjustedSurvey(results, observations, network, place, not any(item is True for item in placed))
    _tell(survey, placed, progress)
    return survey


def _nodes(trajectory: Trajectory, parameter: np.ndarray, number: int,
           observations: NetworkObservations) -> tuple[DriveNodes, np.ndarray]:
    """Nodes along the parameter of the drive `number`, and their times, s."""
    count = max(int(np.ceil((parameter[-1] - parameter[0]) / LIMITS.nodes)), 1)
    at = np.linspace(parameter[0], parameter[-1], count + 1)
    rising = np.concatenate([[True], np.diff(parameter) > 0])
    time = np.interp(at, parameter[rising], trajectory.time[rising])
    return DriveNodes(at, stop_steps(trajectory, time), jump_steps(trajectory, time),
                      observed_steps(observations, number, at)), time


def _networks(count: int, observations: NetworkObservations, inlier: np.ndarray) -> list[bool | None]:
    """For each drive: whether its network has control or reference; None for a drive without any observation."""
    group = list(range(count))
    for first, second in pairs_of(observations.select(inlier)):
        old, new = group[first], group[second]
        group = [new if item == old else item for item in group]
    absolute = inlier & ~np.isin(observations.kind, RELATIVE_KINDS)
    placed = {group[number] for number in observations.drive[absolute].tolist()}
    seen = set(observations.drive[inlier].tolist()) | set(observations.other[inlier].tolist())
    return [group[number] in placed if number in seen else None for number in range(count)]


def _node_status(nodes: DriveNodes, number: int, observations: NetworkObservations, inlier: np.ndarray,
                 placed: bool | None) -> np.ndarray:
    """(k,) status of a drive's nodes."""
    if not placed:
        return np.full(len(nodes), RELATIVE if placed is False else NOT_TIED)
    parameter = np.concatenate([observations.parameter[inlier & (observations.drive == number)],
                            observations.other_parameter[inlier & (observations.other == number)]])
    near = np.abs(nodes.parameter[:, None] - parameter[None, :]).min(axis=1) <= LIMITS.near
    return np.where(near, PLACED, BRIDGED)


def _drive_result(drive: Drive, parameter: np.ndarray, nodes: DriveNodes, time: np.ndarray, state: np.ndarray,
                  covariance: np.ndarray, status: np.ndarray) -> AdjustedDrive:
    """A drive with its correction at all epochs."""
    if status[0] == NOT_TIED:
        state = np.zeros_like(state)
    value = np.column_stack([np.interp(parameter, nodes.parameter, axis) for axis in state[:, :, 0].T])
    angles = np.zeros((len(parameter), 3))
    angles[:, 2] = value[:, 3]
    reported = drive.trajectory
    corrected = Trajectory(reported.time, reported.place + value[:, :3], reported.angles + angles)
    return AdjustedDrive(drive.name, reported, corrected, time, nodes.parameter, interpolate(corrected, time).place,
                         state[:, :, 0], covariance, status)


def _tell(survey: AdjustedSurvey, placed: Sequence[bool | None], progress: Progress) -> None:
    """Say what was reached, and warn of what is not placed."""
    for name, count, lost, plan, _, up, _ in survey.residual_rows():
        progress.message(say("{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in "
                             "plan, {up:.1f} cm in height.", count=count, name=known(name), lost=lost, plan=100 * plan,
                             up=100 * up))
    relative = [drive.name for drive, item in zip(survey.drives, placed) if item is False]
    loose = [drive.name for drive, item in zip(survey.drives, placed) if item is None]
    if relative:
        progress.warn(say("No control point or reference marking fixes {relative}: these drives agree with each "
                          "other, but their place is only relative.", relative=", ".join(relative)))
    if loose:
        progress.warn(say("Nothing ties {loose} to anything: it stays as reported.", loose=", ".join(loose)))
