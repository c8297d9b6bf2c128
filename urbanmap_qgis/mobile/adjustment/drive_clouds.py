"""Which files belong to which drive, and the markings of each."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...io.points.pointcloud import PointCloud, iter_chunks, open_cloud
from ...progress import Progress
from ...wording import say
from ..calibration import Calibration
from ..gps_time import time_shift
from ..registration.survey_markings import survey_markings
from ..trajectory import Trajectory, interpolate
from .records import AdjustmentRun
from .ties import Drive


@dataclass(frozen=True)
class DriveCloudLimits:
    """Limits of the files of drives, each with its unit."""

    belongs: float = 200.0  # m from the vehicle within which its points lie in the median
    sample: int = 5000  # points by which a cloud's drive is found


LIMITS = DriveCloudLimits()


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
        shift = time_shift(cloud, trajectory)
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


def read_drives(clouds: Sequence[Sequence[str | os.PathLike]], trajectories: Sequence[Trajectory],
                names: Sequence[str], run: AdjustmentRun, calibration: Calibration | None,
                progress: Progress) -> list[Drive]:
    """The drives with their markings; each has its files, surveys or markings."""
    drives = []
    for number, (paths, trajectory, name) in enumerate(zip(clouds, trajectories, names)):
        part = progress.part(number / len(names), (number + 1) / len(names))
        drives.append(Drive(name, trajectory, survey_markings(open_cloud(paths), trajectory,
                                                              run.registration.extraction, calibration, part)))
    return drives
