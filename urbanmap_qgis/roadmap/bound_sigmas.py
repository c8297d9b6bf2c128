"""Standard deviations of bounds at their nodes: those of the lines there, growing where a bound runs without a line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .map_records import Bound, MapLine, VectorMap
from .node_heights import fill_heights

STATION = 1.0  # Lines are looked for so densely along a bound, m.
NEAR = 0.2  # A line so near to a bound is the one that it follows, m.
# Without a line a bound may leave its course by this share of the way to the nearest one beyond the first metre,
# as the centre lines of paint themselves do.
GROWTH = 0.01
FREE_DISTANCE = 1.0  # m


@dataclass(frozen=True)
class _Course:
    """Stations of a bound: chainage (n,), sigma of the line there (n,; NaN where none is), rows of its nodes."""

    chainage: np.ndarray
    sigma: np.ndarray
    rows: np.ndarray


def fill_heights_and_sigmas(built: VectorMap, lines: Sequence[MapLine]) -> int:
    """Heights of nodes that have none of their own, and standard deviations of the bounds; the number of heights
    filled."""
    filled = fill_heights(built)
    set_bound_sigmas(built, lines)
    return filled


def set_bound_sigmas(built: VectorMap, lines: Sequence[MapLine]) -> None:
    """Give painted bounds the standard deviations at their nodes (`sigmas`) and the mean one along them (`sigma`).

    Where no line is, it is that of the nearest place with a line, also on a bound that goes on from it, and grows with
    the distance. Bounds whose lines state none keep what they have.
    """
    known = [line for line in lines if line.kind != "stop line" and np.isfinite(line.sigma)]
    tree = shapely.STRtree([shapely.LineString(line.points[:, :2]) for line in known])
    courses = {k: _course(built, bound, tree, known) for k, bound in enumerate(built.bounds) if bound.kind != "virtual"}
    reached = _from_ends(built, courses)
    for k, course in courses.items():
        bound = built.bounds[k]
        sigma = _grown(course, [reached.get(bound.nodes[tip], (np.inf, np.nan)) for tip in (0, -1)])
        if np.isfinite(sigma).all():
            bound.sigmas = sigma[course.rows].tolist()
            bound.sigma = float(np.sqrt(np.mean(sigma ** 2)))


def _course(built: VectorMap, bound: Bound, tree: shapely.STRtree, lines: Sequence[MapLine]) -> _Course:
    """The stations of a bound, its nodes among them, with the sigma of the nearest line."""
    path = built.bound_points(bound)[:, :2]
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    chainage = np.union1d(at, np.arange(0.0, at[-1], STATION))
    places = shapely.points(np.column_stack([np.interp(chainage, at, column) for column in path.T]))
    sigma = np.full(len(chainage), np.nan)
    for row, line in tree.query_nearest(places, max_distance=NEAR, all_matches=False).T:
        sigma[row] = _line_sigma(lines[line], tree.geometries[line], places[row])
    return _Course(chainage, sigma, np.searchsorted(chainage, at))


def _line_sigma(line: MapLine, plan: shapely.LineString, place: shapely.Point) -> float:
    """Standard deviation of a line at a place beside it."""
    if len(line.sigmas) != len(line.points):
        return line.sigma
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line.points[:, :2], axis=0), axis=1))])
    return float(np.interp(plan.project(place), at, line.sigmas))


def _from_ends(built: VectorMap, courses: dict[int, _Course]) -> dict[int, tuple[float, float]]:
    """Distance from each end of bounds to the nearest place with a line, along the bounds, and the sigma there."""
    reached: dict[int, tuple[float, float]] = {}
    changed = True
    while changed:
        changed = False
        for k, course in courses.items():
            nodes = built.bounds[k].nodes
            for tip, other in ((0, -1), (-1, 0)):
                seen = np.flatnonzero(np.isfinite(course.sigma))
                nearest = seen[tip] if len(seen) else 0
                options = [(abs(float(course.chainage[nearest] - course.chainage[tip])),
                            float(course.sigma[nearest]))] if len(seen) else []
                if nodes[other] in reached:
                    options.append((reached[nodes[other]][0] + course.chainage[-1], reached[nodes[other]][1]))
                best = min(options, default=(np.inf, np.nan))
                if best[0] < reached.get(nodes[tip], (np.inf, np.nan))[0]:
                    reached[nodes[tip]], changed = best, True
    return reached


def _grown(course: _Course, ends: Sequence[tuple[float, float]]) -> np.ndarray:
    """Standard deviations (n,) at the stations; NaN where no line is known anywhere."""
    seen = np.flatnonzero(np.isfinite(course.sigma))
    ways = [ends[0][0] + course.chainage, ends[1][0] + course.chainage[-1] - course.chainage]
    sigmas = [np.full(len(course.chainage), end[1]) for end in ends]
    if len(seen):
        behind = np.clip(np.searchsorted(seen, np.arange(len(course.chainage))), 0, len(seen) - 1)
        for row in (seen[behind], seen[np.maximum(behind - 1, 0)]):
            ways.append(np.abs(course.chainage - course.chainage[row]))
            sigmas.append(course.sigma[row])
    nearest = np.argmin(ways, axis=0)[None]
    distance, sigma = (np.take_along_axis(np.array(one), nearest, axis=0)[0] for one in (ways, sigmas))
    grown = np.hypot(sigma, GROWTH * np.maximum(distance - FREE_DISTANCE, 0.0))
    return np.where(np.isfinite(distance), grown, np.nan)
