"""The range of each point: its distance from where the scanner was when it measured it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import ROUNDING
from ..calibration import Calibration, MountedScanner, scanner_of, scanner_positions
from ..trajectory import Trajectory, interpolate

STEP = 0.1
"""s; between the entries of a track a scanner moves on a straight line. At 90 degrees a second and a lever arm of 1 m
that is 3 mm off at most."""


@dataclass(frozen=True)
class Track:
    """Where a scanner was.

    Attributes
    ----------
    time : (k,) s, increasing.
    place : (k, 3) m.
    max_range : of the scanner, m.
    """

    time: np.ndarray
    place: np.ndarray
    max_range: float = np.inf

    def interpolate(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """x, y and z (m,) at times (m,), m; outside the track that of its nearest end."""
        return tuple(np.interp(time, self.time, axis) for axis in self.place.T)


class Tracks:
    """The track of each scanner by the number its points carry; without a calibration, that of the body's origin."""

    def __init__(self, trajectory: Trajectory, calibration: Calibration | None):
        self._trajectory, self._calibration = trajectory, calibration
        self._time = _times(trajectory.time)
        self._made: dict[int, Track] = {}
        self.by_source: dict[int, Track] = {}

    def of(self, source: int) -> Track:
        """Track of a scanner; numbers of one scanner have the same object.

        Raises
        ------
        InputError : the calibration does not know the number.
        """
        if source not in self.by_source:
            scanner = scanner_of(self._calibration, source) if self._calibration else None
            key = id(scanner)
            if key not in self._made:
                self._made[key] = self._track(scanner)
            self.by_source[source] = self._made[key]
        return self.by_source[source]

    def _track(self, scanner: MountedScanner | None) -> Track:
        if scanner is None:
            return Track(self._time, interpolate(self._trajectory, self._time).place)
        return Track(self._time, scanner_positions(self._trajectory, scanner, self._time), scanner.max_range)


def _times(epochs: np.ndarray) -> np.ndarray:
    """The epochs, and times between those that are more than `STEP` apart."""
    parts = np.maximum(np.ceil(np.diff(epochs) / STEP - ROUNDING), 1).astype(int)
    number = np.repeat(np.arange(len(parts)), parts)
    within = np.arange(len(number)) - np.repeat(np.cumsum(parts) - parts, parts)
    return np.append(epochs[number] + np.diff(epochs)[number] * within / parts[number], epochs[-1])


def ranges(x: np.ndarray, y: np.ndarray, z: np.ndarray,
           place: tuple[np.ndarray, np.ndarray, np.ndarray]) -> np.ndarray:
    """Range (n,) in m of points at x, y, z (n,) m from their scanner's place at their times (`Track.at`)."""
    return np.sqrt((x - place[0]) ** 2 + (y - place[1]) ** 2 + (z - place[2]) ** 2)
