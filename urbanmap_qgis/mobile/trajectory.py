"""The trajectory of a survey vehicle: poses over time, and what they do to points.

Body: x forward, y right, z down. A body vector b lies in north, east, down as Rz(heading) Ry(pitch) Rx(roll) b;
roll right side down, pitch nose up, heading clockwise from grid north. The map is east, north, up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..geometry.tolerances import LEAST_DIVISOR
from ..wording import say

STOP_SPEED = 0.15
"""Below this speed a vehicle stands, m/s: what still moves is noise of its navigation."""


@dataclass(frozen=True)
class Trajectory:
    """Poses of the body at n epochs.

    Attributes
    ----------
    time : (n,) s, strictly increasing.
    place : (n, 3) easting, northing and height of the body's origin, m.
    angles : (n, 3) roll, pitch and heading, degrees, without jumps of a full turn.
    angle_sigma : (n, 3) degrees, standard deviations of the angles as the navigation states them; None where it does
        not. Trajectories made from this one do not carry them.
    place_sigma : (n, 2) m, standard deviations of easting and northing as the navigation states them, likewise: between
        tall buildings they are far too small, but tell where GNSS was missing.
    """

    time: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    angle_sigma: np.ndarray | None = None
    place_sigma: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.time)

    @property
    def duration(self) -> float:
        """Time from the first epoch to the last, s."""
        return float(self.time[-1] - self.time[0])

    def within(self, time: np.ndarray) -> np.ndarray:
        """Mask (m,) of the times that lie between the first and the last epoch."""
        return (time >= self.time[0]) & (time <= self.time[-1])


def interpolate(trajectory: Trajectory, time: np.ndarray, outside: str = "error") -> Trajectory:
    """Poses at any times (m,): position and angles linear between epochs.

    Parameters
    ----------
    outside : what is done with times before the first or after the last epoch: "error", "hold" (the pose there) or
        "nan".

    Raises
    ------
    InputError : a time lies outside, and `outside` is "error".
    """
    time = np.asarray(time, float)
    before, share = _between(trajectory, time)
    within = trajectory.within(time)
    if outside == "error" and not within.all():
        worst = time[~within][0]
        raise InputError(say("The trajectory runs from {time:.3f} to {time_2:.3f} s, but a pose is needed at "
                             "{worst:.3f} s: give the trajectory of the whole survey.", time=trajectory.time[0],
                             time_2=trajectory.time[-1], worst=worst))
    place, angles = (_linear(values, before, share) for values in (trajectory.place, trajectory.angles))
    if outside == "nan":
        place[~within], angles[~within] = np.nan, np.nan
    return Trajectory(time, place, angles)


def _between(trajectory: Trajectory, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number of the epoch before each time and the share of the step to the next, 0 to 1."""
    if len(trajectory) == 1:
        return np.zeros(len(time), int), np.zeros(len(time))
    before = np.clip(np.searchsorted(trajectory.time, time, side="right") - 1, 0, len(trajectory) - 2)
    start = trajectory.time[before]
    return before, np.clip((time - start) / (trajectory.time[before + 1] - start), 0.0, 1.0)


def _linear(values: np.ndarray, before: np.ndarray, share: np.ndarray) -> np.ndarray:
    start = values[before]
    return start + share[:, None] * (values[np.minimum(before + 1, len(values) - 1)] - start)


def unwrapped(angles: np.ndarray) -> np.ndarray:
    """Angles (n, 3) in degrees without jumps of a full turn from one row to the next."""
    return np.unwrap(np.asarray(angles, float), axis=0, period=360.0)


def rotations(angles: np.ndarray) -> np.ndarray:
    """Matrices (m, 3, 3) that take body vectors (forward, right, down) to the map (east, north, up).

    `angles` (m, 3) are roll, pitch, heading in degrees.
    """
    # Of columns of a table numpy's sine differs in its last digit with the place of the result in memory.
    roll, pitch, heading = np.ascontiguousarray(np.radians(np.asarray(angles, float)).T)
    cr, sr, cp, sp, ch, sh = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch), np.cos(heading), np.sin(heading)
    north = np.stack([ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr], axis=-1)
    east = np.stack([sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr], axis=-1)
    up = np.stack([sp, -cp * sr, -cp * cr], axis=-1)
    return np.stack([east, north, up], axis=-2)


def attitude_angles(matrices: np.ndarray) -> np.ndarray:
    """Roll, pitch and heading (m, 3) in degrees of matrices as of `rotations`; heading 0 to 360."""
    east, north, up = np.ascontiguousarray(np.moveaxis(np.asarray(matrices, float), (-2, -1), (0, 1)))
    roll = np.degrees(np.arctan2(-up[1], -up[2]))
    pitch = np.degrees(np.arctan2(up[0], np.hypot(up[1], up[2])))
    heading = np.degrees(np.arctan2(east[0], north[0])) % 360.0
    return np.stack([roll, pitch, heading], axis=-1)


