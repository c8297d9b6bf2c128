"""The network of several drives against dense least squares and known drifts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.estimation.gauss_markov import GaussMarkovDrift, PathLinks
from urbanmap_qgis.mobile.adjustment.drive_drift import DriveNodes
from urbanmap_qgis.mobile.adjustment.network import (
    CONTROL,
    NONE,
    TIE,
    NetworkObservations,
    NetworkSettings,
    adjust_network,
)

MODEL = GaussMarkovDrift(np.full(6, 2e-3), 40.0, np.full(6, 1.5e-3), np.full(6, 3.0), 1.0, 0.1)
SETTINGS = NetworkSettings(MODEL)


def nodes(length: float, spacing: float = 5.0) -> DriveNodes:
    parameter = np.arange(0.0, length + spacing, spacing)
    return DriveNodes(parameter, PathLinks.none(len(parameter) - 1))


def rows(drive, parameter, other, other_parameter, value, sigma, kind) -> NetworkObservations:
    n, none = len(parameter), np.zeros((len(parameter), 2))
    value = np.column_stack([np.asarray(value, float), np.full(n, np.nan)])
    return NetworkObservations(np.full(n, drive), np.asarray(parameter, float), none, np.full(n, other),
                        np.asarray(other_parameter, float), none, value, np.tile(np.eye(4) * sigma**2, (n, 1, 1)),
                        np.full(n, kind))


def drift(parameter, seed):
    """A smooth error of about a metre, east, north, up."""
    phase = np.random.default_rng(seed).uniform(0, 6, 3)
    return np.stack([np.sin(parameter / 120 + phase[0]), 0.8 * np.cos(parameter / 150 + phase[1]),
                     0.5 * np.sin(parameter / 200 + phase[2])], axis=1)


def two_drives(seed=0, sigma=0.01, control=()):
    """Two drives of one street in opposite directions, tied every 10 m; control points on the first."""
    random = np.random.default_rng(seed)
    parameter = np.arange(5.0, 400.0, 10.0)
    true = [drift(np.arange(0, 405.0, 5.0), 1), drift(np.arange(0, 405.0, 5.0), 2)]
    at = [lambda c: drift(c, 1), lambda c: drift(c, 2)]
    value = at[0](parameter) - at[1](400.0 - parameter) + random.normal(0, sigma, (len(parameter), 3))
    parts = [rows(0, parameter, 1, 400.0 - parameter, value, sigma, TIE)]
    if len(control):
        here = np.asarray(control, float)
        parts.append(rows(0, here, NONE, np.zeros(len(here)), at[0](here) + random.normal(0, 0.02, (len(here), 3)),
                          0.02, CONTROL))
    return [nodes(400.0), nodes(400.0)], NetworkObservations.joined(parts), true


def test_drives_agree_and_the_place_is_only_relative():
    drives, observations, true = two_drives()
    made = adjust_network(drives, observations, SETTINGS)
    first, second = made.state[0][:, :3, 0], made.state[1][::-1, :3, 0]
    apart = (first - second) - (true[0] - true[1][::-1])
    assert np.abs(apart[1:-1]).max() < 0.03
    # Nothing says where both are: half of each drive's own uncertainty is left.
    assert np.sqrt(made.covariance[0][40, 0, 0]) == pytest.approx(3.0 / np.sqrt(2), rel=0.15)


def test_control_points_place_both_drives():
    drives, observations, true = two_drives(control=(20.0, 110.0, 200.0, 290.0, 380.0))
    made = adjust_network(drives, observations, SETTINGS)
    for state, covariance, truth in zip(made.state, made.covariance, true):
        error = state[:, :3, 0] - truth
        sigma = np.sqrt(np.einsum("nii->ni", covariance))[:, :3]
        assert np.hypot(error[:, 0], error[:, 1]).mean() < 0.15
        assert (np.abs(error) < 2.5 * sigma).mean() > 0.9


def test_a_gross_tie_loses_its_weight():
    drives, observations, _ = two_drives(control=(20.0, 200.0, 380.0))
    clean = adjust_network(drives, observations, SETTINGS)
    value = observations.value.copy()
    value[13, :3] += (2.0, -1.0, 0.0)
    made = adjust_network(drives, replace(observations, value=value), SETTINGS)
    assert made.weight[13] < 0.01
    assert np.abs(made.state[1][:, :, 0] - clean.state[1][:, :, 0]).max() < 0.03


def test_heights_that_are_not_observed_stay_free():
    drives, observations, _ = two_drives(control=(200.0,))
    value = observations.value.copy()
    value[:, 2] = np.nan
    made = adjust_network(drives, replace(observations, value=value), SETTINGS)
    assert np.abs(made.state[0][:, 2, 0]).max() < 1e-9
    assert np.sqrt(made.covariance[0][0, 2, 2]) > 2.9
    assert np.isnan(made.residual[:, 2]).all() and np.isfinite(made.residual[:, :2]).all()


def test_against_dense_normal_equations():
    """One drive, three nodes, one control point: the sparse solution is that of the dense one written out."""
    drive = nodes(10.0)
    seen = rows(0, [5.0], NONE, [0.0], [[1.0, -2.0, 0.5]], 0.1, CONTROL)
    made = adjust_network([drive], seen, NetworkSettings(MODEL))
    model = MODEL.scaled(made.drift_factor)
    transition, precision = model.steps(drive.parameter, drive.links, (0,))
    dense = np.zeros((6, 6))
    for i in range(2):
        step = np.zeros((2, 6))
        step[:, 2 * i:2 * i + 2], step[:, 2 * i + 2:2 * i + 4] = -transition[i], np.eye(2)
        dense += step.T @ precision[i, 0] @ step
    dense[0, 0] += model.initial_sigma[0] ** -2
    dense[1, 1] += model.rate_sigma[0] ** -2
    dense[2, 2] += 100.0 * made.weight[0] / made.noise_factor
    right = np.zeros(6)
    right[2] = 100.0 * made.weight[0] / made.noise_factor
    expected = np.linalg.solve(dense, right)
    assert made.state[0][:, 0, 0] == pytest.approx(expected[::2], abs=1e-4)
    assert made.covariance[0][1, 0, 0] == pytest.approx(np.linalg.inv(dense)[2, 2], rel=1e-3)


def test_a_control_point_beside_the_path_tells_of_the_heading():
    """Two points 10 m to the right and left of a northbound vehicle: their difference is the heading's error."""
    drive, heading = nodes(20.0), np.radians(0.05)
    place = np.array([[0.2, 0.1, 0.0], [0.2, 0.1, 0.0]])
    arm = np.array([[10.0, 0.0], [-10.0, 0.0]])
    place[:, 1] -= heading * arm[:, 0]
    seen = replace(rows(0, [10.0, 10.0], NONE, [0.0, 0.0], place, 1e-4, CONTROL), arm=arm)
    made = adjust_network([drive], seen, SETTINGS)
    assert made.state[0][2, :, 0] == pytest.approx([0.2, 0.1, 0.0, 0.05], abs=1e-3)


