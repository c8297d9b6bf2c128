"""The correction from windows with a known truth: smooth, robust, and as sure as it says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.simulated_windows import shifted, simulate
from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.estimation.block_chain import solve_chain
from urbanmap_qgis.estimation.error_model import AttitudeError
from urbanmap_qgis.estimation.gauss_markov import GaussMarkovDrift, PathLinks
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.patch_corrections import correct_trajectory
from urbanmap_qgis.mobile.registration.correction.patch_status import BRIDGED, DISTRUSTED, REGISTERED
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.records import NO_MARKINGS
from urbanmap_qgis.mobile.registration.trajectory_stops import path_parameters_of


def plan_error(drive, correction):
    return np.hypot(*(correction.value - drive.error)[:, :2].T)


SIMULATED_ATTITUDE = (0.058, 0.058, 0.058)
"""Degrees: standard deviation of the angles' errors of `simulate`, its constant and its drifting part."""


def within_two_sigma(drive, correction):
    """Share of all estimated values within 2 sigma."""
    sigma = correction.sigma()
    active = np.isfinite(sigma).all(axis=0)
    return float((np.abs(correction.value - drive.error)[:, active] < 2 * sigma[:, active]).mean())


def test_chain_equals_the_dense_solution():
    rng = np.random.default_rng(0)
    n, p = 6, 4
    whole = np.zeros((n * p, n * p))
    for k in range(n):
        end = min(k + 2, n) * p
        part = rng.normal(size=(end - k * p, end - k * p))
        whole[k * p:end, k * p:end] += part @ part.T + 0.1 * np.eye(end - k * p)
    right = rng.normal(size=n * p)
    diagonal = np.array([whole[k * p:(k + 1) * p, k * p:(k + 1) * p] for k in range(n)])
    ahead = np.array([whole[k * p:(k + 1) * p, (k + 1) * p:(k + 2) * p] for k in range(n - 1)])
    made, inverse = solve_chain(diagonal, ahead, right.reshape(n, p)), np.linalg.inv(whole)
    assert np.allclose(made.state.ravel(), inverse @ right, atol=1e-10)
    assert np.allclose(made.covariance, [inverse[k * p:(k + 1) * p, k * p:(k + 1) * p] for k in range(n)], atol=1e-10)
    assert made.log_determinant == pytest.approx(np.linalg.slogdet(whole)[1])


def test_drift_is_the_integral_of_a_forgetting_rate():
    """Variance after a distance, from many short steps of an Euler scheme written here."""
    model = GaussMarkovDrift(np.full(6, 0.01), 20.0, np.full(6, 0.002), np.ones(6), 1.0, 0.1)
    transition, precision = model.steps(np.array([0.0, 30.0]), PathLinks.none(1), (0,))
    rng, step, count = np.random.default_rng(1), 0.05, 20000
    rate, error = np.zeros(count), np.zeros(count)
    for _ in range(600):
        error += rate * step + 0.002 * np.sqrt(step) * rng.standard_normal(count)
        rate += -rate / 20.0 * step + 0.01 * np.sqrt(2 * step / 20.0) * rng.standard_normal(count)
    assert np.allclose(np.linalg.inv(precision[0, 0]), np.cov(error, rate), rtol=0.06)
    assert transition[0, 0, 1] == pytest.approx(20.0 * (1 - np.exp(-1.5)))
    stopped = model.steps(np.array([0.0, 30.0]), replace(PathLinks.none(1), stopped=np.array([25.0])), (0, 5))[1]
    grown = np.linalg.inv(stopped[0, 0]) - np.linalg.inv(precision[0, 0])
    assert grown[0, 0] == pytest.approx(0.25, rel=1e-6)  # 0.1 m in the root of a second, 25 s
    assert np.allclose(np.linalg.inv(stopped[0, 1]), np.linalg.inv(precision[0, 0]))  # angles do not mind


@pytest.mark.parametrize("seed", range(3))
def test_sigma_covers_the_error_in_plan(seed):
    drive = simulate(seed, crossings=25.0)
    made = adjust_correction(drive.windows, drive.reported)
    assert plan_error(drive, made).mean() < 0.03 and plan_error(drive, made).max() < 0.12
    assert within_two_sigma(drive, made) >= 0.95
    assert np.median(made.plan_sigma()) < 0.05
    assert (made.status == REGISTERED).mean() > 0.9


def test_sigma_covers_the_error_in_space_with_waits():
    drive = simulate(1, three_d=True, waits={120.0: 40.0, 300.0: 20.0}, crossings=25.0)
    made = adjust_correction(drive.windows, drive.reported, CorrectionSettings(attitude_sigma=SIMULATED_ATTITUDE))
    assert np.linalg.norm((made.value - drive.error)[:, :3], axis=1).mean() < 0.05
    assert np.abs(made.value - drive.error)[:, 2].max() < 0.1
    assert within_two_sigma(drive, made) >= 0.95


