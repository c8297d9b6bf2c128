"""Heights of a trajectory from the ground along its course (Z 3.2, vertical registration).

Where the vehicle is, its body's origin lies a known height above the ground: o_z' = ground(o_x, o_y) + h. Samples are
taken at equal chainages along the course. What stands on the ground in a surface model (vehicles, bridges, crowns)
raises it, and is recognised by its step against the lowest samples around. The error of height is a random walk in
time through the others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.ndimage import percentile_filter
from scipy.optimize import minimize

from ...errors import InsufficientDataError
from ...geometry.tolerances import LEAST_SQUARE, ROUNDING, SIGMA_OF_MAD
from ...progress import SILENT, Progress
from ...wording import say
from ..trajectory import Trajectory, path_chainage

SPACING = 2.0
"""m along the course between samples."""

STANDING_STEP = 5.0  # s between samples where the vehicle stands.
WINDOW = 51  # samples
MIN_SCATTER = 0.03  # m
LOWEST_EIGHTH = 0.48  # sigmas from the lower quartile to the lowest eighth
SIGMAS = 4.0
MIN_SAMPLES = 5
SPANS = (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)  # s

MAX_ERROR = 3.0
"""m: ground farther from where it should be is not believed to be the vehicle's (bridges, roofs)."""

_EXPECTED = np.log([0.01, 0.03])  # m per square root of a second, m
_SPREAD = np.log([4.0, 4.0])


@dataclass(frozen=True)
class CourseHeights:
    """Errors of height along a course.

    Attributes
    ----------
    error : (n,) at the epochs, m: to be added.
    sigma : (n,) m.
    sensor_height : of the body's origin above the ground, m, given or found.
    found : it was found: then the mean height stayed as reported.
    before, after : root mean square of the samples used, against the ground, m.
    sample_sigma : of a sample, m.
    samples, left_out : how many samples had a ground, and how many of them stand out.
    covered : share of the course with a ground, 0 to 1.
    used_time, used_error : (k,) the samples used.
    """

    error: np.ndarray
    sigma: np.ndarray
    sensor_height: float
    found: bool
    before: float
    after: float
    sample_sigma: float
    samples: int
    left_out: int
    covered: float
    used_time: np.ndarray
    used_error: np.ndarray


def course_heights(trajectory: Trajectory, ground: Callable[[np.ndarray, np.ndarray], np.ndarray],
                   sensor_height: float | None, progress: Progress = SILENT) -> CourseHeights:
    """Errors of height of a trajectory that is right in plan.

    Parameters
    ----------
    ground : gives heights (k,) at places x, y (k,), NaN where there are none.
    sensor_height : of the body's origin above the ground, m; None takes the one that leaves the mean height as it is.

    Raises
    ------
    InsufficientDataError : hardly any of the course has a ground.
    """
    row = _samples(trajectory)
    place = trajectory.place[row]
    below = np.asarray(ground(place[:, 0], place[:, 1]), float)
    known = np.isfinite(below)
    if np.count_nonzero(known) < MIN_SAMPLES:
        raise InsufficientDataError(say("The ground does not reach the trajectory's course: give a ground of the "
                                        "same place and coordinate reference system."))
    time, above = trajectory.time[row[known]], (place[:, 2] - below)[known]
    found = sensor_height is None
    # What stands on the ground comes nearer to the vehicle: the upper quarter is the road's.
    start = float(np.percentile(above, 75)) if found else float(sensor_height)
    believed = np.abs(start - above) <= MAX_ERROR
    if np.count_nonzero(believed) < MIN_SAMPLES:
        raise InsufficientDataError(say("The trajectory lies {above:.1f} m above the ground (median), not "
                                        "{start:.1f} m: check the origin's height and both height systems.",
                                        above=np.median(above), start=start))
    used_rows = np.flatnonzero(believed)[_on_the_ground(start - above[believed])]
    height = float(np.median(above[used_rows])) if found else start
    error = height - above
    progress.check()
    walk, used = _fitted(time[used_rows], error[used_rows])
    used_rows = used_rows[used]
    value, variance = walk.interpolate(trajectory.time)
    left = error[used_rows] - np.interp(time[used_rows], trajectory.time, value)
    return CourseHeights(value, np.sqrt(variance), height, found,
                         _rms(error[used_rows]), _rms(left), walk.sigma, len(time), len(time) - len(used_rows),
                         float(known.mean()), time[used_rows], error[used_rows])


