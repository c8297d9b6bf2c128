"""Covariances of some of the evidence are, to the last digit, those of that evidence alone."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.localisation.evidence.information import Evidence, SharedError, covariance, covariances_of_parts
from urbanmap_qgis.localisation.evidence.symmetric_systems import solved

PLACES = 23


def evidence(rows):
    """Rows of 23 places in no order, with walls that several of them share."""
    rng = np.random.default_rng(11)
    of, row = rng.integers(0, PLACES, 900), rng.normal(size=(900, 3)) * [1.0, 1.0, 20.0]
    weight, noise = rng.uniform(1.0, 900.0, 900), rng.uniform(0.01, 0.3, 900)
    group, factor = rng.integers(-1, 40, 900), rng.uniform(-1, 1, 900)
    shared = [SharedError(group[rows], factor[rows], np.full(len(group[rows]), 0.2))]
    return Evidence(of[rows], row[rows], weight[rows], noise[rows], shared)


def by_hand(given, place, prior):
    """H^-1 (sum u^2 s^2 a a^T + sum_g s_g^2 b_g b_g^T + P) H^-1 of one place."""
    mine = given.of == place
    a, u, s = given.row[mine], given.weight[mine], given.noise[mine]
    h, middle = prior + (a.T * u) @ a, prior + (a.T * (u * s) ** 2) @ a
    error = given.shared[0]
    for number in np.unique(error.group[mine & (error.group >= 0)]):
        of_group = mine & (error.group == number)
        b = (given.weight * error.factor)[of_group] @ given.row[of_group]
        middle = middle + 0.2**2 * np.outer(b, b)
    return np.linalg.inv(h) @ middle @ np.linalg.inv(h)


@pytest.mark.parametrize("share", [0.0, 0.2, 0.7, 1.0])
def test_a_part_is_what_its_rows_alone_give(share):
    whole, prior = evidence(slice(None)), np.diag([1.0, 1.0, 0.1])
    mask = np.random.default_rng(3).random(900) < share
    part, = covariances_of_parts(whole, [mask.astype(float)], PLACES, prior)
    alone = evidence(mask)
    assert np.array_equal(part, covariance(alone, PLACES, prior))
    for place in range(PLACES):
        assert part[place] == pytest.approx(by_hand(alone, place, prior), rel=1e-9, abs=1e-15)


def test_a_share_of_a_row_is_a_row_of_fewer_measurements():
    whole, prior = evidence(slice(None)), np.diag([1.0, 1.0, 0.1])
    share = np.random.default_rng(4).uniform(0.1, 1.0, 900)
    part, = covariances_of_parts(whole, [share], PLACES, prior)
    fewer = Evidence(whole.of, whole.row, whole.weight * share, whole.noise / np.sqrt(share), whole.shared)
    assert part == pytest.approx(covariance(fewer, PLACES, prior), rel=1e-9, abs=1e-15)


def test_small_systems_are_solved_as_the_library_does():
    rng = np.random.default_rng(5)
    root = rng.normal(size=(400, 3, 3)) * [1.0, 30.0, 900.0]
    matrix, right = root @ np.swapaxes(root, 1, 2) + np.diag([1.0, 1.0, 800.0]), rng.normal(size=(400, 3))
    upper = np.stack([matrix[:, i, j] for i in range(3) for j in range(i, 3)])
    expected = np.linalg.solve(matrix, right[..., None])[..., 0]
    assert np.allclose(solved(upper, right.T).T, expected, rtol=1e-6, atol=1e-9)
