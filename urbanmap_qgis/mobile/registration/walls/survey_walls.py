"""The facades of a survey's files as a second witness beside its markings."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ....errors import InsufficientDataError
from ....io.points.pointcloud import PointCloud
from ....progress import SILENT, Progress
from ....wording import say
from ...trajectory import Trajectory
from ..trajectory_stops import path_parameters_of
from .facade_planes import facade_planes
from .laser_walls import laser_walls
from .outline_walls import WallEdges
from .witness import WallWitness


def walls_of(paths: Sequence[str | os.PathLike], trajectory: Trajectory, time_weight: float,
             edges: WallEdges | None = None, alone: bool = False, progress: Progress = SILENT,
             laser: Sequence[str | os.PathLike] | PointCloud | None = None) -> WallWitness:
    """The facades of a survey as a second witness beside its markings.

    Parameters
    ----------
    time_weight : of the path parameter, see `path_parameters_of`, m/s.
    edges : of buildings; without them walls tell the pitch alone.
    alone : the markings give the start only, the walls the correction.
    laser : airborne points, in which the walls are looked for where no edges are given.

    Raises
    ------
    InsufficientDataError : the survey shows no facade, or the airborne points no wall there.
    """
    along = path_parameters_of(trajectory, time_weight)
    planes = facade_planes(paths, trajectory, along, progress if laser is None else progress.part(0.0, 0.7))
    if not len(planes):
        raise InsufficientDataError(say("The survey shows no facade near the vehicle: give all its points, not the "
                                        "markings alone, or register it by its markings."))
    if edges is None and laser is not None:
        edges = laser_walls(planes, laser, progress.part(0.7, 1.0))
    return WallWitness(planes, edges, alone)
