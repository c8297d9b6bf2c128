"""Rows of a trajectory that cannot be: found before anything is laid out along the path or over the time."""

from __future__ import annotations

import numpy as np

from ..errors import InputError
from ..wording import say
from .gps_time import WEEK

_FASTEST = 1000.0
"""m/s; nothing that surveys moves so fast."""
_LARGEST_JUMP = 1000.0
"""m from one epoch to the next, however short: navigation that starts anew jumps by metres."""
_LARGEST_ANGLE = 1e5
"""Degrees; headings that count turns on reach thousands."""


def require_drivable(table: np.ndarray, order: np.ndarray, name: str, unit: str, first: int) -> None:
    """Refuse a row that lies where no vehicle can have been, at a time weeks from its neighbours, or with an angle that
    is none.

    Parameters
    ----------
    table : (n, 4 or more) time (s), easting, northing, height (m), angles (degrees).
    order : (m,) its rows by time.
    unit, first : what a row is called in the file, "row" or "record", and the number of its first.

    Raises
    ------
    InputError : there is one; it is named.
    """
    time, place = table[order, 0], table[order, 1:4]
    with np.errstate(over="ignore", invalid="ignore"):
        step, late = np.linalg.norm(np.diff(place, axis=0), axis=1), np.diff(time)
    far = np.flatnonzero(~(step <= np.maximum(_FASTEST * late, _LARGEST_JUMP)))
    if len(far):
        row = _farther(place, far[0])
        raise InputError(say("{name}: {unit} {row} (time {time:.4f} s) lies {length:.0f} km from its neighbour, where "
                             "no vehicle can have been: correct or remove it.", name=name, unit=unit,
                             row=int(order[row]) + first, time=time[row], length=step[far[0]] / 1000))
    turned = np.flatnonzero((np.abs(table[order, 4:]) > _LARGEST_ANGLE).any(axis=1))
    if len(turned):
        row = turned[0]
        raise InputError(say("{name}: {unit} {row} (time {time:.4f} s) has an angle of {angle:g} degrees, which no "
                             "vehicle has: correct or remove it.", name=name, unit=unit, row=int(order[row]) + first,
                             time=time[row], angle=np.abs(table[order[row], 4:]).max()))
    pause = np.flatnonzero(~(late <= WEEK))
    if len(pause):
        row = _farther(time[:, None], pause[0])
        raise InputError(say("{name}: the time {time:.1f} s of {unit} {row} lies more than a week from its "
                             "neighbour's: correct or remove it, or give surveys one by one.", name=name, unit=unit,
                             time=time[row], row=int(order[row]) + first))


def _farther(values: np.ndarray, before: int) -> int:
    """Which end of the step after row `before` is the strange one: that farther from the middle of all rows."""
    away = np.linalg.norm(values[before:before + 2] - np.median(values, axis=0), axis=1)
    return before + int(np.argmax(away))
