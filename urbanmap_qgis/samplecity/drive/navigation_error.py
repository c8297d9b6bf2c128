"""The error of GNSS/INS positions between tall buildings: smooth, drifting, faster where the vehicle waits.

Its size follows J 3.3 (about a metre in the mean, up to two); its rate of change that of smoothed urban positions, some
centimetres a second, so that neighbouring scans keep fitting each other within a centimetre.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d

from .trajectory import SimulatedTrajectory

MEAN, MAXIMUM = 1.0, 2.0
"""Horizontal error, m: mean over the drive (give or take a tenth) and its limit."""

MAX_HEIGHT = 1.0
"""Of the height error, m."""

# Times over which the drift and the shorter process on it change, s.
SLOW = 40.0
FAST = 8.0
WAITING = 2.5  # Positions drift this many times faster while the vehicle waits: the same reflections act on.
STANDING = 0.3  # Below this speed the vehicle waits, m/s.
# Standard deviations of the angles' errors, degrees.
ROLL_PITCH = 0.015
HEADING = 0.03


def reported_trajectory(true: SimulatedTrajectory, rng: np.random.Generator, mean: float = MEAN,
                        heading: float = HEADING) -> SimulatedTrajectory:
    """What the vehicle's navigation reports: the true trajectory with a smooth error of place and angles.

    `mean` is the mean horizontal error in m (give or take a tenth), `heading` the standard deviation in degrees.
    """
    drift_time = _drift_time(true)
    place = true.place + np.column_stack([*_horizontal(drift_time, mean, rng), _vertical(drift_time, rng)])
    angles = true.angles + np.column_stack([size * _angle(drift_time, rng)
                                            for size in (ROLL_PITCH, ROLL_PITCH, heading)])
    return SimulatedTrajectory(true.time, place, angles).rounded()


def _drift_time(true: SimulatedTrajectory) -> np.ndarray:
    """Time (n,) in which errors change: it runs faster where the vehicle waits."""
    step = np.diff(true.time)
    speed = np.hypot(*np.diff(true.place[:, :2], axis=0).T) / step
    rate = 1.0 + (WAITING - 1.0) * gaussian_filter1d((speed < STANDING).astype(float), 50.0,
                                                            mode="nearest")
    return np.concatenate([[0.0], np.cumsum(step * rate)])


def _horizontal(drift_time: np.ndarray, mean: float, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Errors to east and north: a bias that rotates and grows slowly, with a shorter random process on it."""
    direction = rng.uniform(0, 2 * np.pi) + 0.3 * _smooth(drift_time, SLOW, rng)
    size = np.exp(0.55 * _smooth(drift_time, SLOW, rng))
    east = size * np.cos(direction) + 0.05 * _smooth(drift_time, FAST, rng)
    north = size * np.sin(direction) + 0.05 * _smooth(drift_time, FAST, rng)
    length = np.hypot(east, north)
    scale = min(rng.uniform(0.9, 1.1) * mean / length.mean(), MAXIMUM / length.max())
    return east * scale, north * scale


def _vertical(drift_time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    sign = rng.choice([-1.0, 1.0])
    slow, fast = (_smooth(drift_time, correlation, rng) for correlation in (SLOW, FAST))
    height = sign * (0.6 + 0.15 * slow) + 0.04 * fast
    return height * min(1.0, MAX_HEIGHT / np.abs(height).max())


def _angle(drift_time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A constant part and a drifting part, at most 1.6."""
    return 1.6 * np.tanh((0.8 * rng.standard_normal() + 0.6 * _smooth(drift_time, SLOW, rng)) / 1.6)


def _smooth(drift_time: np.ndarray, correlation: float, rng: np.random.Generator) -> np.ndarray:
    """A smooth random process over the drift time, standard deviation 1, that forgets itself within `correlation` s."""
    step = 0.05
    sigma = correlation / 2 / step
    margin = int(4 * sigma)
    count = int(drift_time[-1] / step) + 2
    noise = gaussian_filter1d(rng.standard_normal(count + 2 * margin), sigma, truncate=4.0)[margin:margin + count]
    return np.interp(drift_time, step * np.arange(count), noise * np.sqrt(2 * np.sqrt(np.pi) * sigma))
