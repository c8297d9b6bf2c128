"""Drift at a set of tie points: known answers, and the paper's formulas where they are right."""

import numpy as np
import pytest

from urbanmap_qgis.mobile.lines.ground_truths import misfit, rotated_vectors, set_drift, two_pair_drift

PLACE = np.array([[100.0, 200.0], [103.0, 206.0]])
SEEN = np.array([[-8.0, 1.0], [9.0, 5.0]])


def pairs(shift, turn, place=PLACE, seen=SEEN):
    """Reported positions, places in the survey and in the reference, when position and heading are off by so much."""
    return place, place + seen, place + np.array(shift) + rotated_vectors(seen, turn)


@pytest.mark.paper("Z 3.2, eq. 11 to 17")
@pytest.mark.parametrize("turn", [0.01, -0.01, 0.3, -2.0])
def test_two_pairs_give_shift_and_turn_with_its_sign(turn):
    """Eq. 15's arc cosine would give the same for both signs."""
    shift, found = two_pair_drift(*pairs([1.5, -0.7], turn))
    np.testing.assert_allclose([*shift, found], [1.5, -0.7, turn], atol=1e-10)
    drift = set_drift(*pairs([1.5, -0.7], turn), sigma=0.1)
    np.testing.assert_allclose([*drift.shift, drift.rotation], [1.5, -0.7, turn], atol=1e-10)
    np.testing.assert_allclose(drift.residuals, 0, atol=1e-10)


@pytest.mark.paper("Z 3.2, eq. 11 to 17")
def test_equations_15_to_17_as_printed_where_the_turn_is_positive():
    """Eq. 16 and 17 with the places in the vehicle's axes, kappa_1 = 0.4."""
    place, measured, reference = pairs([1.5, -0.7], 0.02)
    v, v_true, v_o = measured[1] - measured[0], reference[1] - reference[0], place[1] - place[0]
    unit = [(w - v_o) / np.hypot(*(w - v_o)) for w in (v_true, v)]
    dkappa = np.arccos(unit[0] @ unit[1])
    kappa = 0.4
    px, py = rotated_vectors(measured[0] - place[0], -kappa)
    dx = reference[0, 0] - place[0, 0] - px * np.cos(kappa + dkappa) + py * np.sin(kappa + dkappa)
    dy = reference[0, 1] - place[0, 1] - px * np.sin(kappa + dkappa) - py * np.cos(kappa + dkappa)
    shift, turn = two_pair_drift(place, measured, reference)
    np.testing.assert_allclose([dx, dy, dkappa], [*shift, turn], atol=1e-9)


def test_more_pairs_are_least_squares():
    """Against a general minimiser, with noise."""
    from scipy.optimize import least_squares

    rng = np.random.default_rng(1)
    place, seen = rng.normal(0, 5, (6, 2)) + 1000, rng.normal(0, 10, (6, 2))
    place, measured, reference = pairs([0.4, 0.9], 0.03, place, seen)
    reference = reference + rng.normal(0, 0.1, reference.shape)

    def left(p):
        return (reference - place - p[:2] - rotated_vectors(seen, p[2])).ravel()

    best = least_squares(left, [0, 0, 0.0], xtol=1e-14, ftol=1e-14, gtol=1e-14)
    drift = set_drift(place, measured, reference, 0.1)
    np.testing.assert_allclose([*drift.shift, drift.rotation], best.x, atol=1e-6)
    np.testing.assert_allclose(drift.covariance, 0.01 * np.linalg.inv(best.jac.T @ best.jac), rtol=1e-2, atol=1e-8)
    np.testing.assert_allclose(drift.residuals.ravel(), left(best.x), atol=1e-6)


def test_covariance_is_what_repetition_shows():
    rng = np.random.default_rng(2)
    place, measured, reference = pairs([0.4, 0.9], 0.03)
    found = []
    for _ in range(4000):
        drift = set_drift(place, measured, reference + rng.normal(0, 0.05, (2, 2)), 0.05)
        found.append([*drift.shift, drift.rotation])
    np.testing.assert_allclose(np.cov(np.array(found).T), drift.covariance, rtol=0.12, atol=2e-5)


def test_what_is_expected_of_the_heading_holds_pairs_that_lie_together():
    place, measured, reference = pairs([1.0, 0.0], 0.0, seen=np.array([[-8.0, 1.0], [-8.0, 1.2]]))
    reference[1, 0] += 0.1
    free, held = (set_drift(place, measured, reference, 0.05, sigma).rotation for sigma in (np.inf, np.radians(1.0)))
    assert abs(free) > 0.4 and abs(held) < np.radians(1.0)
    single = set_drift(place[:1], measured[:1], reference[:1], 0.05, np.radians(1.0))
    assert single.rotation == 0 and single.covariance[2, 2] == pytest.approx(np.radians(1.0) ** 2)
    np.testing.assert_allclose(single.shift, [1.0, 0.0])


def test_misfit_is_the_difference_of_lengths_or_the_distance_from_the_others():
    place, measured, reference = pairs([1.0, 2.0], 0.1)
    np.testing.assert_allclose(misfit(place, measured, reference), 0, atol=1e-9)
    along = rotated_vectors(SEEN[1] - SEEN[0], 0.1)
    reference[1] += 0.7 * along / np.hypot(*along)
    np.testing.assert_allclose(misfit(place, measured, reference), 0.7, atol=1e-9)
    rng = np.random.default_rng(3)
    place, measured, reference = pairs([1.0, 2.0], 0.1, np.zeros((5, 2)), rng.normal(0, 10, (5, 2)))
    reference[3] += [3.0, 4.0]
    away = misfit(place, measured, reference)
    assert away.argmax() == 3 and away[3] == pytest.approx(5.0)
    assert misfit(place[:1], measured[:1], reference[:1]).tolist() == [0]
