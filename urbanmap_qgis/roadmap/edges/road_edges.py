"""Edges of a surveyed road from its points: kerbs, borders, rails and walls, stretch by stretch of the map."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import open_cloud
from ...mobile.trajectory import Trajectory
from ...progress import SILENT, Progress
from ...settings.roadmap import EdgeSettings
from .bare_sides import bare_sides
from .doubts import with_low_doubts
from .edge_courses import edge_courses
from .edge_lines import edge_lines
from .edge_points import EdgePoints
from .edge_records import POINT, RoadEdge
from .ground_profile import Heights

DEFAULTS = EdgeSettings()


@dataclass(frozen=True)
class EdgesFound:
    """Edges and what they come from.

    Attributes
    ----------
    edges : kerbs first, then rails and walls, then borders, each kind in the order in which it was found.
    path_length : m driven.
    points_read, points_used : of the survey.
    bare_sides : m driven without a kerb within reach on the left and on the right.
    least_step : m; lower steps do not show at half of the smooth places beside the path, by the scatter and the number
        of their points. NaN where there are none.
    """

    edges: list[RoadEdge]
    path_length: float
    points_read: int
    points_used: int
    bare_sides: tuple[float, float] = (0.0, 0.0)
    least_step: float = float("nan")

    def length(self, *kinds: str) -> float:
        """Length of the edges of some kinds, m."""
        return float(sum(edge.length for edge in self.edges if edge.kind in kinds))


def road_edges(paths: Sequence[str | os.PathLike], trajectory: Trajectory, settings: EdgeSettings = DEFAULTS,
               ground: Heights | None = None, progress: Progress = SILENT) -> EdgesFound:
    """Find the edges along a drive.

    Parameters
    ----------
    paths : LAS or LAZ files with GPS times, in a projected CRS in metres, placed by `trajectory`.
    ground : heights (m) of the ground at places x, y; without it the ground is found among the points.

    Raises
    ------
    InsufficientDataError : no points beside the path, or too few to tell edges.
    InputError : the files cannot be read.
    """
    with PointBuckets(POINT) as buckets:
        survey = EdgePoints(open_cloud(paths), trajectory, settings.width, buckets)
        survey.read(progress.part(0.0, 0.4))
        local = None if ground is None else lambda x, y: ground(x + survey.corner[0], y + survey.corner[1])
        courses = edge_courses(survey, settings, local, progress.part(0.4, 0.65))
        edges = edge_lines(courses, survey, settings, local, progress.part(0.65, 1.0))
        edges = with_low_doubts(edges, courses.least_step)
    return EdgesFound([_placed(edge, settings) for edge in edges], float(survey.chainage[-1]), survey.read_points,
                      survey.kept_points, bare_sides(edges, trajectory.place, settings.width),
                      courses.least_step)


def _placed(edge: RoadEdge, settings: EdgeSettings) -> RoadEdge:
    """The edge with how well the survey itself is placed in its standard deviations."""
    return replace(edge, sigma=float(np.hypot(edge.sigma, settings.survey_sigma)),
                   sigma_z=float(np.hypot(edge.sigma_z, settings.survey_sigma)))
