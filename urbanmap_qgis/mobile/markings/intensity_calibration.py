"""Asphalt's intensity as a function of range, and intensities freed of it (J 3.2.3.2, eq. 4).

On a level road the angle of incidence follows from the range, so that one curve over range holds both. Asphalt is the
ground that is most common where the vehicle drives; its intensity is followed from there to other ranges as a peak of
the histogram of logarithms, so that paint, pavements and grass do not enter. The curve

    f(R) = C + A R^-b (1 - exp(-(R / d)^2))

has a receiver's floor C, the fall with range and incidence, and the loss of signal close to the scanner (d = 0: none).
It is fitted by robust nonlinear least squares on logarithms. Then, as in eq. 4 (I_ref a reference intensity):

    R < R1        I I_ref / f(R)
    R1 < R < R2   I I_ref / I_m        I_m = f(R1), where the floor is reached
    R > R2        ignored
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import least_squares

from ...errors import InsufficientDataError
from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from ...wording import say

BIN = 0.25  # m, width of the bins of range.
LEVEL = 0.02  # Width of the bins of the intensity's natural logarithm.
WIDTHS = (0.08, 0.25)
PEAK_SHARE = 0.15
WINDOW = 2.5
DARKEST = 1.0
MAX_SCATTER = 0.54
CATCH = 0.17
FOLLOWED = 0.3
NEIGHBOURS = 16
SHRINK = 0.01
MIN_POINTS = 60
MIN_BINS = 4
SHARE = 2e-5
AT_FLOOR = 1.1
PAINT = 2.5
CLEAR = 2.0
GAP_BINS = 4

MIN_INTENSITY = 0.5
"""Intensities below count as this: there is no logarithm of 0."""

_TOP = np.log(70_000.0)
_LEVELS = int(np.ceil((_TOP - np.log(MIN_INTENSITY)) / LEVEL))

# With a floor or not, with a loss close to the scanner or not: what is not needed is taken for real only where it
# explains a good part of the misfit.
_MODELS = ((False, False, 1.0), (True, False, 1.1), (False, True, 1.3), (True, True, 1.4))


class RangeHistogram:
    """Counts of ground points by range and intensity, of one scanner.

    Parameters
    ----------
    max_range : m.
    """

    def __init__(self, max_range: float):
        self.rows = max(int(np.ceil(max_range / BIN)), 1)
        self.counts = np.zeros((self.rows, _LEVELS), dtype=np.int64)

    def add(self, ranges: np.ndarray, intensity: np.ndarray) -> None:
        """Take points: ranges (n,) in m, intensity (n,)."""
        row = (ranges * (1.0 / BIN)).astype(np.int64)
        level = (np.log(np.maximum(intensity, MIN_INTENSITY) / MIN_INTENSITY) * (1.0 / LEVEL)).astype(np.int64)
        inside = row < self.rows
        cell = row[inside] * _LEVELS + np.minimum(level[inside], _LEVELS - 1)
        self.counts += np.bincount(cell, minlength=self.counts.size).reshape(self.counts.shape)

    @staticmethod
    def level_values() -> np.ndarray:
        """Natural logarithm of the intensity at the middle of each level."""
        return np.log(MIN_INTENSITY) + (np.arange(_LEVELS) + 0.5) * LEVEL


@dataclass(frozen=True)
class IntensityCurve:
    """The curve of one scanner and how well it is known.

    Attributes
    ----------
    floor, gain, fall, near : C, A, b, d of the curve; gain is that at 1 m, near in m.
    r1 : R1, m; equal to `r2` where the floor is not reached.
    r2 : R2, m.
    nearest : shortest range with asphalt, m; below it the curve is that at `nearest`.
    ranges, asphalt, points : (k,) middles of the bins of range (m), asphalt's intensity and number of points in them.
    used : (k,) bool, bins that the fit follows.
    residual : scatter of the bins' asphalt about the curve, as a share of it (robust standard deviation).
    scatter : scatter of single asphalt points about the curve, likewise.
    """

    floor: float
    gain: float
    fall: float
    near: float
    r1: float
    r2: float
    nearest: float
    ranges: np.ndarray
    asphalt: np.ndarray
    points: np.ndarray
    used: np.ndarray
    residual: float
    scatter: float

    def intensity(self, ranges: np.ndarray) -> np.ndarray:
        """Asphalt's intensity f(R) (n,) at ranges (n,) in m, as eq. 4 uses it."""
        r = np.clip(np.asarray(ranges, float), self.nearest, self.r1)
        return _model(r, self.floor, self.gain, self.fall, self.near)

    @property
    def smallest(self) -> float:
        """I_m of eq. 4."""
        return float(self.intensity(self.r1))


def _model(r: np.ndarray, floor: float, gain: float, fall: float, near: float) -> np.ndarray:
    signal = gain * r ** -fall
    return floor + (signal * -np.expm1(-((r / near) ** 2)) if near > 0 else signal)


