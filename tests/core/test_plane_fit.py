"""Robust wall planes: place, lean, accuracy, passes."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.facades.plane_fit import pass_numbers, robust_plane

SIDE = np.array([0.0, -1.0, 0.0])


def points_of(rng, n=2000, noise=0.02, lean=0.0, width=8.0, height=10.0):
    """Points of a wall at y = 0 that looks south and leans back by degrees."""
    x, z = rng.uniform(0, width, n), rng.uniform(0, height, n)
    y = np.tan(np.radians(lean)) * (z - height / 2) + rng.normal(0, noise, n)
    return np.column_stack([x - 7000, y - 34000, z + 12])


def place(plane):
    """y of the plane over the middle of the wall."""
    middle = np.array([-6996.0, -34000.0, 17.0])
    return (middle - plane.distance(middle[None])[0] * plane.normal)[1] + 34000


def test_place_and_noise():
    plane = robust_plane(points_of(np.random.default_rng(1)), np.full(2000, np.nan), SIDE)
    assert place(plane) == pytest.approx(0.0, abs=0.002)
    assert plane.rmse == pytest.approx(0.02, rel=0.08)
    assert plane.normal == pytest.approx([0, -1, 0], abs=0.001) and plane.tilt == 0.0
    assert plane.passes == 1 and np.isnan(plane.pass_spread)


def test_things_before_the_wall_do_not_move_it():
    rng = np.random.default_rng(2)
    points = points_of(rng)
    points[:500, 1] -= rng.uniform(0.06, 0.4, 500)
    plane = robust_plane(points, np.full(2000, np.nan), SIDE)
    assert abs(place(plane)) < 0.004 and plane.points < 1600


@pytest.mark.parametrize("lean", [-3.0, 1.5, 8.0])
def test_leaning_walls(lean):
    plane = robust_plane(points_of(np.random.default_rng(3), lean=lean), np.full(2000, np.nan), SIDE)
    assert plane.tilt == pytest.approx(lean, abs=0.05)
    along, up = plane.axes
    assert np.cross(along, up) == pytest.approx(plane.normal)
    assert along[2] == 0 and up[2] > 0.9


def test_noise_alone_does_not_make_a_wall_lean():
    leans = [robust_plane(points_of(np.random.default_rng(seed), 150, 0.03), np.full(150, np.nan), SIDE).tilt
             for seed in range(40)]
    assert np.count_nonzero(leans) <= 2


def test_sigma_covers_errors_that_square_metres_share():
    """Errors shared within a metre, as of a scan line: the stated sigma is neither far too small nor far too large."""
    normalised = []
    for seed in range(150):
        rng = np.random.default_rng(seed)
        points = points_of(rng, 3000, 0.005)
        block = (np.floor(points[:, 0]) * 100 + np.floor(points[:, 2])).astype(int)
        points[:, 1] += rng.normal(0, 0.02, block.max() - block.min() + 1)[block - block.min()]
        plane = robust_plane(points, np.full(3000, np.nan), SIDE)
        normalised.append(place(plane) / plane.sigma)
    assert 0.6 < np.sqrt(np.mean(np.square(normalised))) < 1.4


def test_passes_that_disagree_show_in_sigma():
    rng = np.random.default_rng(8)
    points, time = points_of(rng), np.repeat([100.0, 500.0], 1000) + np.tile(np.arange(1000) * 0.01, 2)
    points[1000:, 1] += 0.03
    plane = robust_plane(points, time, SIDE)
    assert plane.passes == 2
    assert plane.pass_spread == pytest.approx(0.03 / np.sqrt(2), rel=0.2)
    assert plane.sigma >= 0.9 * plane.pass_spread / np.sqrt(2)


def test_pass_numbers_follow_time_not_order():
    time = np.array([5.0, 400.0, 6.0, 401.0, 7.0])
    assert pass_numbers(time).tolist() == [0, 1, 0, 1, 0]
    assert pass_numbers(np.array([1.0, np.nan])).tolist() == [0, 0]


def test_too_few_points_give_no_plane():
    assert robust_plane(np.zeros((9, 3)), np.zeros(9), SIDE) is None
