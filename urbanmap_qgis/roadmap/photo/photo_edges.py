"""Edges of roads in an orthophoto: where the road's surface gives way to another one, along the road's lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d, median_filter, uniform_filter1d

from .straight_photo import StraightPhoto

REACH = 16.0  # An edge is looked for so far beyond the road's outermost line, m.
MARGIN = 1.2  # The surface is compared over so many metres on both sides of it, m.
NEAREST = 0.2  # It lies so far beyond the line at least, m.
# What is no road before it costs no more than such a length of it, m: vehicles stand there and crowns hang over.
HIDDEN = 0.8
SEEN = 0.12  # What a metre of road before it is worth, m: else the side of a row of vehicles would do.
BEND = 1.5  # What a step of one column aside costs, m: only edges that go on aside are followed.
TOLD = 0.3  # Likeness to road that is asked for before it, and its negative beyond it.
LEAST = 8.0  # An edge shows over so many metres at least, m,
SHARE = 0.4  # and over such a share of the section.
ONWARD = 12.0  # It is drawn on beyond where it shows by so much, m.
# A strip so wide, m, whose log brightness differs so much from the road's is another surface.
STRIP = 1.0
OTHER = 0.25
SMOOTH = 1.5  # Standard deviation of the smoothing along the road, m.

SIGMA = 0.1
"""Standard deviation of an edge of the image across the road, m: a column of it, and what kerbs are wide."""


@dataclass(frozen=True)
class PhotoEdge:
    """An edge of a road section.

    Attributes
    ----------
    side : 1 to the left of the axis, -1 to its right.
    offset : (n,) at all chainages of the photo, m.
    first, last : rows of the photo between which it is told.
    shown : share of that length on which the image shows it.
    """

    side: int
    offset: np.ndarray
    first: int
    last: int
    shown: float

    @property
    def usual(self) -> float:
        """Its median offset, m."""
        return float(np.median(self.offset[self.first:self.last + 1]))


def photo_edges(photo: StraightPhoto, like: np.ndarray, lit: np.ndarray, outermost: np.ndarray) -> list[PhotoEdge]:
    """Edges on both sides of a section; none where the image shows none, or where a strip before it is brighter or
    darker than the road all along: pavements may look like roads, and what ends there is the pavement.

    Parameters
    ----------
    like, lit : (n, m), see `road_likeness`.
    outermost : (2, n) offsets of the lines that are outermost on the right and on the left, m.
    """
    step = photo.chainage[1] - photo.chainage[0]
    found = []
    for side, start in zip((-1, 1), outermost):
        columns = slice(None, None, side)
        path, before, beyond = _best_path(like[:, columns], side * photo.offset[columns], side * start, step)
        shows = (before > TOLD) & (beyond < -TOLD)
        shows = median_filter(shows.astype(np.uint8), int(2.0 / step) | 1).astype(bool)
        if shows.mean() < SHARE or shows.sum() * step < LEAST:
            continue
        offset = side * gaussian_filter1d(path, SMOOTH / step, mode="nearest")
        more, rows = int(ONWARD / step), np.flatnonzero(shows)
        first, last = max(0, rows[0] - more), min(len(path) - 1, rows[-1] + more)
        across = start[first:last + 1, None] + side * np.arange(MARGIN / 3.0, abs(np.median(offset - start)) -
                                                                MARGIN / 3.0, STRIP / 4.0)
        rows = np.arange(first, last + 1)[:, None]
        strips = np.abs(np.nanmedian(lit[rows, photo.column(across)], axis=0)) > OTHER if across.size else []
        if np.sum(strips) * STRIP / 4.0 >= STRIP:
            continue
        found.append(PhotoEdge(side, offset, first, last, float(shows[first:last + 1].mean())))
    return found


def _best_path(like: np.ndarray, offset: np.ndarray, start: np.ndarray, step: float
               ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Offsets (n,) of the edge beyond a line (n,), and the likeness to road before and beyond it (by Viterbi)."""
    like = uniform_filter1d(like, int(1.0 / step) | 1, axis=0, mode="nearest")
    count, width = like.shape
    cell = offset[1] - offset[0]
    margin = int(MARGIN / cell)
    column, rows = np.arange(width), np.arange(count)
    line = np.clip(np.round((start - offset[0]) / cell).astype(int), 0, width - 1)
    total, against = (np.concatenate([np.zeros((count, 1)), np.cumsum(one, axis=1)], axis=1) * cell
                      for one in (like, np.minimum(like, 0.0)))
    before = total[:, column] - total[:, np.maximum(column - margin, 0)]
    beyond = total[:, np.minimum(column + margin, width)] - total[:, column]
    score = before - beyond + SEEN * (total[:, column] - total[rows, line][:, None])
    score += np.maximum(against[:, column] - against[rows, line][:, None], -HIDDEN)
    reach = int(REACH / cell) - margin
    away = column[None] - line[:, None]
    score[(away < NEAREST / cell) | (away > reach)] = -5.0
    best, steps = score[0], np.zeros((count, width), int)
    for row in range(1, count):
        aside = np.full((3, width), -np.inf)
        aside[0, 1:], aside[1], aside[2, :-1] = best[:-1] - BEND, best, best[1:] - BEND
        steps[row] = aside.argmax(axis=0) - 1
        best = aside.max(axis=0) + score[row]
    path = np.zeros(count, int)
    path[-1] = best.argmax()
    for row in range(count - 1, 0, -1):
        path[row - 1] = path[row] + steps[row, path[row]]
    return offset[path] - cell / 2.0, before[rows, path] / MARGIN, beyond[rows, path] / MARGIN