def calibrated(intensity: np.ndarray, ranges: np.ndarray, curve: IntensityCurve, reference: float) -> np.ndarray:
    """Calibrated intensity (n,), NaN beyond R2 (eq. 4); asphalt comes out as `reference`."""
    values = intensity * (reference / curve.intensity(ranges))
    return np.where(ranges <= curve.r2, values, np.nan)


def brightness_counts(histogram: RangeHistogram, curve: IntensityCurve) -> tuple[np.ndarray, np.ndarray]:
    """Brightness (asphalt: 1) of each filled cell of a histogram within R2, (k,), and its number of points (k,)."""
    row, level = np.nonzero(histogram.counts)
    ranges = (row + 0.5) * BIN
    value = calibrated(np.exp(RangeHistogram.level_values()[level]), ranges, curve, 1.0)
    known = np.isfinite(value)
    return value[known], histogram.counts[row, level][known]


def fit_curve(histogram: RangeHistogram) -> IntensityCurve:
    """The curve that the asphalt of a histogram follows.

    Raises
    ------
    InsufficientDataError : too few ground points, or no asphalt can be told.
    """
    counts = histogram.counts.copy()
    # No signal is no level of a surface.
    counts[:, 0] = 0
    points = counts.sum(axis=1)
    enough = points >= max(MIN_POINTS, SHARE * points.sum())
    if np.count_nonzero(enough) < MIN_BINS:
        raise InsufficientDataError(say("too few ground points with intensity at different ranges"))
    for width in WIDTHS:
        try:
            return _fitted(_Peaks(counts, enough, width))
        except InsufficientDataError as error:
            failure = error
    raise failure


def _fitted(peaks: _Peaks) -> IntensityCurve:
    """The curve through the peaks of asphalt."""
    middle = (np.arange(len(peaks.enough)) + 0.5) * BIN
    points = peaks.counts.sum(axis=1)
    level = peaks.followed()
    for _ in range(2):
        used = np.isfinite(level)
        if np.count_nonzero(used) < max(MIN_BINS, FOLLOWED * np.count_nonzero(peaks.enough)):
            raise InsufficientDataError(say("no surface of even intensity can be followed over the ranges"))
        parameters = _fit(middle[used], level[used], points[used])
        level = peaks.nearest(np.log(_model(middle, *parameters)))
    return _judged(middle, level, points, peaks.counts, parameters)


class _Peaks:
    """The peaks of the histograms of logarithms, bin of range by bin of range.

    Parameters
    ----------
    counts : (ranges, levels).
    enough : (ranges,) bool, bins with enough points.
    width : standard deviation of the smoothing: wide where a scanner's lasers differ from each other.
    """

    def __init__(self, counts: np.ndarray, enough: np.ndarray, width: float):
        self.counts, self.enough, self.width = counts, enough, width
        self.smooth = gaussian_filter1d(counts.astype(float), width / LEVEL, axis=1, mode="constant")

    def followed(self) -> np.ndarray:
        """Logarithm of asphalt's intensity in each bin of range, NaN where there is none.

        Begins at the bin with the most points, where the vehicle drives, and goes on to the next bins, always to the
        peak nearest to where the bins before point.
        """
        level = np.full(len(self.enough), np.nan)
        start = int(np.argmax(np.where(self.enough, self.counts.sum(axis=1), 0)))
        level[start] = self._mean_shift(start, RangeHistogram.level_values()[int(np.argmax(self.smooth[start]))])
        place = np.log(np.arange(len(level)) + 0.5)
        for order in (range(start + 1, len(level)), range(start - 1, -1, -1)):
            for row in order:
                if self.enough[row]:
                    level[row] = self._found(row, _expected(place, level, row))
        return level

    def nearest(self, expected: np.ndarray) -> np.ndarray:
        """The peak of each bin that is nearest to what is expected, NaN where there is none."""
        level = np.full(len(self.enough), np.nan)
        for row in np.flatnonzero(self.enough):
            level[row] = self._found(row, expected[row])
        return level

    def _found(self, row: int, expected: float) -> float:
        """Logarithm of the intensity at the peak of a bin nearest to `expected`, NaN if none is near."""
        smooth = self.smooth[row]
        inner = smooth[1:-1]
        peaks = 1 + np.flatnonzero((inner >= smooth[:-2]) & (inner > smooth[2:])
                                   & (inner >= PEAK_SHARE * smooth.max()))
        if not len(peaks):
            return np.nan
        values = RangeHistogram.level_values()[peaks]
        best = values[np.argmin(np.abs(values - expected))]
        return self._mean_shift(row, best) if abs(best - expected) <= CATCH + self.width else np.nan

    def _mean_shift(self, row: int, start: float) -> float:
        """Mean of the logarithms round a peak, in a window that moves with it.

        It is wider where intensities are so low that their steps show.
        """
        values, counts = RangeHistogram.level_values(), self.counts[row]
        centre, width = float(start), WINDOW * self.width + np.exp(-start)
        for _ in range(8):
            weight = np.where(np.abs(values - centre) <= width, counts, 0)
            moved = float((weight * values).sum() / weight.sum()) if weight.any() else centre
            if abs(moved - centre) < 1e-3:
                break
            centre = moved
        return centre


