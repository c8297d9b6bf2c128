"""Landmark updating, the usual way to correct a survey (J 3.1): as accurate as its control points are near."""

from __future__ import annotations

import numpy as np

from ..errors import InsufficientDataError
from ..wording import say
from .control import ControlPoints, residuals
from .trajectory import Trajectory

SAME_EPOCH = 0.5
"""Control points measured within this time, s, are taken as one: their mean."""


def update_by_landmarks(trajectory: Trajectory, control: ControlPoints) -> Trajectory:
    """The trajectory moved by position correction vectors at the times of control points (J 3.1).

    A vector is the true place of a control point less its place in the survey. Between control epochs vectors are
    interpolated over time; before the first and after the last they stay as they are. Angles are not touched, and
    heights only by control points that have them.

    Raises
    ------
    InsufficientDataError : no control point was given.
    """
    if not len(control):
        raise InsufficientDataError(say("No control point lies in the survey's time: the trajectory cannot be "
                                        "updated."))
    vectors = -residuals(control)
    place = trajectory.place.copy()
    for axis in range(3):
        known = np.isfinite(vectors[:, axis])
        if known.any():
            time, value = _epochs(control.time[known], vectors[known, axis])
            place[:, axis] += np.interp(trajectory.time, time, value)
    return Trajectory(trajectory.time, place, trajectory.angles)


def _epochs(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean times and values of groups: what follows within `SAME_EPOCH` of a group's first."""
    order = np.argsort(time)
    time, values = time[order], values[order]
    group, start = np.zeros(len(time), int), time[0]
    for row in range(1, len(time)):
        new = time[row] - start > SAME_EPOCH
        group[row] = group[row - 1] + new
        start = time[row] if new else start
    count = np.bincount(group)
    return np.bincount(group, time) / count, np.bincount(group, values) / count
