"""Edges of a surveyed road from its points: kerbs, borders, rails and walls, stretch by stretch of the map."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import InsufficientDataError
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import open_cloud
from ...mobile.trajectory import Trajectory
from ...progress import SILENT, Progress
from ...wording import say
from .assembly import kerb_lines
from .borders import border_candidates, border_lines, measure_borders
from .courses import find_courses, lengthened, linked
from .doubts import with_doubts
from .edge_points import EdgePoints, EdgeTile
from .edge_records import POINT, Course, EdgeCandidates, EdgeSettings, RoadEdge, joined_candidates
from .ground_profile import above_ground, near_ground
from .height_steps import step_candidates
from .stations import Stations, measure_stations
from .uprights import Uprights, measure_uprights, upright_candidates, upright_lines

DEFAULTS = EdgeSettings()

_SPARSE = 8.0  # points a square metre of tiles at the path below which no edge can be told


@dataclass(frozen=True)
class EdgesFound:
    """Edges and what they come from.

    Attributes
    ----------
    edges : kerbs first, then rails and walls, then borders, each kind in the order in which it was found.
    path_length : m driven.
    points_read, points_used : of the survey.
    """

    edges: list[RoadEdge]
    path_length: float
    points_read: int
    points_used: int

    def length(self, *kinds: str) -> float:
        """Length of the edges of some kinds, m."""
        return float(sum(edge.length for edge in self.edges if edge.kind in kinds))


def road_edges(paths: Sequence[str | os.PathLike], trajectory: Trajectory, settings: EdgeSettings = DEFAULTS,
               ground: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None, progress: Progress = SILENT
               ) -> EdgesFound:
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
        kerbs, faces, verges = (_courses(found) for found in _candidates(survey, settings, local,
                                                                         progress.part(0.4, 0.65)))
        stations, upright_stations, border_stations = Stations.of(kerbs), Uprights.of(faces), Stations.of(verges)
        for tile in survey.tiles(progress.part(0.65, 1.0)):
            height = above_ground(tile.points, local)
            low = near_ground(tile.points, height)
            measure_stations(stations, tile, low)
            measure_uprights(upright_stations, tile, height)
            measure_borders(border_stations, tile, low)
    edges = kerb_lines(stations, settings, survey.corner)
    edges += upright_lines(upright_stations, settings, survey.corner, len(kerbs))
    edges = with_doubts(edges, survey.path + survey.corner[:2], float(survey.chainage[-1]))
    edges += border_lines(border_stations, edges, survey.path, settings, survey.corner, len(kerbs) + len(faces))
    return EdgesFound([_placed(edge, settings) for edge in edges], float(survey.chainage[-1]), survey.read_points,
                      survey.kept_points)


def _candidates(survey: EdgePoints, settings: EdgeSettings, ground, progress: Progress
                ) -> tuple[EdgeCandidates, ...]:
    """Candidates of steps, of upright faces and of borders without a step within the width of the path."""
    steps, uprights, borders, density = [], [], [], []
    for tile in survey.tiles(progress):
        height = above_ground(tile.points, ground)
        low = near_ground(tile.points, height)
        steps.append(_beside(step_candidates(tile, low, settings), survey))
        uprights.append(_beside(upright_candidates(tile, height, survey.path_tree), survey))
        borders.append(_beside(border_candidates(tile, low, survey.path_tree), survey))
        density += _densities(tile, low, survey)
    if not density or np.median(density) < _SPARSE:
        found = float(np.median(density)) if density else 0.0
        raise InsufficientDataError(say("There are {found:.1f} ground points a square metre beside the path: edges "
                                        "need {sparse:.0f} or more; give the whole survey, not a thinned one.",
                                        found=found, sparse=_SPARSE))
    return tuple(joined_candidates(parts) for parts in (steps, uprights, borders))


def _densities(tile: EdgeTile, low: np.ndarray, survey: EdgePoints) -> list[int]:
    """Ground points within a square metre at each fourth place of the path in a tile, or beside it if more are there.

    Scanners on the roof of a car do not see the ground right below.
    """
    in_tile = tile.owns(survey.path)
    if not in_tile.any():
        return []
    way = np.gradient(survey.path, axis=0)[in_tile][::4]
    across = np.column_stack([-way[:, 1], way[:, 0]]) / np.maximum(np.hypot(*way.T), 1e-9)[:, None]
    x, y = tile.points["x"][low], tile.points["y"][low]
    return [max(int(np.count_nonzero((np.abs(x - place[0]) < 0.5) & (np.abs(y - place[1]) < 0.5)))
                for place in at + np.array([[-3.5], [0.0], [3.5]]) * normal)
            for at, normal in zip(survey.path[in_tile][::4], across)]


def _beside(candidates: EdgeCandidates, survey: EdgePoints) -> EdgeCandidates:
    """Those within the width of the path."""
    if not len(candidates):
        return candidates
    near = survey.within(candidates.place)
    return EdgeCandidates(candidates.place[near], candidates.normal[near], candidates.height[near],
                          candidates.score[near])


def _courses(candidates: EdgeCandidates) -> list[Course]:
    return [lengthened(course) for course in linked(find_courses(candidates))]


def _placed(edge: RoadEdge, settings: EdgeSettings) -> RoadEdge:
    """The edge with how well the survey itself is placed in its standard deviations."""
    return replace(edge, sigma=float(np.hypot(edge.sigma, settings.survey_sigma)),
                   sigma_z=float(np.hypot(edge.sigma_z, settings.survey_sigma)))