def sampled_heights(trajectory: Trajectory, ground: Callable[[np.ndarray, np.ndarray], np.ndarray],
                    sensor_height: float) -> CourseHeights:
    """Errors of height to the letter of Z 3.2: o_z' = ground(o_x, o_y) + h at equally sampled updates.

    Between the samples the error is linear, before the first and after the last it is held. Nothing is left out: what
    stands on a surface model is taken for the ground. The paper states no accuracy; `sigma` is the scatter of
    neighbouring samples.

    Raises
    ------
    InsufficientDataError : the ground covers fewer than two samples.
    """
    length = float(path_chainage(trajectory)[-1])
    every = max(int(np.ceil(SPACING * len(trajectory) / max(length, SPACING))), 1)
    row = np.arange(0, len(trajectory), every)
    place = trajectory.place[row]
    error = np.asarray(ground(place[:, 0], place[:, 1]), float) + sensor_height - place[:, 2]
    known = np.isfinite(error)
    if np.count_nonzero(known) < 2:
        raise InsufficientDataError(say("The ground does not reach the trajectory's course: give a ground of the "
                                        "same place and coordinate reference system."))
    time, error = trajectory.time[row[known]], error[known]
    sigma = SIGMA_OF_MAD * float(np.median(np.abs(np.diff(error)))) / np.sqrt(2.0)
    return CourseHeights(np.interp(trajectory.time, time, error), np.full(len(trajectory), sigma), sensor_height, False,
                         _rms(error), 0.0, sigma, len(time), 0, float(known.mean()), time, error)


def _samples(trajectory: Trajectory) -> np.ndarray:
    """Epochs at equal chainages along the course, and some while the vehicle stands."""
    chainage = path_chainage(trajectory)
    row = np.searchsorted(chainage, np.arange(0.0, chainage[-1] + ROUNDING, SPACING))
    row = np.unique(np.minimum(row, len(chainage) - 1))
    standing = np.searchsorted(trajectory.time, np.arange(trajectory.time[0], trajectory.time[-1],
                                                          STANDING_STEP))
    taken = np.concatenate([[-np.inf], trajectory.time[row], [np.inf]])
    next_one = np.searchsorted(taken, trajectory.time[standing])
    away = np.minimum(taken[next_one] - trajectory.time[standing], trajectory.time[standing] - taken[next_one - 1])
    return np.unique(np.concatenate([row, standing[away > 0.5 * STANDING_STEP]]))


