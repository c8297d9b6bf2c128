"""Patches and dynamic windows (J 3.2.4.2)."""

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.matching.windows import choose_windows
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.start.patch_points import thin_points
from urbanmap_qgis.mobile.registration.start.patches import divide_path
from urbanmap_qgis.mobile.trajectory import Trajectory


def true_trajectory(length, wait_at=None, wait=10.0):
    """Eastwards at 8 m/s, with a wait if wanted."""
    time = np.arange(0, length / 8 + (wait if wait_at is not None else 0), 0.02)
    along = 8 * time
    if wait_at is not None:
        along = np.where(along > wait_at, np.maximum(wait_at, along - 8 * wait), along)
    zero = np.zeros_like(time)
    place, angles = np.column_stack([along - 7000, zero, zero]), np.column_stack([zero, zero, zero + 90])
    return Trajectory(361000.0 + time, place, angles)


def test_a_wait_makes_no_patches_and_its_seconds_count_apart():
    plain, waiting = true_trajectory(80.0), true_trajectory(80.0, wait_at=40.0, wait=30.0)
    without, with_wait = divide_path(plain, 0.5), divide_path(waiting, 0.5)
    assert abs(len(without) - len(with_wait)) <= 1
    assert without.stop_time[-1] == 0
    assert with_wait.stop_time[-1] == pytest.approx(30.0, abs=1.5)
    before = with_wait.chainage < 39.0
    assert (with_wait.stop_time[before] == 0).all()
    assert np.allclose(np.diff(with_wait.chainage)[:-1], 0.5)
    assert np.allclose(with_wait.place[before, 0], with_wait.chainage[before] - 7000, atol=0.02)


def test_a_vehicle_that_stands_is_told():
    time = np.arange(0, 10, 0.1)
    still = Trajectory(time, np.zeros((100, 3)), np.zeros((100, 3)))
    with pytest.raises(InsufficientDataError):
        divide_path(still, 0.5)


def brute_window(x, y, patch, patches, settings, number, extend_at_end):
    """J's rule written plainly: add a patch at a time until enough cells are occupied."""
    half = settings.window_patches // 2
    for more in range(settings.max_window_patches - settings.window_patches + 1):
        first = number - half - (0 if extend_at_end else more // 2)
        last = first + settings.window_patches + more - 1
        first, last = max(first, 0), min(last, patches - 1)
        here = (patch >= first) & (patch <= last)
        cells = np.floor(np.column_stack([x[here] - x.min(), y[here] - y.min()]) / settings.feature_grid)
        _, count = np.unique(cells, axis=0, return_counts=True)
        features = (count >= settings.feature_points).sum()
        if features >= settings.feature_count or (first == 0 and last == patches - 1):
            break
    return first, last, features


@pytest.mark.paper("J 3.2.4.2")
@pytest.mark.parametrize("extend_at_end", [True, False])
def test_windows_grow_as_the_paper_says(extend_at_end):
    rng = np.random.default_rng(2)
    patches = 70
    patch = np.sort(rng.integers(0, patches, 2000) ** 2 // patches)  # sparse at the end
    x, y = 0.5 * patch + rng.uniform(0, 1, 2000), rng.uniform(0, 4, 2000)
    settings = RegistrationSettings(window_patches=12, max_window_patches=60, feature_count=50,
                                    extend_at_end=extend_at_end)
    windows = choose_windows(x, y, patch, patches, settings)
    for number in range(patches):
        assert (windows.first[number], windows.last[number], windows.features[number]) == brute_window(
            x, y, patch, patches, settings, number, extend_at_end)
    size = windows.last - windows.first + 1
    assert size.max() <= 60 and len(np.unique(size)) > 3


def test_thinning_keeps_one_point_a_cell_and_each_pass_apart():
    trajectory = true_trajectory(40.0)
    patches = divide_path(trajectory, 0.5)
    x, y = np.array([0.01, 0.05, 0.32, 0.01]) + 500, np.array([0.02, 0.08, 0.35, 0.02]) + 700
    time = trajectory.time[0] + np.array([1.0, 1.01, 1.0, 4.0])  # the last one on another stretch
    one = np.ones(4)
    thin = thin_points(MarkingPoints(x, y, one, time, one, one), trajectory, patches, 0.3)
    assert len(thin) == 3
    assert (np.diff(thin.patch) >= 0).all()
    mean = thin.place[np.argmin(np.abs(thin.place[:, 0] - x[:2].mean()) + np.abs(thin.place[:, 1] - y[:2].mean()))]
    assert np.allclose(mean[:2], [x[:2].mean(), y[:2].mean()], atol=1e-9)


def test_thinning_nothing():
    trajectory = true_trajectory(40.0)
    none = np.zeros(0)
    thin = thin_points(MarkingPoints(none, none, none, none, none, none), trajectory, divide_path(trajectory, 0.5), 0.1)
    assert len(thin) == 0


def test_a_window_counts_the_cells_that_hold_enough_points():
    """Patches of 3, 1, 2 and 0 points in one cell each; windows of two."""
    patch = np.array([0, 0, 0, 1, 2, 2])
    x = np.where(patch == 0, 0.5, np.where(patch == 1, 5.5, 9.5))
    settings = RegistrationSettings(window_patches=2, feature_count=1, feature_points=2, feature_grid=1.0,
                                    max_window_patches=2, extend_at_end=True)
    found = choose_windows(x, np.zeros(6), patch, 4, settings)
    assert (found.first.tolist(), found.last.tolist()) == ([0, 0, 1, 2], [0, 1, 2, 3])
    assert found.features.tolist() == [1, 1, 1, 1]
