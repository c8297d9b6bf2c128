"""The drift of all tie points against full covariance matrices, repetition, and what simulated walks show."""


import numpy as np
import pytest

from urbanmap_qgis.mobile.lines.drift_adjustment import (
    RandomWalk,
    TiePairs,
    fit_drift,
    leave_one_out_misfits,
    misfit_of_excluded,
)
from urbanmap_qgis.mobile.lines.ground_truths import rotated_vectors
from urbanmap_qgis.mobile.trajectory import Trajectory


def course(seconds=600.0, speed=6.0, step=0.2):
    time = np.arange(0.0, seconds + step / 2, step)
    heading = 60 * np.sin(time / 40)
    way = speed * step * np.column_stack([np.sin(np.radians(heading)), np.cos(np.radians(heading)), 0 * time])
    return Trajectory(time, np.cumsum(way, axis=0), np.column_stack([0 * time, 0 * time, heading]))


def walked(trajectory, walk, rng):
    """A drift (n, 3) that walks as told."""
    step = np.diff(trajectory.time)[:, None]
    noise = rng.normal(size=(len(step), 3)) * np.sqrt(step) * [walk.position_walk, walk.position_walk,
                                                               walk.heading_walk]
    turn = rng.normal(0, walk.heading_sigma) + np.concatenate([[0.0], np.cumsum(noise[:, 2])])
    way = np.diff(trajectory.place[:, :2], axis=0)
    aside = turn[:-1, None] * np.column_stack([-way[:, 1], way[:, 0]]) * walk.coupled
    shift = rng.normal(0, 2, 2) + np.vstack([[0, 0], np.cumsum(noise[:, :2] + aside, axis=0)])
    return np.column_stack([shift, turn])


def observed(trajectory, drift, walk, rng, sets=12, margin=20.0):
    """Two pairs a set, a second apart."""
    start = np.linspace(margin, trajectory.time[-1] - margin, sets)
    time = np.column_stack([start, start + rng.uniform(0.5, 2.0, sets)]).ravel()
    seen = np.tile([[-8.0, 1.0], [9.0, 6.0]], (sets, 1)) + rng.normal(0, 2, (2 * sets, 2))
    at = np.column_stack([np.interp(time, trajectory.time, column) for column in drift.T])
    true = at[:, :2] + rotated_vectors(seen, at[:, 2]) + rng.normal(0, walk.sigma, seen.shape)
    return TiePairs(seen, true, time, np.repeat(np.arange(sets), 2))


def model_of(pairs, trajectory, walk):
    """The model with the walk as it is: estimation is switched off by an impossible number of rounds."""
    import urbanmap_qgis.mobile.lines.drift_adjustment as module

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_most_likely", lambda system, given, fixed: (walk, 0.0, np.zeros(2)))
        return fit_drift(pairs, trajectory, walk)


@pytest.mark.parametrize("coupled", [False, True])
def test_values_and_variances_are_those_of_the_full_covariance(coupled):
    """Best linear estimate with the covariance of a finely stepped walk, at times between and outside the sets."""
    rng = np.random.default_rng(1)
    trajectory = course(60.0)
    walk = RandomWalk(0.05, np.radians(0.02), 0.03, np.radians(0.5), coupled)
    pairs = observed(trajectory, walked(trajectory, walk, rng), walk, rng, sets=4, margin=8.0)
    model = model_of(pairs, trajectory, walk)
    time = np.unique(np.concatenate([np.arange(0, 60.01, 0.25), pairs.time]))
    place = np.column_stack([np.interp(time, trajectory.time, axis) for axis in trajectory.place[:, :2].T])
    way = np.diff(place, axis=0)
    covariance = np.zeros((len(time), 3, len(time), 3))
    state = np.diag([1e3, 1e3, walk.heading_sigma**2])
    covariance[0, :, 0] = state
    for k, (de, dn) in enumerate(way):
        f = np.array([[1, 0, -dn * coupled], [0, 1, de * coupled], [0, 0, 1]])
        covariance[k + 1, :, :k + 1] = np.einsum("ij,jkl->ikl", f, covariance[k, :, :k + 1])
        covariance[:k + 1, :, k + 1] = covariance[k + 1, :, :k + 1].transpose(1, 2, 0)
        step = time[k + 1] - time[k]
        state = f @ state @ f.T + step * np.diag([walk.position_walk**2, walk.position_walk**2, walk.heading_walk**2])
        covariance[k + 1, :, k + 1] = state
    turn = model.interpolate(pairs.time)[:, 2]
    lever = rotated_vectors(pairs.seen, turn + np.pi / 2)
    design = np.zeros((2 * len(turn), len(time), 3))
    for row, node in enumerate(np.searchsorted(time, pairs.time)):
        design[2 * row:2 * row + 2, node] = [[1, 0, lever[row, 0]], [0, 1, lever[row, 1]]]
    design = design.reshape(2 * len(turn), -1)
    whole = covariance.reshape(3 * len(time), -1)
    gain = whole @ design.T @ np.linalg.inv(design @ whole @ design.T + walk.sigma**2 * np.eye(len(design)))
    linear = (pairs.true - rotated_vectors(pairs.seen, turn) + lever * turn[:, None]).ravel()
    value = (gain @ linear).reshape(-1, 3)
    variance = np.diag(whole - gain @ design @ whole).reshape(-1, 3)
    np.testing.assert_allclose(model.interpolate(time), value, atol=2e-3)
    np.testing.assert_allclose(np.sqrt(model.variances(time)), np.sqrt(variance), rtol=0.02, atol=1e-4)


