"""Where the windows' own curve changes faster than drift: the final correction may follow it there."""

from __future__ import annotations

import numpy as np

from ...trajectory import Trajectory
from ..records import WindowResults
from ..start.fast_drift import fast_drift_rate
from .gauss_markov import still_wandering

COHERENT = 4.0
"""m of path in which a step goes one way: over so much its change is the rate times it, not that of a random walk."""

MIN_CHANGE = 0.35
"""m in 20 m: the curve is known to centimetres, and drifts by 0.3 m in 20 m at most without a stop (four cities)."""


MIN_CHANGE_UP = 0.2
"""m in height in 20 m: heights drift slower, and what the ground is off by changes by less over so much path."""


def window_steps(windows: WindowResults, chainage: np.ndarray, min_margin: float,
                 trajectory: Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations (k,) m of the error's change between k + 1 chainages where it is faster than drift.

    In plan and in height; 0 elsewhere. What the reported trajectory wanders while the vehicle stands is no step.
    Only windows that carry a correction with information of their own count, and whose place beats all others by
    `min_margin` (log-likelihood); a GNSS re-fix shows in them as a step.
    """
    known = windows.usable & np.isfinite(windows.linearised[:, :2]).all(axis=1) & windows.information.any(axis=(1, 2))
    known &= windows.margin >= min_margin
    none = np.zeros(len(chainage) - 1)
    if np.count_nonzero(known) < 2:
        return none, none
    wandered = still_wandering(trajectory)
    moving = windows.linearised[known, :3] + np.column_stack([
        np.interp(windows.time[known], trajectory.time, axis) for axis in wandered.T])
    shift = np.column_stack([np.interp(chainage, windows.chainage[known], axis) for axis in moving.T])
    height = np.column_stack([shift[:, 2], np.zeros(len(shift))]) if np.isfinite(shift[:, 2]).all() else None
    changes = [none if part is None else _rates(chainage, part, least)
               for part, least in ((shift[:, :2], MIN_CHANGE), (height, MIN_CHANGE_UP))]
    return changes[0], changes[1]


def _rates(chainage: np.ndarray, shift: np.ndarray, least: float) -> np.ndarray:
    """Standard deviation (k,) m of the change of shifts (k + 1, 2) m where it is more than `least` m in 20 m."""
    rate = fast_drift_rate(chainage, shift, least)
    return np.maximum(rate[1:], rate[:-1]) * np.sqrt(np.diff(chainage) * COHERENT)