def body_to_map(trajectory: Trajectory, time: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Map coordinates (m, 3) of body vectors (m, 3) or (3,) at times (m,): p(t) + R(t) b.

    Raises
    ------
    InputError : a time lies outside the trajectory.
    """
    pose = interpolate(trajectory, time)
    return pose.place + _rotated_to_map(pose.angles, np.broadcast_to(body, pose.place.shape))


def move_points(points: np.ndarray, time: np.ndarray, reported: Trajectory, corrected: Trajectory) -> np.ndarray:
    """Points (m, 3) placed with the reported trajectory, as the corrected one places them: T_corrected T_reported^-1.

    `time` (m,) must lie within both trajectories; points outside are to be left out before (see `Trajectory.within`).

    Raises
    ------
    InputError : a time lies outside a trajectory.
    """
    before, after = interpolate(reported, time), interpolate(corrected, time)
    return after.place + _rotated_to_map(after.angles, _rotated_to_body(before.angles, points - before.place))


def _rotated_to_map(angles: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Body vectors (m, 3) in the map's axes, turned axis by axis: no matrix is made for each point."""
    roll, pitch, heading = np.ascontiguousarray(np.radians(angles).T)
    x, y, z = body.T
    y, z = _plane_rotation(y, z, roll)
    z, x = _plane_rotation(z, x, pitch)
    x, y = _plane_rotation(x, y, heading)
    return np.column_stack([y, x, -z])


def _rotated_to_body(angles: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (m, 3) of the map in the body's axes."""
    roll, pitch, heading = np.ascontiguousarray(np.radians(angles).T)
    y, x, z = vectors[:, 0], vectors[:, 1], -vectors[:, 2]
    x, y = _plane_rotation(x, y, -heading)
    z, x = _plane_rotation(z, x, -pitch)
    y, z = _plane_rotation(y, z, -roll)
    return np.column_stack([x, y, z])


def _plane_rotation(u: np.ndarray, v: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two coordinates turned from the first axis towards the second."""
    cos, sin = np.cos(angle), np.sin(angle)
    return cos * u - sin * v, sin * u + cos * v


def path_chainage(trajectory: Trajectory, stop_speed: float = STOP_SPEED) -> np.ndarray:
    """Way driven in plan (n,) since the first epoch, m; what a standing vehicle's navigation wanders does not count.

    `stop_speed` : speed in m/s, over about a second, below which the vehicle stands.
    """
    step = np.hypot(*np.diff(trajectory.place[:, :2], axis=0).T)
    moving = _speeds(trajectory) >= stop_speed
    return np.concatenate([[0.0], np.cumsum(np.where(moving, step, 0.0))])


def _speeds(trajectory: Trajectory) -> np.ndarray:
    """Speed (n - 1,) in plan between epochs, m/s, as the net movement over about a second round each step."""
    time = trajectory.time
    middle = 0.5 * (time[1:] + time[:-1])
    half = np.maximum(0.5, 0.5 * np.diff(time))
    ends = [np.clip(middle + sign * half, time[0], time[-1]) for sign in (-1, 1)]
    start, end = (np.column_stack([np.interp(at, time, axis) for axis in trajectory.place[:, :2].T]) for at in ends)
    return np.hypot(*(end - start).T) / np.maximum(ends[1] - ends[0], LEAST_DIVISOR)


def joined_trajectory(trajectories: Sequence[Trajectory], names: Sequence[str] = ()) -> Trajectory:
    """One trajectory of several that follow each other in time, in any order.

    Between two of them there is a gap, over which no pose is known.

    Raises
    ------
    InputError : two overlap in time.
    """
    order = sorted(range(len(trajectories)), key=lambda number: trajectories[number].time[0])
    for before, after in zip(order[:-1], order[1:]):
        if trajectories[after].time[0] <= trajectories[before].time[-1]:
            who = " and ".join(names[number] for number in (before, after)) if names else "Two trajectories"
            raise InputError(say("{who} overlap in time: give times that count on over the weeks (full GPS seconds), "
                                 "or each place of the vehicle once.", who=who))
    parts = [trajectories[number] for number in order]
    return Trajectory(np.concatenate([part.time for part in parts]), np.concatenate([part.place for part in parts]),
                      unwrapped(np.concatenate([part.angles for part in parts])))


def gaps(trajectory: Trajectory, max_step: float = 1.0) -> np.ndarray:
    """Spans of time (k, 2), s, between epochs that are more than `max_step` seconds apart."""
    return _spans(trajectory, np.diff(trajectory.time) > max_step)


def jumps(trajectory: Trajectory, max_speed: float = 60.0) -> np.ndarray:
    """Spans of time (k, 2), s, between epochs from which the body moves faster than `max_speed` m/s."""
    step = np.linalg.norm(np.diff(trajectory.place, axis=0), axis=1)
    return _spans(trajectory, step > max_speed * np.diff(trajectory.time))


def _spans(trajectory: Trajectory, steps: np.ndarray) -> np.ndarray:
    number = np.flatnonzero(steps)
    return np.column_stack([trajectory.time[number], trajectory.time[number + 1]])
