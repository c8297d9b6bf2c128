"""Latent steps of a chain: their closed forms, whose they are, and what stays unseen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.estimation.chain import NodeChain
from urbanmap_qgis.estimation.error_model import AttitudeError, PoseErrorModel
from urbanmap_qgis.estimation.gauss_markov import GaussMarkovDrift, PathLinks
from urbanmap_qgis.estimation.latent_steps import (
    BLOCK,
    DRIVE,
    REFERENCE,
    UnseenSteps,
    log_odds,
    switched_on,
    unseen_steps,
)
from urbanmap_qgis.estimation.normal_equations import NormalEquations

NODES = np.arange(0.0, 402.0, 2.0)
AT = np.arange(1.0, 400.0, 2.0)
MODEL = PoseErrorModel(GaussMarkovDrift(np.full(6, 2e-3), 40.0, np.full(6, 1.5e-3), np.full(6, 3.0), 1.0, 0.1),
                       AttitudeError(np.full((len(NODES), 3), 0.05), np.full(3, 200.0)))


def chain(change=None, noise=0.02, seed=0):
    """A drive without drift whose markings are off by `change` of the way (m)."""
    off = np.zeros((len(AT), 2)) if change is None else change(AT)[:, None] * np.array([0.6, 0.8])
    place = np.column_stack([off + np.random.default_rng(seed).normal(0.0, noise, off.shape), np.zeros(len(AT))])
    information = np.tile(np.diag([noise**-2.0, noise**-2.0, 100.0]), (len(AT), 1, 1))
    normals = NormalEquations((0, 1, 5), AT, place, np.zeros_like(place), information, np.ones(len(AT), bool), False)
    return NodeChain(normals, NODES, PathLinks.none(len(NODES) - 1))


def equations(*args, **changes):
    made = chain(*args, **changes)
    return made.step_equations(MODEL, np.ones(len(AT)))


def test_the_likelihood_of_a_step_is_that_of_a_chain_that_may_jump_there():
    """Twice the gain of a jump with a standard deviation, against the closed form of gradient and information."""
    made, step = chain(lambda at: 0.3 * (at > 200.0)), 100
    fast = np.zeros(len(NODES) - 1)
    likelihoods = [made.with_fast(np.where(np.arange(len(fast)) == step, sigma, fast)).solve(
        MODEL, np.ones(len(AT)))[2] for sigma in (0.0, 0.4)]
    closed = made.step_equations(MODEL, np.ones(len(AT)))
    assert log_odds(closed.gradient, closed.own, (0.4,), np.inf)[step] == pytest.approx(
        likelihoods[1] - likelihoods[0], rel=1e-3)
    given = closed.given(np.eye(len(fast))[step], 0.4)
    alone = made.with_fast(np.where(np.arange(len(fast)) == step, 0.4, fast))
    both = alone.with_fast(np.where(np.arange(len(fast)) == 150, 0.4, alone.fast)).solve(MODEL, np.ones(len(AT)))[2]
    assert log_odds(given.gradient, given.own, (0.4,), np.inf)[150] == pytest.approx(both - likelihoods[1], abs=1e-2)


def test_a_drive_without_steps_has_none():
    assert switched_on(equations()) == []


@pytest.mark.parametrize(("change", "kind", "first", "last", "noise"), [
    (lambda at: 0.36 * (at > 250.0), REFERENCE, 250.0, 250.0, 0.02),
    (lambda at: 1.5 * np.clip((at - 240.0) / 20.0, 0.0, 1.0), DRIVE, 250.0, 250.0, 0.05),
    (lambda at: 0.12 * ((at > 150.0) & (at < 250.0)), BLOCK, 150.0, 250.0, 0.02),
    (lambda at: 5.0 * ((at > 150.0) & (at < 210.0)), BLOCK, 150.0, 210.0, 0.02)])
def test_whose_a_change_is_shows_in_its_shape(change, kind, first, last, noise):
    made = equations(change, noise=noise)
    step, = switched_on(made)
    assert step.kind == kind
    assert [made.place[step.first], made.place[step.last]] == pytest.approx([first, last], abs=3.0)
    assert step.change == pytest.approx(change(AT).max() * np.array([0.6, 0.8]), abs=3.0 * step.covariance[0, 0]**0.5)
    assert (step.by_reference > 0.95) == (kind != DRIVE)


def test_small_stretches_stay_off_and_in_the_accuracy():
    change = lambda at: 0.05 * ((at > 150.0) & (at < 250.0))  # noqa: E731
    made, calm = equations(change), equations()
    assert switched_on(made) == []
    inside, quiet = (unseen_steps(item, []).variance(np.array([200.0]))[0] for item in (made, calm))
    assert np.trace(inside) > 1.2 * np.trace(quiet)


def test_unseen_steps_count_for_their_surroundings_and_not_for_all_of_a_long_drive():
    place = np.arange(0.0, 8000.0, 4.0)
    none = np.zeros((len(place), 2, 2))
    steps = UnseenSteps(place, np.full(len(place), 0.01), np.broadcast_to(np.diag([0.02, 0.01]), none.shape), none)
    found = steps.variance(np.array([100.0, 2000.0, 6000.0]))
    assert found[1] == pytest.approx(found[2]) and (found[0] < found[1])[0, 0]
    sure = replace(steps, chance=np.where(place == 1000.0, 1e6, steps.chance))
    beside, far = sure.variance(np.array([900.0, 4000.0]))
    assert beside[0, 0] == pytest.approx(0.02, rel=1e-4) and far == pytest.approx(found[2])
