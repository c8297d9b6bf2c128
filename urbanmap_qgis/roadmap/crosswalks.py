"""Crosswalks: rows of parallel bars of paint, also where bars are worn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from .strokes import Stroke

BAR_WIDTH = (0.25, 0.85)
"""Of a bar, m; 45 or 50 cm in most countries."""

BAR_LENGTH = (0.8, 9.0)
PITCH = (0.65, 1.75)
"""Distance of neighbouring bars' centre lines, m."""

PARALLEL = np.radians(12.0)
FEWEST = 4
"""Bars of a crosswalk."""

REGULAR = 0.6
"""Share of the distances between bars that must be multiples of the pitch, to a quarter of it."""


@dataclass(frozen=True)
class Crosswalk:
    """A row of bars.

    Attributes
    ----------
    area : polygon from the first bar to the last, along and across.
    strokes : numbers of its bars' strokes.
    pitch : distance of the bars, m. bars : number of them that were seen.
    direction : unit vector along the bars (2,), the direction of the traffic that it crosses.
    """

    area: shapely.Polygon
    strokes: tuple[int, ...]
    pitch: float
    bars: int
    direction: np.ndarray


def find_crosswalks(strokes: Sequence[Stroke]) -> list[Crosswalk]:
    """All rows of at least four bars with regular distances."""
    numbers = np.array([n for n, stroke in enumerate(strokes) if BAR_WIDTH[0] <= stroke.width <= BAR_WIDTH[1]
                        and BAR_LENGTH[0] <= stroke.length <= BAR_LENGTH[1]], np.int64)
    if len(numbers) < FEWEST:
        return []
    start = np.array([strokes[n].axis[0] for n in numbers])
    end = np.array([strokes[n].axis[-1] for n in numbers])
    found = []
    width = np.array([strokes[n].width for n in numbers])
    for group in _groups(start, end):
        made = _crosswalk(start[group], end[group], numbers[group], width[group])
        if made is not None:
            found.append(made)
    return found


def _groups(start: np.ndarray, end: np.ndarray) -> list[np.ndarray]:
    """Bars side by side, as arrays of their places."""
    chord = end - start
    length = np.linalg.norm(chord, axis=1)
    along = chord / length[:, None]
    middle = (start + end) / 2.0
    tree = shapely.STRtree(shapely.linestrings(np.stack([start, end], axis=1)))
    a, b = tree.query(tree.geometries, predicate="dwithin", distance=PITCH[1])
    apart = middle[b] - middle[a]
    turn = np.abs(along[a, 0] * along[b, 1] - along[a, 1] * along[b, 0])
    across = np.abs(apart[:, 0] * along[a, 1] - apart[:, 1] * along[a, 0])
    ahead = np.abs((apart * along[a]).sum(axis=1))
    beside = (turn < np.sin(PARALLEL)) & (across > PITCH[0]) & (across < PITCH[1])
    beside &= ahead < 0.5 * np.maximum(length[a], length[b])
    count = len(start)
    links = coo_matrix((np.ones(beside.sum()), (a[beside], b[beside])), shape=(count, count))
    label = connected_components(links, directed=False)[1]
    return [np.flatnonzero(label == one) for one in np.unique(label) if (label == one).sum() >= FEWEST]


def _crosswalk(start: np.ndarray, end: np.ndarray, numbers: np.ndarray, width: np.ndarray) -> Crosswalk | None:
    """The crosswalk that a group of bars makes, None where their row is not regular."""
    chord = end - start
    angle = np.arctan2(chord[:, 1], chord[:, 0])
    length = np.linalg.norm(chord, axis=1)
    doubled = np.average(np.exp(2j * angle), weights=length)
    direction = np.array([np.cos(np.angle(doubled) / 2), np.sin(np.angle(doubled) / 2)])
    normal = np.array([-direction[1], direction[0]])
    place = ((start + end) / 2.0) @ normal
    order = np.argsort(place)
    bar = np.concatenate([[0], np.cumsum(np.diff(place[order]) > PITCH[0] / 2)])
    row = np.array([np.average(place[order][bar == one], weights=length[order][bar == one]) for one in np.unique(bar)])
    if len(row) < FEWEST:
        return None
    steps = np.diff(row)
    pitch = float(np.median(steps[steps < 1.5 * np.median(steps)]))
    off = np.abs(steps / pitch - np.round(steps / pitch))
    if (off < 0.25).mean() < REGULAR or not PITCH[0] <= pitch <= PITCH[1]:
        return None
    ends = np.sort(np.stack([start @ direction, end @ direction]), axis=0)
    full = length >= 0.75 * np.quantile(length, 0.8)
    half = float(np.median(width)) / 2.0
    corners = []
    for edge in ends:
        slope, level = _robust_line(place[full], edge[full])
        corners.append([(p, slope * p + level) for p in (row[0] - half, row[-1] + half)])
    ring = np.array([*corners[0], *corners[1][::-1]])
    plan = shapely.Polygon(ring[:, :1] * normal + ring[:, 1:] * direction)
    return Crosswalk(plan, tuple(int(n) for n in numbers), pitch, len(row), direction)


def _robust_line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Slope and level of the line through points by Theil and Sen; level only where there are few points."""
    i, j = np.triu_indices(len(x), 1)
    far = np.abs(x[i] - x[j]) > 1.0
    slope = float(np.median((y[i] - y[j])[far] / (x[i] - x[j])[far])) if far.sum() >= 6 else 0.0
    slope = float(np.clip(slope, -1.0, 1.0))
    return slope, float(np.median(y - slope * x))
