"""Lasers of a spinning scanner: told apart, freed of their gains, left out where they say nothing."""

import numpy as np
import pytest

from urbanmap_qgis.mobile.calibration import MountedScanner
from urbanmap_qgis.mobile.markings.lasers import ANGLE, ATTRIBUTE, find_gains, told_apart, vertical_angles
from urbanmap_qgis.mobile.markings.ranges import Track
from urbanmap_qgis.mobile.markings.survey_points import RECORD
from urbanmap_qgis.mobile.trajectory import Trajectory, rotations

LASERS, HEIGHT = 24, 1.8


def drive(seed=1, gains=True, numbered=True, mount=None):
    """Ground points of a spinning scanner on a road with paint: records, true gains by laser, true paint."""
    rng = np.random.default_rng(seed)
    trajectory = Trajectory(np.array([0.0, 10.0]), np.array([[0.0, 0.0, HEIGHT], [0.0, 20.0, HEIGHT]]),
                            np.array([[0.5, -0.3, 0.0], [0.5, -0.3, 0.0]]))
    elevation = np.radians(-24.0 + 0.8 * np.arange(LASERS))
    n = 60_000
    laser, azimuth = rng.integers(0, LASERS, n), rng.uniform(0, 2 * np.pi, n)
    time = rng.uniform(0, 10, n)
    e = elevation[laser]
    beam = np.column_stack([np.cos(e) * np.cos(azimuth), np.cos(e) * np.sin(azimuth), -np.sin(e)])
    if mount is not None:
        turned = rotations(mount.angles[None])[0]
        beam = beam @ np.stack([turned[1], turned[0], -turned[2]]).T
    mapped = beam @ rotations(trajectory.angles[:1])[0].T
    start = np.column_stack([np.zeros(n), 2.0 * time, np.full(n, HEIGHT)])
    down = mapped[:, 2] < -0.05
    beam, mapped, start, laser, time = beam[down], mapped[down], start[down], laser[down], time[down]
    n = len(beam)
    place = start - mapped * (HEIGHT / mapped[:, 2])[:, None]
    gain = np.exp(rng.normal(0, 0.6, LASERS)) if gains else np.ones(LASERS)
    paint = np.abs(place[:, 0] - 3.0) < 0.1
    records = np.zeros(n, RECORD)
    records["x"], records["y"], records["z"] = place.T
    records["range"] = np.linalg.norm(place - start, axis=1)
    records["time"], records["laser"] = time, laser if numbered else 0
    records["intensity"] = 1000 * gain[laser] * np.where(paint, 3.0, 1.0) * np.exp(rng.normal(0, 0.1, n))
    return records, gain, paint, laser, trajectory


def told(records, trajectory, mount=None):
    track = Track(trajectory.time, trajectory.place)
    brightness = records["intensity"] / 1000.0
    return told_apart(records, brightness, brightness < 0.01, track, mount, trajectory)


@pytest.mark.parametrize("numbered", [True, False])
def test_gains_are_found_by_number_or_by_angle(numbered):
    records, gain, paint, laser, trajectory = drive(numbered=numbered)
    found = told(records, trajectory)
    assert found.gains.told_by == (ATTRIBUTE if numbered else ANGLE) and found.gains.after < 0.2 < found.gains.before
    freed = found.freed(records)
    assert np.isfinite(freed).mean() > 0.97
    asphalt = np.array([np.nanmedian(freed[(laser == k) & ~paint]) for k in range(LASERS)])
    ranges = np.array([np.median(records["range"][laser == k]) for k in range(LASERS)])
    off, put_in = (about_parabola(np.log(ranges), np.log(values)) for values in (asphalt, gain))
    assert np.abs(off).max() < 0.1 and np.ptp(put_in) > 1.0
    ratio = freed / asphalt[laser]
    assert np.nanmedian(ratio[paint]) == pytest.approx(3.0, abs=0.2)


def about_parabola(way, values):
    """What varies from laser to laser: the course over range belongs to the curve."""
    return values - np.polyval(np.polyfit(way, values, 2), way)


def test_the_angle_is_that_of_the_scanners_own_plane():
    mount = MountedScanner("top", np.zeros(3), np.array([12.0, -20.0, 75.0]))
    records, _, _, laser, trajectory = drive(numbered=False, mount=mount)
    angle = vertical_angles(records, Track(trajectory.time, trajectory.place), trajectory, mount)
    assert np.allclose(angle, -24.0 + 0.8 * laser, atol=0.01)
    assert told(records, trajectory, mount).gains.told_by == ANGLE


def test_lasers_that_are_alike_are_left_as_they_are():
    records, _, _, _, trajectory = drive(gains=False)
    assert told(records, trajectory) is None


def test_a_blind_and_a_noisy_laser_are_left_out():
    records, _, _, laser, trajectory = drive()
    rng = np.random.default_rng(2)
    records["intensity"][(laser == 3) & (rng.random(len(laser)) < 0.5)] = 0
    noisy = laser == 7
    records["intensity"][noisy] *= np.exp(rng.normal(0, 1.5, noisy.sum()))
    found = told(records, trajectory)
    freed = found.freed(records)
    assert np.isnan(freed[(laser == 3) | noisy]).all() and np.isfinite(freed[~((laser == 3) | noisy)]).all()
    assert found.gains.left_out == 2 and found.gains.used == LASERS - 2


def test_too_few_points_tell_nothing():
    few = np.arange(100.0)
    assert find_gains(few, few, few, np.ones(100), np.zeros(100, bool), np.zeros(100, int), ATTRIBUTE) is None
