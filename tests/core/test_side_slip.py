"""Whether a change of the correction is the drive's: then its trajectory slipped aside of where it headed."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from urbanmap_qgis.mobile.registration.correction.ground_errors import (
    LENGTH,
    HeightDifferences,
    ground_sigma,
    without_shared_errors,
)
from urbanmap_qgis.mobile.registration.correction.side_slip import SideSlip
from urbanmap_qgis.mobile.trajectory import Trajectory

SPEED = 8.0


def driven(jump=0.0, length=20.0, at=200.0, misaligned=0.3, bend=60.0, seed=3):
    """A drive northwards with a bend to the right whose place is fixed anew by `jump` m to the right over `length` m.

    Its heading is misaligned by some degrees, and wanders by 0.02.
    """
    rng, way = np.random.default_rng(seed), np.arange(0.0, 500.0, 0.4)
    heading = np.radians(bend) * np.clip((way - 300.0) / 30.0, 0.0, 1.0)
    place = np.column_stack([np.cumsum(0.4 * np.sin(heading)), np.cumsum(0.4 * np.cos(heading)), 0.0 * way])
    place[:, 0] += jump * np.clip((way - at) / length + 0.5, 0.0, 1.0)
    wander = np.radians(0.02) * np.cumsum(rng.normal(size=len(way))) / 20.0
    angles = np.column_stack([0.0 * way, 0.0 * way, np.degrees(heading + wander) + misaligned])
    return SideSlip.of(Trajectory(way / SPEED, place, angles), way)


def by_reference(slip, east, north, sigma=0.02):
    """Probability that a change (m) about 200 m is the reference's, which the markings leave open."""
    return slip.share_of_reference(0.5, 185.0, 215.0, np.array([east, north]), sigma**2 * np.eye(2))


@pytest.mark.parametrize("misaligned", [0.0, 0.5, -1.0])
def test_a_slip_is_found_whatever_the_heading_is_off(misaligned):
    right, slip, sigma = driven(0.4, misaligned=misaligned).between(185.0, 215.0)
    assert right == pytest.approx([1.0, 0.0], abs=0.03)
    assert slip == pytest.approx(0.4, abs=0.03) and sigma < 0.04


def test_a_slight_bend_is_no_slip_and_in_a_sharp_one_nothing_is_told():
    _, slip, sigma = driven(bend=15.0).between(300.0, 330.0)
    assert abs(slip) < 3.0 * sigma
    assert driven().between(300.0, 330.0) is None


def test_a_change_that_the_drive_slipped_by_is_its_own():
    assert by_reference(driven(0.4), -0.4, 0.1) < 0.05


def test_a_change_aside_without_a_slip_is_not_the_drives():
    assert by_reference(driven(), -0.4, 0.1) > 0.95
    assert by_reference(driven(-0.4), -0.4, 0.1) < 0.95  # it slipped the other way: who knows


def test_along_the_way_nothing_is_told():
    assert by_reference(driven(), 0.02, 0.6) == pytest.approx(0.5, abs=0.2)


# Errors of a reference's heights: their size is found, and they do not count as knowledge of roll and pitch


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
