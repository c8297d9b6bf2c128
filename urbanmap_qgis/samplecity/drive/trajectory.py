"""Where the vehicle is and how it is turned, over time; its poses as files.

Body: x forward, y right, z down. A body vector b lies in north, east, down as Rz(heading) Ry(pitch) Rx(roll) b.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

FIELDS = "time,x,y,z,roll,pitch,heading"
FORMATS = ("%.2f", "%.4f", "%.4f", "%.4f", "%.6f", "%.6f", "%.6f")


@dataclass(frozen=True)
class SimulatedTrajectory:
    """Poses of the body at epochs; linear between them (position and angles).

    Attributes
    ----------
    time : (n,) GPS seconds, rising.
    place : (n, 3) x, y, z of the body's origin, m.
    angles : (n, 3) roll, pitch, heading in degrees; the heading goes on through 360 without a jump.
    """

    time: np.ndarray
    place: np.ndarray
    angles: np.ndarray

    def rounded(self) -> SimulatedTrajectory:
        """The trajectory as its file gives it (0.1 mm, a millionth of a degree)."""
        return SimulatedTrajectory(np.round(self.time, 2), np.round(self.place, 4), np.round(self.angles, 6))

    def interpolate(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Place (n, 3) and rotation body to east, north, up (n, 3, 3) at the times (n,)."""
        place = np.column_stack([np.interp(time, self.time, column) for column in self.place.T])
        angles = np.column_stack([np.interp(time, self.time, column) for column in self.angles.T])
        return place, body_to_world(angles)

    def chainage(self) -> np.ndarray:
        """Chainage since the first epoch (n,), m in plan."""
        steps = np.hypot(*np.diff(self.place[:, :2], axis=0).T)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def write(self, path: Path) -> None:
        """Write CSV `time,x,y,z,roll,pitch,heading`; headings 0 to 360."""
        angles = self.angles.copy()
        angles[:, 2] = np.round(angles[:, 2] % 360.0, 6) % 360.0
        np.savetxt(path, np.column_stack([self.time, self.place, angles]), FORMATS, ",", header=FIELDS, comments="")


def body_to_world(angles: np.ndarray) -> np.ndarray:
    """Rotations (n, 3, 3) from the body into east, north, up for roll, pitch, heading (n, 3) in degrees."""
    (sr, sp, sh), (cr, cp, ch) = np.sin(np.radians(angles)).T, np.cos(np.radians(angles)).T
    rotation = np.empty((len(angles), 3, 3))
    rotation[:, 0] = np.column_stack([cp * sh, sr * sp * sh + cr * ch, cr * sp * sh - sr * ch])
    rotation[:, 1] = np.column_stack([cp * ch, sr * sp * ch - cr * sh, cr * sp * ch + sr * sh])
    rotation[:, 2] = np.column_stack([sp, -sr * cp, -cr * cp])
    return rotation


def mounting(roll: float, pitch: float, heading: float) -> np.ndarray:
    """Rotation (3, 3) from a sensor's axes into the body's for its angles in degrees."""
    world = body_to_world(np.array([[roll, pitch, heading]]))[0]
    return world[[1, 0, 2]] * np.array([[1.0], [1.0], [-1.0]])


def carried_over(points: np.ndarray, time: np.ndarray, source: SimulatedTrajectory,
                 target: SimulatedTrajectory) -> np.ndarray:
    """Points (n, 3) seen at the times (n,) from `source`, as they lie when seen from `target`."""
    place, rotation = source.interpolate(time)
    body = np.einsum("nji,nj->ni", rotation, points - place)
    place, rotation = target.interpolate(time)
    return place + np.einsum("nij,nj->ni", rotation, body)
