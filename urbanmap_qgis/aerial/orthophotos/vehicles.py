"""Vehicles taken out of overlapping views of the same ground (J 3.2.1.2).

A vehicle that moves stands in another place in the next frame, so that some frame shows the road where it stood.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence

import cv2
import numpy as np

METHODS = ("vote", "darkest")

AGREEMENT = 0.12
"""Views agree where their channels differ by less than this share of the road's own brightness there ..."""

AGREEMENT_FLOOR = 0.04  # ... or by less than this share of the full scale.
# A view is like the road around where its channels differ by less than this share of the road's brightness.
LIKENESS = 0.2
ROAD_BOX = 41  # Pixels, side of the neighbourhood in which the road's colour is looked for.
OBJECT_BOX = 25  # Pixels, about the size of a vehicle: over this neighbourhood a view is judged as a whole.
# A view shows free road where at least this share of the neighbourhood is like the road around, or paint on
# it.
FREE_SHARE = 0.6
CLEARER = 0.2  # ... and this share more than in the view that it replaces.
PAINT_WIDTH = 9  # Pixels: what is brighter than the road and narrower is paint; vehicles are wider.

_STRIP = 32  # rows
_TOGETHER = 16384  # pixels

REACH = 2 * (ROAD_BOX // 2) + OBJECT_BOX // 2 + 1
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
    return _lowest(np.stack([_sum(cv2.split(view)) for view in views]), seen)


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
    bands = [cv2.split(view) for view in views]
    total = np.stack([_sum(planes) for planes in bands])
    smooth = [_box_mean(planes, sees.astype(np.float32), box)[0] for planes, sees in zip(bands, seen)]
    del bands
    number, agreed = _largest_group(smooth, total, seen, full_scale)
    road, known = _road_around(cv2.split(composite(views, number)), agreed)
    like, paint = np.empty(seen.shape, bool), np.empty(seen.shape, bool)
    narrow = _narrow(total)
    for rows in _strips(len(number)):
        around = [plane[rows] for plane in road]
        unlike = np.stack([_largest_difference(planes, around) for planes in _part(smooth, rows)])
        like[:, rows] = seen[:, rows] & (unlike < np.maximum(LIKENESS * _mean(around),
                                                             AGREEMENT_FLOOR * full_scale))
        alike = _lowest(unlike, like[:, rows])
        number[rows] = np.where(~agreed[rows] & known[rows] & (alike >= 0), alike, number[rows])
        paint[:, rows] = seen[:, rows] & (narrow[:, rows] > LIKENESS * _sum(around))
    return np.where(known, _freer(number, total, like, paint, seen), number)


def _strips(rows: int) -> Iterator[slice]:
    """Slices of so few rows that what is made of all views there stays in the processor's cache."""
    return (slice(top, min(top + _STRIP, rows)) for top in range(0, rows, _STRIP))


def _part(views: Sequence[Sequence[np.ndarray]], rows: slice) -> list[list[np.ndarray]]:
    """Some rows of the planes of views."""
    return [[plane[rows] for plane in planes] for planes in views]


def _largest_group(smooth: Sequence[Sequence[np.ndarray]], total: np.ndarray, seen: np.ndarray, full_scale: float
                   ) -> tuple[np.ndarray, np.ndarray]:
    """Number of the middle view of the largest group that agrees, int16, and whether it is more than half of the views.

    Parameters
    ----------
    smooth : the views' bands, means over a box.
    total, seen : (views, rows, columns) brightness, and where the views see the ground.
    """
    number, agreed = np.empty(seen.shape[1:], np.int16), np.empty(seen.shape[1:], bool)
    torn = np.empty(agreed.shape, bool)
    for rows in _strips(len(number)):
        number[rows] = _middle(total[:, rows], seen[:, rows])
        np.greater(seen[:, rows].sum(axis=0, dtype=np.int16), 1, out=agreed[rows])
        torn[rows] = agreed[rows] & ~_all_agree(_part(smooth, rows), seen[:, rows], full_scale)
    # Groups need every pair of views; on most of the ground all agree, and that is told by lowest and highest.
    places = np.flatnonzero(torn)
    for first in range(0, len(places), _TOGETHER):
        at = places[first:first + _TOGETHER]
        parts = [[plane.take(at)[None] for plane in planes] for planes in smooth]
        number.ravel()[at], agreed.ravel()[at] = _torn_group(
            parts, *(np.stack([view.take(at)[None] for view in values]) for values in (total, seen)), full_scale)
    return number, agreed


def _torn_group(smooth: Sequence[Sequence[np.ndarray]], total: np.ndarray, seen: np.ndarray, full_scale: float
                ) -> tuple[np.ndarray, np.ndarray]:
    """The same by all pairs of views."""
    agree = _agreement(smooth, seen, full_scale)
    support = agree.sum(axis=0, dtype=np.int16)
    support[~seen] = 0
    most = support.max(axis=0, initial=0)
    winner = _lowest(total, seen & (support == most))
    members = np.zeros(seen.shape, bool)
    for view, with_it in enumerate(agree):
        members |= with_it & (winner == view)
    return _middle(total, members), (most >= 2) & (2 * most > seen.sum(axis=0, dtype=np.int16))


def _all_agree(smooth: Sequence[Sequence[np.ndarray]], seen: np.ndarray, full_scale: float) -> np.ndarray:
    """Where all views that see a pixel surely agree: the lowest and the highest of every band do, by the least level
    that a pair of them may have."""
    beyond = [np.multiply(~sees, np.float32(1e9), dtype=np.float32) for sees in seen]
    lowest, highest = [], []
    for planes in zip(*smooth):
        lowest.append(functools.reduce(cv2.min, map(cv2.add, planes, beyond)))
        highest.append(functools.reduce(cv2.max, map(cv2.subtract, planes, beyond)))
    level = _mean(lowest)
    level *= AGREEMENT
    np.maximum(level, AGREEMENT_FLOOR * full_scale, out=level)
    return _largest_difference(lowest, highest) < level


def _sum(planes: Sequence[np.ndarray]) -> np.ndarray:
    """Sum of the bands, float32; by planes, as sums along an axis of three numbers are slow."""
    total = planes[0].astype(np.float32)
    for plane in planes[1:]:
        total += plane
    return total


def _mean(planes: Sequence[np.ndarray]) -> np.ndarray:
    """Mean of the bands, float32."""
    return _sum(planes) / np.float32(len(planes))


def _largest_difference(one: Sequence[np.ndarray], other: Sequence[np.ndarray]) -> np.ndarray:
    """Difference of the band in which two images differ most."""
    largest = cv2.absdiff(one[0], other[0])
    for a, b in zip(one[1:], other[1:]):
        np.maximum(largest, cv2.absdiff(a, b), out=largest)
    return largest


def _freer(number: np.ndarray, total: np.ndarray, like: np.ndarray, paint: np.ndarray,
           seen: np.ndarray) -> np.ndarray:
    """The chosen views, or those that show far more free road over the size of a vehicle.

    Parameters
    ----------
    total : (views, rows, columns) brightness.
    like, paint, seen : where the views are like the road around, may show paint, and see the ground. Paint speaks for
        the view that is chosen only: vehicles have narrow bright parts too.
    """
    around = [np.maximum(_count(sees), 1) for sees in seen]
    free = np.stack([_share(*part) for part in zip(like, seen, around)])
    freest = free.max(axis=0, initial=0)
    # Of several that are as free, the darkest, so that their order does not matter.
    best = _lowest(total, seen & (free >= freest - 0.02))
    chosen = np.zeros(number.shape, np.float32)
    for view, (flags, sees, counts) in enumerate(zip(like | paint, seen, around)):
        np.copyto(chosen, _share(flags, sees, counts), where=np.maximum(number, 0) == view)
    return np.where((number >= 0) & (freest >= FREE_SHARE) & (freest > chosen + CLEARER), best, number)


def _narrow(total: np.ndarray) -> np.ndarray:
    """How much brighter than what is wider than paint each pixel of the views is, (views, rows, columns)."""
    square = np.ones((PAINT_WIDTH, PAINT_WIDTH), np.uint8)
    return np.stack([cv2.morphologyEx(view, cv2.MORPH_TOPHAT, square, borderType=cv2.BORDER_REPLICATE)
                     for view in total])


def _share(flags: np.ndarray, seen: np.ndarray, around: np.ndarray) -> np.ndarray:
    """Share of the seen pixels of the neighbourhood, `around` of them, that are flagged; 0 where the pixel itself is
    not seen."""
    share = _count(flags)
    share /= around
    share[~seen] = 0
    return share


def _count(flags: np.ndarray) -> np.ndarray:
    """Flags set in the neighbourhood, float32."""
    return cv2.boxFilter(flags.view(np.uint8), cv2.CV_32F, (OBJECT_BOX, OBJECT_BOX), normalize=False,
                         borderType=cv2.BORDER_CONSTANT)


def _road_around(image: Sequence[np.ndarray], agreed: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    """Colour of the road round each pixel, a plane for each band, and where it is known.

    The mean of the agreed pixels of the neighbourhood that are not much brighter than the others, so that paint does
    not count.
    """
    weight = agreed.astype(np.float32)
    mean, _ = _box_mean(image, weight, ROAD_BOX)
    weight[_sum(image) > 1.15 * _sum(mean)] = 0
    road, share = _box_mean(image, weight, ROAD_BOX)
    return road, share > 0.05


def _box_mean(image: Sequence[np.ndarray], weight: np.ndarray, box: int) -> tuple[list[np.ndarray], np.ndarray]:
    """Weighted mean over a box, a plane for each band, and the mean weight there."""
    share = cv2.boxFilter(weight, -1, (box, box), borderType=cv2.BORDER_REPLICATE)
    least = np.maximum(share, np.float32(1e-6))
    means = []
    for plane in image:
        total = cv2.boxFilter(plane * weight, -1, (box, box), borderType=cv2.BORDER_REPLICATE)
        total /= least
        means.append(total)
    return means, share


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
    image = np.zeros(views.shape[1:], views.dtype)
    for k, view in enumerate(views):
        cv2.copyTo(view, (number == k).view(np.uint8), image)
    return image


def _lowest(values: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Number of the lowest value of each pixel among the marked ones, int16; -1 where none is marked."""
    number = np.full(among.shape[1:], -1, np.int16)
    lowest = np.full(among.shape[1:], np.inf, values.dtype)
    for k, (value, marked) in enumerate(zip(values, among)):
        lower = (value < lowest) & marked
        np.copyto(number, k, where=lower)
        np.copyto(lowest, value, where=lower)
    return number


def _middle(values: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Number of the (lower) median value of each pixel among the marked ones; -1 where none is marked."""
    before = np.zeros(among.shape, np.min_scalar_type(len(values)))
    for first in range(len(values)):
        for second in range(first + 1, len(values)):
            both = among[first] & among[second]
            later = values[first] <= values[second]
            later &= both
            before[second] += later.view(np.uint8)
            later ^= both
            before[first] += later.view(np.uint8)
    middle = (np.maximum(among.sum(axis=0, dtype=before.dtype), 1) - 1) >> 1
    number = np.full(among.shape[1:], -1, np.int16)
    for k, marked in enumerate(among):
        np.copyto(number, k, where=marked & (before[k] == middle))
    return number


def _agreement(smooth: Sequence[Sequence[np.ndarray]], seen: np.ndarray, full_scale: float) -> np.ndarray:
    """Which views, each given by its bands, agree with which, (views, views, rows, columns); a view agrees with itself
    where it sees."""
    count = len(smooth)
    agree = np.zeros((count, *seen.shape), bool)
    for first in range(count):
        agree[first, first] = seen[first]
        for second in range(first + 1, count):
            one, other = smooth[first], smooth[second]
            level = _mean([np.minimum(a, b) for a, b in zip(one, other)])
            level *= AGREEMENT
            np.maximum(level, AGREEMENT_FLOOR * full_scale, out=level)
            near = _largest_difference(one, other) < level
            near &= seen[first]
            near &= seen[second]
            agree[first, second] = agree[second, first] = near
    return agree
