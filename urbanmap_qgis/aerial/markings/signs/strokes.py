"""Accepted pieces as strokes: where they lie, which way, how long and how wide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..marking_pieces import MarkingPieces, stroke_axes

LONGEST = 8.0
"""m, diagonal of the box of the longest ones."""

_PARTS = 64.0
"""Of a pixel, in which middles are told: what is compared does not depend on where an image is cut."""


@dataclass(frozen=True)
class Strokes:
    """Pieces of a mask as strokes.

    Attributes
    ----------
    middle : (m, 2) row and column, m.
    direction : (m, 2) of length 1.
    length, width : (m,) m.
    box : (m,) m, diagonal of the box of the piece; infinite of those not accepted, or longer than `LONGEST`, of which
        nothing else is told.
    """

    middle: np.ndarray
    direction: np.ndarray
    length: np.ndarray
    width: np.ndarray
    box: np.ndarray


def strokes_of(pieces: MarkingPieces, accepted: np.ndarray, columns: int, pixel: float) -> Strokes:
    """The accepted pieces (m,) of an image of so many columns with pixels of so many m."""
    told = accepted & (pieces.length < LONGEST)
    inside = told[pieces.labels]
    axes = stroke_axes(pieces.labels[inside], *np.divmod(pieces.inside[inside], columns), pieces.size)
    return Strokes(np.rint(axes.middle * _PARTS) / _PARTS * pixel, axes.direction,
                   pixel * np.sqrt(12 * axes.along + 1), pixel * np.sqrt(12 * axes.across + 1),
                   np.where(told, pieces.length, np.inf))
