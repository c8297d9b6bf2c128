"""The height of the antenna as the satellites see it, and how well their signals agree at the trajectory's places.

Both are judged without a map, by the strongest signals: those in line of sight. They show a mix-up of heights
above sea level and above the ellipsoid, of times, and of places.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ...errors import InsufficientDataError
from ...geometry.grouped_median import grouped_median
from ...geometry.tolerances import SIGMA_OF_MAD
from ...wording import say
from .tables import Signals

TUKEY = 4.7
BLOCK = 60.0
LOW_LOSS = 7.0
FADING = 4.0
HIGH = 50.0
AIR_HEIGHT = 0.7

_COARSE = np.array([40.0, 20.0, 10.0, 6.0, 4.0, 3.0, 3.0, 3.0, 3.0, 3.0])


def tukey(scaled: np.ndarray) -> np.ndarray:
    """Tukey's weights: 1 at 0, 0 from 4.7 sigma on; 0 for NaN."""
    return np.where(np.abs(scaled) < TUKEY, (1 - (scaled / TUKEY) ** 2) ** 2, 0.0)


def strong_signals(signals: Signals) -> np.ndarray:
    """(n,) bool: signals as strong as a free line of sight lets them be, judged without a map.

    The strongest tenth of a system's signals, each raised by what the elevation costs (about 7 dB from the zenith to
    the horizon), sets the measure; 4 dB below it, more than fading takes and less than a reflection costs, is the
    limit. Signals without a strength count from 50 degrees of elevation.
    """
    raised = signals.cn0 + LOW_LOSS * (1.0 - signals.direction[:, 2])
    strong = np.zeros(len(signals), bool)
    for name in np.unique(signals.system):
        of_system = (signals.system == name) & np.isfinite(raised)
        if of_system.any():
            strong[of_system] = raised[of_system] >= np.percentile(raised[of_system], 90) - FADING
    unknown = ~np.isfinite(signals.cn0)
    strong[unknown] = signals.elevation[unknown] >= HIGH
    return strong


def strong_scatter(signals: Signals) -> float:
    """How far the strongest signals contradict each other at an epoch, m (robust standard deviation); offsets of the
    systems are taken off by medians. NaN with fewer than fifty to compare."""
    rows = np.flatnonzero(strong_signals(signals))
    epoch, epochs = _numbered(signals.epoch[rows])
    system = np.unique(signals.system[rows], return_inverse=True)[1].ravel()
    part, parts = _numbered(signals.epochs.source[signals.epoch[rows]] * 8 + system)
    left = signals.residual[rows]
    for _ in range(4):
        left = left - grouped_median(left, epoch, epochs)[epoch]
        left = left - grouped_median(left, part, parts)[part]
    left = left - grouped_median(left, epoch, epochs)[epoch]
    # One of three signals or more is the median itself.
    left = left[(np.bincount(epoch, minlength=epochs)[epoch] > 3) & (left != 0)]
    return float(SIGMA_OF_MAD * np.median(np.abs(left))) if len(left) >= 50 else float("nan")


def estimate_height(signals: Signals, line_of_sight: np.ndarray | None = None) -> tuple[float, float]:
    """By how much the satellites see the antenna higher than it was put, and sigma, m.

    A height too low by h makes every residual smaller by h times the sine of the elevation. Signals of an epoch share
    a clock, but for an offset of each system in a file. Without `line_of_sight` (n,) all signals are used, late
    ones weighed down; those that pass for line of sight make the height too large: they come from low satellites.
    Neighbouring epochs err alike: the sigma counts a satellite's minute as one observation, and holds 0.7 m for what
    the models of the atmosphere leave in a height.

    Raises
    ------
    InsufficientDataError : too few signals or too little difference of elevation.
    """
    rows = np.arange(len(signals)) if line_of_sight is None else np.flatnonzero(line_of_sight)
    group, count = _numbered(signals.epoch[rows])
    lift = signals.direction[rows, 2]
    spread = lift - _centre(lift, np.ones(len(rows)), group, count)[group]
    if len(rows) < 100 or np.sqrt(np.mean(spread ** 2)) < 0.05:
        raise InsufficientDataError(say("Too few satellites at different elevations tell the height of the antenna: "
                                        "give the geoid separation."))
    system = np.unique(signals.system[rows], return_inverse=True)[1].ravel()
    part, parts = _numbered(signals.epochs.source[signals.epoch[rows]] * 8 + system)
    unknowns = sparse.hstack([sparse.csr_matrix(lift[:, None]), _incidence(part, parts)], format="csr")
    value, sigma = signals.residual[rows], signals.sigma[rows]
    solution, weight = _height_steps(value, sigma, unknowns, part, group, count)
    left = value - unknowns @ solution
    left = left - _centre(left, weight, group, count)[group]
    inverse = np.linalg.pinv(_normal(unknowns, weight, group, count), rcond=1e-10, hermitian=True)
    slope = unknowns @ inverse[0]
    influence = weight * left * (slope - _centre(slope, weight, group, count)[group])
    block = np.floor(signals.time[rows] / BLOCK).astype(np.int64)
    satellite, satellites = _numbered(signals.satellite[rows])
    score = np.bincount(_numbered(block * satellites + satellite)[0], influence)
    return -float(solution[0]), float(np.hypot(np.sqrt(np.sum(score ** 2)), AIR_HEIGHT))


def _numbered(values: np.ndarray) -> tuple[np.ndarray, int]:
    """Values replaced by the number of each different one, and how many there are."""
    names, number = np.unique(values, return_inverse=True)
    return number.ravel(), len(names)


def _incidence(number: np.ndarray, count: int) -> sparse.csr_matrix:
    return sparse.csr_matrix((np.ones(len(number)), (np.arange(len(number)), number)), (len(number), count))


def _centre(value: np.ndarray, weight: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    total = np.bincount(group, weight, count)
    return np.bincount(group, weight * value, count) / np.where(total > 0, total, 1.0)


def _normal(unknowns: sparse.csr_matrix, weight: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    """Normal matrix of the unknowns, the clocks of the groups eliminated."""
    weighted = unknowns.multiply(weight[:, None]).tocsr()
    cells = _incidence(group, count).T @ weighted
    total = np.bincount(group, weight, count)
    cells_scaled = cells.multiply(np.where(total > 0, 1 / np.where(total > 0, total, 1.0), 0.0)[:, None])
    return (unknowns.T @ weighted - cells.T @ cells_scaled).toarray()


def _height_steps(value: np.ndarray, sigma: np.ndarray, unknowns: sparse.csr_matrix, part: np.ndarray,
                  group: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Minus height and offsets, and final weights; the robust scale falls from tens of metres: a mix-up is followed."""
    solution = np.zeros(unknowns.shape[1])
    # Offsets of the systems by medians, each against the median of its epochs.
    above = value - grouped_median(value, group, count)[group]
    solution[1:] = grouped_median(above, part, unknowns.shape[1] - 1)
    left = value - unknowns @ solution
    left = left - grouped_median(left, group, count)[group]
    for scale in _COARSE:
        for _ in range(4):
            weight = tukey(left / (np.maximum(sigma, 0.5) * scale)) / sigma ** 2
            centred = value - _centre(value, weight, group, count)[group]
            right = unknowns.T @ (weight * centred)
            before = solution[0]
            solution = np.linalg.lstsq(_normal(unknowns, weight, group, count), right, rcond=1e-10)[0]
            left = value - unknowns @ solution
            left = left - _centre(left, weight, group, count)[group]
            if abs(solution[0] - before) < 1e-2:
                break
    return solution, weight
