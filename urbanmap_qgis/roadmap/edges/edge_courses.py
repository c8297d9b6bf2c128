"""Where kerbs, upright faces and borders without a step run along a surveyed road, before they are measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import InsufficientDataError
from ...geometry.tolerances import LEAST_DIVISOR
from ...progress import Progress
from ...settings.roadmap import EdgeSettings
from ...wording import say
from .borders import border_candidates
from .courses import find_courses, lengthened, linked
from .edge_points import EdgePoints, EdgeTile
from .edge_records import Course, EdgeCandidates, joined_candidates
from .ground_profile import Heights, above_ground, near_ground
from .height_steps import step_candidates
from .uprights import upright_candidates

_SPARSE = 8.0  # points a square metre of tiles at the path below which no edge can be told


@dataclass(frozen=True)
class EdgeCourses:
    """Courses of kerbs, of upright faces (rails and walls) and of verges, the borders without a step.

    `least_step` : m, so low a step shows at half of the smooth places beside the path; NaN where there are none.
    """

    kerbs: list[Course]
    faces: list[Course]
    verges: list[Course]
    least_step: float


def edge_courses(survey: EdgePoints, settings: EdgeSettings, ground: Heights | None, progress: Progress
                 ) -> EdgeCourses:
    """Find the courses within the width of the path.

    Parameters
    ----------
    ground : heights (m) of the ground at places of the survey; None where it is found among the points.

    Raises
    ------
    InsufficientDataError : too few points to tell edges.
    """
    *found, least = _candidates(survey, settings, ground, progress)
    return EdgeCourses(*(_courses(one) for one in found), least)


def kerb_courses(survey: EdgePoints, settings: EdgeSettings, progress: Progress) -> list[Course]:
    """The courses of kerbs alone, on the ground that is found among the points."""
    steps = []
    for tile in survey.tiles(progress):
        low = near_ground(tile.points, above_ground(tile.points))
        steps.append(_beside(step_candidates(tile, low, settings)[0], survey))
    return _courses(joined_candidates(steps))


def _candidates(survey: EdgePoints, settings: EdgeSettings, ground: Heights | None, progress: Progress
                ) -> tuple[EdgeCandidates | float, ...]:
    """Candidates of steps, of upright faces and of borders without a step within the width of the path, and the least
    step that shows, m."""
    steps, uprights, borders, density, least = [], [], [], [], [np.zeros(0)]
    for tile in survey.tiles(progress):
        height = above_ground(tile.points, ground)
        low = near_ground(tile.points, height)
        found, shown = step_candidates(tile, low, settings)
        steps.append(_beside(found, survey))
        least.append(shown)
        uprights.append(_beside(upright_candidates(tile, height, survey.path_tree), survey))
        borders.append(_beside(border_candidates(tile, low, survey.path_tree), survey))
        density += _densities(tile, low, survey)
    if not density or np.median(density) < _SPARSE:
        median = float(np.median(density)) if density else 0.0
        raise InsufficientDataError(say("There are {found:.1f} ground points a square metre beside the path: edges "
                                        "need {sparse:.0f} or more; give the whole survey, not a thinned one.",
                                        found=median, sparse=_SPARSE))
    shown = np.concatenate(least)
    return (*(joined_candidates(parts) for parts in (steps, uprights, borders)),
            float(np.median(shown)) if len(shown) else np.nan)


def _densities(tile: EdgeTile, low: np.ndarray, survey: EdgePoints) -> list[int]:
    """Ground points within a square metre at each fourth place of the path in a tile, or beside it if more are there.

    Scanners on the roof of a car do not see the ground right below.
    """
    in_tile = tile.owns(survey.path)
    if not in_tile.any():
        return []
    way = np.gradient(survey.path, axis=0)[in_tile][::4]
    across = np.column_stack([-way[:, 1], way[:, 0]]) / np.maximum(np.hypot(*way.T), LEAST_DIVISOR)[:, None]
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
