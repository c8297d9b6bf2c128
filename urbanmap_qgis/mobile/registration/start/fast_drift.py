"""Where the error of the trajectory changes faster than navigation drifts: a GNSS re-fix after an outage (a step).

The correlation start finds each block's place by its own markings. Where it changes by more than half a metre within
20 m of path and stays changed, neighbouring patches may differ by that rate, so that the correction follows.
"""

from __future__ import annotations

import numpy as np

SPAN = 20.0
"""m of path over which the change is taken."""

MIN_CHANGE = 0.5
"""m: the start is known to 0.2 m, and errors drift by 0.1 to 0.4 m in 20 m with a stop (four sample cities)."""

_STEP_OFFSETS = np.arange(-12.5, 13.0, 2.5)  # m, round which the largest change belongs to the same step

_BESIDE = (np.arange(20.0, 51.0, 10.0), np.arange(20.0, 101.0, 10.0))
"""m before and after a step, near and far, between which its change must have lasted."""

_LASTING = 0.7  # share of the change: markings painted anew and slips by a dash give a shift that goes back


def fast_drift_rate(chainage: np.ndarray, shift: np.ndarray, min_change: float = MIN_CHANGE) -> np.ndarray:
    """Rate (n,) in plan, m a metre of path, at which the error changes; 0 where it drifts as usual.

    Parameters
    ----------
    chainage : (n,) m, rising.
    shift : (n, 2) m, the error of the trajectory there.
    """
    change = _shifts_ahead(chainage, shift, 0.5 * SPAN) - _shifts_ahead(chainage, shift, -0.5 * SPAN)
    size = np.hypot(*change.T)
    around = np.max([_shifts_ahead(chainage, size[:, None], offset)[:, 0] for offset in _STEP_OFFSETS], axis=0)
    stays = np.ones(len(chainage), bool)
    for offsets in _BESIDE:
        lasting = _mean_beside(chainage, shift, offsets) - _mean_beside(chainage, shift, -offsets)
        stays &= (lasting * change).sum(axis=1) > _LASTING * size * around
    return np.where((size > min_change) & stays, size / SPAN, 0.0)


def _shifts_ahead(chainage: np.ndarray, shift: np.ndarray, offset: float) -> np.ndarray:
    """Shifts (n, 2) `offset` m farther along the path."""
    return np.column_stack([np.interp(chainage + offset, chainage, axis) for axis in shift.T])


def _mean_beside(chainage: np.ndarray, shift: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Mean shift (n, 2) at `offsets` m from each place along the path."""
    return np.mean([_shifts_ahead(chainage, shift, offset) for offset in offsets], axis=0)