def _expected(place: np.ndarray, level: np.ndarray, row: int) -> float:
    """Where the known bins nearest to a row point: a straight line over the logarithm of range."""
    known = np.flatnonzero(np.isfinite(level))
    known = known[np.argsort(np.abs(known - row))[:NEIGHBOURS]]
    x, y = place[known] - place[row], level[known]
    # A slope that few bins give is drawn towards that of the near known ones: none.
    slope = ((x - x.mean()) * (y - y.mean())).sum() / (((x - x.mean()) ** 2).sum() + SHRINK)
    return float(y.mean() - slope * x.mean())


def _fit(ranges: np.ndarray, level: np.ndarray, points: np.ndarray) -> tuple[float, float, float, float]:
    """C, A, b, d of the curve through levels (k,) at ranges (k,), by robust least squares on logarithms."""
    weight = np.sqrt(np.minimum(points, np.quantile(points, 0.75)) / points.max())
    scale = float(np.exp(np.median(level)))
    reach = float(np.median(ranges))

    def values(p: np.ndarray) -> np.ndarray:
        floor, gain, fall, near = scale * p[0], scale * np.exp(p[1]), p[2], p[3]
        return _model(ranges / reach, floor, gain, fall, near / reach)

    def misfit(p: np.ndarray) -> np.ndarray:
        return weight * (np.log(np.maximum(values(p), LEAST_DIVISOR)) - level)

    best = None
    for has_floor, has_near, price in _MODELS:
        upper = [1.5 if has_floor else 1e-9, 8.0, 6.0, 3.0 * ranges[0] if has_near else 1e-9]
        for fall in (0.3, 2.0):
            start = [0.1 * has_floor, 0.0, fall, 0.5 * ranges[0] * has_near]
            found = least_squares(misfit, start, loss="soft_l1", f_scale=0.03, bounds=([0.0, -8.0, 0.0, 0.0], upper))
            if best is None or found.cost * price < best[0]:
                best = found.cost * price, found.x
    floor, gain, fall, near = best[1]
    near = float(near) if near > 1e-6 else 0.0
    return float(scale * floor), float(scale * np.exp(gain) * reach ** fall), float(fall), near


def _judged(middle: np.ndarray, level: np.ndarray, points: np.ndarray, counts: np.ndarray,
            parameters: tuple[float, float, float, float]) -> IntensityCurve:
    """The curve with its limits R1 and R2 and its quality."""
    curve, floor = _model(middle, *parameters), parameters[0]
    spread = _spread(counts, np.log(curve))
    clear = (PAINT - 1) * (curve - floor) >= CLEAR * spread * curve
    good = np.flatnonzero(np.isfinite(level) & clear)
    if len(good) < MIN_BINS:
        raise InsufficientDataError(say("the intensity of asphalt scatters too much to tell paint from it"))
    runs = np.split(good, np.flatnonzero(np.diff(good) > GAP_BINS) + 1)
    run = max(runs, key=lambda some: points[some].sum())
    nearest, r2 = max(float(run[0]), 0.5) * BIN, float(run[-1] + 1) * BIN
    at_floor = np.flatnonzero((curve <= AT_FLOOR * floor) & (middle > nearest) & (middle < r2))
    r1 = float(middle[at_floor[0]]) if len(at_floor) else r2
    rows = np.flatnonzero(np.isfinite(level))
    residual = np.median(np.abs(level[run] - np.log(curve[run])))
    scatter = np.sqrt((spread[run] ** 2 * points[run]).sum() / points[run].sum())
    if scatter > MAX_SCATTER:
        raise InsufficientDataError(say("the intensity of asphalt scatters too much to tell paint from it"))
    return IntensityCurve(*parameters, r1, r2, nearest, middle[rows], np.exp(level[rows]), points[rows],
                          np.isin(rows, run), float(SIGMA_OF_MAD * residual), float(scatter))


def scatter_about(histogram: RangeHistogram, curve: IntensityCurve) -> float:
    """Scatter of single asphalt points of a histogram about a curve, as a share of it, where the curve holds."""
    middle = (np.arange(histogram.rows) + 0.5) * BIN
    used = (middle >= curve.nearest) & (middle <= curve.r2)
    spread = _spread(histogram.counts, np.log(curve.intensity(middle)))[used]
    points = histogram.counts.sum(axis=1)[used]
    return float(np.sqrt((spread**2 * points).sum() / max(points.sum(), 1)))


def _spread(counts: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Standard deviation (bins,) of the logarithms of asphalt, from its dark side: no paint or paving lies there."""
    offset = RangeHistogram.level_values()[None, :] - centre[:, None]
    dark = np.where((offset <= 0) & (offset >= -DARKEST), counts, 0)
    return np.sqrt((dark * offset ** 2).sum(axis=1) / np.maximum(dark.sum(axis=1), 1))
