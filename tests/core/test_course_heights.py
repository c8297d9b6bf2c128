"""Heights from the ground along a course: hills, vehicles, bridges, gaps."""

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.lines.course_heights import course_heights
from urbanmap_qgis.mobile.trajectory import Trajectory

HEIGHT = 1.9


def hills(x, y):
    return 20 + 5 * np.sin(np.asarray(x) / 150) + 0.01 * np.asarray(y)


def drive(error, seconds=300.0):
    """East at 8 m/s with a wait of a minute; heights off by `error(time)`."""
    time = np.arange(0.0, seconds, 0.1)
    way = 8.0 * np.interp(time, [0, 100, 160, seconds], [0, 100, 100, seconds - 60])
    place = np.column_stack([way, 0 * way, hills(way, 0) + HEIGHT + error(time)])
    return Trajectory(time, place, np.tile([0, 0, 90.0], (len(time), 1)))


def wander(time):
    return 0.8 + 0.3 * np.sin(time / 50)


def test_error_is_found_with_its_sigma():
    rng = np.random.default_rng(0)
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: hills(x, y) + rng.normal(0, 0.03, len(x)), HEIGHT)
    left = made.error + wander(trajectory.time)
    assert np.sqrt(np.mean(left**2)) < 0.03 and 0.5 < np.sqrt(np.mean((left / made.sigma) ** 2)) < 1.6
    assert made.sample_sigma == pytest.approx(0.03, rel=0.3) and made.after < 0.04 < 0.7 < made.before
    assert made.covered == 1.0 and not made.found and made.left_out < 0.03 * made.samples
    assert made.samples == pytest.approx(240 * 8 / 2 + 60 / 5, abs=3)


def test_vehicles_and_bridges_on_a_surface_model_are_left_out():
    """A third of the course under parked vehicles, and a bridge 2.5 m above it over 60 m."""
    rng = np.random.default_rng(1)

    def surface(x, y):
        standing = (np.asarray(x) % 30 < 10) * rng.uniform(1.3, 2.0, len(x))
        return hills(x, y) + rng.normal(0, 0.02, len(x)) + np.where((x > 500) & (x < 560), 2.5, standing)

    trajectory = drive(wander)
    made = course_heights(trajectory, surface, HEIGHT)
    left = made.error + wander(trajectory.time)
    assert np.sqrt(np.mean(left**2)) < 0.05 and np.abs(left).max() < 0.2
    assert 0.3 < made.left_out / made.samples < 0.45


def test_a_bridge_far_above_is_not_driven_on():
    """Over most of the course a deck 6 m above: only the part without it counts, and its sigma is larger under it."""
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: hills(x, y) + 6.0 * ((x > 300) & (x < 1700)), HEIGHT)
    left = made.error + wander(trajectory.time)
    outside = (trajectory.place[:, 0] < 290) | (trajectory.place[:, 0] > 1710)
    assert np.abs(left[outside]).max() < 0.02
    assert made.sigma[~outside].max() > 5 * made.sigma[outside].mean()
    assert np.abs(left[~outside]).max() < 4 * made.sigma[~outside].max()


def test_without_the_sensor_s_height_the_mean_stays():
    trajectory = drive(wander)
    made = course_heights(trajectory, hills, None)
    moved = np.diff(trajectory.place[:, 0], prepend=0.0) > 0
    assert made.found and abs(np.median(made.error[moved])) < 0.05
    np.testing.assert_allclose(np.diff(made.error), -np.diff(wander(trajectory.time)), atol=0.01)


def test_gaps_of_the_ground_are_bridged_with_a_larger_sigma():
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: np.where((x > 400) & (x < 1200), np.nan, hills(x, y)), HEIGHT)
    inside = (trajectory.place[:, 0] > 450) & (trajectory.place[:, 0] < 1150)
    assert made.covered == pytest.approx(1 - 800 / 1920, abs=0.01)
    assert made.sigma[inside].min() > 2 * np.median(made.sigma[trajectory.place[:, 0] < 350])


def test_a_ground_elsewhere_or_at_another_level_is_refused():
    with pytest.raises(InsufficientDataError, match="does not reach"):
        course_heights(drive(wander), lambda x, y: np.full(len(x), np.nan), HEIGHT)
    with pytest.raises(InsufficientDataError, match="40.. m above the ground"):
        course_heights(drive(wander), lambda x, y: hills(x, y) - 38.0, HEIGHT)
