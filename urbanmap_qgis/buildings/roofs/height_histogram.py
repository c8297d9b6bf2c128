"""Roof heights from the height histogram of a building's points (J 5.3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...wording import say

BIN_WIDTH = 0.5
"""Width of a histogram bin, m (J 5.3.2)."""

BIN_SHIFT = 0.1
"""Distance from one bin to the next, m: bins overlap by 80 % (J 5.3.2)."""

PARAPET_SHARE = 0.3
"""Default of J's beta, as a share of the smaller one of the two maxima.

Measured between consecutive maxima: 48 % and more on the slopes of gable roofs (AHN3, Delft), where the maxima are
chance and must be joined; 12 % and less between flat roofs, which only hits on walls and parapets fill. A parapet
that the histogram cannot separate from a low storey is found in plan, see `roof_levels`.
"""

MAX_BINS = 100_000


@dataclass(frozen=True)
class HeightPeaks:
    """Maxima of a height histogram that stand for one roof each, from low to high.

    Attributes
    ----------
    height : (k,) centre of the fullest bin of each roof, m.
    count : (k,) points in that bin.
    lower, upper : (k,) height interval of each roof, m; intervals meet where the histogram between two roofs
        is emptiest. The first lower is -inf and the last upper is +inf.
    """

    height: np.ndarray
    count: np.ndarray
    lower: np.ndarray
    upper: np.ndarray

    def __len__(self) -> int:
        return len(self.height)

    def assign(self, z: np.ndarray) -> np.ndarray:
        """Roof of each height z (n,): index into the peaks, (n,) int; -1 everywhere if there is no peak."""
        if len(self) == 0:
            return np.full(np.shape(z), -1)
        return np.searchsorted(self.lower[1:], z, side="right")


def minimum_points(area: float, density: float) -> float:
    """J's alpha: points on the smallest roof of `area` m2 at `density` points/m2 (50 m2 x 7 = 350)."""
    return area * density


def height_histogram(z: np.ndarray, bin_width: float = BIN_WIDTH,
                     bin_shift: float = BIN_SHIFT) -> tuple[np.ndarray, np.ndarray]:
    """Histogram with overlapping bins.

    Parameters
    ----------
    z : (n,) heights, m.
    bin_width : width of a bin, m.
    bin_shift : distance between the centres of consecutive bins, m.

    Returns
    -------
    Bin centres (m,) and counts (m,). Bins start at multiples of `bin_shift` and hold their lower, not their
    upper end; the first and the last bin are empty.

    Raises
    ------
    InputError : a bin size is not positive, a height is not finite or the heights span too many bins.
    """
    z = np.sort(np.asarray(z, dtype=float).ravel())
    if not (bin_width > 0 and bin_shift > 0):
        raise InputError(say("The bin width and the bin shift of the height histogram must be more than 0."))
    if len(z) == 0:
        return np.empty(0), np.empty(0, dtype=np.int64)
    if not (np.isfinite(z[0]) and np.isfinite(z[-1])):
        raise InputError(say("Some point heights are not numbers: remove these points first."))
    first = np.floor((z[0] - bin_width) / bin_shift) - 1
    last = np.floor(z[-1] / bin_shift) + 1
    if last - first > MAX_BINS:
        raise InputError(say("The heights of a building's points span too many bins: remove outliers first."))
    start = np.arange(first, last + 1) * bin_shift
    # A hair of tolerance, as multiples of 0.1 are not exact in binary: 0.3 must be in the bin that starts at 0.3.
    hair = 1e-9 * bin_shift
    count = np.searchsorted(z, start + bin_width - hair) - np.searchsorted(z, start - hair)
    return start + bin_width / 2, count


def _local_maxima(count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and last bin of every local maximum; a plateau is one maximum. Both ends of `count` are zero."""
    first = np.flatnonzero(np.r_[True, count[1:] != count[:-1]])
    last = np.r_[first[1:], len(count)] - 1
    level = count[first]
    peak = np.zeros(len(level), dtype=bool)
    peak[1:-1] = (level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])
    return first[peak], last[peak]


def height_peaks(z: np.ndarray, bin_width: float = BIN_WIDTH, bin_shift: float = BIN_SHIFT, *,
                 alpha: float, beta: float | None = None) -> HeightPeaks:
    """Heights of the roofs of one building (J 5.3.2).

    Local maxima of the overlapping-bin histogram that hold fewer than `alpha` points are ignored. Consecutive
    maxima are one roof where the minimum between them is more than `beta` (a roof and its parapet).

    Parameters
    ----------
    z : (n,) heights of the points inside the primary (not expanded) outline, m.
    bin_width, bin_shift : m.
    alpha : fewest points of a bin that stand for a roof, see `minimum_points`.
    beta : points of a bin; None for `PARAPET_SHARE` of the smaller one of the two maxima.

    Raises
    ------
    InputError : as `height_histogram`.
    """
    centre, count = height_histogram(z, bin_width, bin_shift)
    if len(count) == 0:
        nothing = np.empty(0)
        return HeightPeaks(nothing, np.empty(0, dtype=np.int64), nothing, nothing)
    first, last = _local_maxima(count)
    enough = count[first] >= max(alpha, 1)
    first, last = first[enough], last[enough]
    value = count[first]
    if len(first) == 0:
        nothing = np.empty(0)
        return HeightPeaks(nothing, np.empty(0, dtype=np.int64), nothing, nothing)

    # The minimum between two maxima, and the middle of the bins that reach it.
    valley = np.array([count[a:b].min() for a, b in zip(last[:-1], first[1:])], dtype=np.int64)
    smaller = np.minimum(value[:-1], value[1:])
    separate = valley <= (PARAPET_SHARE * smaller if beta is None else beta)
    group_start = np.flatnonzero(np.r_[True, separate])
    group_end = np.r_[group_start[1:], len(value)]
    top = np.array([a + np.argmax(value[a:b]) for a, b in zip(group_start, group_end)])
    cut = np.array([_emptiest(centre, count, last[i], first[i + 1]) for i in np.flatnonzero(separate)])
    return HeightPeaks((centre[first[top]] + centre[last[top]]) / 2, value[top],
                       np.r_[-np.inf, cut], np.r_[cut, np.inf])


def _emptiest(centre: np.ndarray, count: np.ndarray, left: int, right: int) -> float:
    """Middle of the bins between two maxima that hold the fewest points, m."""
    between = count[left:right + 1]
    return float(centre[left:right + 1][between == between.min()].mean())
