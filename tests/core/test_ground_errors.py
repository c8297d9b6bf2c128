"""Errors of a reference's heights: their size is found, and they do not count as knowledge of roll and pitch."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from urbanmap_qgis.mobile.registration.correction.ground_errors import (
    LENGTH,
    HeightDifferences,
    ground_sigma,
    without_shared_errors,
)


def street(sigma, roll=0.0, noise=0.01, seed=0):
    """Differences seen along 400 m of a street 16 m wide, whose ground is wrong by a field of `sigma` m."""
    rng = np.random.default_rng(seed)
    field = gaussian_filter(rng.standard_normal((1200, 600)), LENGTH / np.sqrt(2.0))
    field *= sigma / field.std()
    along, right = rng.uniform(0, 400, 20000), rng.uniform(-8, 8, 20000)
    piece = (along / 2).astype(int)
    order = np.argsort(piece, kind="stable")
    along, right, piece = along[order], right[order], piece[order]
    off = field[(along + 400).astype(int), (right + 300).astype(int)] + rng.normal(0, noise, len(along))
    return HeightDifferences(piece, np.column_stack([along - 2 * piece, right]), off + np.radians(roll) * right)


@pytest.mark.parametrize("sigma", [0.04, 0.1])
def test_size_of_the_errors_is_found(sigma):
    found = np.mean([ground_sigma(street(sigma, seed=seed)) for seed in range(4)])
    assert 0.6 * sigma < found < 1.5 * sigma


def test_a_constant_roll_is_no_error_of_the_ground():
    assert ground_sigma(street(0.0001, roll=0.3)) < 0.025


def test_too_few_points_give_the_usual_size():
    few = HeightDifferences(np.zeros(3, int), np.zeros((3, 2)), np.zeros(3))
    assert ground_sigma(few) == 0.05


def test_shared_errors_leave_roll_and_pitch_unknown():
    information = np.zeros((60, 6, 6))
    for east, north in ((-6, -6), (-6, 6), (6, -6), (6, 6)):
        row = np.array([0, 0, 1.0, north, -east, 0])
        information += 500.0 * row[:, None] * row
    gradient = np.zeros((60, 6))
    gradient[:, 3] = 1.0
    _, kept = without_shared_errors(gradient, information, 0.07, 2.0)
    roll = 1 / np.sqrt(kept.sum(axis=0)[3, 3])  # of 120 m, radians
    assert roll > 0.07 / LENGTH / np.sqrt(2)
    same = without_shared_errors(gradient, information, 0.0, 2.0)
    np.testing.assert_allclose(same[0], gradient)
    np.testing.assert_allclose(same[1], information)
