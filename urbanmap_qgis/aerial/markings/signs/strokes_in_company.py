"""Strokes that others vouch for: a solid one across the road before the bars of a crossing, and those in line with sure
ones.

Round a stop line and round lines of narrow streets little ground is to be seen by which paint is told.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .crossing_bars import BARS_REACH, CONFIDENCE
from .strokes import LONGEST, Strokes


@dataclass(frozen=True)
class StrokesInCompanyLimits:
    """Limits of strokes, each with its unit."""

    shortest: float = 1.8  # m
    slender: tuple[float, float] = (3.0, 4.0)  # times its width that one is long: before bars, and in line
    widest: tuple[float, float] = (0.8, 0.45)  # m, the same
    before: float = 6.0  # m from the middle of one to those of bars
    square: float = 0.12  # cosine between one and bars
    beyond: float = 0.5  # m, that bars' middles lie beyond its ends at most
    bars: int = 3  # that vouch for one
    sure: float = 0.5  # confidence by the ground beside of one that vouches for others in line
    following: float = 14.0  # m between the middles of those in line
    straight: float = 0.995  # cosine between them
    sideways: float = 0.25  # m, that the middle of one lies off the axis of the other


LIMITS = StrokesInCompanyLimits()

IN_LINE = 0.5
"""Confidence of a stroke in line with a sure one: it stays, and is asked of the user as others in doubt are."""

STROKES_REACH = max(LIMITS.before + BARS_REACH + LONGEST / 2, LIMITS.following + LONGEST)
"""m from a stroke's pixel to the far end of one that vouches for it, or for a bar that does."""


def vouched_confidence(strokes: Strokes, bars: np.ndarray, labels: np.ndarray, rules: np.ndarray) -> np.ndarray:
    """Confidence (m,) of the strokes that others vouch for, float32, 0 of others.

    Parameters
    ----------
    bars : (m,) bool, those that are bars of a crossing.
    labels, rules : (n,) stroke of each pixel, and the confidence by the ground beside, that of their piece.
    """
    vouched = np.where(bars | _before_bars(strokes, _slender(strokes, 0), bars), np.float32(CONFIDENCE), 0)
    sure, in_line = np.zeros(len(bars), bool), _slender(strokes, 1)
    sure[labels] = rules >= LIMITS.sure
    following = _in_line(strokes, in_line, in_line & sure)
    return np.maximum(vouched, np.where(following, np.float32(IN_LINE), 0))


def _slender(strokes: Strokes, kind: int) -> np.ndarray:
    """Which strokes are slender enough, bool (m,), before bars (0) or in line (1)."""
    slender = (strokes.length > LIMITS.shortest) & (strokes.length > LIMITS.slender[kind] * strokes.width)
    return np.isfinite(strokes.box) & slender & (strokes.width < LIMITS.widest[kind])


def _before_bars(strokes: Strokes, asked: np.ndarray, bars: np.ndarray) -> np.ndarray:
    """Which of those asked for (m,) lie across and before enough bars, bool."""
    one, other = _pairs(strokes, asked, bars, LIMITS.before)
    direction = strokes.direction[one]
    square = np.abs((strokes.direction[other] * direction).sum(axis=1)) < LIMITS.square
    along = np.abs(((strokes.middle[other] - strokes.middle[one]) * direction).sum(axis=1))
    beside = square & (along < strokes.length[one] / 2 + LIMITS.beyond)
    return np.bincount(one[beside], minlength=len(asked)) >= LIMITS.bars


def _in_line(strokes: Strokes, asked: np.ndarray, sure: np.ndarray) -> np.ndarray:
    """Which of those asked for (m,) lie in line with a sure one, bool."""
    one, other = _pairs(strokes, asked, sure, LIMITS.following)
    between = strokes.middle[other] - strokes.middle[one]
    good = one != other
    good &= np.abs((strokes.direction[other] * strokes.direction[one]).sum(axis=1)) > LIMITS.straight
    for axis in strokes.direction[one], strokes.direction[other]:
        good &= np.abs(between[:, 0] * axis[:, 1] - between[:, 1] * axis[:, 0]) < LIMITS.sideways
    return np.bincount(one[good], minlength=len(asked)) > 0


def _pairs(strokes: Strokes, asked: np.ndarray, others: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (k,) of those asked for and of others within a reach, m, of their middles."""
    asked, others = np.flatnonzero(asked), np.flatnonzero(others)
    if not len(asked) or not len(others):
        return asked[:0], others[:0]
    trees = [cKDTree(strokes.middle[these]) for these in (asked, others)]
    near = trees[0].sparse_distance_matrix(trees[1], reach, output_type="ndarray")
    return asked[near["i"]], others[near["j"]]
