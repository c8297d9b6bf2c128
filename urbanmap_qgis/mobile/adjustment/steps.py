"""Where a drive's observations change faster than drift: its trajectory steps there (a GNSS re-fix)."""

from __future__ import annotations

import numpy as np

from ..registration.start.fast_drift import SPAN, fast_drift_rate
from .network import ACROSS_KINDS, NetworkObservations

_MIN_CHANGE = 0.35  # m in 20 m: the course is known to centimetres, and drifts by 0.3 m there at most (four cities)
_FEWEST = 4  # observations with one other drive
_SPACING = 5.0  # m
_DENIED = 1.0 / 3.0  # of a step, that observations with others change by at most where they deny it
_REACH, _MOST_REACH = 60.0, 120.0  # m of path a metre of the step, and at most, within which drift is small beside it


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

    Ties with each other drive, and control or reference, are looked at one after another. A tie alone does not say
    which of its two drives steps; where what is observed with others does not change there, it is not this one.
    """
    courses, found = _courses(observations, number), np.zeros(len(parameter) - 1)
    for rank, (at, value) in enumerate(courses):
        if len(at) < _FEWEST:
            continue
        shift = np.column_stack([np.interp(parameter, at, axis) for axis in value.T])
        rate = fast_drift_rate(parameter, shift, _MIN_CHANGE)
        step = np.maximum(rate[1:], rate[:-1])
        others = courses[:rank] + courses[rank + 1:]
        middle, seen = 0.5 * (parameter[1:] + parameter[:-1]), step.copy()
        for node in np.flatnonzero(seen):
            size = SPAN * seen[np.abs(middle - middle[node]) <= SPAN].max()
            if any(_denies(*other, middle[node], size) for other in others):
                step[node] = 0.0
        found = np.maximum(found, step * np.diff(parameter))
    return found


def _courses(observations: NetworkObservations, number: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """What is observed of a drive with each other drive, and alone: path parameters (n,), rising, and values (n, 2) m.
    """
    known = np.isfinite(observations.value[:, :2]).all(axis=1) & ~np.isin(observations.kind, ACROSS_KINDS)
    sides = ((observations.drive, observations.parameter, observations.other, 1.0),
             (observations.other, observations.other_parameter, observations.drive, -1.0))
    found = []
    for drive, at, other, sign in sides:
        for partner in np.unique(other[known & (drive == number)]):
            some = np.flatnonzero(known & (drive == number) & (other == partner))
            if partner != number:
                order = some[np.argsort(at[some], kind="stable")]
                found.append((at[order], sign * observations.value[order, :2]))
    return found


def _denies(at: np.ndarray, value: np.ndarray, place: float, size: float) -> bool:
    """Whether observations at path parameters (n,) near a place do not change there, as a step of `size` m would."""
    before, after = np.searchsorted(at, place - 0.5 * SPAN, side="right") - 1, np.searchsorted(at, place + 0.5 * SPAN)
    reach = 0.5 * SPAN + min(_REACH * size, _MOST_REACH)
    if before < 0 or after == len(at) or at[before] < place - reach or at[after] > place + reach:
        return False
    return bool(np.hypot(*(value[after] - value[before])) < _DENIED * size)
