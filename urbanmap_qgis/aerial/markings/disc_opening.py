"""Opening of an image by a round structuring element, as OpenCV has it, in a quarter of the time for wide ones.

A disc is a stack of rows. The lowest values over rows of all its lengths come from each other, two shifted ones at a
time, so that a disc of n pixels across takes about 3 n comparisons a pixel, not 0.8 n².
"""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np

_BLOCK = 256
"""Pixels, side of the blocks that are worked on at a time: they stay in the processor's cache."""

_LEAST = 11
"""Pixels across; OpenCV is as fast for smaller discs."""


def disc_kernel(diameter: float, pixel: float) -> np.ndarray:
    """Round structuring element of a diameter in m, at least 3 pixels."""
    side = max(round(diameter / pixel) | 1, 3)
    return cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))


def disc_opened(image: np.ndarray, disc: np.ndarray) -> np.ndarray:
    """A float32 image (rows, columns) without what is brighter than its surroundings and narrower than a disc.

    Parameters
    ----------
    disc : (n, n) uint8 from OpenCV's ellipse, n odd. Beyond the image its edge goes on.
    """
    if len(disc) < _LEAST:
        return cv2.morphologyEx(image, cv2.MORPH_OPEN, disc, borderType=cv2.BORDER_REPLICATE)
    return _in_blocks(_in_blocks(image, disc, cv2.min), disc, cv2.max)


def _in_blocks(image: np.ndarray, disc: np.ndarray, pick: Callable[..., np.ndarray]) -> np.ndarray:
    """Lowest or highest values over a disc, block by block."""
    found, reach = np.empty_like(image), len(disc) // 2
    half = disc.sum(axis=1, dtype=int) // 2
    for top in range(0, image.shape[0], _BLOCK):
        for left in range(0, image.shape[1], _BLOCK):
            block = found[top:top + _BLOCK, left:left + _BLOCK]
            sides = [(place, size, min(place - reach, 0), max(place + size + reach - whole, 0))
                     for place, size, whole in zip((top, left), block.shape, image.shape)]
            wide = image[tuple(slice(place - reach - under, place + size + reach - over)
                               for place, size, under, over in sides)]
            beyond = [abs(side) for _, _, under, over in sides for side in (under, over)]
            if any(beyond):
                wide = cv2.copyMakeBorder(wide, *beyond, cv2.BORDER_REPLICATE)
            _over_disc(wide, half, pick, block)
    return found


def _over_disc(wide: np.ndarray, half: np.ndarray, pick: Callable[..., np.ndarray], found: np.ndarray) -> None:
    """Write lowest or highest values over a disc to `found`; `wide` has half its width more on all sides.

    `half` (n,) is how far each of the disc's rows reaches to either side.
    """
    reach = len(half) // 2
    height, width = found.shape
    row, length, first = wide, 0, True  # row[:, x] is of wide[:, x : x + 2 length + 1]
    for next_length in np.unique(half).tolist():
        while length < next_length:
            step = min(next_length - length, max(length, 1))
            both = pick(row[:, :-2 * step], row[:, 2 * step:])
            row = both if length else pick(both, row[:, 1:-1], dst=both)
            length += step
        for down in np.flatnonzero(half == next_length).tolist():
            part = row[down:down + height, reach - length:reach - length + width]
            found[:] = part if first else pick(found, part)
            first = False
