"""How far and whereto a corrected trajectory moves points, as a table over time that is fast to apply."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from .trajectory import Trajectory, gaps, interpolate, rotations

STEP = 0.1
"""Longest step of the table, s: between its entries a movement is linear, where poses are linear before they meet."""


@dataclass(frozen=True)
class Movement:
    """T_corrected(t) T_reported(t)^-1 (J 3.2.4.3) at k times: the movement of a point p is turn (p - centre) + shift.

    Attributes
    ----------
    time : (k,) s, increasing.
    centre : (3,) m, near the trajectory.
    turn : (k, 3, 3) rotation less the identity.
    shift : (k, 3) m.
    gaps : (g, 2) spans of time, s, in which a trajectory has no epochs.
    """

    time: np.ndarray
    centre: np.ndarray
    turn: np.ndarray
    shift: np.ndarray
    gaps: np.ndarray

    def within(self, time: np.ndarray) -> np.ndarray:
        """Mask (m,) of the times for which both trajectories have poses."""
        return (time >= self.time[0]) & (time <= self.time[-1])

    def in_gap(self, time: np.ndarray) -> np.ndarray:
        """Mask (m,) of the times inside a gap, where the movement is that between the gap's ends."""
        inside = np.zeros(len(time), bool)
        for start, end in self.gaps:
            inside |= (time > start) & (time < end)
        return inside

    def at(self, points: np.ndarray, time: np.ndarray) -> np.ndarray:
        """Movements (m, 3), m, of points (m, 3) measured at times (m,); outside the table that of its nearest end.

        In single precision: exact to a hundredth of a millimetre for points within kilometres of the centre.
        """
        step, share = self._steps(time)
        local = (points - self.centre).astype(np.float32)
        table = np.concatenate([self.turn.reshape(-1, 9), self.shift], axis=1).astype(np.float32)
        slope = np.diff(table, axis=0)
        moved = np.empty(local.shape, np.float32)
        for axis in range(3):
            columns = [3 * axis, 3 * axis + 1, 3 * axis + 2, 9 + axis]
            values = table[:-1, columns][step]
            values += slope[:, columns][step] * share[:, None]
            moved[:, axis] = np.einsum("ij,ij->i", values[:, :3], local) + values[:, 3]
        return moved

    def _steps(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Number of the table's entry before each time, and the share of the step to the next."""
        step = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        start = self.time[step]
        share = (time - start) / (self.time[step + 1] - start)
        return step, np.clip(share, 0.0, 1.0).astype(np.float32)


def movement_between(reported: Trajectory, corrected: Trajectory) -> Movement:
    """The table of what a correction does; the two trajectories need not have the same epochs.

    Raises
    ------
    InputError : the trajectories do not overlap in time.
    """
    start, end = max(reported.time[0], corrected.time[0]), min(reported.time[-1], corrected.time[-1])
    if not end > start:
        raise InputError(f"The corrected trajectory runs from {corrected.time[0]:.1f} to {corrected.time[-1]:.1f} s, "
                         f"the reported one from {reported.time[0]:.1f} to {reported.time[-1]:.1f} s: give two of one "
                         "survey.")
    time = _times(reported.time, corrected.time, start, end)
    before, after = interpolate(reported, time), interpolate(corrected, time)
    turn = rotations(after.angles) @ np.swapaxes(rotations(before.angles), 1, 2) - np.eye(3)
    centre = before.place.mean(axis=0)
    shift = after.place - before.place - np.einsum("kij,kj->ki", turn, before.place - centre)
    return Movement(time, centre, turn, shift, np.concatenate([gaps(reported), gaps(corrected)]))


def _times(first: np.ndarray, second: np.ndarray, start: float, end: float) -> np.ndarray:
    """Epochs of both trajectories inside the common span, and more where they are further apart than `STEP`."""
    time = np.unique(np.concatenate([first, second, [start, end]]))
    time = time[(time >= start) & (time <= end)]
    parts = np.ceil(np.diff(time) / STEP).astype(int)
    number = np.repeat(np.arange(len(parts)), parts)
    within = np.arange(len(number)) - np.repeat(np.cumsum(parts) - parts, parts)
    fine = time[number] + (time[number + 1] - time[number]) * within / parts[number]
    return np.append(fine, time[-1])
