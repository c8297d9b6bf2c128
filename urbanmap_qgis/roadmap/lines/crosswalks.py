"""Crosswalks: rows of parallel bars of paint, also where bars are worn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from .crosswalk_extent import BarRow, extended
from .strokes import Stroke
from .worn_crosswalks import faced_rows, worn_rows


@dataclass(frozen=True)
class CrosswalksLimits:
    """Limits of crosswalks, each with its unit."""

    bar_width: tuple[float, ...] = (0.25, 0.85)  # Of a bar, m; 45 or 50 cm in most countries.
    bar_length: tuple[float, ...] = (0.8, 9.0)
    pitch: tuple[float, ...] = (0.65, 1.75)  # Distance of neighbouring bars' centre lines, m.
    least_mean_fill: float = 0.35  # The bars' places hold so much more paint than those between them, 0 to 1.
    many: int = 6  # A row of so many bars is measured anew with all of them.
    member: float = 0.2  # Bars whose middles lie so near a row are its, m.
    regular: float = 0.6  # Share of the distances between bars that must be multiples of the pitch, to a quarter of it.


LIMITS = CrosswalksLimits()

PARALLEL = np.radians(12.0)
FEWEST, SEED = 4, 3
"""Bars of a crosswalk, and of a row that may be part of one."""


@dataclass(frozen=True)
class Crosswalk:
    """A row of bars.

    Attributes
    ----------
    area : polygon from the first bar to the last, along and across.
    strokes : numbers of its bars' strokes.
    pitch : distance of the bars, m.
    bars : number of them from the first to the last.
    direction : unit vector along the bars (2,), the direction of the traffic that it crosses.
    fill : share of paint at the bars' places less that between them, 0 to 1.
    """

    area: shapely.Polygon
    strokes: tuple[int, ...]
    pitch: float
    bars: int
    direction: np.ndarray
    fill: float


def find_crosswalks(strokes: Sequence[Stroke], polygons: Sequence[shapely.Polygon]) -> list[Crosswalk]:
    """All rows of at least four bars with regular distances, also where shadow or wear cuts a row or its bars.

    Three bars with regular distances are enough to start from: where paint lies at the places of further bars, and
    not between them, the row goes on. Where two or more are alike, worn ones of their pattern are looked for too, and
    those across one street reach as far as each other.

    Parameters
    ----------
    polygons : the markings that the strokes were taken from.
    """
    numbers = np.array([n for n, stroke in enumerate(strokes)
                        if LIMITS.bar_width[0] <= stroke.width <= LIMITS.bar_width[1]
                        and LIMITS.bar_length[0] <= stroke.length <= LIMITS.bar_length[1]], np.int64)
    if len(numbers) < SEED:
        return []
    start = np.array([strokes[n].axis[0] for n in numbers])
    end = np.array([strokes[n].axis[-1] for n in numbers])
    width = np.array([strokes[n].width for n in numbers])
    paint = shapely.STRtree(polygons)
    middles = shapely.points((start + end) / 2.0)
    grown = [_grown(group, start, end, width, middles, paint) for group in _groups(start, end)]
    # Of two that lie in each other the one that explains more paint is right: halves of bars in shadow lie askew.
    rows = sorted((row for row in grown if row is not None and row.count >= FEWEST and
                   row.fill >= LIMITS.least_mean_fill), key=lambda row: -row.count * row.fill)
    rows = _distinct_rows(rows)
    rows = faced_rows([*rows, *worn_rows(strokes, rows, paint)])
    return [_crosswalk(row, numbers[shapely.intersects(row.area.buffer(LIMITS.member), middles)]) for row in rows]


def _grown(group: np.ndarray, start: np.ndarray, end: np.ndarray, width: np.ndarray, middles: np.ndarray,
           paint: shapely.STRtree) -> BarRow | None:
    """The row that a group of bars is part of, None where it is not regular.

    Few bars tell their distance roughly: a row of many is measured anew with all that it reaches, until it grows no
    more; of few, which wear turns easily, the ones that are whole tell its direction better than all.
    """
    best = None
    while best is None or best.count >= LIMITS.many:
        row = _bar_row(start[group], end[group], width[group])
        row = None if row is None else extended(row, paint)
        if row is None or (best is not None and not row.count * row.fill > best.count * best.fill):
            break
        best, group = row, np.flatnonzero(shapely.intersects(row.area.buffer(LIMITS.member), middles))
    return best


def _crosswalk(row: BarRow, numbers: np.ndarray) -> Crosswalk:
    return Crosswalk(row.area, tuple(int(n) for n in numbers), row.pitch, row.count, row.direction, row.fill)


def _distinct_rows(rows: Sequence[BarRow]) -> list[BarRow]:
    """The rows without those that are mostly part of one before them (two pieces of one crosswalk grow to the same)."""
    distinct: list[BarRow] = []
    for row in rows:
        area = row.area
        if not any(area.intersection(other.area).area > 0.3 * min(area.area, other.area.area) for other in distinct):
            distinct.append(row)
    return distinct


def _groups(start: np.ndarray, end: np.ndarray) -> list[np.ndarray]:
    """Bars side by side, as arrays of their places."""
    chord = end - start
    length = np.linalg.norm(chord, axis=1)
    along = chord / length[:, None]
    middle = (start + end) / 2.0
    tree = shapely.STRtree(shapely.linestrings(np.stack([start, end], axis=1)))
    a, b = tree.query(tree.geometries, predicate="dwithin", distance=LIMITS.pitch[1])
    separation = middle[b] - middle[a]
    turn = np.abs(along[a, 0] * along[b, 1] - along[a, 1] * along[b, 0])
    across = np.abs(separation[:, 0] * along[a, 1] - separation[:, 1] * along[a, 0])
    ahead = np.abs((separation * along[a]).sum(axis=1))
    beside = (turn < np.sin(PARALLEL)) & (across > LIMITS.pitch[0]) & (across < LIMITS.pitch[1])
    beside &= ahead < 0.5 * np.maximum(length[a], length[b])
    return [group for group in linked_members(a[beside], b[beside], len(start)) if len(group) >= SEED]


def _bar_row(start: np.ndarray, end: np.ndarray, width: np.ndarray) -> BarRow | None:
    """The row that a group of bars makes, None where it is not regular."""
    chord = end - start
    angle = np.arctan2(chord[:, 1], chord[:, 0])
    length = np.linalg.norm(chord, axis=1)
    doubled = np.average(np.exp(2j * angle), weights=length)
    direction = np.array([np.cos(np.angle(doubled) / 2), np.sin(np.angle(doubled) / 2)])
    normal = np.array([-direction[1], direction[0]])
    place = ((start + end) / 2.0) @ normal
    order = np.argsort(place)
    bar = np.concatenate([[0], np.cumsum(np.diff(place[order]) > LIMITS.pitch[0] / 2)])
    row = np.array([np.average(place[order][bar == one], weights=length[order][bar == one]) for one in np.unique(bar)])
    if len(row) < SEED:
        return None
    steps = np.diff(row)
    pitch = float(np.median(steps[steps < 1.5 * np.median(steps)]))
    off = np.abs(steps / pitch - np.round(steps / pitch))
    if (off < 0.25).mean() < LIMITS.regular or not LIMITS.pitch[0] <= pitch <= LIMITS.pitch[1]:
        return None
    first, pitch, count = _comb(row, pitch)
    ends = np.sort(np.stack([start @ direction, end @ direction]), axis=0)
    full = length >= 0.75 * np.quantile(length, 0.8)
    near, far = (_robust_line(place[full], edge[full]) for edge in ends)
    return BarRow(direction, first, pitch, count, float(np.median(width)) / 2.0, near, far)


def _comb(row: np.ndarray, pitch: float) -> tuple[float, float, int]:
    """First place, pitch (m) and number of places of the regular row through the places (n,) of bars."""
    number = np.round(np.cumsum(np.concatenate([[0.0], np.round(np.diff(row) / pitch)])))
    for _ in range(3):
        slope, level = np.polyfit(number, row, 1)
        good = np.abs(row - level - slope * number) < 0.25 * pitch
        if good.all() or good.sum() < SEED:
            break
        number, row = number[good], row[good]
    return float(level + slope * number[0]), float(slope), int(number[-1] - number[0]) + 1


def _robust_line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Slope and level of the line through points by Theil and Sen; level only where there are few points."""
    i, j = np.triu_indices(len(x), 1)
    far = np.abs(x[i] - x[j]) > 1.0
    slope = float(np.median((y[i] - y[j])[far] / (x[i] - x[j])[far])) if far.sum() >= 6 else 0.0
    slope = float(np.clip(slope, -1.0, 1.0))
    return slope, float(np.median(y - slope * x))
