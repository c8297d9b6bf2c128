"""When a plane that moves with the vehicle sweeps over places of the map: a bracketed search for millions of places.

The plane passes through c(t) with normal e(t). Places change sides where e(t) (P - c(t)) changes sign. Over an interval
of time this value stays within bounds that follow from how far c and e move: intervals of which no place can be swept
are left out, the others are cut in four, down to the interval between two columns. In a bend the plane may come to
within millimetres of a place and go back: the column where it is nearest counts too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...progress import SILENT, Progress

Planes = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""From times (n,) to points (n, 3) on the planes and unit normals (n, 3)."""

FAN = 4
COARSEST = 6
CELL_LEVEL = 3
CELL = 8.0  # m
PAIRS_AT_ONCE = 300_000
MAX_STEP_RATIO = 10.0
ON_PLANE = 1e-6  # m
TOUCH = 2e-3  # m
ITERATIONS = 40


@dataclass(frozen=True)
class _Level:
    """Intervals of equal numbers of steps: a middle plane each, and how far the interval's planes lie from it.

    Attributes
    ----------
    place, normal : (k, 3) of the middle.
    moved : (k,) m.
    rotated : (k,) length of the normal's change.
    ahead : (k,) m moved along the middle's normal.
    """

    place: np.ndarray
    normal: np.ndarray
    moved: np.ndarray
    rotated: np.ndarray
    ahead: np.ndarray


@dataclass(frozen=True)
class Sweep:
    """Planes at times (m,), with the bounds of their intervals.

    Attributes
    ----------
    time : (m,) s.
    place, normal : (m, 3).
    step_used : (m - 1,) False where the times have a gap.
    planes : the planes at any time.
    levels : intervals of 4^k steps, k = 1 upwards.
    """

    time: np.ndarray
    place: np.ndarray
    normal: np.ndarray
    step_used: np.ndarray
    planes: Planes
    levels: tuple[_Level, ...]

    @classmethod
    def of(cls, time: np.ndarray, planes: Planes) -> Sweep:
        """Planes at times (m >= 2,). Steps ten times as long as usual are gaps, over which nothing is swept."""
        place, normal = planes(time)
        step = np.diff(time)
        levels = [_level(place, normal, FAN ** power) for power in range(1, COARSEST + 1)]
        return cls(time, place, normal, step <= MAX_STEP_RATIO * np.median(step), planes, tuple(levels))


