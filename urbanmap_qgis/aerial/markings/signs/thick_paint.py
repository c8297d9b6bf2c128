"""How much sure paint lies round a pixel: paint is seldom alone, and flecks of sun seldom lie where a road is thickly
painted, so that letters in shade stay there."""

from __future__ import annotations

import cv2
import numpy as np

THICK = 12.0
"""m2 of sure paint in the sun within reach; under trees a street with lines alone has less."""


def paint_around(sure: np.ndarray, inside: np.ndarray, shape: tuple[int, int], pixel: float, reach: float
                 ) -> np.ndarray:
    """How many sure pixels (float32, n) lie within `reach` m by rows and columns of each pixel of pieces.

    Parameters
    ----------
    sure : (n,) bool, pixels that are paint for sure.
    inside : (n,) places of the pixels in the flat image of the shape (rows, columns).
    pixel : m.
    """
    flags = np.zeros(shape, np.uint8)
    flags.ravel()[inside] = sure
    side = 2 * round(reach / pixel) + 1
    around = cv2.boxFilter(flags, cv2.CV_32F, (side, side), normalize=False, borderType=cv2.BORDER_CONSTANT)
    return around.take(inside)
