"""Steps in the error of a trajectory (a GNSS re-fix): told from drift and from shifts that go back, and followed."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.correction.disagreements import NodeStep
from urbanmap_qgis.mobile.registration.correction.error_steps import LIMITS, UnseenSteps, short_gaps, window_steps
from urbanmap_qgis.mobile.registration.start.fast_drift import fast_drift_rate
from urbanmap_qgis.mobile.trajectory import Trajectory

CHAINAGE = np.arange(0.0, 300.0, 0.5)


def error_of(steps, drift=0.002):
    """East and north errors (n, 2): drift, and steps (from m, to m, size m)."""
    east = drift * CHAINAGE
    for start, end, size in steps:
        east = east + size * np.clip((CHAINAGE - start) / (end - start), 0, 1)
    return np.column_stack([east, 0.3 - 0.5 * east])


@pytest.mark.parametrize(("size", "length"), [(1.0, 20.0), (3.0, 20.0), (3.0, 60.0)])
def test_rate_of_a_step(size, length):
    start = 150.0 - 0.5 * length
    rate = fast_drift_rate(CHAINAGE, error_of([(start, start + length, size)]))
    expected = np.hypot(1.0, 0.5) * (size / length + 0.002)
    assert rate[CHAINAGE == 150.0] == pytest.approx(expected, rel=0.02)
    assert not rate[np.abs(CHAINAGE - 150.0) > 0.5 * length + 10].any()


def test_drift_is_no_step_nor_is_a_shift_that_goes_back():
    assert not fast_drift_rate(CHAINAGE, error_of([], drift=0.01)).any()
    assert not fast_drift_rate(CHAINAGE, error_of([(100.0, 101.0, 5.0), (150.0, 151.0, -5.0)])).any()


class _Windows:
    def __init__(self, shift, margin=np.inf):
        n = len(shift)
        self.chainage, self.usable, self.margin = CHAINAGE, np.ones(n, bool), np.full(n, margin)
        self.linearised = np.column_stack([shift, np.zeros((n, 4))])
        self.information = np.broadcast_to(np.eye(6), (n, 6, 6))
        self.time = 0.1 * CHAINAGE  # 10 m/s


def driven(shift):
    """The trajectory as reported with an error, eastwards at 10 m/s."""
    place = np.column_stack([CHAINAGE - shift[:, 0], -shift[:, 1], 0.0 * CHAINAGE])
    return Trajectory(0.1 * CHAINAGE, place, np.tile([0.0, 0.0, 90.0], (len(CHAINAGE), 1)))


def test_steps_of_the_windows_and_none_of_doubtful_ones():
    nodes, shift = np.arange(0.0, 300.0, 2.0), error_of([(140.0, 160.0, 2.0)])
    steps = window_steps(_Windows(shift), nodes, 3.0, driven(shift))[0]
    inside = (nodes[1:] > 140) & (nodes[:-1] < 160)
    assert steps[inside].sum() == pytest.approx(2.0 * np.hypot(1, 0.5), rel=0.25)
    assert not window_steps(_Windows(shift, margin=1.0), nodes, 3.0, driven(shift))[0].any()


def test_a_step_in_height_is_told_apart_from_one_in_plan():
    nodes, drift = np.arange(0.0, 300.0, 2.0), error_of([])
    windows = _Windows(drift)
    windows.linearised[:, 2] = 0.001 * CHAINAGE + 0.5 * np.clip((CHAINAGE - 140.0) / 20.0, 0.0, 1.0)
    plan, up = window_steps(windows, nodes, 3.0, driven(drift))
    inside = (nodes[1:] > 140) & (nodes[:-1] < 160)
    assert not plan.any() and not up[np.abs(nodes[:-1] - 150.0) > 25.0].any()
    assert up[inside].sum() == pytest.approx(0.52 * np.sqrt(2.0), rel=0.25)  # nodes of 2 m, changes alike over 4 m
    windows.linearised[:, 2] = np.nan  # in plan alone
    assert not np.any(window_steps(windows, nodes, 3.0, driven(drift))[1])


def test_what_the_trajectory_wanders_while_the_vehicle_stands_is_no_step():
    shift = error_of([(150.0, 150.5, 0.8)])
    moving = driven(shift)
    waits = np.searchsorted(CHAINAGE, 150.5)  # between two epochs it stands for a minute
    place = moving.place.copy()
    place[waits:, 0] -= 0.5  # the vehicle does not drive in it
    moving = Trajectory(moving.time, place, moving.angles)
    time = moving.time + 60.0 * (np.arange(len(CHAINAGE)) >= waits)
    windows, trajectory = _Windows(shift), Trajectory(time, moving.place, moving.angles)
    windows.time = time
    nodes = np.arange(0.0, 300.0, 2.0)
    assert window_steps(windows, nodes, 3.0, moving)[0].any()
    assert not window_steps(windows, nodes, 3.0, trajectory)[0].any()


def test_a_short_gap_holds_what_the_correction_changes_in_it_but_for_the_wandering_of_a_stop():
    nodes, at = np.arange(0.0, 102.0, 2.0), np.array([30.0, 45.0, 75.0])
    state, stops = np.zeros((len(nodes), 6, 2)), np.zeros((len(nodes) - 1, 6))
    state[nodes > 45.0, 0, 0] = 0.3
    chain, fit = SimpleNamespace(nodes=nodes, stop_changes=lambda: stops), SimpleNamespace(state=state)
    known = NodeStep(22, np.zeros(2), 1e-4 * np.eye(2), 0.0)
    short, variance = short_gaps(chain, fit, [(40.0, 52.0, known), (60.0, 90.0, known)], at)
    assert short.tolist() == [False, True, False]  # the second is long enough for a re-fix to hide
    assert np.sqrt(variance[1, 0, 0]) == pytest.approx(0.3 * np.sqrt(0.5), rel=0.01) and not variance[[0, 2]].any()
    assert np.sqrt(variance[1, 1, 1]) < 0.001
    stops[22, 0] = 0.3
    assert short_gaps(chain, fit, [(40.0, 52.0, known)], at)[1].max() < 1e-5
    likely = NodeStep(22, np.array([0.2, 0.0]), 0.06**2 * np.eye(2), (0.2 / 0.06) ** 2)
    assert 0.05 < np.sqrt(short_gaps(chain, fit, [(40.0, 52.0, likely)], at)[1].max()) < 0.15


def test_unseen_steps_count_for_their_surroundings_and_not_for_all_of_a_long_drive():
    place = np.arange(0.0, 8000.0, 4.0)
    chance = np.full(len(place), 0.01)
    expected = np.broadcast_to(np.diag([0.02, 0.01]), (len(place), 2, 2))
    at = np.array([100.0, 2000.0, 6000.0])
    found = UnseenSteps(place, chance, expected).variance(at)
    for here, variance in zip(at, found):
        near = (place >= here - LIMITS.between_changes) & (place < here + LIMITS.between_changes)
        share = chance[near].sum() / (1.0 + chance[near].sum())
        assert np.allclose(variance, share * expected[0], atol=1e-9)
    alone = UnseenSteps(place[:250], chance[:250], expected[:250]).variance(at[:1])
    assert found[0, 0, 0] < 1.3 * alone[0, 0, 0]
    sure = np.where(place == 1000.0, 1e6, chance)
    beside, far = UnseenSteps(place, sure, expected).variance(np.array([900.0, 4000.0]))
    assert beside[0, 0] == pytest.approx(0.02, rel=1e-4) and np.allclose(far, found[1])


def test_without_places_of_unseen_steps_nothing_is_added():
    none = UnseenSteps(np.zeros(0), np.zeros(0), np.zeros((0, 2, 2)))
    response = np.broadcast_to(np.eye(2), (3, 2, 2))
    assert not none.followed(response, np.array([0.0, 10.0, 900.0])).any()
