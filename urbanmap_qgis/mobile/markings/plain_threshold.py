"""Marking points by the paper's adaptive threshold alone (J 3.2.3.3, Table 3-2).

Calibrated intensities of ground points become an image of 8 bits, which is thresholded as the aerial one: a pixel is
marking where it is brighter than the Gaussian weighted mean of its block by more than c. J gives the block in metres
and in pixels (2.5 m, 21), from which the pixel follows, and c, but neither how intensities become grey values nor what
fills pixels without points: here white is the brightness that 0.1 % of the ground exceeds, and such pixels are asphalt.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ...errors import InputError
from ...geometry.grid import Grid
from ...wording import say
from .marking_points import MarkingAnswer

PIXEL = 0.12
"""m, side of a pixel: 2.5 m are 21 pixels."""

WHITE_SHARE = 0.999
"""Share of the ground's points that are darker than white."""


@dataclass(frozen=True)
class PlainThreshold:
    """The paper's threshold.

    Attributes
    ----------
    block_size : m, side of the block (J Table 3-2: 2.5 m).
    c : grey levels of 256 (J: 17).
    """

    block_size: float = 2.5
    c: float = 17.0

    def __post_init__(self) -> None:
        if not self.block_size >= 3 * PIXEL or not self.c > 0:
            raise InputError(say("The block of the paper's threshold must be {pixel:g} m or larger, and c above 0.",
                                 pixel=3 * PIXEL))

    @property
    def block_pixels(self) -> int:
        """Side of the block in pixels, odd."""
        return 2 * round((self.block_size / PIXEL - 1) / 2) + 1

    @property
    def reach(self) -> float:
        """How far, m, the answer for a point looks round it."""
        return (self.block_pixels // 2 + 1) * PIXEL


def plain_marking_points(x: np.ndarray, y: np.ndarray, brightness: np.ndarray, white: float,
                         settings: PlainThreshold = PlainThreshold()) -> MarkingAnswer:
    """Which ground points lie on pixels above the threshold; all weigh 1.

    Parameters
    ----------
    x, y : (n,) m.
    brightness : (n,) calibrated intensity in units of asphalt's.
    white : the brightness of grey value 255.
    """
    n = len(x)
    if not n:
        return MarkingAnswer(np.zeros(0, bool), np.zeros(0, np.float32), np.zeros(0, np.float32))
    grid = Grid.covering(x.min() - settings.reach, y.min() - settings.reach, x.max() + settings.reach,
                         y.max() + settings.reach, PIXEL)
    row, column, _ = grid.cells(x, y)
    cell = row * grid.columns + column
    count = np.bincount(cell, minlength=grid.rows * grid.columns)
    mean = np.ones(grid.rows * grid.columns)
    total = np.bincount(cell, weights=brightness, minlength=len(mean))
    np.divide(total, count, out=mean, where=count > 0)
    grey = np.round(np.clip(mean * (255.0 / white), 0, 255)).astype(np.uint8).reshape(grid.shape)
    marking = cv2.adaptiveThreshold(grey, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY,
                                    settings.block_pixels, -settings.c)
    paint = marking.ravel()[cell] > 0
    contrast = np.where(paint, brightness, np.nan).astype(np.float32)
    return MarkingAnswer(paint, paint.astype(np.float32), contrast)
