"""Line cameras: strip images whose columns are times and whose rows are angles (Z 2.1, eq. 2 and 3).

A strip image is taken one column at a time while the vehicle drives. Row h (0 is the centre of the first) of a column
looks along (cos w, 0, sin w) in the camera's axes x forward, y right, z down, w = 2 asin((h - centre) / 2 / focal):
the fish-eye of Z eq. 2. Z counts the angle from its own axes; docs/lines.md sets both side by side.

`project_to_strip` finds where places of the map lie in a strip, `pixel_rays` whither its pixels look.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...progress import SILENT, Progress
from ...wording import say
from ..calibration import MountedCamera
from ..trajectory import Trajectory, interpolate, rotations
from .plane_sweep import Sweep, sweep_times

POINTS_AT_ONCE = 200_000
"""Places projected at a time; bounds the memory."""

STILL = 0.02
"""m: while the camera moves less than this, a place is swept over once, however often noise does it."""

_MAX_DISTANCE = 100.0


@dataclass(frozen=True)
class LineCamera:
    """A camera that sees one line at a time.

    Attributes
    ----------
    mount : its lever arm and angles on the body.
    rows : pixels of a line.
    focal, centre : of eq. 2, pixels.
    margin : rows at either end that are not used, for they are too distorted (Z 2.1).
    """

    mount: MountedCamera
    rows: int
    focal: float
    centre: float
    margin: int = 0

    def angles(self, rows: np.ndarray) -> np.ndarray:
        """Angles w (n,) of rows in radians, from the camera's x axis downwards (Z eq. 2)."""
        return 2.0 * np.arcsin(np.clip((np.asarray(rows, float) - self.centre) / 2.0 / self.focal, -1.0, 1.0))

    def rows_of(self, angles: np.ndarray) -> np.ndarray:
        """Rows (n,) of angles w in radians, -pi to pi; may lie beyond the line's ends."""
        return self.centre + 2.0 * self.focal * np.sin(np.asarray(angles) / 2.0)

    def sees(self, rows: np.ndarray) -> np.ndarray:
        """Mask (n,) of rows that lie on the used part of the line."""
        return (rows >= self.margin - 0.5) & (rows <= self.rows - self.margin - 0.5)


@dataclass(frozen=True)
class StripImage:
    """An image of a line camera.

    Attributes
    ----------
    camera : what took it.
    times : (columns,) s, strictly increasing: when each column was taken.
    path : of the image file; None where only its geometry is known.
    """

    camera: LineCamera
    times: np.ndarray
    path: Path | None = None

    @property
    def columns(self) -> int:
        """Number of lines."""
        return len(self.times)

    def times_of(self, columns: np.ndarray) -> np.ndarray:
        """Times (n,) of columns, which may lie between whole numbers and half a column beyond the ends."""
        columns = np.asarray(columns, float)
        before = np.clip(np.floor(columns).astype(int), 0, len(self.times) - 2)
        return self.times[before] + (columns - before) * (self.times[before + 1] - self.times[before])


@dataclass(frozen=True)
class Projection:
    """Where places lie in a strip image, (n,) each; a place may have none, one or several, ordered by place and time.

    Attributes
    ----------
    point_index : row of the place in what was given to `project_to_strip`.
    column, row : pixels, to a part of a pixel; 0 is the centre of the first.
    time : s, when the line's plane sweeps over the place.
    distance : from the camera, m.
    """

    point_index: np.ndarray
    column: np.ndarray
    row: np.ndarray
    time: np.ndarray
    distance: np.ndarray

    def __len__(self) -> int:
        return len(self.point_index)