def test_a_drive_that_drifts_more_than_the_others_is_less_sure_between_its_control_points():
    """Three drives of 2 mm a metre and one of 6: the others stay as sure as without it."""
    at = np.setdiff1d(np.arange(0.0, 401.0, 10.0), np.arange(180.0, 221.0, 10.0))
    steps = np.random.default_rng(7).normal(0.0, 0.02, (4, 41, 3)).cumsum(axis=1)
    steps[3, :, :2] *= 3.0
    seen = [rows(number, at, NONE, 0.0 * at, steps[number][(at / 10.0).astype(int)], 0.02, CONTROL)
            for number in range(4)]
    made = adjust_network([nodes(400.0)] * 4, NetworkObservations.joined(seen), SETTINGS)
    still = adjust_network([nodes(400.0)] * 3, NetworkObservations.joined(seen[:3]), SETTINGS)
    gap = [[np.sqrt(np.trace(covariance[40, :2, :2])) for covariance in one.covariance] for one in (made, still)]
    assert gap[0][3] > 1.3 * max(gap[0][:3]) and gap[0][:3] == pytest.approx(gap[1], rel=0.05)


def test_a_jump_of_the_trajectory_lets_the_error_jump_by_as_much():
    """The covariance of a step grows by the square of the jump, of the fast drift, and by the walk while it stands."""
    model = GaussMarkovDrift(np.full(6, 0.01), 20.0, np.full(6, 0.002), np.ones(6), 1.0, 0.1)
    path = np.array([0.0, 5.0, 10.0, 15.0, 20.0])
    jump, stopped, fast = np.array([0.0, 3.0, 0.0, 0.0]), np.array([0.0, 0, 4.0, 0]), np.array([0.0, 0, 0, 5.0])
    _, precision = model.steps(path, replace(PathLinks.none(4), stopped=stopped, jump=jump), (0, 3), fast)
    variance = np.linalg.inv(precision)[:, :, 0, 0]
    assert variance[:, 0] - variance[0, 0] == pytest.approx([0.0, 9.0, 4.0 * 0.1**2, 25.0], rel=1e-6, abs=1e-9)
    assert variance[:, 1] - variance[0, 1] == pytest.approx([0.0, 9.0, 0.0, 0.0], rel=1e-6, abs=1e-9)
