"""Bars of a crossing vouch for each other: narrow pieces of one length, side by side at a steady step.

Between bars no ground is to be seen by which paint is told, and round a crossing of a narrow street little; that pieces
follow each other like the teeth of a comb says more.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..marking_pieces import MarkingPieces, stroke_axes


@dataclass(frozen=True)
class CrossingBarsLimits:
    """Limits of bars, each with its unit."""

    shortest: float = 1.5  # m
    longest: float = 6.5  # m, diagonal of the box of a piece
    slender: float = 2.5  # times its width that a bar is long
    parallel: float = 0.97  # cosine between two
    uneven: float = 0.4  # of its length, that another is longer or shorter at most
    shifted: tuple[float, float] = (0.25, 0.3)  # of its length, and m, that another is shifted along it at most
    reach: float = 4.0  # m across, to the others that vouch for it
    apart: float = 0.5  # m between the axes of neighbours at least
    step: float = 1.4  # m between them at most
    sparse: float = 4.0  # times their width, the same: ribs of roofs are thinner
    unsteady: float = 0.12  # of the step, that others lie off whole steps
    company: int = 2  # others like it that vouch for a bar
    part: float = 0.6  # of the length of others, that a part of a worn bar reaches from beside their middles at most
    part_company: int = 3  # others that vouch for it, none off whole steps


LIMITS = CrossingBarsLimits()

CONFIDENCE = 0.75
"""That bars are paint: 0.96 and more of what they add were in sample cities, 0.6 (13 of 22 m2 by eye) in six
photographs, where ribs of roofs and a deck have bars too."""

_FARTHEST = math.hypot(LIMITS.reach, LIMITS.part * LIMITS.longest)
"""m between the middles of a piece and of a bar that vouches for it."""

BARS_REACH = LIMITS.longest + _FARTHEST
"""m from a piece's pixel to the far end of one that vouches for it."""

_PARTS = 64.0
"""Of a pixel, in which middles are told: what is compared does not depend on where an image is cut."""


def crossing_bars(pieces: MarkingPieces, accepted: np.ndarray, columns: int, pixel: float,
                  max_width: float) -> np.ndarray:
    """Which accepted pieces (m,) of an image of so many columns are bars, or parts of worn ones, with others beside
    them, bool; `pixel` and `max_width` in m."""
    found = accepted & (pieces.length < LIMITS.longest)
    inside = found[pieces.labels]
    axes = stroke_axes(pieces.labels[inside], *np.divmod(pieces.inside[inside], columns), pieces.size)
    length, width = (pixel * np.sqrt(12 * square + 1) for square in (axes.along, axes.across))
    narrow = np.flatnonzero(found & (width < max_width))
    length, width = length[narrow], width[narrow]
    bars = (length > LIMITS.shortest) & (length > LIMITS.slender * width)
    found = np.zeros(len(found), bool)
    if np.count_nonzero(bars) > LIMITS.company:
        middle = np.rint(axes.middle[narrow] * _PARTS) / _PARTS * pixel
        found[narrow] = _vouched(middle, axes.direction[narrow], length, width, bars)
    return found


def _vouched(middles: np.ndarray, directions: np.ndarray, length: np.ndarray, width: np.ndarray, bars: np.ndarray
             ) -> np.ndarray:
    """Which narrow pieces have enough bars beside them at whole steps, bool (n,).

    Parameters
    ----------
    middles, directions : (n, 2), in m and of length 1.
    length, width : (n,) m.
    bars : (n,) bool, those long enough.
    """
    pairs = cKDTree(middles).query_pairs(_FARTHEST, output_type="ndarray")
    one, other = np.concatenate([pairs, pairs[:, ::-1]])[np.concatenate([bars[pairs[:, 1]], bars[pairs[:, 0]]])].T
    between, along = middles[other] - middles[one], directions[other]
    beside = np.abs(between[:, 0] * along[:, 1] - between[:, 1] * along[:, 0])
    shift = np.abs((between * along).sum(axis=1))
    like = bars[one] & (np.abs((directions[one] * along).sum(axis=1)) > LIMITS.parallel)
    like &= shift < LIMITS.shifted[0] * length[one] + LIMITS.shifted[1]
    like &= np.abs(length[other] - length[one]) < LIMITS.uneven * length[one]
    good = like | (shift + length[one] / 2 < LIMITS.part * length[other])
    good &= (beside > LIMITS.apart) & (beside < LIMITS.reach)
    one, beside, like, wide = one[good], beside[good], like[good], width[other[good]]
    return _in_step(one, beside, wide, like, len(middles))


def _in_step(one: np.ndarray, beside: np.ndarray, wide: np.ndarray, like: np.ndarray, count: int) -> np.ndarray:
    """Which of so many pieces have enough bars at whole steps, bool (count,).

    Parameters
    ----------
    one : (n,) the piece that each bar vouches for.
    beside, wide : (n,) m between them, and the bar's width.
    like : (n,) bool, bars that are as it is.
    """
    def total(values: np.ndarray) -> np.ndarray:
        return np.bincount(one, values, minlength=count)

    nearest = np.full(count, np.inf)
    np.minimum.at(nearest, one, beside)
    steps = np.rint(beside / nearest[one])
    others, step = total(np.ones(len(one))), total(beside) / np.maximum(total(steps), 1)
    steady = np.abs(beside - steps * step[one]) < LIMITS.unsteady * step[one]
    vouched = total(steady & like) >= LIMITS.company
    vouched |= (total(steady) >= LIMITS.part_company) & (total(steady) == others)
    return vouched & (step < LIMITS.step) & (step * others < LIMITS.sparse * total(wide))
