"""What the search for markings took and rejected, by which a result is judged without any truth.

Counts are of an image's own pixels and pieces, so that they mean the same in every kind of image; those of tiles add
up, and hardly depend on how an image is cut (pixels along seams count twice).
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from .marking_pieces import variances


@dataclass(frozen=True)
class SearchTallyLimits:
    """Limits of evidence, each with its unit."""

    straight: float = 2.0  # m: pieces of this length or more tell of lines
    slender: float = 0.25  # m: of these, the standard deviation across is less
    pale: float = 0.75  # of the highest number that an image can hold, that all colours exceed in what is nearly white
    green: float = 1.06  # times red and blue, that green is in leaves


LIMITS = SearchTallyLimits()


@dataclass(frozen=True)
class SearchTally:
    """Sums over an image or a part of it.

    Attributes
    ----------
    seen, empty, full, colourless : pixels of the image; without any light; with a colour at the top of what its numbers
        can hold; with all colours alike.
    narrow : bright pixels that stand out on two sides.
    painted, unsure : of these, taken for paint, and left out by their confidence alone.
    clear, smooth : pixels of ground without paint; of these, smooth, grey and as bright as around.
    colder : of `narrow` (round tiles counted again), where only a colour bluer than the ground's speaks against paint.
    pale, green : pixels of the image that are nearly white; that are green.
    straight, straight_unsure : pixels of slender straight pieces of `narrow`; of these, left out by their confidence.
    """

    seen: int = 0
    empty: int = 0
    full: int = 0
    colourless: int = 0
    narrow: int = 0
    painted: int = 0
    unsure: int = 0
    clear: int = 0
    smooth: int = 0
    straight: int = 0
    straight_unsure: int = 0
    colder: int = 0
    pale: int = 0
    green: int = 0

    def __add__(self, other: SearchTally) -> SearchTally:
        return SearchTally(**{one.name: getattr(self, one.name) + getattr(other, one.name) for one in fields(self)})


def evidence_of_light(bands: np.ndarray, seen: np.ndarray, top: float) -> SearchTally:
    """Of the light in a piece of image: bands (1 or 3 and more, rows, columns), where ground is seen (bool), and the
    highest number that the image can hold."""
    colours = bands[:3]
    highest = colours.max(axis=0)
    lowest = colours.min(axis=0)
    alike = highest == lowest
    return SearchTally(seen=np.count_nonzero(seen), empty=np.count_nonzero(seen & (highest <= 0)),
                    full=np.count_nonzero(seen & (highest >= top)), colourless=np.count_nonzero(seen & alike),
                    pale=np.count_nonzero(seen & (lowest > LIMITS.pale * top)), green=_green(colours, seen))


def _green(colours: np.ndarray, seen: np.ndarray) -> int:
    """Pixels of colours (1 or 3, rows, columns) where green is above red and blue."""
    if len(colours) < 3:
        return 0
    other = np.maximum(colours[0], colours[2]).astype(np.float32)
    other *= np.float32(LIMITS.green)
    return np.count_nonzero(seen & (colours[1] > other))


def evidence_of_pieces(inside: np.ndarray, labels: np.ndarray, accepted: np.ndarray, good: np.ndarray,
                       shape: tuple[int, int], counted: tuple[slice, slice], pixel: float) -> SearchTally:
    """Of bright narrow pixels in some rows and columns.

    Parameters
    ----------
    inside : (n,) their places in the flat image.
    labels : (n,) the pieces that they belong to, from 0.
    accepted, good : (n,) bool, by all but confidence, and by that too.
    shape : of the image, pixels.
    counted : rows and columns.
    pixel : side, m.
    """
    rows, columns = np.divmod(inside, shape[1])
    in_tile = ((rows >= counted[0].start) & (rows < counted[0].stop)
               & (columns >= counted[1].start) & (columns < counted[1].stop))
    straight = _slender(labels, rows, columns, pixel)[labels] & accepted & in_tile
    return SearchTally(narrow=np.count_nonzero(in_tile), painted=np.count_nonzero(good & in_tile),
                    unsure=np.count_nonzero(accepted & ~good & in_tile), straight=np.count_nonzero(straight),
                    straight_unsure=np.count_nonzero(straight & ~good))


def _slender(labels: np.ndarray, rows: np.ndarray, columns: np.ndarray, pixel: float) -> np.ndarray:
    """Which pieces are long, straight and narrow, by their pixels' second moments, bool."""
    along, across = variances(labels, rows, columns, np.bincount(labels, minlength=1))
    return (pixel * np.sqrt(12 * along) >= LIMITS.straight) & (pixel * np.sqrt(across) < LIMITS.slender)
