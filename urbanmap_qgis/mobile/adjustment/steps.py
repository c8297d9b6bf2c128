"""Where a drive's observations change faster than drift: its trajectory steps there (a GNSS re-fix)."""

from __future__ import annotations

import numpy as np

from ..registration.correction.error_steps import MIN_CHANGE
from ..registration.start.fast_drift import fast_drift_rate
from .network import PLANE, NetworkObservations

_FEWEST = 4  # observations with one other drive
_SPACING = 5.0  # m


def away_from_steps(observations: NetworkObservations, ties: NetworkObservations, reach: float) -> np.ndarray:
    """Mask (n,) of observations farther than `reach` m from all steps that ties show in their drives."""
    away = np.ones(len(observations), bool)
    for drive, at in ((observations.drive, observations.parameter), (observations.other, observations.other_parameter)):
        for number in np.unique(drive[drive >= 0]):
            of_drive = drive == number
            nodes = np.arange(at[of_drive].min() - reach, at[of_drive].max() + reach + _SPACING, _SPACING)
            steps = nodes[:-1][observed_steps(ties, int(number), nodes) > 0]
            if len(steps):
                away[of_drive] &= np.abs(at[of_drive][:, None] - steps[None] - 0.5 * _SPACING).min(axis=1) > reach
    return away


def observed_steps(observations: NetworkObservations, number: int, parameter: np.ndarray) -> np.ndarray:
    """Change (k,) m in plan between k + 1 nodes of the drive `number` that is no drift; 0 elsewhere.

    Ties with each other drive, and control or reference, are looked at one after another; a tie alone does not say
    which of its two drives steps.
    """
    found = np.zeros(len(parameter) - 1)
    known = np.isfinite(observations.value[:, :2]).all(axis=1) & (observations.kind != PLANE)
    sides = ((observations.drive, observations.parameter, observations.other, 1.0),
             (observations.other, observations.other_parameter, observations.drive, -1.0))
    for drive, at, other, sign in sides:
        for partner in np.unique(other[known & (drive == number)]):
            some = np.flatnonzero(known & (drive == number) & (other == partner))
            if len(some) < _FEWEST or partner == number:
                continue
            order = some[np.argsort(at[some], kind="stable")]
            value = sign * observations.value[order, :2]
            shift = np.column_stack([np.interp(parameter, at[order], axis) for axis in value.T])
            rate = fast_drift_rate(parameter, shift, MIN_CHANGE)
            found = np.maximum(found, np.maximum(rate[1:], rate[:-1]) * np.diff(parameter))
    return found
