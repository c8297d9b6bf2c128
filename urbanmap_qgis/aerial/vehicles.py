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

LIKENESS = 0.2
"""A view is like the road around where its channels differ by less than this share of the road's brightness."""

ROAD_BOX = 41
"""Pixels, side of the neighbourhood in which the road's colour is looked for."""

OBJECT_BOX = 25
"""Pixels, about the size of a vehicle: over this neighbourhood a view is judged as a whole."""

FREE_SHARE = 0.6
"""A view shows free road where at least this share of the neighbourhood is like the road around, or paint on it."""

CLEARER = 0.2
"""... and this share more than in the view that it replaces."""

PAINT_WIDTH = 9
"""Pixels: what is brighter than the road and narrower is paint; vehicles are wider."""

REACH = ROAD_BOX + OBJECT_BOX // 2 + PAINT_WIDTH + 3
"""Pixels: what lies farther off has no say in a pixel's vote."""


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


def majority_vote(views: np.ndarray, seen: np.ndarray, full_scale: float, box: int = 3) -> np.ndarray:
    """Number of the view that most of the others agree with, unless another shows the road far more freely.

    Taking the darkest lets a dark vehicle over a zebra crossing win against every view of the free paint. Here the
    views that agree are grouped, and the largest group wins; of it, the view whose brightness is the group's middle is
    taken. Where no group holds more than half of the views, the view most like the road around is taken if one is
    like it, and otherwise the group with the darkest member.

    A queue stands in most views at the same place and would win. So each view is also judged over the size of a
    vehicle: the one chosen is replaced where little of it is like the road around and most of another is. What is
    bright and narrow counts as road in the chosen one, so that a grey vehicle does not win over a zebra crossing.

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
    most = support.max(axis=0, initial=0)
    winner = _lowest(total, seen & (support == most))
    members = np.take_along_axis(agree, np.maximum(winner, 0)[None, None], axis=0)[0] & seen
    number = _middle(total, members)
    agreed = (most >= 2) & (2 * most > seen.sum(axis=0))
    road, known = _road_around(composite(views, number), agreed)
    unlike = np.abs(smooth - road).max(axis=-1)
    like = seen & (unlike < np.maximum(LIKENESS * road.mean(axis=-1), AGREEMENT_FLOOR * full_scale))
    alike = _lowest(unlike, like)
    number = np.where(~agreed & known & (alike >= 0), alike, number)
    paint = seen & (_narrow(total) > LIKENESS * road.sum(axis=-1))
    return np.where(known, _freer(number, total, like, paint, seen), number)


def _freer(number: np.ndarray, total: np.ndarray, like: np.ndarray, paint: np.ndarray,
           seen: np.ndarray) -> np.ndarray:
    """The chosen views, or those that show far more free road over the size of a vehicle.

    Parameters
    ----------
    total : (views, rows, columns) brightness; like, paint, seen : where the views are like the road around, may show
        paint, and see the ground. Paint speaks for the view that is chosen only: vehicles have narrow bright parts too.
    """
    free = np.stack([_share(flags, sees) for flags, sees in zip(like, seen)])
    freest = free.max(axis=0, initial=0)
    # Of several that are as free, the darkest, so that their order does not matter.
    best = _lowest(total, seen & (free >= freest - 0.02))
    held = np.stack([_share(flags, sees) for flags, sees in zip(like | paint, seen)])
    chosen = np.take_along_axis(held, np.maximum(number, 0)[None], axis=0)[0]
    return np.where((number >= 0) & (freest >= FREE_SHARE) & (freest > chosen + CLEARER), best, number)


def _narrow(total: np.ndarray) -> np.ndarray:
    """How much brighter than what is wider than paint each pixel of the views is, (views, rows, columns)."""
    square = np.ones((PAINT_WIDTH, PAINT_WIDTH), np.uint8)
    return np.stack([cv2.morphologyEx(view, cv2.MORPH_TOPHAT, square, borderType=cv2.BORDER_REPLICATE)
                     for view in total])


def _share(flags: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Share of the seen pixels of the neighbourhood that are flagged; 0 where the pixel itself is not seen."""
    counts = [cv2.boxFilter(part.astype(np.float32), -1, (OBJECT_BOX, OBJECT_BOX), normalize=False,
                            borderType=cv2.BORDER_CONSTANT) for part in (flags, seen)]
    return np.where(seen, np.rint(counts[0]) / np.maximum(np.rint(counts[1]), 1), 0).astype(np.float32)


def _road_around(image: np.ndarray, agreed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Colour of the road round each pixel, (rows, columns, bands), and where it is known.

    The mean of the agreed pixels of the neighbourhood that are not much brighter than the others, so that paint does
    not count.
    """
    weight = agreed.astype(np.float32)
    mean, _ = _box_mean(image, weight, ROAD_BOX)
    weight[image.sum(axis=-1) > 1.15 * mean.sum(axis=-1)] = 0
    road, share = _box_mean(image, weight, ROAD_BOX)
    return road, share > 0.05


def _box_mean(image: np.ndarray, weight: np.ndarray, box: int) -> tuple[np.ndarray, np.ndarray]:
    """Weighted mean (rows, columns, bands) over a box, and the mean weight there."""
    share = cv2.boxFilter(weight, -1, (box, box), borderType=cv2.BORDER_REPLICATE)
    total = cv2.boxFilter(image * weight[..., None], -1, (box, box), borderType=cv2.BORDER_REPLICATE)
    return total.reshape(image.shape) / np.maximum(share, 1e-6)[..., None], share


def steepest_view(tangents: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Number of the view that looks down most steeply among those that see a pixel.

    Parameters
    ----------
    tangents : (views, rows, columns), tangent of the angle between the ray and the vertical.
    seen : as in `darkest`.
    """
    return _lowest(tangents, seen)


def composite(views: np.ndarray, number: np.ndarray) -> np.ndarray:
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
    return np.stack([_box_mean(view, sees.astype(np.float32), box)[0] for view, sees in zip(views, seen)])


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
