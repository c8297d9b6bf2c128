"""Lines of two maps met on cross-sections, where they keep their order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from .map_elements import MapElement

STEP = 0.5
"""Distance of the cross-sections along a line, m."""

PARALLEL = np.cos(np.radians(30.0))
"""Lines whose courses differ by more than this angle's are not the same one."""

SAME = 1e-6
"""Crossings of one line so near to each other are one, m."""

OTHER_CLASS = 0.3
"""Where two lines may be the one looked for, that of another class counts as so much farther, m."""


@dataclass(frozen=True)
class LineSamples:
    """Places along lines.

    Attributes
    ----------
    line : (n,) number of the line; the samples of a line are together and in its order.
    along : (n,) m from its begin.
    places, normals : (n, 2) m; normals point to the left.
    bend : (n,) m by which the line between its points may lie beside the curve that they stand for.
    """

    line: np.ndarray
    along: np.ndarray
    places: np.ndarray
    normals: np.ndarray
    bend: np.ndarray

    def of(self, chosen: np.ndarray) -> LineSamples:
        """Those that a mask or indices choose."""
        return LineSamples(*(getattr(self, name)[chosen] for name in ("line", "along", "places", "normals", "bend")))


def line_samples(lines: Sequence[MapElement]) -> LineSamples:
    """Places each `STEP` along lines, one at least on each, in the middle of pieces of one length."""
    numbers, along, places, normals, bend = [], [], [], [], []
    for number, line in enumerate(lines):
        ahead = np.diff(line.points, axis=0)
        lengths = np.linalg.norm(ahead, axis=1)
        ahead, points = ahead[lengths > 0], line.points[np.r_[True, lengths > 0]]
        lengths = lengths[lengths > 0]
        ends = np.cumsum(lengths)
        count = max(int(np.ceil(ends[-1] / STEP)), 1)
        at = (np.arange(count) + 0.5) * ends[-1] / count
        part = np.searchsorted(ends, at)
        course = ahead / lengths[:, None]
        numbers.append(np.full(count, number))
        along.append(at)
        places.append(points[part] + (at - ends[part] + lengths[part])[:, None] * course[part])
        normals.append(np.column_stack([-course[part, 1], course[part, 0]]))
        bend.append(_bend(course, lengths)[part])
    if not numbers:
        return LineSamples(np.empty(0, int), np.empty(0), np.empty((0, 2)), np.empty((0, 2)), np.empty(0))
    return LineSamples(*map(np.concatenate, (numbers, along, places, normals, bend)))


