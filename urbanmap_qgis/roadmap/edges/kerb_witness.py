"""The kerbs of a survey as a second witness beside its markings, laid on the lines of a map (J 6.2)."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...io.points.pointcloud import PointCloud
from ...mobile.registration.trajectory_stops import path_parameters_of
from ...mobile.registration.walls.facade_planes import FacadePlanes
from ...mobile.registration.walls.outline_walls import WallEdges
from ...mobile.registration.walls.witness import WallWitness
from ...mobile.trajectory import Trajectory
from ...progress import SILENT, Progress
from ...wording import say
from .survey_kerbs import survey_kerbs

BESIDE = 10.0
"""m about the survey's kerbs within which a line may be one of theirs."""


def kerbs_of(paths: Sequence[str | os.PathLike] | PointCloud, trajectory: Trajectory, time_weight: float,
             lines: np.ndarray, alone: bool = False, progress: Progress = SILENT) -> WallWitness:
    """The kerbs of a survey as a second witness beside its markings.

    Parameters
    ----------
    time_weight : of the path parameter, see `path_parameters_of`, m/s.
    lines : (n,) lines of kerbs or road edges, in plan, m.
    alone : the markings give the start only, the kerbs the correction.

    Raises
    ------
    InsufficientDataError : the survey shows no kerb, or no line lies there.
    """
    kerbs = survey_kerbs(paths, trajectory, path_parameters_of(trajectory, time_weight), progress=progress)
    if not len(kerbs):
        raise InsufficientDataError(say("The survey shows no kerb beside the path: give all its points, not the "
                                        "markings alone, or register it without road edges."))
    edges = WallEdges.of_kerbs(_beside(lines, kerbs))
    if not len(edges):
        raise InsufficientDataError(say("No line of the road edges lies where the survey shows kerbs: check that both "
                                        "show the same streets."))
    return WallWitness(kerbs, edges, alone, edges.inside[0])


def _beside(lines: np.ndarray, kerbs: FacadePlanes) -> np.ndarray:
    """The lines near kerbs, cut to them; none of those whose coordinates are no numbers."""
    places, owner = shapely.get_coordinates(lines, return_index=True)
    known = np.ones(len(lines), bool)
    known[owner[~np.isfinite(places).all(axis=1)]] = False
    low, high = kerbs.place[:, :2].min(axis=0) - BESIDE, kerbs.place[:, :2].max(axis=0) + BESIDE
    near = shapely.clip_by_rect(shapely.force_2d(lines[known]), *low, *high)
    _, some = shapely.STRtree(near).query(shapely.points(kerbs.place[:, :2]), predicate="dwithin", distance=BESIDE)
    return near[np.unique(some)]