def test_no_step_between_patches_and_only_what_was_estimated_changes():
    drive = simulate(2, crossings=25.0)
    corrected = correct_trajectory(drive.reported, adjust_correction(drive.windows, drive.reported))
    move = corrected.place - drive.reported.place
    assert np.abs(np.diff(move[:, :2], axis=0)).max() < 0.005  # in 2 cm of way
    assert np.array_equal(move[:, 2], np.zeros(len(move)))
    assert np.array_equal(corrected.angles[:, :2], drive.reported.angles[:, :2])
    assert np.abs(corrected.place - drive.true.place)[:, :2].max() < 0.15


def test_gap_is_bridged_with_growing_sigma_and_told():
    drive = simulate(0, gaps=((200.0, 300.0),))
    made = adjust_correction(drive.windows, drive.reported)
    middle, inside = np.argmin(np.abs(made.chainage - 250)), (made.chainage > 220) & (made.chainage < 280)
    relative = made.relative_sigma()
    assert relative[middle] > 1.5 * np.median(relative[~inside])
    assert (made.status[inside] != REGISTERED).all()
    assert set(made.reason[inside]) & {"no markings registered around the patch"}
    assert within_two_sigma(drive, made) >= 0.95


@pytest.mark.parametrize(("gap", "registered"), [((200.0, 212.0), True), ((200.0, 225.0), False)])
def test_a_short_gap_between_markings_that_fit_the_drift_is_registered(gap, registered):
    drive = simulate(0, gaps=(gap,), crossings=25.0)
    made = adjust_correction(drive.windows, drive.reported)
    inside = (made.chainage > gap[0] + 1.5) & (made.chainage < gap[1] - 1.5)
    assert (made.status[inside] == REGISTERED).all() == registered
    assert plan_error(drive, made)[inside].max() < 3 * made.plan_sigma()[inside].min()


def test_long_end_without_markings_is_not_to_be_trusted():
    drive = simulate(0, gaps=((150.0, 500.0),), drift_size=0.25)
    made = adjust_correction(drive.windows, drive.reported)
    assert made.status[-1] == DISTRUSTED and made.status[10] == REGISTERED
    assert made.plan_sigma()[-1] > made.plan_sigma()[400] > made.plan_sigma()[200]
    plan = np.abs(made.value - drive.error)[:, :2] < 2 * made.sigma()[:, :2]
    assert plan.mean() >= 0.95


def test_gross_stretch_loses_its_weight():
    drive = simulate(0)
    honest = adjust_correction(drive.windows, drive.reported)
    made = adjust_correction(shifted(drive, 240.0, 260.0, (0.5, 0.3)).windows, drive.reported)
    there = (made.chainage > 242) & (made.chainage < 258)
    assert plan_error(drive, made)[there].max() < plan_error(drive, honest)[there].max() + 0.05
    assert (made.status[there] == BRIDGED).mean() > 0.5


@pytest.mark.slow
@pytest.mark.parametrize(("change", "most"), [({}, 0.3), ({"margin": 1.0, "with_truth": True}, 0.1)])
def test_slip_by_a_dash_is_not_followed(change, most):
    drive = simulate(1)
    made = adjust_correction(shifted(drive, 100.0, 160.0, (5.0, 0.0), **change).windows, drive.reported)
    there = (made.chainage > 100) & (made.chainage < 160)
    assert plan_error(drive, made)[there].max() < most
    assert (made.status[there] != REGISTERED).mean() > 0.8


def test_a_step_that_lasts_is_followed():
    drive, step = simulate(0), np.array([1.2, 0.9])
    made = adjust_correction(shifted(drive, 250.0, 1000.0, step).windows, drive.reported)
    truth = drive.error[:, :2] + np.where(made.chainage >= 250.0, 1.0, 0.0)[:, None] * step
    away = np.abs(made.chainage - 250.0) > 20.0
    off = np.hypot(*(made.value[:, :2] - truth).T)
    assert off[away].max() < 0.15
    assert (off[(made.status == REGISTERED)] < 0.3).all()


@pytest.mark.slow
def test_sure_place_resolves_a_doubt():
    drive = simulate(1, crossings=25.0)
    doubted = shifted(drive, 100.0, 130.0, (0.0, 0.0), margin=1.0)
    modes = doubted.windows.modes.copy()
    modes[:, 1] = modes[:, 0] + [5.0, 0.0]
    made = adjust_correction(replace(doubted.windows, modes=modes), drive.reported)
    assert plan_error(drive, made).max() < 0.1
    assert (made.status == REGISTERED).mean() > 0.9


