"""The faces of kerbs as each pass of a survey saw them."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, open_cloud
from ...mobile.registration.matching.results import angle_rates
from ...mobile.registration.walls.facade_planes import FacadePlanes
from ...mobile.trajectory import Trajectory, interpolate, path_chainage
from ...progress import SILENT, Progress
from ...settings.roadmap import EdgeSettings
from .edge_courses import kerb_courses
from .edge_points import EdgePoints, EdgeTile
from .edge_records import POINT
from .ground_profile import above_ground, near_ground
from .profile import FAR_REACH, HALF_LENGTH, Profile, fit_edge_profile
from .stations import Stations

DEFAULTS = EdgeSettings(min_height=0.05)
"""Lower steps are told from the scatter of the ground where their course is long alone."""

MOST_SIGMA = 0.05
"""m across, of a kerb at one station."""

TIMED_POINT = np.dtype([*POINT.descr, ("time", "<f8")])
"""`POINT`, and when it was measured, s."""


def survey_kerbs(paths: Sequence[str | os.PathLike] | PointCloud, trajectory: Trajectory, path_parameter: np.ndarray,
                 settings: EdgeSettings = DEFAULTS, progress: Progress = SILENT) -> FacadePlanes:
    """The faces of kerbs each half metre, of every pass for itself: small upright planes towards the lower side.

    Parameters
    ----------
    path_parameter : (e,) m, at the trajectory's epochs.
    """
    with PointBuckets(TIMED_POINT) as buckets:
        cloud = paths if isinstance(paths, PointCloud) else open_cloud(paths)
        survey = EdgePoints(cloud, trajectory, settings.width, buckets)
        survey.read(progress.part(0.0, 0.4))
        stations = Stations.of(kerb_courses(survey, settings, progress.part(0.4, 0.7)))
        parts = [_faces(stations, tile, settings) for tile in survey.tiles(progress.part(0.7, 1.0))]
    found = np.concatenate([np.zeros((0, 6)), *parts])
    found = found[np.argsort(found[:, 0], kind="stable")]
    return _planes(found, survey.corner, trajectory, path_parameter)


def _planes(found: np.ndarray, corner: np.ndarray, trajectory: Trajectory, path_parameter: np.ndarray) -> FacadePlanes:
    """Planes of rows (n, 6): time, place relative to the corner, normal."""
    time = np.clip(found[:, 0], trajectory.time[0], trajectory.time[-1])
    place, body = found[:, 1:4] + corner, interpolate(trajectory, time)
    back = np.linalg.inv(angle_rates(body.angles)) if len(time) else np.zeros((0, 6, 6))
    along, chainage = (np.interp(time, trajectory.time, way) for way in (path_parameter, path_chainage(trajectory)))
    return FacadePlanes(along, chainage, place, place - body.place, found[:, 4:], back)


def _faces(stations: Stations, tile: EdgeTile, settings: EdgeSettings) -> np.ndarray:
    """(n, 6) time (s), place (m) and normal in plan of the kerbs at the stations of a tile, of each pass."""
    mine = np.flatnonzero(tile.owns(stations.place) & stations.seen)
    points = tile.points[near_ground(tile.points, above_ground(tile.points))]
    if not len(mine) or not len(points):
        return np.zeros((0, 6))
    plan = np.column_stack([points["x"], points["y"]])
    around, rows = cKDTree(plan).query_ball_point(stations.place[mine], FAR_REACH + HALF_LENGTH), []
    for number, near in zip(mine.tolist(), around):
        place, normal = stations.place[number], stations.normal[number]
        offset = plan[near] - place
        near = np.array(near, int)[np.abs(offset @ np.array([-normal[1], normal[0]])) <= HALF_LENGTH]
        for drive in np.unique(points["drive"][near]).tolist():
            some = points[near[points["drive"][near] == drive]]
            across = np.column_stack([some["x"], some["y"]]) @ normal - place @ normal
            face = fit_edge_profile(across, some["z"])
            if face is not None and _is_kerb(face, settings):
                rows.append([some["time"].mean(), *(place + face.foot * normal), face.z_foot, *-normal])
    return np.array(rows).reshape(-1, 6)


def _is_kerb(face: Profile, settings: EdgeSettings) -> bool:
    """Whether a profile is that of a kerb whose place is known."""
    return settings.min_height <= face.height <= settings.max_height and face.sigma <= MOST_SIGMA
