"""Patches: short pieces of the driven path that count as rigid (J 3.2.4.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....errors import InsufficientDataError
from ...trajectory import Trajectory, interpolate, path_chainage


@dataclass(frozen=True)
class Patches:
    """Pieces of equal length of the driven path, in the order driven.

    Attributes
    ----------
    length : m.
    time : (n,) s, when the vehicle is at the patch's middle. way : (n,) m driven up to there.
    place : (n, 3) m, angles : (n, 3) degrees, reported.
    standing : (n,) s waited up to there.
    epoch_time, epoch_way, epoch_standing : the trajectory's epochs, the way driven and the time waited until then.
    """

    length: float
    time: np.ndarray
    way: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    standing: np.ndarray
    epoch_time: np.ndarray
    epoch_way: np.ndarray
    epoch_standing: np.ndarray

    def __len__(self) -> int:
        return len(self.time)

    def way_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) m driven at times (m,) s."""
        return np.interp(time, self.epoch_time, self.epoch_way)

    @property
    def clock(self) -> np.ndarray:
        """(n,) m driven and s waited, together: between patches errors change evenly with it."""
        return self.way + self.standing

    def clock_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) the same at times (m,) s."""
        return np.interp(time, self.epoch_time, self.epoch_way + self.epoch_standing)

    def number_at(self, time: np.ndarray) -> np.ndarray:
        """(m,) number of the patch that the vehicle is in at times (m,) s."""
        return np.clip((self.way_at(time) / self.length).astype(np.int64), 0, len(self) - 1)


def cut_patches(trajectory: Trajectory, length: float) -> Patches:
    """Patches of `length` m along the driven path; a vehicle that waits makes none.

    Raises
    ------
    InsufficientDataError : the vehicle drives less than one patch.
    """
    way = path_chainage(trajectory)
    count = int(np.ceil(way[-1] / length - 1e-9))
    if count < 1:
        raise InsufficientDataError(f"The trajectory drives {way[-1]:.2f} m, less than one patch of {length:g} m: "
                                    "give a longer one.")
    middle = np.minimum((np.arange(count) + 0.5) * length, way[-1])
    moving = np.concatenate([[True], np.diff(way) > 0])
    time = np.interp(middle, way[moving], trajectory.time[moving])
    pose = interpolate(trajectory, time)
    waited = np.concatenate([[0.0], np.cumsum(np.where(np.diff(way) > 0, 0.0, np.diff(trajectory.time)))])
    return Patches(length, time, middle, pose.place, pose.angles, np.interp(time, trajectory.time, waited),
                   trajectory.time, way, waited)