@pytest.mark.slow
def test_sigma_bridges_between_sets_and_grows_outside():
    rng = np.random.default_rng(2)
    trajectory, walk = course(), RandomWalk()
    model = fit_drift(observed(trajectory, walked(trajectory, walk, rng), walk, rng, sets=6, margin=100.0), trajectory,
                      RandomWalk())
    sigma = np.sqrt(model.variances(trajectory.time)[:, 0])
    at = np.interp([100.0, 140.0, 180.0, 0.0, 600.0], trajectory.time, sigma)
    assert at[1] > 2 * at[0] and at[1] > 2 * at[2]
    assert at[3] == pytest.approx(np.hypot(at[0], model.walk.position_walk * 10.0), rel=0.1)
    assert at[4] > at[0]


@pytest.mark.slow
@pytest.mark.parametrize("coupled", [False, True])
def test_walk_and_sigma_are_found_and_errors_are_as_large_as_said(coupled):
    rng = np.random.default_rng(3)
    trajectory = course(1500.0, step=0.5)
    walk = RandomWalk(0.03, np.radians(0.005), 0.02, np.radians(0.3), coupled)
    ratios, paces, told = [], [], []
    for _ in range(5):
        drift = walked(trajectory, walk, rng)
        model = fit_drift(observed(trajectory, drift, walk, rng, sets=25), trajectory, RandomWalk())
        error = model.interpolate(trajectory.time) - drift
        ratios.append(np.mean(error**2 / model.variances(trajectory.time), axis=0))
        paces.append([model.walk.position_walk, model.walk.sigma])
        told.append(model.walk.coupled)
    assert all(found == coupled for found in told)
    np.testing.assert_allclose(np.mean(paces, axis=0), [walk.position_walk, walk.sigma], rtol=0.35)
    assert np.all(np.sqrt(np.mean(ratios, axis=0)) < 1.5) and np.all(np.sqrt(np.mean(ratios, axis=0)) > 0.5)


@pytest.mark.slow
@pytest.mark.parametrize("coupled", [False, True])
def test_predicted_misfits_are_those_of_refits_without_the_set(coupled):
    rng = np.random.default_rng(4)
    trajectory, walk = course(), RandomWalk(0.05, np.radians(0.01), 0.03, np.radians(0.5), coupled)
    pairs = observed(trajectory, walked(trajectory, walk, rng), walk, rng, sets=8)
    away, sigmas = leave_one_out_misfits(pairs, model_of(pairs, trajectory, walk))
    for number in range(8):
        own = pairs.sets == number
        rest, left = (TiePairs(pairs.seen[rows], pairs.true[rows], pairs.time[rows], pairs.sets[rows])
                      for rows in (~own, own))
        distance, in_sigmas = misfit_of_excluded(left, model_of(rest, trajectory, walk))
        assert away[number] == pytest.approx(distance, rel=0.02, abs=2e-3)
        assert sigmas[number] == pytest.approx(in_sigmas, rel=0.05, abs=0.02)


def test_one_set_holds_and_tells_no_prediction():
    rng = np.random.default_rng(5)
    trajectory, walk = course(), RandomWalk()
    pairs = observed(trajectory, np.tile([1.0, -2.0, 0.001], (len(trajectory), 1)), walk, rng, sets=1, margin=300.0)
    model = fit_drift(pairs, trajectory, walk)
    np.testing.assert_allclose(model.interpolate(np.array([0.0, 600.0]))[:, :2], [[1.0, -2.0]] * 2, atol=0.15)
    assert np.isnan(leave_one_out_misfits(pairs, model)[0]).all()
