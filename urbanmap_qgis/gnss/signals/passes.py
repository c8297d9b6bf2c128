"""Several drives past the same buildings: which observations belong to which trajectory."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ...errors import InputError
from ...mobile.trajectory import Trajectory, joined_trajectory
from ...progress import SILENT, Progress
from ...settings.gnss import SignalSettings
from ...wording import say
from ..rinex.observation_file import read_observations
from .observations import load_observations, trajectory_shift
from .tables import Signals, join_signals

Span = tuple[float, float]


def load_passes(observation_paths: Sequence[str | os.PathLike], navigation_paths: Sequence[str | os.PathLike],
                trajectories: Sequence[Trajectory], names: Sequence[str], crs_wkt: str,
                geoid_separation: float | None = None, settings: SignalSettings | None = None,
                progress: Progress = SILENT) -> Signals:
    """Signals of several drives, each observation file with the trajectory of its time.

    Trajectories that follow each other in one time are taken as one. Where times of the week of different weeks are
    given, each file goes with the trajectory that it overlaps.

    Parameters
    ----------
    names : of the trajectories, for messages.  The others as in `observations.load_observations`.

    Raises
    ------
    InputError : an observation file overlaps no trajectory, or two; or as `load_observations` does.
    """
    settings = settings or SignalSettings()

    def load(paths: Sequence[str | os.PathLike], trajectory: Trajectory, part: Progress) -> Signals:
        return load_observations(paths, navigation_paths, trajectory, crs_wkt, geoid_separation, settings, part)

    if len(trajectories) == 1:
        return load(observation_paths, trajectories[0], progress)
    spans = _spans(observation_paths, settings, progress.part(0.0, 0.2))
    if _one_time(trajectories, spans):
        return load(observation_paths, joined_trajectory(trajectories, names), progress.part(0.2, 1.0))
    groups = _grouped(observation_paths, spans, trajectories, names)
    parts = []
    for number, (owner, paths) in enumerate(groups.items()):
        part = progress.part(0.2 + 0.8 * number / len(groups), 0.2 + 0.8 * (number + 1) / len(groups))
        parts.append(load(paths, trajectories[owner], part))
    return join_signals(parts)


def _spans(paths: Sequence[str | os.PathLike], settings: SignalSettings, progress: Progress) -> list[Span]:
    """First and last GPS time of observation files."""
    spans = []
    for number, path in enumerate(paths):
        progress.step(number / len(paths))
        file = read_observations(path, settings.systems)
        spans.append((float(file.time[0]), float(file.time[-1])))
    return spans


def _one_time(trajectories: Sequence[Trajectory], spans: Sequence[Span]) -> bool:
    """Whether the trajectories follow each other and one shift of time brings all files to one of them."""
    order = sorted(trajectories, key=lambda trajectory: trajectory.time[0])
    if any(after.time[0] <= before.time[-1] for before, after in zip(order[:-1], order[1:])):
        return False
    whole = joined_trajectory(trajectories)
    shift = trajectory_shift(whole, spans)
    return all(any(_overlap(trajectory, shift, span) > 0 for trajectory in trajectories) for span in spans)


def _overlap(trajectory: Trajectory, shift: float, span: Span) -> float:
    """Seconds that a trajectory and a file have in common."""
    return min(trajectory.time[-1] + shift, span[1]) - max(trajectory.time[0] + shift, span[0])


def _grouped(paths: Sequence[str | os.PathLike], spans: Sequence[Span], trajectories: Sequence[Trajectory],
             names: Sequence[str]) -> dict[int, list[str | os.PathLike]]:
    """Observation files by the trajectory that each overlaps."""
    groups: dict[int, list[str | os.PathLike]] = {}
    for path, span in zip(paths, spans):
        fitting = []
        for number, trajectory in enumerate(trajectories):
            try:
                shift = trajectory_shift(trajectory, [span])
            except InputError:  # not of this file's time
                continue
            if _overlap(trajectory, shift, span) > 0:
                fitting.append(number)
        if not fitting:
            raise InputError(say("{path} is of the time of none of the trajectories: give the trajectory of that "
                                 "drive, or leave the file out.", path=Path(path).name))
        if len(fitting) > 1:
            who = " and ".join(names[number] for number in fitting[:2])
            raise InputError(say("{path} may belong to {who}, which have the same times of the week: give "
                                 "trajectories in full GPS seconds.", path=Path(path).name, who=who))
        groups.setdefault(fitting[0], []).append(path)
    return groups
