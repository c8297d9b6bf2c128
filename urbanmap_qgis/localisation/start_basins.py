"""Where a local search ends that starts beside the true place: basins of the score over shifts (J 6.2)."""

from __future__ import annotations

import itertools

import numpy as np

from .map_aliases import STEP

REACH = 3.0
"""Starts are looked at within so many of their standard deviations."""

_MARGIN = 4
_SAME = 2
"""A search that ends so many cells from the place, or nearer, has found it."""

BESIDE = _SAME * STEP
"""The same, m."""

_NEIGHBOURS = [each for each in itertools.product((-1, 0, 1), repeat=2) if each != (0, 0)]


def share_elsewhere(score: np.ndarray, start_sigma: float) -> float:
    """Share of starts, normally distributed about the middle with `start_sigma` m, from which the score leads away.

    `score` (s, s) over shifts, rows north, columns east, steps of `STEP`: from each shift a search goes to the highest
    neighbour until none is higher. NaN where the score tells nothing, or reaches no farther than one sigma.
    """
    middle = len(score) // 2
    most = min(int(np.ceil(REACH * start_sigma / STEP)) + _MARGIN, middle)
    near = score[middle - most:middle + most + 1, middle - most:middle + most + 1]
    if np.ptp(near) == 0 or most * STEP < start_sigma:
        return float("nan")
    row, column = np.divmod(_tops(near), len(near))
    away = np.maximum(np.abs(row - most), np.abs(column - most)) > _SAME
    step = (np.arange(len(near)) - most) * STEP
    chance = np.exp(-(step[:, None] ** 2 + step ** 2) / (2 * start_sigma ** 2)).ravel()
    return float(chance[away].sum() / chance.sum())


def _tops(score: np.ndarray) -> np.ndarray:
    """(s * s,) number of the cell in which an ascent from each cell ends."""
    size = len(score)
    cells = np.arange(size * size).reshape(size, size)
    padded = np.pad(score, 1, constant_values=-np.inf)
    highest, leads_to = score, cells
    for down, right in _NEIGHBOURS:
        beside = padded[1 + down:1 + down + size, 1 + right:1 + right + size]
        higher = beside > highest
        highest, leads_to = np.where(higher, beside, highest), np.where(higher, cells + down * size + right, leads_to)
    tops = leads_to.ravel()
    # Each round doubles the steps that are followed.
    for _ in range(int(np.ceil(np.log2(tops.size)))):
        tops = tops[tops]
    return tops