def camera_poses(camera: LineCamera, trajectory: Trajectory, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) of the camera and its axes (n, 3, 3), columns x, y and z, in the map at times (n,).

    Raises
    ------
    InputError : a time lies outside the trajectory.
    """
    pose = interpolate(trajectory, time)
    body = rotations(pose.angles)
    return pose.place + body @ camera.mount.lever_arm, body @ mount_matrix(camera.mount.angles)


def mount_matrix(angles: np.ndarray) -> np.ndarray:
    """Matrix (3, 3) that takes a sensor's axes to the body's, of its roll, pitch and heading (3,) in degrees."""
    return rotations(np.asarray(angles, float)[None])[0][[1, 0, 2]] * np.array([[1.0], [1.0], [-1.0]])


def pixel_rays(strip: StripImage, trajectory: Trajectory, columns: np.ndarray,
               rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the rays of pixels (n,) start, (n, 3) m, and their unit directions (n, 3), in the map (Z eq. 3).

    Raises
    ------
    InputError : the trajectory does not reach a column's time.
    """
    place, axes = camera_poses(strip.camera, trajectory, strip.times_of(columns))
    angle = strip.camera.angles(rows)
    return place, axes[:, :, 0] * np.cos(angle)[:, None] + axes[:, :, 2] * np.sin(angle)[:, None]


def project_to_strip(points: np.ndarray, strip: StripImage, trajectory: Trajectory, max_distance: float = _MAX_DISTANCE,
                     progress: Progress = SILENT) -> Projection:
    """Where places of the map lie in a strip image: the inverse of Z eq. 3.

    The line's plane sweeps over a place when the place's y in the camera's axes is nought; all such times are found
    (a rotating vehicle may show a place several times) to a small part of a column. What hides a place is not asked.

    Parameters
    ----------
    points : (n, 3) east, north, up, m.
    max_distance : places farther from the camera are left out, m.

    Raises
    ------
    InputError : the strip has fewer than two columns within the trajectory's time.
    """
    points = np.asarray(points, float).reshape(-1, 3)
    sweep = sweep_of(strip, trajectory)
    parts = []
    for first in range(0, len(points), POINTS_AT_ONCE):
        progress.step(first / len(points))
        some = points[first:first + POINTS_AT_ONCE]
        index, time = sweep_times(some, sweep, max_distance, progress)
        parts.append(_seen(some, index, time, strip, trajectory, first))
    empty = np.empty(0)
    columns = zip(*parts) if parts else ((np.empty(0, int),), *(((empty,),) * 4))
    return Projection(*(np.concatenate(column) for column in columns))


def sweep_of(strip: StripImage, trajectory: Trajectory) -> Sweep:
    """The planes of a strip's columns, as far as the trajectory reaches.

    Raises
    ------
    InputError : fewer than two columns lie within the trajectory's time.
    """
    times = strip.times[trajectory.within(strip.times)]
    if len(times) < 2:
        raise InputError(say("The strip image was taken from {times:.1f} to {times_2:.1f} s, the trajectory runs "
                             "from {time:.1f} to {time_2:.1f} s: give those of one survey.", times=strip.times[0],
                             times_2=strip.times[-1], time=trajectory.time[0], time_2=trajectory.time[-1]))

    def planes(time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        place, axes = camera_poses(strip.camera, trajectory, time)
        return place, axes[:, :, 1]

    return Sweep.of(times, planes)


def _seen(points: np.ndarray, index: np.ndarray, time: np.ndarray, strip: StripImage, trajectory: Trajectory,
          first: int) -> tuple[np.ndarray, ...]:
    """The columns of `Projection` of sweeps over places (n, 3), each standing of the camera once."""
    place, axes = camera_poses(strip.camera, trajectory, time)
    vector = points[index] - place
    row = strip.camera.rows_of(np.arctan2(np.einsum("ni,ni->n", vector, axes[:, :, 2]),
                                          np.einsum("ni,ni->n", vector, axes[:, :, 0])))
    in_view = np.flatnonzero(strip.camera.sees(row))
    index, time, vector, row, place = index[in_view], time[in_view], vector[in_view], row[in_view], place[in_view]
    again = (np.diff(index) == 0) & (np.linalg.norm(np.diff(place, axis=0), axis=1) < STILL)
    again &= np.abs(np.diff(row)) < 1.0
    once = np.flatnonzero(np.concatenate([[True], ~again])) if len(index) else np.empty(0, int)
    column = np.interp(time[once], strip.times, np.arange(len(strip.times)))
    return index[once] + first, column, row[once], time[once], np.linalg.norm(vector[once], axis=1)
