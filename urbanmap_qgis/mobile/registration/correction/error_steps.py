"""Where the windows' own curve changes faster than drift: the final correction may follow it there."""

from __future__ import annotations

import numpy as np

from ..records import WindowResults
from ..start.fast_drift import fast_drift_rate

COHERENT = 4.0
"""m of path in which a step goes one way: over so much its change is the rate times it, not that of a random walk."""

MIN_CHANGE = 0.35
"""m in 20 m: the curve is known to centimetres, and drifts by 0.3 m in 20 m at most without a stop (four cities)."""


def window_steps(windows: WindowResults, chainage: np.ndarray, min_margin: float) -> np.ndarray:
    """Standard deviation (k,) m of the error's change in plan between k + 1 chainages where it is faster than drift.

    0 elsewhere.
    Only windows that carry a correction with information of their own count, and whose place beats all others by
    `min_margin` (log-likelihood); a GNSS re-fix shows in them as a step.
    """
    known = windows.usable & np.isfinite(windows.linearised[:, :2]).all(axis=1) & windows.information.any(axis=(1, 2))
    known &= windows.margin >= min_margin
    if np.count_nonzero(known) < 2:
        return np.zeros(len(chainage) - 1)
    shift = np.column_stack([np.interp(chainage, windows.chainage[known], axis)
                             for axis in windows.linearised[known, :2].T])
    rate = fast_drift_rate(chainage, shift, MIN_CHANGE)
    return np.maximum(rate[1:], rate[:-1]) * np.sqrt(np.diff(chainage) * COHERENT)