def _on_the_ground(error: np.ndarray) -> np.ndarray:
    """Mask (k,) of samples that do not stand on the ground, which only ever raises it: vehicles, crowns, bridges.

    The lower quarter of the samples around is the ground's; its scatter is estimated from what lies below that quarter.
    """
    window = min(WINDOW, len(error) // 2 * 2 + 1)
    low = percentile_filter(error, 25, window, mode="mirror")
    below = low[error < low] - error[error < low]
    scatter = max(float(np.median(below)) / LOWEST_EIGHTH,
                  MIN_SCATTER) if len(below) else MIN_SCATTER
    return (error >= low - SIGMAS * scatter) & (error <= low + (SIGMAS + 0.67) * scatter)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


@dataclass(frozen=True)
class _HeightWalk:
    """A random walk through samples: values and variances at nodes, and covariances with the next.

    `coefficient` (m per square root of a second) holds for the longest gaps, where it may be more than from sample to
    sample.
    """

    time: np.ndarray
    value: np.ndarray
    variance: np.ndarray
    lag_covariance: np.ndarray
    coefficient: float
    sigma: float

    def interpolate(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Value and variance at times (m,), linear between nodes and held outside."""
        before = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        length = self.time[before + 1] - self.time[before]
        u = np.clip((time - self.time[before]) / length, 0.0, 1.0)
        outside = np.maximum(self.time[0] - time, 0.0) + np.maximum(time - self.time[-1], 0.0)
        variance = ((1 - u) ** 2 * self.variance[before] + u**2 * self.variance[before + 1]
                    + 2 * u * (1 - u) * self.lag_covariance[before]
                    + self.coefficient**2 * (length * u * (1 - u) + outside))
        return np.interp(time, self.time, self.value), variance


def _fitted(time: np.ndarray, error: np.ndarray) -> tuple[_HeightWalk, np.ndarray]:
    """The most likely walk through samples, and which of them it used: those within four sigmas of a first walk."""
    coefficient, sigma = _most_likely(time, error)
    value = _solve(time, error, coefficient, sigma)[0]
    used = np.abs(error - value) <= max(SIGMAS * sigma, MIN_SCATTER)
    time, error = time[used], error[used]
    coefficient, sigma = _most_likely(time, error)
    value, factor, _ = _solve(time, error, coefficient, sigma)
    left = error - value
    # What neighbours share of their deviations (a ground's smooth errors) does not average out.
    alike = float(np.clip((left[1:] @ left[:-1]) / max(left @ left, LEAST_SQUARE), 0.0, 0.95))
    inflation = (1 + alike) / (1 - alike)
    variance, lag = _inverse_bands(factor)
    coefficient = max(coefficient, _long_span_walk(time, value))
    return _HeightWalk(time, value, variance * inflation, lag * inflation, coefficient, sigma), used


def _long_span_walk(time: np.ndarray, value: np.ndarray) -> float:
    """Largest random walk coefficient, m per square root of a second, of errors over some span of time."""
    walks = [0.0]
    longest = 0.5 * (time[-1] - time[0])
    for span in (item for item in SPANS if item < longest):
        later = np.searchsorted(time, time + span)
        paired = later < len(time)
        paired[paired] = time[later[paired]] - time[paired] < 1.5 * span
        if paired.any():
            change = value[later[paired]] - value[paired]
            walks.append(float(np.sqrt(np.mean(change**2 / (time[later[paired]] - time[paired])))))
    return max(walks)


def _solve(time: np.ndarray, error: np.ndarray, coefficient: float, sigma: float
           ) -> tuple[np.ndarray, np.ndarray, float]:
    """Values of the walk, factor of its information, and the logarithm of its likelihood."""
    weight = coefficient**-2 / np.diff(time)
    band = np.zeros((2, len(time)))
    band[1] = sigma**-2
    band[1, :-1] += weight
    band[1, 1:] += weight
    band[0, 1:] = -weight
    factor = cholesky_banded(band)
    value = cho_solve_banded((factor, False), error / sigma**2)
    misfit = float(error @ (error - value)) / sigma**2
    likelihood = 0.5 * (np.log(weight).sum() - misfit) - np.log(factor[1]).sum() - len(time) * np.log(sigma)
    return value, factor, likelihood


def _most_likely(time: np.ndarray, error: np.ndarray) -> tuple[float, float]:
    """Random walk coefficient and sigma of the samples."""
    def negative_log_likelihood(logs: np.ndarray) -> float:
        logs = np.clip(logs, -12.0, 5.0)
        return 0.5 * float((((logs - _EXPECTED) / _SPREAD) ** 2).sum()) - _solve(time, error, *np.exp(logs))[2]

    found = minimize(negative_log_likelihood, _EXPECTED, method="Nelder-Mead",
                     options={"xatol": 0.05, "fatol": 0.05, "maxiter": 80})
    coefficient, sigma = np.exp(np.clip(found.x, -12.0, 5.0))
    return float(coefficient), float(sigma)


def _inverse_bands(factor: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Diagonal (k,) and first off-diagonal (k - 1,) of the inverse of U'U with a bidiagonal U (Takahashi)."""
    diagonal, above = factor[1], factor[0, 1:]
    variance, lag = np.empty(len(diagonal)), np.empty(len(above))
    variance[-1] = diagonal[-1] ** -2.0
    ratio = (above / diagonal[:-1]).tolist()
    inverse = (diagonal**-2.0).tolist()
    last = float(variance[-1])
    for k in range(len(above) - 1, -1, -1):
        lag[k] = -ratio[k] * last
        last = inverse[k] - ratio[k] * lag[k]
        variance[k] = last
    return variance, lag
