"""Ranges against the scanner's place worked out anew."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.calibration import Calibration, MountedScanner
from urbanmap_qgis.mobile.markings.ranges import Tracks, ranges
from urbanmap_qgis.mobile.trajectory import Trajectory

ARM = np.array([0.9, -0.4, -0.6])


def turning(rate=20.0, epochs=10.0):
    """A trajectory on a circle, rolling and pitching."""
    time = np.arange(0.0, 20.0, 1 / epochs)
    heading = rate * time
    turn = np.radians(heading)
    place = np.column_stack([100 + 30 * np.sin(turn), 200 + 30 * np.cos(turn), 0.1 * time])
    return Trajectory(time, place, np.column_stack([3 * np.sin(time), 2 * np.cos(time), heading]))


def scanner_place(trajectory, time, arm):
    """p + R arm by rotation matrices written out one by one."""
    place = np.array([np.interp(time, trajectory.time, axis) for axis in trajectory.place.T])
    roll, pitch, heading = (np.radians(np.interp(time, trajectory.time, axis)) for axis in trajectory.angles.T)
    rx = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    ry = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
    rz = np.array([[np.cos(heading), -np.sin(heading), 0], [np.sin(heading), np.cos(heading), 0], [0, 0, 1]])
    north, east, down = rz @ ry @ rx @ arm
    return place + np.array([east, north, -down])


def calibration(*numbers):
    return Calibration(tuple(MountedScanner(f"s{number}", ARM * (1 + i), np.zeros(3), number, 40.0)
                             for i, number in enumerate(numbers)))


@pytest.mark.parametrize("epochs", [1.0, 10.0, 100.0])
def test_range_is_the_distance_to_the_scanners_place(epochs):
    trajectory = turning(epochs=epochs)
    track = Tracks(trajectory, calibration(7)).of(7)
    rng = np.random.default_rng(1)
    time = rng.uniform(0, trajectory.time[-1], 300)
    points = rng.normal([100, 200, 0], 10, (300, 3))
    expected = [np.linalg.norm(point - scanner_place(trajectory, at, ARM)) for point, at in zip(points, time)]
    assert np.abs(ranges(*points.T, track.interpolate(time)) - expected).max() < 0.003
    assert track.max_range == 40.0


def test_without_calibration_from_the_body():
    trajectory = turning()
    track = Tracks(trajectory, None).of(1234)
    x, y, z = track.interpolate(np.array([5.0]))
    assert np.allclose([x[0], y[0], z[0]], trajectory.place[50])


def test_scanners_are_told_apart_and_one_stands_for_all():
    tracks = Tracks(turning(), calibration(1, 2))
    assert tracks.of(1) is tracks.of(1) and tracks.of(1) is not tracks.of(2)
    single = Tracks(turning(), calibration(None))
    assert single.of(0) is single.of(17)
    with pytest.raises(InputError, match="no scanner with point source id 3"):
        tracks.of(3)