def _level(place: np.ndarray, normal: np.ndarray, steps: int) -> _Level:
    last = len(place) - 1
    start = np.arange(0, last, steps)
    member = np.minimum(start[:, None] + np.arange(steps + 1), last)
    middle = member[:, steps // 2]
    away = place[member] - place[middle][:, None]
    return _Level(place[middle], normal[middle], np.linalg.norm(away, axis=2).max(axis=1),
                  np.linalg.norm(normal[member] - normal[middle][:, None], axis=2).max(axis=1),
                  np.abs(np.einsum("kmi,ki->km", away, normal[middle])).max(axis=1))


def sweep_times(points: np.ndarray, sweep: Sweep, max_distance: float,
                progress: Progress = SILENT) -> tuple[np.ndarray, np.ndarray]:
    """All times at which the plane sweeps over places, ordered by place and time.

    Parameters
    ----------
    points : (n, 3) m.
    max_distance : only sweeps with the plane's point at most this far from the place, m.

    Returns
    -------
    index : (k,) rows of `points`.
    time : (k,) s.
    """
    passed, touched = ([(np.empty(0, int), np.empty(0, int))] for _ in range(2))
    for index, step in _candidates(points, sweep, max_distance):
        progress.check()
        for found, part in zip((passed, touched), _swept(points, index, step, sweep)):
            found.append(part)
    index, step = (np.concatenate(column) for column in zip(*passed))
    time = _refined(points[index], step, sweep)
    beside, column = (np.concatenate(part) for part in zip(*touched))
    index, time = np.concatenate([index, beside]), np.concatenate([time, sweep.time[column]])
    order = np.lexsort((time, index))
    index, time = index[order], time[order]
    near = np.linalg.norm(sweep.planes(time)[0] - points[index], axis=1) <= max_distance
    return index[near], time[near]


def _candidates(points: np.ndarray, sweep: Sweep, max_distance: float):
    """Pieces of places and steps (index, step) within which the plane may sweep over the place."""
    centre, radius, members, bounds = _cells(points)
    cell, interval = _all_pairs(len(centre), len(sweep.levels[-1].moved))
    for power in range(COARSEST, CELL_LEVEL, -1):
        possible = _possible(centre[cell], radius[cell], sweep.levels[power - 1], interval, max_distance)
        cell, interval = _children(cell[possible], interval[possible], len(sweep.levels[power - 2].moved))
    possible = _possible(centre[cell], radius[cell], sweep.levels[CELL_LEVEL - 1], interval, max_distance)
    cell, interval = cell[possible], interval[possible]
    size = np.diff(bounds)[cell]
    piece = np.cumsum(size) // PAIRS_AT_ONCE
    for some in np.split(np.arange(len(cell)), np.flatnonzero(np.diff(piece)) + 1):
        many = size[some]
        within = np.arange(many.sum()) - np.repeat(np.cumsum(many) - many, many)
        index = members[np.repeat(bounds[cell[some]], many) + within]
        yield _steps(points, index, np.repeat(interval[some], many), sweep, max_distance)


def _steps(points: np.ndarray, index: np.ndarray, interval: np.ndarray, sweep: Sweep,
           max_distance: float) -> tuple[np.ndarray, np.ndarray]:
    """Of places and intervals the steps within which the plane may sweep over the place."""
    for power in range(CELL_LEVEL, 0, -1):
        possible = _possible(points[index], 0.0, sweep.levels[power - 1], interval, max_distance)
        limit = len(sweep.levels[power - 2].moved) if power > 1 else len(sweep.time) - 1
        index, interval = _children(index[possible], interval[possible], limit)
    used = sweep.step_used[interval]
    return index[used], interval[used]


def _swept(points: np.ndarray, index: np.ndarray, step: np.ndarray,
           sweep: Sweep) -> tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Places and steps in which the plane passes, and places and columns at which it touches and goes back."""
    start, end = (_ahead(points[index], sweep.place[step + k], sweep.normal[step + k]) for k in (0, 1))
    side = start < 0.0
    passed = side != (end < 0.0)
    near = np.flatnonzero(~passed & (np.abs(start) < TOUCH) & (np.abs(start) < np.abs(end)) & (step > 0))
    before = _ahead(points[index[near]], sweep.place[step[near] - 1], sweep.normal[step[near] - 1])
    near = near[(np.abs(before) >= np.abs(start[near])) & ((before < 0.0) == side[near])]
    return (index[passed], step[passed]), (index[near], step[near])


def _ahead(points: np.ndarray, place: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Distance (n,) of places before planes, m."""
    return np.einsum("ni,ni->n", points - place, normal)


def _possible(points: np.ndarray, radius: np.ndarray | float, level: _Level, interval: np.ndarray,
              max_distance: float) -> np.ndarray:
    """Pairs (k,) of balls of places and intervals in which a plane may touch the ball within the distance."""
    vector = points - level.place[interval]
    distance = np.linalg.norm(vector, axis=1) + radius
    tolerance = level.ahead[interval] + radius + level.rotated[interval] * (distance + level.moved[interval])
    ahead = np.abs(np.einsum("ni,ni->n", vector, level.normal[interval]))
    return np.flatnonzero((ahead <= tolerance) & (distance - 2.0 * radius - level.moved[interval] <= max_distance))


def _all_pairs(first: int, second: int) -> tuple[np.ndarray, np.ndarray]:
    return np.repeat(np.arange(first), second), np.tile(np.arange(second), first)


def _children(index: np.ndarray, interval: np.ndarray, limit: int) -> tuple[np.ndarray, np.ndarray]:
    """Every pair with each of the four parts of its interval."""
    part = (FAN * interval[:, None] + np.arange(FAN)).ravel()
    existing = np.flatnonzero(part < limit)
    return np.repeat(index, FAN)[existing], part[existing]


def _cells(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places gathered in cubes: centres (c, 3), radii (c,), rows sorted by cube (n,) and where each begins (c + 1,)."""
    cube = np.floor((points - points.min(axis=0)) / CELL).astype(np.int64)
    size = cube.max(axis=0) + 1
    number = (cube[:, 0] * size[1] + cube[:, 1]) * size[2] + cube[:, 2]
    members = np.argsort(number, kind="stable")
    start = np.flatnonzero(np.diff(number[members], prepend=-1))
    low, high = (function.reduceat(points[members], start) for function in (np.minimum, np.maximum))
    return 0.5 * (low + high), 0.5 * np.linalg.norm(high - low, axis=1), members, np.append(start, len(points))


def _refined(points: np.ndarray, step: np.ndarray, sweep: Sweep) -> np.ndarray:
    """Times (n,) within steps at which the plane passes through places (false position after Illinois)."""
    low, high = sweep.time[step].copy(), sweep.time[step + 1].copy()
    at_low = _ahead(points, sweep.place[step], sweep.normal[step])
    at_high = _ahead(points, sweep.place[step + 1], sweep.normal[step + 1])
    time = low - at_low * (high - low) / (at_high - at_low)
    side = np.zeros(len(points), np.int8)
    left = np.arange(len(points))
    for _ in range(ITERATIONS):
        value = _ahead(points[left], *sweep.planes(time[left]))
        going = np.abs(value) > ON_PLANE
        left, value = left[going], value[going]
        if not len(left):
            break
        same = (value < 0.0) == (at_low[left] < 0.0)
        lower, upper = left[same], left[~same]
        low[lower], at_low[lower] = time[lower], value[same]
        high[upper], at_high[upper] = time[upper], value[~same]
        # An end that stays twice counts half: otherwise it could stay for ever.
        at_high[lower[side[lower] < 0]] *= 0.5
        at_low[upper[side[upper] > 0]] *= 0.5
        side[lower], side[upper] = -1, 1
        time[left] = low[left] - at_low[left] * (high[left] - low[left]) / (at_high[left] - at_low[left])
    return time
