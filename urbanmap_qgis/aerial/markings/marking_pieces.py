"""Connected pieces of bright narrow pixels."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

ALONG_REACH = 1.25
"""m round a pixel of a long piece over which its confidence is a mean."""


@dataclass(frozen=True)
class MarkingPieces:
    """Connected pieces of flags.

    Attributes
    ----------
    inside : (n,) places of the flags in the flat image.
    labels : (n,) the piece that each belongs to, from 0 (none).
    size : (m,) flags of each piece.
    long : (m,) bool, too long to be judged as one.
    """

    inside: np.ndarray
    labels: np.ndarray
    size: np.ndarray
    long: np.ndarray


def marking_pieces_of(mask: np.ndarray, pixel: float, min_area: float, max_length: float) -> MarkingPieces:
    """MarkingPieces of flags (uint8, 0 or 1), which lose those smaller than `min_area` m2; `max_length` in m."""
    _count, labels, boxes, _centres = cv2.connectedComponentsWithStats(mask, connectivity=8)
    size = boxes[:, cv2.CC_STAT_AREA]
    inside = np.flatnonzero(mask)
    which = labels.take(inside)
    small = size[which] * pixel ** 2 < min_area
    mask.ravel()[inside[small]] = 0
    long = np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel >= max_length
    return MarkingPieces(inside[~small], which[~small], size, long)


def variances(labels: np.ndarray, rows: np.ndarray, columns: np.ndarray, size: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray]:
    """Variances (m,) along and across the main axes of pieces of sizes (m,), of pixels at rows and columns (n,)."""
    some = np.maximum(size, 1)

    def mean(values: np.ndarray) -> np.ndarray:
        return np.bincount(labels, values, minlength=len(size)) / some

    down, across = rows - mean(rows)[labels], columns - mean(columns)[labels]
    first, second, mixed = mean(down * down), mean(across * across), mean(down * across)
    half, root = (first + second) / 2, np.hypot((first - second) / 2, mixed)
    return half + root, np.maximum(half - root, 0)


def along_strokes(values: np.ndarray, inside: np.ndarray, shape: tuple[int, int], pixel: float) -> np.ndarray:
    """Means (n,) of values, 0 to 1, of pixels at flat places in an image of a shape over those within `ALONG_REACH`."""
    side = 2 * max(round(ALONG_REACH / pixel), 1) + 1

    def around(numbers: np.ndarray | int) -> np.ndarray:
        image = np.zeros(shape, np.uint8)
        image.ravel()[inside] = numbers
        return cv2.boxFilter(image, cv2.CV_32F, (side, side), normalize=False,
                             borderType=cv2.BORDER_CONSTANT).take(inside)

    return around(np.rint(values * np.float32(255))) / np.float32(255) / np.maximum(around(1), 1)
