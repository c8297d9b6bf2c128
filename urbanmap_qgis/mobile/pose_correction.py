"""How far and whereto a corrected trajectory moves points, as a table over time that is fast to apply."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..wording import say
from .trajectory import Trajectory, gaps, interpolate, rotations

MAX_STEP = 0.02
"""Longest step of the table, s: between its entries a movement is linear, where poses are linear before they meet."""


@dataclass(frozen=True)
class PoseCorrection:
    """T_corrected(t) T_reported(t)^-1 (J 3.2.4.3) at k times; a point p moves by rotation (p - centre) + shift.

    Attributes
    ----------
    time : (k,) s, increasing.
    centre : (3,) m, near the trajectory.
    table : (k, 12) float32; for east, north, up the row of the rotation less the identity, then the shift, m.
    gaps : (g, 2) spans of time, s, in which a trajectory has no epochs.
    """

    time: np.ndarray
    centre: np.ndarray
    table: np.ndarray
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

    def translations(self, points: np.ndarray, time: np.ndarray) -> np.ndarray:
        """Movements (m, 3), m, of points (m, 3) measured at times (m,); outside the table that of its nearest end.

        In single precision: exact to a hundredth of a millimetre for points within kilometres of the centre.
        """
        step, share = self._steps(time)
        local = (points - self.centre).astype(np.float32)
        moved = np.empty(local.shape, np.float32)
        first, last = (int(step.min()), int(step.max())) if len(step) else (0, 0)
        table = self.table[first:last + 2]
        values = np.diff(table, axis=0)[step - first]
        values *= share[:, None]
        values += table[step - first]
        for axis in range(3):
            row = values[:, 4 * axis:4 * axis + 4]
            moved[:, axis] = np.einsum("ij,ij->i", row[:, :3], local) + row[:, 3]
        return moved

    def max_displacement(self, points: np.ndarray) -> float:
        """A bound of every movement inside the box of points (m, 3), m."""
        extent = np.abs(points - self.centre).max()
        rotation, shift = np.abs(self.table[:, [0, 1, 2, 4, 5, 6, 8, 9, 10]]), np.abs(self.table[:, 3::4])
        return float(shift.max() + 3 * rotation.max() * extent)

    def _steps(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Number of the table's entry before each time, and the share of the step to the next."""
        step = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        start = self.time[step]
        share = (time - start) / (self.time[step + 1] - start)
        return step, np.clip(share, 0.0, 1.0).astype(np.float32)


def correction_between(reported: Trajectory, corrected: Trajectory) -> PoseCorrection:
    """The table of what a correction does; the two trajectories need not have the same epochs.

    Raises
    ------
    InputError : the trajectories do not overlap in time.
    """
    start, end = max(reported.time[0], corrected.time[0]), min(reported.time[-1], corrected.time[-1])
    if not end > start:
        raise InputError(say("The corrected trajectory runs from {time:.1f} to {time_2:.1f} s, the reported one from "
                             "{time_3:.1f} to {time_4:.1f} s: give two of one survey.", time=corrected.time[0],
                             time_2=corrected.time[-1], time_3=reported.time[0], time_4=reported.time[-1]))
    time = _times(reported.time, corrected.time, start, end)
    before, after = interpolate(reported, time), interpolate(corrected, time)
    rotation = _rotations_between(before.angles, after.angles)
    centre = before.place.mean(axis=0)
    shift = after.place - before.place - np.einsum("kij,kj->ki", rotation, before.place - centre)
    table = np.concatenate([rotation, shift[:, :, None]], axis=2).reshape(-1, 12).astype(np.float32)
    return PoseCorrection(time, centre, table, np.concatenate([gaps(reported), gaps(corrected)]))


def _rotations_between(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Rotations (k, 3, 3) from one attitude to another, less the identity; exactly none where both are alike."""
    rotation = rotations(after) @ np.swapaxes(rotations(before), 1, 2) - np.eye(3)
    rotation[(before == after).all(axis=1)] = 0.0
    return rotation


def _times(first: np.ndarray, second: np.ndarray, start: float, end: float) -> np.ndarray:
    """Epochs of both trajectories inside the common span, and more where they are further apart than `MAX_STEP`."""
    time = np.unique(np.concatenate([first, second, [start, end]]))
    time = time[(time >= start) & (time <= end)]
    parts = np.ceil(np.diff(time) / MAX_STEP).astype(int)
    number = np.repeat(np.arange(len(parts)), parts)
    within = np.arange(len(number)) - np.repeat(np.cumsum(parts) - parts, parts)
    fine = time[number] + (time[number + 1] - time[number]) * within / parts[number]
    return np.append(fine, time[-1])
