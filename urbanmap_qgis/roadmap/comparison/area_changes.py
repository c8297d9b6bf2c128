"""Changes of stop lines, crosswalks and symbols: each is one thing, matched with one of the other map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...settings.roadmap import ComparisonSettings
from ..lines.symbols import UNKNOWN_ARROW
from .comparison_records import ADDED, MOVED, REPAINTED, MapChange, MapNoise
from .cross_sections import PARALLEL
from .difference_noise import BOTH, difference_sigma
from .line_changes import COVER
from .map_elements import CROSSWALK, STOP_LINE, SYMBOL, MapElement

REACH_STOP = 5.0  # Farthest match of stop lines, m.
REACH_CROSSWALK = 5.0  # Of crosswalks, m.
REACH_SYMBOL = 3.0  # Of symbols, m.

REACH = {STOP_LINE: REACH_STOP, CROSSWALK: REACH_CROSSWALK, SYMBOL: REACH_SYMBOL}


@dataclass(frozen=True)
class ElementFrames:
    """Where elements lie: points (each (k, 2)) and middles (n, 2), m, and the directions (n, 2) along them.

    Along is the direction of traffic: across a stop line, the heading of a symbol or crosswalk. Where that is not
    known (`known`) it is taken from the outline: a symbol's longer side, a crosswalk's shorter one.
    """

    points: list[np.ndarray]
    middles: np.ndarray
    along: np.ndarray
    known: np.ndarray


def element_frames(elements: Sequence[MapElement]) -> ElementFrames:
    """Middles and directions of stop lines, crosswalks and symbols."""
    middles, along = np.empty((len(elements), 2)), np.empty((len(elements), 2))
    known = np.array([one.element == STOP_LINE or bool(np.isfinite(one.heading).all()) for one in elements], bool)
    for number, one in enumerate(elements):
        if one.element == STOP_LINE:
            middles[number] = shapely.get_coordinates(shapely.line_interpolate_point(one.plan, one.plan.length / 2))[0]
            side = one.points[-1] - one.points[0]
            course = np.array([-side[1], side[0]])
        else:
            outline = shapely.polygons(one.points)
            middles[number] = shapely.get_coordinates(shapely.centroid(outline))[0]
            course = one.heading if known[number] else _side(outline, longer=one.element == SYMBOL)
        along[number] = course / max(np.linalg.norm(course), np.finfo(float).tiny)
    return ElementFrames([one.points for one in elements], middles, along, known)


def _side(outline: shapely.Geometry, longer: bool) -> np.ndarray:
    sides = np.diff(shapely.get_coordinates(shapely.minimum_rotated_rectangle(outline))[:3], axis=0)
    return sides[int(np.argsort(np.linalg.norm(sides, axis=1))[-1 if longer else 0])]


def element_pairs(old: ElementFrames, new: ElementFrames, reach: float) -> np.ndarray:
    """Pairs (n, 2) of elements, nearest first, each once; directions, where known, are about the same or opposite."""
    if not len(old.middles) or not len(new.middles):
        return np.empty((0, 2), int)
    points = shapely.points(new.middles)
    a, b = shapely.STRtree(points).query(shapely.points(old.middles), predicate="dwithin", distance=reach)
    keep = (np.abs((old.along[a] * new.along[b]).sum(axis=1)) >= PARALLEL) | ~old.known[a] | ~new.known[b]
    a, b = a[keep], b[keep]
    taken: tuple[set[int], set[int]] = (set(), set())
    pairs = []
    for k in np.argsort(np.linalg.norm(old.middles[a] - new.middles[b], axis=1), kind="stable"):
        if a[k] not in taken[0] and b[k] not in taken[1]:
            taken[0].add(int(a[k]))
            taken[1].add(int(b[k]))
            pairs.append((a[k], b[k]))
    return np.array(pairs, int).reshape(-1, 2)


@dataclass(frozen=True)
class PairDifferences:
    """Differences of matched elements along and across (to the left), m.

    Attributes
    ----------
    pairs : (n, 2) numbers of the elements.
    axes : (n, 2, 2) directions along and across.
    shifts : (n, 2) what both ends of an element have in common: one that reaches farther on one side, or was seen in
        part, has not moved.
    middles : (n, 2) of the middles between both ends: how well such differences are known.
    """

    pairs: np.ndarray
    axes: np.ndarray
    shifts: np.ndarray
    middles: np.ndarray


def pair_differences(old: ElementFrames, new: ElementFrames, pairs: np.ndarray) -> PairDifferences:
    """Differences of pairs of elements."""
    along = old.along[pairs[:, 0]]
    axes = np.stack([along, np.column_stack([-along[:, 1], along[:, 0]])], axis=1)
    shifts, middles = np.zeros((len(pairs), 2)), np.zeros((len(pairs), 2))
    for number, (a, b) in enumerate(pairs):
        before, after = old.points[a] @ axes[number].T, new.points[b] @ axes[number].T
        ends = np.stack([after.min(axis=0) - before.min(axis=0), after.max(axis=0) - before.max(axis=0)])
        together = np.sign(ends[0]) == np.sign(ends[1])
        shifts[number] = np.where(together, np.sign(ends[0]) * np.abs(ends).min(axis=0), 0.0)
        middles[number] = ends.mean(axis=0)
    return PairDifferences(pairs, axes, shifts, middles)


def paired_changes(old: Sequence[MapElement], new: Sequence[MapElement], found: PairDifferences,
                   noises: tuple[MapNoise, MapNoise], settings: ComparisonSettings,
                   offset: np.ndarray) -> list[MapChange]:
    """Elements of both maps that moved or were painted anew; `noises` are those along and across."""
    changes = []
    for (a, b), shift, frame in zip(found.pairs, found.shifts, found.axes):
        before, after = old[a], new[b]
        places = after.points + offset
        ids = {"old_id": before.identifier, "new_id": after.identifier}
        kinds = {before.kind, after.kind}
        if len(kinds) == 2 and UNKNOWN_ARROW not in kinds:
            changes.append(MapChange(REPAINTED, before.element, before.words, after.words, places, **ids))
        # A stop line's sigma is that across the bar; how far it reaches to the sides is known from the rest alone.
        stated = [(before.sigma, after.sigma)] * 2
        if before.element == STOP_LINE:
            stated[1] = (np.nan, np.nan)
        sigmas = np.array([float(difference_sigma(noise, *one)) for noise, one in zip(noises, stated)])
        limits = np.array([noise.limit for noise in noises])
        ratio = float(np.sqrt(np.sum((shift / sigmas / limits) ** 2))) / BOTH
        if ratio > 1.0 and np.hypot(*shift) > settings.least_shift:
            east, north = shift @ frame
            sigma = float(np.sqrt(np.sum((shift * sigmas) ** 2)) / np.hypot(*shift))
            changes.append(MapChange(MOVED, before.element, before.words, after.words, places, np.nan, float(east),
                                     float(north), *map(float, shift), sigma, float(np.max(np.abs(shift) / sigmas)),
                                     **ids))
    return changes


def single_changes(kind: str, elements: Sequence[MapElement], frames: ElementFrames, paired: np.ndarray,
                   other_lines: Sequence[MapElement], area: shapely.Geometry | None,
                   offset: np.ndarray) -> list[MapChange]:
    """Elements (`ADDED` or `REMOVED`) without a partner, where the other map shows a road."""
    alone = np.setdiff1d(np.arange(len(elements)), paired)
    shown = _shown(frames.middles[alone], other_lines, area)
    changes = []
    for number in alone[shown]:
        one = elements[number]
        names = ("", one.words) if kind == ADDED else (one.words, "")
        ids = {"new_id" if kind == ADDED else "old_id": one.identifier}
        changes.append(MapChange(kind, one.element, *names, one.points + (offset if kind == ADDED else 0.0), **ids))
    return changes


def _shown(places: np.ndarray, lines: Sequence[MapElement], area: shapely.Geometry | None) -> np.ndarray:
    """Mask of places (n, 2) beside lines of a map, or in the area that both show."""
    if area is not None:
        return shapely.contains_xy(area, *places.T)
    shown = np.zeros(len(places), bool)
    if len(lines) and len(places):
        shapes, points = np.array([line.plan for line in lines], object), shapely.points(places)
        place, line = shapely.STRtree(shapes).query(points, predicate="dwithin", distance=COVER)
        at = shapely.line_locate_point(shapes[line], points[place])
        shown[place[(at > 0) & (at < shapely.length(shapes[line]))]] = True
    return shown