def test_rigid_windows_count_by_their_share():
    """Without evidence of single patches, windows that share points are not counted as if each were new."""
    drive = simulate(0)
    windows = drive.windows
    nothing = {"information": np.zeros_like(windows.information), "gradient": np.zeros_like(windows.gradient)}
    made = adjust_correction(replace(drive.windows, **nothing), drive.reported)
    assert plan_error(drive, made).mean() < 0.06
    assert within_two_sigma(drive, made) >= 0.9


@pytest.mark.slow
def test_fast_drift_is_noticed():
    made = adjust_correction(simulate(0, drift_length=40.0).windows, simulate(0, drift_length=40.0).reported)
    slow = adjust_correction(simulate(0, drift_length=300.0).windows, simulate(0, drift_length=300.0).reported)
    assert made.drift_factor > slow.drift_factor


def test_nothing_registered_is_refused():
    drive = simulate(0, length=60.0)
    lost = replace(drive.windows, status=np.full(len(drive.windows), NO_MARKINGS, np.int8))
    with pytest.raises(InsufficientDataError, match="No section of the survey could be registered"):
        adjust_correction(lost, drive.reported)


def test_waiting_counts_in_the_clock():
    drive = simulate(0, length=60.0, waits={30.0: 10.0})
    path_parameter = path_parameters_of(drive.reported, 2.0)
    assert path_parameter[-1] == pytest.approx(60.0 + 2.0 * drive.reported.duration, abs=0.5)
    assert (np.diff(path_parameter) > 0).all()
    assert CorrectionSettings().model().time_weight > 0


@pytest.mark.slow
def test_correction_at_the_limit_of_the_search_is_not_to_be_trusted():
    drive = simulate(0, length=100.0)
    largest = np.abs(drive.error[:, :2]).max()
    near = adjust_correction(drive.windows, drive.reported, CorrectionSettings(search=largest + 0.1))
    far = adjust_correction(drive.windows, drive.reported, CorrectionSettings(search=largest + 2.0))
    assert (near.status == DISTRUSTED).all()
    assert set(near.reason) == {"the correction reaches the largest error looked for"}
    assert (far.status != DISTRUSTED).all()


@pytest.mark.slow
def test_gap_and_jump_of_the_trajectory_are_not_to_be_trusted():
    drive = simulate(0, length=200.0)
    since = drive.reported.time
    hole = (since > 10.0) & (since < 13.0)
    gappy = type(drive.reported)(since[~hole], drive.reported.place[~hole], drive.reported.angles[~hole])
    made = adjust_correction(drive.windows, gappy)
    inside = (made.time > 10.1) & (made.time < 12.9)
    assert (made.status[inside] == DISTRUSTED).all() and (made.status[made.time < 8.0] != DISTRUSTED).all()
    place = drive.reported.place + (since > 15.0)[:, None] * np.array([2.0, 0.0, 0.0])
    jump = adjust_correction(drive.windows, type(drive.reported)(since, place, drive.reported.angles))
    assert "the trajectory jumps here" in set(jump.reason[np.abs(jump.time - 15.0) < 1.0])


@pytest.mark.slow
def test_angles_stay_within_the_reported_accuracy():
    """Evidence that contradicts itself does not turn the body by more than its inertial unit may be wrong."""
    drive = simulate(1, three_d=True, crossings=25.0)
    stated = replace(drive.reported, angle_sigma=np.full((len(drive.reported), 3), 0.001))
    made = adjust_correction(drive.windows, stated)
    assert np.abs(made.value[:, 3:]).max() < 0.004
    assert made.sigma()[:, 3:].max() <= 0.0011


@pytest.mark.slow
def test_grossly_wrong_heading_is_found_all_the_same():
    drive = simulate(0, crossings=25.0)
    turned = np.array([0, 0, 0, 0, 0, 2.0])
    windows = replace(drive.windows, angles=drive.windows.angles - turned[3:],
                      linearised=drive.windows.linearised + turned, correction=drive.windows.correction + turned)
    reported = replace(drive.reported, angles=drive.reported.angles - turned[3:])
    made = adjust_correction(windows, reported)
    assert np.abs(made.value[:, 5] - drive.error[:, 5] - 2.0).mean() < 0.05
    assert made.sigma()[:, 5].max() < 0.5


def test_process_of_angles_is_stationary():
    """However many steps it is propagated, its variance stays what is stated: P = F P F' + Q."""
    sigma = np.full((4, 3), 0.05)
    model = AttitudeError(sigma, np.full(3, 200.0))
    still = np.diag(model.start()[0])
    for spacing in (0.5, 2.0, 30.0):
        transition, precision = model.steps(spacing * np.arange(4), np.zeros(3))
        after = transition[0, 0] @ still @ transition[0, 0].T + np.linalg.inv(precision[0, 0])
        np.testing.assert_allclose(np.sqrt(np.diag(after)), np.sqrt(np.diag(still)), rtol=2e-3)
