"""From observations to adjusted drives: nodes, the network solved, and of each node how it was placed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...progress import Progress
from ...wording import known, say
from ..registration.trajectory_stops import links_along, still_wandering
from ..trajectory import Trajectory, interpolate
from .drive_drift import DriveNodes
from .network import RELATIVE_KINDS, NetworkObservations, NetworkSettings, adjust_network
from .records import (
    BRIDGED,
    COUNTED,
    NOT_TIED,
    PLACED,
    RELATIVE,
    AdjustedDrive,
    AdjustedSurvey,
    AdjustmentRun,
)
from .steps import observed_steps
from .ties import Drive, pairs_of


@dataclass(frozen=True)
class DriveNetworkLimits:
    """Limits of the network of drives, each with its unit."""

    nodes: float = 5.0  # m of the drift's parameter
    near: float = 30.0  # m from an observation that a node is placed by


LIMITS = DriveNetworkLimits()


def adjust_drives(drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun, progress: Progress,
                  differ: tuple[float, float] = NetworkSettings.differ) -> AdjustedSurvey:
    """Solve the network and say of each node how it was placed.

    `differ` : m, of buildings and of their walls, as `NetworkSettings` has it.
    """
    parameters = [run.path_parameters(drive.trajectory) for drive in drives]
    nodes, times = zip(*(_nodes(drive.trajectory, parameter, number, observations)
                         for number, (drive, parameter) in enumerate(zip(drives, parameters))))
    stepped = [drive.name for drive, of_drive in zip(drives, nodes) if of_drive.fast.any()]
    if stepped:
        progress.warn(say("Ties change by more than drift within 20 m (a step of a trajectory): {stepped} may step "
                          "there, and control or reference says which does.", stepped=", ".join(stepped)))
    progress.message(say("Adjusting {drives_count} drives with {observations_count} observations.",
                         drives_count=len(drives), observations_count=len(observations)))
    wandering = [_Wandering(drive.trajectory, parameter) for drive, parameter in zip(drives, parameters)]
    network = adjust_network(nodes, _at_nodes(observations, nodes, wandering),
                             NetworkSettings(run.registration.correction.model(), differ=differ))
    inlier = network.weight >= COUNTED
    placed = _networks(len(drives), observations, inlier)
    results = tuple(
        _drive_result(drives[k], wandering[k], nodes[k], times[k], network.state[k], network.covariance[k],
                      _node_status(nodes[k], k, observations, inlier, placed[k]))
        for k in range(len(drives)))
    times_of = [np.interp([c], parameters[d], results[d].reported.time)
                for d, c in zip(observations.drive, observations.parameter)]
    place = np.array([interpolate(results[d].corrected, time).place[0] + np.append(arm, 0.0)
                      for d, time, arm in zip(observations.drive, times_of, observations.arm)]).reshape(-1, 3)
    survey = AdjustedSurvey(results, observations, network, place, not any(item is True for item in placed))
    _tell(survey, placed, progress)
    return survey


class _Wandering:
    """What a trajectory wandered in stops, m, up to path parameters (n,): the correction takes it back at once."""

    def __init__(self, trajectory: Trajectory, parameter: np.ndarray):
        self.parameter, self._wandered = parameter, still_wandering(trajectory)

    def __call__(self, parameter: np.ndarray) -> np.ndarray:
        return np.column_stack([np.interp(parameter, self.parameter, axis) for axis in self._wandered.T])


def _at_nodes(observations: NetworkObservations, nodes: Sequence[DriveNodes],
              wandering: Sequence[_Wandering]) -> NetworkObservations:
    """The observations as their nearest nodes have them: what is wandered in a stop between both is no drift."""
    value = observations.value.copy()
    for sign, drive, parameter in ((1.0, observations.drive, observations.parameter),
                                   (-1.0, observations.other, observations.other_parameter)):
        for number, (of_drive, wandered) in enumerate(zip(nodes, wandering)):
            mine = np.flatnonzero(drive == number)
            nearest = of_drive.parameter[of_drive.nearest(parameter[mine])]
            value[mine, :3] += sign * (wandered(parameter[mine]) - wandered(nearest))
    return replace(observations, value=value)


def _nodes(trajectory: Trajectory, parameter: np.ndarray, number: int,
           observations: NetworkObservations) -> tuple[DriveNodes, np.ndarray]:
    """Nodes along the parameter of the drive `number`, and their times, s."""
    count = max(int(np.ceil((parameter[-1] - parameter[0]) / LIMITS.nodes)), 1)
    at = np.linspace(parameter[0], parameter[-1], count + 1)
    rising = np.concatenate([[True], np.diff(parameter) > 0])
    time = np.interp(at, parameter[rising], trajectory.time[rising])
    return DriveNodes(at, links_along(trajectory, time), observed_steps(observations, number, at)), time


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


def _drive_result(drive: Drive, wandering: _Wandering, nodes: DriveNodes, time: np.ndarray, state: np.ndarray,
                  covariance: np.ndarray, status: np.ndarray) -> AdjustedDrive:
    """A drive with its correction at all epochs."""
    if status[0] == NOT_TIED:
        state = np.zeros_like(state)
    value = _between_nodes(state[:, :, 0], nodes.parameter, wandering, status[0] != NOT_TIED)
    angles = np.zeros((len(value), 3))
    angles[:, 2] = value[:, 3]
    reported = drive.trajectory
    corrected = Trajectory(reported.time, reported.place + value[:, :3], reported.angles + angles)
    return AdjustedDrive(drive.name, reported, corrected, time, nodes.parameter, interpolate(corrected, time).place,
                         state[:, :, 0], covariance, status)


def _between_nodes(correction: np.ndarray, parameter: np.ndarray, wandering: _Wandering, tied: bool) -> np.ndarray:
    """(e, 4) m, degrees, at all epochs of corrections (k, 4) of nodes: in a stop it goes as the trajectory wanders."""
    still = correction.copy()
    still[:, :3] += tied * wandering(parameter)
    value = np.column_stack([np.interp(wandering.parameter, parameter, axis) for axis in still.T])
    value[:, :3] -= tied * wandering(wandering.parameter)
    return value


def _tell(survey: AdjustedSurvey, placed: Sequence[bool | None], progress: Progress) -> None:
    """Say what was reached, and warn of what is not placed."""
    for name, count, lost, plan, _, up, _ in survey.residual_rows():
        facts = {"count": count, "name": known(name), "lost": lost, "plan": 100 * plan}
        progress.message(say("{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in "
                             "plan, {up:.1f} cm in height.", **facts, up=100 * up) if np.isfinite(up) else
                         say("{count} observations ({name}), {lost} without weight; RMS residual {plan:.1f} cm in "
                             "plan.", **facts))
    relative = [drive.name for drive, item in zip(survey.drives, placed) if item is False]
    loose = [drive.name for drive, item in zip(survey.drives, placed) if item is None]
    if relative:
        progress.warn(say("No control point or reference marking fixes {relative}: these drives agree with each "
                          "other, but their place is only relative.", relative=", ".join(relative)))
    if loose:
        progress.warn(say("Nothing ties {loose} to anything: it stays as reported.", loose=", ".join(loose)))
