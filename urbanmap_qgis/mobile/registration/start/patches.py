"""Patches: short pieces of the driven path that count as rigid (J 3.2.4.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....errors import InsufficientDataError
from ....geometry.tolerances import ROUNDING
from ....wording import say
from ...trajectory import Trajectory, interpolate, path_chainage


@dataclass(frozen=True)
class Patches:
    """Pieces of equal length of the driven path, in the order driven.

    Attributes
    ----------
    length : m.
    time : (n,) s, when the vehicle is at the patch's middle.
    chainage : (n,) m driven up to there.
    place : (n, 3) m.
    angles : (n, 3) degrees, reported.
    stop_time : (n,) s waited up to there.
    epoch_time, epoch_chainage, epoch_stop_time : the trajectory's epochs, chainage and time of stops until then.
    """

    length: float
    time: np.ndarray
    chainage: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    stop_time: np.ndarray
    epoch_time: np.ndarray
    epoch_chainage: np.ndarray
    epoch_stop_time: np.ndarray

    def __len__(self) -> int:
        return len(self.time)

    def chainage_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) m driven at times (m,) s."""
        return np.interp(time, self.epoch_time, self.epoch_chainage)

    @property
    def path_parameter(self) -> np.ndarray:
        """(n,) chainage (m) and time of stops (s) together: between patches errors change evenly with it."""
        return self.chainage + self.stop_time

    def path_parameter_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) the same at times (m,) s."""
        return np.interp(time, self.epoch_time, self.epoch_chainage + self.epoch_stop_time)

    def number_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) number of the patch that the vehicle is in at times (m,) s."""
        return np.clip((self.chainage_at(time) / self.length).astype(np.int64), 0, len(self) - 1)


def divide_path(trajectory: Trajectory, length: float) -> Patches:
    """Patches of `length` m along the driven path; a vehicle that stands makes none.

    Raises
    ------
    InsufficientDataError : the vehicle drives less than one patch.
    """
    chainage = path_chainage(trajectory)
    count = int(np.ceil(chainage[-1] / length - ROUNDING))
    if count < 1:
        raise InsufficientDataError(say("The trajectory drives {chainage:.2f} m, less than one patch of {length:g} "
                                        "m: give a longer one.", chainage=chainage[-1], length=length))
    middle = np.minimum((np.arange(count) + 0.5) * length, chainage[-1])
    moving = np.concatenate([[True], np.diff(chainage) > 0])
    time = np.interp(middle, chainage[moving], trajectory.time[moving])
    pose = interpolate(trajectory, time)
    stop_time = np.concatenate([[0.0], np.cumsum(np.where(np.diff(chainage) > 0, 0.0, np.diff(trajectory.time)))])
    return Patches(length, time, middle, pose.place, pose.angles, np.interp(time, trajectory.time, stop_time),
                   trajectory.time, chainage, stop_time)
