"""The pitch that nothing measures is as accurate as roll and heading show the inertial unit to be."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core.simulated_windows import simulate
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.patch_corrections import Correction, shown_factor, with_shown_pitch
from urbanmap_qgis.mobile.registration.correction.patch_status import REGISTERED
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings


@pytest.mark.parametrize("true", [0.5, 1.0, 2.0, 3.0])
def test_the_factor_is_that_of_the_errors(true):
    """Errors so many times as large as stated, estimated with a prior of the stated size from good observations."""
    rng = np.random.default_rng(int(10 * true))
    stated, noise = np.full(4000, 0.05), 0.01
    keep = stated**2 / (stated**2 + noise**2)
    value = keep * (true * stated * rng.normal(size=4000) + noise * rng.normal(size=4000))
    assert shown_factor(value, keep * noise**2, stated) == pytest.approx(max(true, 1.0), rel=0.05)


def test_angles_that_were_not_measured_show_nothing():
    assert shown_factor(np.full(5, 0.3), np.full(5, 0.05**2 * 0.9), np.full(5, 0.05)) == 1.0


def made(roll_error, heading_factor, pitch_sigma=0.05):
    value = np.zeros((10, 6))
    value[:, 3] = roll_error
    sigma = np.array([0.01, 0.01, 0.02, 0.01, pitch_sigma, 0.02])
    covariance = np.tile(np.diag(sigma**2), (10, 1, 1))
    covariance[:, 2, 4] = covariance[:, 4, 2] = 0.5 * 0.02 * pitch_sigma
    stated = np.tile([0.05, 0.05, 0.1], (10, 1))
    correction = Correction(None, None, value, covariance, *[None] * 7, heading_factor, *[None] * 4)
    return covariance, with_shown_pitch(correction, stated).covariance


def test_a_roll_twice_as_bad_as_stated_doubles_the_pitch_alone():
    before, after = made(0.1, 1.0)
    factor = np.sqrt((0.1**2 + 0.01**2) / 0.05**2)
    assert np.sqrt(after[:, 4, 4]) == pytest.approx(factor * 0.05)
    assert after[:, 2, 4] == pytest.approx(factor * before[:, 2, 4])
    others = [0, 1, 2, 3, 5]
    assert (after[:, others][:, :, others] == before[:, others][:, :, others]).all()


def test_what_was_measured_stays():
    before, after = made(0.1, 1.0, pitch_sigma=0.02)
    assert (after == before).all()
    before, after = made(0.0, 5.0)
    assert (after == before).all()


def test_relative_sigma_is_without_what_the_reference_is_off_by():
    drive = simulate(1, crossings=25.0, turn=None)
    made, stated = (adjust_correction(drive.windows, drive.reported, CorrectionSettings(reference_sigma=sigma))
                    for sigma in (0.0, 0.05))
    assert stated.relative_sigma() == pytest.approx(made.relative_sigma(), rel=1e-6)
    assert stated.plan_sigma() ** 2 == pytest.approx(made.plan_sigma() ** 2 + 0.05**2, rel=1e-6)
    assert (made.relative_sigma() < made.plan_sigma()).all() and made.unseen.median < made.unseen.largest


def test_rounded_coordinates_add_to_the_axes_that_are_rounded():
    drive = simulate(1, crossings=25.0, turn=None)
    made, rounded = (adjust_correction(drive.windows, drive.reported, CorrectionSettings(rounding_variance=added))
                     for added in ((0.0, 0.0, 0.0), (0.0, 0.0052, 0.0)))
    difference = (rounded.covariance - made.covariance)[:, :2, :2]
    assert np.allclose(difference, np.diag([0.0, 0.0052]), atol=1e-9)


def test_a_reference_of_little_accuracy_takes_no_patch_its_registration():
    """Its markings fix the place on it as well as ever; the sigma tells the rest."""
    drive = simulate(1, crossings=25.0, turn=None)
    sure, stated = (adjust_correction(drive.windows, drive.reported, CorrectionSettings(reference_sigma=sigma))
                    for sigma in (0.0, 0.5))
    assert (sure.status == REGISTERED).mean() > 0.5
    np.testing.assert_array_equal(stated.status, sure.status)
    assert (stated.plan_sigma() > 0.5).all()
