"""What the search for markings took and rejected, by which a result is judged without any truth.

Counts are of an image's own pixels and pieces, so that they mean the same in every kind of image; those of tiles add
up, and hardly depend on how an image is cut (pixels along seams count twice).
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

PALE = 0.75
"""Of the highest number that an image can hold, that all colours exceed in what is nearly white."""

GREEN = 1.06
"""Times red and blue, that green is in leaves."""


@dataclass(frozen=True)
class SearchTally:
    """Sums over an image or a part of it.

    Attributes
    ----------
    seen, empty, full, colourless : pixels of the image; without any light; with a colour at the top of what its numbers
        can hold; with all colours alike.
    narrow, painted : bright pixels that stand out on two sides; of these, taken for paint.
    likely, sure : sums of their confidence, which is how many of them are paint, and of those taken.
    pale, green : pixels of the image that are nearly white; that are green.
    """

    seen: int = 0
    empty: int = 0
    full: int = 0
    colourless: int = 0
    narrow: int = 0
    painted: int = 0
    likely: float = 0.0
    sure: float = 0.0
    pale: int = 0
    green: int = 0

    @property
    def precision(self) -> float | None:
        """Share of what was taken that is paint, by its confidence; None where that was not measured."""
        return self.sure / self.painted if self.likely and self.painted else None

    @property
    def recall(self) -> float | None:
        """Share of the paint that was taken, by the confidence of all that is bright and narrow; None as well."""
        return self.sure / self.likely if self.likely else None

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
                    pale=np.count_nonzero(seen & (lowest > PALE * top)), green=_green(colours, seen))


def _green(colours: np.ndarray, seen: np.ndarray) -> int:
    """Pixels of colours (1 or 3, rows, columns) where green is above red and blue."""
    if len(colours) < 3:
        return 0
    other = np.maximum(colours[0], colours[2]).astype(np.float32)
    other *= np.float32(GREEN)
    return np.count_nonzero(seen & (colours[1] > other))
