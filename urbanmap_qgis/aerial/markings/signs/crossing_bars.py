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
    sparse: float = 5.0  # times its width, the same: ribs of roofs are thinner
    unsteady: float = 0.25  # of the step, that others lie off whole steps
    company: int = 2  # others that vouch for a bar


LIMITS = CrossingBarsLimits()

CONFIDENCE = 0.9
"""That bars are paint: 0.96 and more were in sample cities, 3.8 of 4.1 m2 that are added in photographs by eye."""

_FARTHEST = math.hypot(LIMITS.reach, LIMITS.shifted[0] * LIMITS.longest + LIMITS.shifted[1])

BARS_REACH = LIMITS.longest + _FARTHEST
"""m from a bar's pixel to the far end of one that vouches for it."""

_PARTS = 64.0
"""Of a pixel, in which middles are told: what is compared does not depend on where an image is cut."""


def bars_confidence(pieces: MarkingPieces, accepted: np.ndarray, columns: int, pixel: float, max_width: float
                    ) -> np.ndarray:
    """Confidence (m,) float32 of pieces as bars, 0 of those that are none; parameters as of `crossing_bars`."""
    return np.where(crossing_bars(pieces, accepted, columns, pixel, max_width), np.float32(CONFIDENCE), np.float32(0))


def crossing_bars(pieces: MarkingPieces, accepted: np.ndarray, columns: int, pixel: float, max_width: float
                  ) -> np.ndarray:
    """Which of the accepted pieces (m,) of an image of so many columns are bars with others beside them, bool; `pixel`
    and `max_width` in m."""
    asked = accepted & (pieces.length > LIMITS.shortest) & (pieces.length < LIMITS.longest)
    inside = asked[pieces.labels]
    axes = stroke_axes(pieces.labels[inside], *np.divmod(pieces.inside[inside], columns), pieces.size)
    length, width = pixel * np.sqrt(12 * axes.along + 1), pixel * np.sqrt(12 * axes.across + 1)
    bars = np.flatnonzero(asked & (length > LIMITS.shortest) & (width < max_width) & (length > LIMITS.slender * width))
    found = np.zeros(len(asked), bool)
    if len(bars) > LIMITS.company:
        middles = np.rint(axes.middle[bars] * _PARTS) / _PARTS * pixel
        found[bars] = _vouched(middles, axes.direction[bars], length[bars], width[bars])
    return found


def _vouched(middles: np.ndarray, directions: np.ndarray, length: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Which bars have enough others beside them at whole steps, bool (n,); middles (n, 2), lengths and widths in m,
    directions (n, 2)."""
    pairs = cKDTree(middles).query_pairs(_FARTHEST, output_type="ndarray")
    one, other = np.concatenate([pairs, pairs[:, ::-1]]).T
    between, along = middles[other] - middles[one], directions[one]
    beside = np.abs(between[:, 0] * along[:, 1] - between[:, 1] * along[:, 0])
    good = np.abs((directions[other] * along).sum(axis=1)) > LIMITS.parallel
    good &= np.abs((between * along).sum(axis=1)) < LIMITS.shifted[0] * length[one] + LIMITS.shifted[1]
    good &= np.abs(length[other] - length[one]) < LIMITS.uneven * length[one]
    good &= (beside > LIMITS.apart) & (beside < LIMITS.reach)
    one, beside = one[good], beside[good]
    step = np.full(len(middles), np.inf)
    np.minimum.at(step, one, beside)
    steps = beside / step[one]
    steady = np.abs(steps - np.rint(steps)) < LIMITS.unsteady
    enough = np.bincount(one[steady], minlength=len(middles)) >= LIMITS.company
    return enough & (step < np.minimum(LIMITS.step, LIMITS.sparse * width))