def _bend(course: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """Rise (n,) of the arc over each piece, m.

    An arc turns to the same side at both ends of a piece, by about as much, and its pieces are of about one length.
    """
    if len(lengths) < 2:
        return np.zeros(len(lengths))
    turns = np.arctan2(course[:-1, 0] * course[1:, 1] - course[:-1, 1] * course[1:, 0],
                       (course[:-1] * course[1:]).sum(axis=1))
    first, last = np.r_[turns[:1], turns], np.r_[turns, turns[-1:]]
    beside = np.maximum(np.r_[lengths[1], lengths[:-1]], np.r_[lengths[1:], lengths[-2]])
    return np.where(first * last > 0, np.minimum(np.abs(first), np.abs(last)), 0.0) * np.minimum(lengths, beside) / 8.0


def crossings(samples: LineSamples, lines: Sequence[MapElement], half: float) -> tuple[np.ndarray, ...]:
    """Where lines of about the same course cross the sections of samples.

    Parameters
    ----------
    half : of the sections' length, m.

    Returns
    -------
    Sample, line and offset (m, to the left) of each crossing, ordered by them.
    """
    ends = np.stack([samples.places - half * samples.normals, samples.places + half * samples.normals], axis=1)
    begins = np.concatenate([one.points[:-1] for one in lines])
    ahead = np.concatenate([np.diff(one.points, axis=0) for one in lines])
    owner = np.repeat(np.arange(len(lines)), [len(one.points) - 1 for one in lines])
    tree = shapely.STRtree(shapely.linestrings(np.stack([begins, begins + ahead], axis=1)))
    sample, piece = tree.query(shapely.linestrings(ends), predicate="intersects")
    across = samples.normals[sample]
    turned = ahead[piece, 0] * across[:, 1] - ahead[piece, 1] * across[:, 0]
    parallel = np.abs(turned) >= PARALLEL * np.maximum(np.linalg.norm(ahead[piece], axis=1), LEAST_DIVISOR)
    sample, piece, turned = sample[parallel], piece[parallel], turned[parallel]
    distance = begins[piece] - samples.places[sample]
    offset = (ahead[piece, 0] * distance[:, 1] - ahead[piece, 1] * distance[:, 0]) / turned
    order = np.lexsort((offset, owner[piece], sample))
    sample, line, offset = sample[order], owner[piece][order], offset[order]
    again = (np.diff(sample) == 0) & (np.diff(line) == 0) & (np.diff(offset) < SAME)  # where two pieces meet
    first = np.r_[True, ~again][:len(sample)]
    return sample[first], line[first], offset[first]


@dataclass(frozen=True)
class LineMatches:
    """What each sample of one map is in the other.

    Attributes
    ----------
    other : (n,) number of the line, -1 where there is none.
    across : (n,) m by which that lies to the left of the sample, NaN where there is none.
    nearest : (n,) m to the nearest line of the other map, whatever it is matched to; inf where none is within reach.
    doubled : (n,) m to the nearest other line of the sample's own map.
    """

    other: np.ndarray
    across: np.ndarray
    nearest: np.ndarray
    doubled: np.ndarray


def line_matches(samples: LineSamples, first: Sequence[MapElement], other: Sequence[MapElement],
                 reach: float) -> LineMatches:
    """Match samples of one map with lines of the other: on each section, at the least sum of squared distances.

    Lines of both maps keep their order on a section. Which of several lines beside each other is meant is so decided
    by all of them.

    Parameters
    ----------
    reach : farthest match, m.
    """
    count = len(samples.line)
    matched, across = np.full(count, -1), np.full(count, np.nan)
    nearest, doubled = np.full(count, np.inf), np.full(count, np.inf)
    own_at, other_at = (_Sections(crossings(samples, lines, 2.0 * reach), count) for lines in (first, other))
    beside = own_at.line != samples.line[own_at.sample]
    np.minimum.at(doubled, own_at.sample[beside], np.abs(own_at.offset[beside]))
    np.minimum.at(nearest, other_at.sample, np.abs(other_at.offset))
    _, codes = np.unique([one.kind for one in (*first, *other)], return_inverse=True)
    own_code, other_code = codes[:len(first)], codes[len(first):]
    for rows, columns in np.unique(np.column_stack([own_at.counts, other_at.counts]), axis=0):
        if not rows or not columns:
            continue
        chosen = np.flatnonzero((own_at.counts == rows) & (other_at.counts == columns))
        (owners, places), (lines, offsets) = own_at.of(chosen), other_at.of(chosen)
        costs = (places[:, :, None] - offsets[:, None]) ** 2 + OTHER_CLASS ** 2 * (
            own_code[owners][:, :, None] != other_code[lines][:, None])
        mine = np.argmin(np.where(owners == samples.line[chosen, None], np.abs(places), np.inf), axis=1)
        found = np.take_along_axis(_in_order(costs, reach ** 2), mine[:, None], axis=1)
        hit = found[:, 0] >= 0
        matched[chosen[hit]] = np.take_along_axis(lines, found, axis=1)[hit, 0]
        across[chosen[hit]] = np.take_along_axis(offsets, found, axis=1)[hit, 0]
    return LineMatches(matched, across, nearest, doubled)


class _Sections:
    """Crossings by sample, each sample's by offset."""

    def __init__(self, found: tuple[np.ndarray, ...], count: int):
        sample, line, offset = found
        order = np.lexsort((offset, sample))
        self.sample, self.line, self.offset = sample[order], line[order], offset[order]
        self.counts = np.bincount(sample, minlength=count)
        self._begins = np.cumsum(self.counts) - self.counts

    def of(self, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lines and offsets (n, k) of samples with the same number k of crossings."""
        at = self._begins[chosen, None] + np.arange(self.counts[chosen[0]])
        return self.line[at], self.offset[at]


def _in_order(costs: np.ndarray, most: float) -> np.ndarray:
    """Columns (n, rows) of the rows' matches, -1 for none, of the least sums of costs in which neither order changes.

    A row or a column that stays alone costs half of `most`, so no match costs more than that.

    Parameters
    ----------
    costs : (n, rows, columns), each of the n by itself.
    """
    count, rows, columns = costs.shape
    total = np.zeros((count, rows + 1, columns + 1))
    total[:, :, 0], total[:, 0] = most / 2 * np.arange(rows + 1), most / 2 * np.arange(columns + 1)
    for a in range(rows):
        for b in range(columns):
            total[:, a + 1, b + 1] = np.minimum(total[:, a, b] + costs[:, a, b], most / 2 + np.minimum(
                total[:, a, b + 1], total[:, a + 1, b]))
    found = np.full((count, rows), -1)
    each, a, b = np.arange(count), np.full(count, rows), np.full(count, columns)
    for _ in range(rows + columns):
        going = (a > 0) & (b > 0)
        above, left = np.maximum(a - 1, 0), np.maximum(b - 1, 0)
        cost = total[each, a, b]
        joined = going & (cost == total[each, above, left] + costs[each, above, left])
        alone = going & ~joined & (cost == total[each, above, b] + most / 2)
        found[each[joined], above[joined]] = left[joined]
        a, b = np.where(joined | alone, above, a), np.where(going & ~alone, left, b)
    return found
