"""Stop lines: bars across the end of lines or beside a crosswalk, through which no line runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...geometry.tolerances import LEAST_DIVISOR
from .crosswalks import Crosswalk
from .line_chains import StrokeChain
from .line_fit import FittedLine


@dataclass(frozen=True)
class StopLinesLimits:
    """Limits of stop lines, each with its unit."""

    near_stop: float = 4.0  # A line ends so near a stop line at most, m.
    # Length of a stop line, m: a lane is not narrower, but wear shortens bars, and a crosswalk tells what they
    # are.
    shortest: float = 2.0
    shortest_at_crosswalk: float = 1.4
    longest: float = 16.0
    # Bars in one line are one stop line so far apart, and so much beside each other, m: lane lines and wear cut
    # them.
    joint: float = 1.5
    joint_offset: float = 0.2
    # Narrow pieces of worn bars continue one so near, m, with a course whose cosine with its own is so much.
    crumbs: float = 1.0
    crumb_course: float = 0.85
    beside: tuple[float, ...] = (0.5, 7.0)  # A stop line lies so far before a crosswalk, m.
    # Confidence of a wholly painted stop line that only lines' ends or only a crosswalk show.
    one_evidence: float = 0.7


LIMITS = StopLinesLimits()

CROSSES = 3.0
"""A line that goes on so far on both sides of a bar crosses it: the bar is no stop line, m."""


def stop_line_confidence(chain: StrokeChain, lines: Sequence[tuple[StrokeChain, FittedLine]],
                         crosswalks: Sequence[Crosswalk]) -> float:
    """How sure a bar is a stop line, 0 (none) to 1.

    It is one where it lies across the end of a line or along a crosswalk, and no line goes through it. Both together
    give the share of its length that is painted; one alone `LIMITS.one_evidence` of it.
    """
    bar = shapely.LineString(chain.axis)
    beside = any(_beside(chain, bar, row) for row in crosswalks)
    if not (LIMITS.shortest_at_crosswalk if beside else LIMITS.shortest) <= chain.length <= LIMITS.longest:
        return 0.0
    at_end, crossed = _at_end(chain, lines)
    if crossed:
        return 0.0
    evidence = at_end + beside
    painted = min(chain.painted / max(chain.length, LEAST_DIVISOR), 1.0)
    return painted * (0.0, LIMITS.one_evidence, 1.0)[evidence]


def joined_bars(bars: Sequence[StrokeChain], crumbs: Sequence[StrokeChain] = ()) -> list[StrokeChain]:
    """The bars, those in one line with short gaps between them made one.

    Narrower pieces (`crumbs`), as wear leaves them, continue a bar but make none by themselves.
    """
    if not len(bars):
        return []
    whole = _joined(bars)
    free = shapely.STRtree([shapely.LineString(crumb.axis) for crumb in crumbs])
    used: set[int] = set()
    for k, bar in enumerate(whole):
        near = free.query(shapely.LineString(bar.axis), predicate="dwithin", distance=LIMITS.crumbs)
        for number in sorted(near, key=lambda n: shapely.distance(free.geometries[n], shapely.LineString(bar.axis))):
            one = None if number in used else _one_bar(whole[k], crumbs[number], worn=True)
            if one is not None:
                whole[k] = one
                used.add(int(number))
    return _joined(whole)


def _joined(bars: Sequence[StrokeChain]) -> list[StrokeChain]:
    tree = shapely.STRtree([shapely.LineString(bar.axis) for bar in bars])
    a, b = tree.query(tree.geometries, predicate="dwithin", distance=LIMITS.joint)
    return [chain for group in linked_members(a, b, len(bars)) for chain in _joined_near([bars[k] for k in group])]


def _joined_near(bars: Sequence[StrokeChain]) -> list[StrokeChain]:
    left = sorted(bars, key=lambda chain: -chain.length)
    k = 0
    while k < len(left):
        for other in range(k + 1, len(left)):
            one = _one_bar(left[k], left[other])
            if one is not None:
                left[k] = one
                del left[other]
                break
        else:
            k += 1
    return left


def _one_bar(one: StrokeChain, other: StrokeChain, worn: bool = False) -> StrokeChain | None:
    """Two bars as one, None where the shorter does not continue the longer; worn ones may be narrower."""
    if np.linalg.norm(one.axis.mean(axis=0) - other.axis.mean(axis=0)) > (one.length + other.length) / 2 + LIMITS.joint:
        return None
    # Short ragged pieces point aside: what they have in common is told by the line through all four ends.
    tips = np.vstack([one.axis[[0, -1]], other.axis[[0, -1]]])
    middle = tips.mean(axis=0)
    along = np.linalg.svd(tips - middle)[2][0]
    place, beside = (tips - middle) @ along, (tips - middle) @ np.array([-along[1], along[0]])
    gap = max(place[:2].min() - place[2:].max(), place[2:].min() - place[:2].max())
    wide = max(one.width, other.width) <= 1.6 * min(one.width, other.width)
    askew = worn and abs(_course(other.axis) @ along) < LIMITS.crumb_course
    if not (-1.0 <= gap <= LIMITS.joint and (wide or worn) and np.abs(beside).max() <= LIMITS.joint_offset) or askew:
        return None
    axis = middle + np.array([[place.min()], [place.max()]]) * along
    painted = one.painted + other.painted
    return StrokeChain(axis, [*one.strokes, *other.strokes], painted,
                       (one.painted * one.width + other.painted * other.width) / max(painted, LEAST_DIVISOR))


def _at_end(chain: StrokeChain, lines: Sequence[tuple[StrokeChain, FittedLine]]) -> tuple[bool, bool]:
    """Whether a line ends at the bar, and whether one goes through it."""
    bar = shapely.LineString(chain.axis)
    low, high = chain.axis.min(axis=0) - LIMITS.near_stop, chain.axis.max(axis=0) + LIMITS.near_stop
    along, strokes = _course(chain.axis), set(chain.strokes)
    at_end = False
    for other, fit in lines:
        if fit.width >= 0.8 * chain.width or not strokes.isdisjoint(other.strokes):
            continue
        if (fit.axis.max(axis=0) < low).any() or (fit.axis.min(axis=0) > high).any():
            continue
        axis = shapely.LineString(fit.axis)
        if axis.distance(bar) > LIMITS.near_stop:
            continue
        if axis.crosses(bar):
            at = axis.project(axis.intersection(bar).centroid)
            if min(at, axis.length - at) > CROSSES:
                return at_end, True
        near = np.linalg.norm(fit.axis[[0, -1]] - np.array(bar.centroid.coords[0]), axis=1)
        tip = 0 if near[0] < near[1] else -1
        inner = (fit.axis if tip == 0 else fit.axis[::-1])[:31][-1]
        cosine = abs(_course(np.array([fit.axis[tip], inner])) @ along)
        if cosine < 0.5 and bar.distance(shapely.Point(fit.axis[tip])) <= LIMITS.near_stop:
            at_end = True
    return at_end, False


def _beside(chain: StrokeChain, bar: shapely.LineString, row: Crosswalk) -> bool:
    """Whether the bar lies before a crosswalk, along its row of bars."""
    if abs(_course(chain.axis) @ row.direction) > 0.35:
        return False
    if not LIMITS.beside[0] < bar.distance(row.area) < LIMITS.beside[1]:
        return False
    normal = np.array([-row.direction[1], row.direction[0]])
    reach = shapely.get_coordinates(row.area.exterior) @ normal
    place = chain.axis @ normal
    common = min(place.max(), reach.max()) - max(place.min(), reach.min())
    return common > 0.6 * np.ptp(place)


def _course(axis: np.ndarray) -> np.ndarray:
    chord = axis[-1] - axis[0]
    return chord / max(float(np.linalg.norm(chord)), LEAST_DIVISOR)
