"""How much sure paint lies round a pixel: paint is seldom alone, and flecks of sun seldom lie where a road is thickly
painted, so that letters in shade stay there."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

THICK = 12.0
"""m2 of sure paint in the sun within reach; under trees a street with lines alone has less."""


def paint_around(kinds: Sequence[np.ndarray], inside: np.ndarray, shape: tuple[int, int], pixel: float, *reach: float
                 ) -> list[np.ndarray]:
    """How many pixels of each kind (float32, n) lie within its `reach`, m, by rows and columns of each of pieces.

    Parameters
    ----------
    kinds : (n,) bool each, such as pixels that are paint for sure.
    inside : (n,) places of the pixels in the flat image of the shape (rows, columns).
    pixel : m.
    """
    around = []
    for kind, side in zip(kinds, (2 * round(far / pixel) + 1 for far in reach)):
        flags = np.zeros(shape, np.uint8)
        flags.ravel()[inside] = kind
        around.append(cv2.boxFilter(flags, cv2.CV_32F, (side, side), normalize=False,
                                    borderType=cv2.BORDER_CONSTANT).take(inside))
    return around
