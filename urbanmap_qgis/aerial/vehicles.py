"""Vehicles taken out of overlapping views of the same ground (J 3.2.1.2).

A vehicle that moves stands in another place in the next frame, so that some frame shows the road where it stood.
"""

from __future__ import annotations

import cv2
import numpy as np

METHODS = ("vote", "darkest")

AGREEMENT = 0.12
"""Views agree where their channels differ by less than this share of the road's own brightness there ..."""

AGREEMENT_FLOOR = 0.04
"""... or by less than this share of the full scale."""


def darkest(views: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Number of the view with the lowest sum of channels among those that see a pixel (J 3.2.1.2).

    Parameters
    ----------
    views : (views, rows, columns, bands), numbers on one scale of exposure.
    seen : (views, rows, columns), True where a view shows the ground.

    Returns
    -------
    (rows, columns) int16, -1 where no view sees the pixel. Of equal ones the first is taken.
    """
    return _lowest(views.sum(axis=-1, dtype=np.float32), seen)


def vote(views: np.ndarray, seen: np.ndarray, full_scale: float, box: int = 3) -> np.ndarray:
    """Number of the view that most of the others agree with; where no two agree, the darkest.

    Taking the darkest lets a dark vehicle over a zebra crossing win against every view of the free paint. Here the
    road wins as soon as two views show it and fewer show one and the same thing in its place. Where several groups
    of views are equally large, the group with the darkest member wins, so that with two views the result is that
    of `darkest`. Of the winning group, the view whose brightness is the group's middle is taken.

    Parameters
    ----------
    views, seen : as in `darkest`.
    full_scale : largest value of the frames' kind of number (255 or 65535).
    box : side in pixels of the neighbourhood over which views are compared, an odd number.

    Returns
    -------
    As `darkest`.
    """
    total = views.sum(axis=-1, dtype=np.float32)
    smooth = _smoothed(views, seen, box)
    agree = _agreement(smooth, seen, full_scale)
    support = agree.sum(axis=0, dtype=np.int16)
    support[~seen] = 0
    most = support == support.max(axis=0, initial=0)
    winner = _lowest(total, seen & most)
    members = np.take_along_axis(agree, np.maximum(winner, 0)[None, None], axis=0)[0] & seen
    return _middle(total, members)


def nearest_nadir(tangents: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Number of the view that looks down most steeply among those that see a pixel.

    Parameters
    ----------
    tangents : (views, rows, columns), tangent of the angle between the ray and the vertical.
    seen : as in `darkest`.
    """
    return _lowest(tangents, seen)


def pick(views: np.ndarray, number: np.ndarray) -> np.ndarray:
    """Pixels (rows, columns, bands) of the views of the given numbers; 0 where the number is -1."""
    image = np.take_along_axis(views, np.maximum(number, 0)[None, :, :, None], axis=0)[0]
    image[number < 0] = 0
    return image


def _lowest(values: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Number of the lowest value of each pixel among the marked ones, int16; -1 where none is marked."""
    number = np.where(among, values, np.inf).argmin(axis=0).astype(np.int16)
    number[~among.any(axis=0)] = -1
    return number


def _middle(values: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Number of the (lower) median value of each pixel among the marked ones; -1 where none is marked."""
    order = np.where(among, values, np.inf).argsort(axis=0, kind="stable").astype(np.int16)
    count = among.sum(axis=0)
    number = np.take_along_axis(order, np.maximum(count - 1, 0)[None] // 2, axis=0)[0]
    number[count == 0] = -1
    return number


def _smoothed(views: np.ndarray, seen: np.ndarray, box: int) -> np.ndarray:
    """Means of each view over a box of seen pixels, so that noise does not decide whether views agree."""
    smooth = np.empty(views.shape, np.float32)
    for view, sees, result in zip(views, seen, smooth, strict=True):
        weight = cv2.boxFilter(sees.astype(np.float32), -1, (box, box), borderType=cv2.BORDER_REPLICATE)
        blurred = cv2.boxFilter(view * sees[..., None].astype(np.float32), -1, (box, box),
                                borderType=cv2.BORDER_REPLICATE).reshape(view.shape)
        result[:] = blurred / np.maximum(weight, 1e-6)[..., None]
    return smooth


def _agreement(smooth: np.ndarray, seen: np.ndarray, full_scale: float) -> np.ndarray:
    """Which views agree with which, (views, views, rows, columns); a view agrees with itself where it sees."""
    count = len(smooth)
    agree = np.zeros((count, *smooth.shape[:1], *smooth.shape[1:3]), bool)
    for first in range(count):
        agree[first, first] = seen[first]
        for second in range(first + 1, count):
            difference = np.abs(smooth[first] - smooth[second]).max(axis=-1)
            level = np.minimum(smooth[first], smooth[second]).mean(axis=-1)
            near = difference < np.maximum(AGREEMENT * level, AGREEMENT_FLOOR * full_scale)
            agree[first, second] = agree[second, first] = near & seen[first] & seen[second]
    return agree
