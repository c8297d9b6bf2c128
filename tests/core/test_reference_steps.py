"""Whose a step is: of one drive, of the other one, or of the reference that both are laid on."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core.test_network import drift as fast_drift
from tests.core.test_network import rows
from urbanmap_qgis.mobile.adjustment.network import CONTROL, NONE, REFERENCE, TIE, NetworkObservations
from urbanmap_qgis.mobile.adjustment.reference_steps import reference_steps, undisputed
from urbanmap_qgis.mobile.adjustment.steps import observed_steps

AT = np.arange(5.0, 400.0, 10.0)
STEP = np.array([0.6, -0.8, 0.0])


def drift(parameter, seed):
    """As real trajectories drift: 2 mm a metre."""
    return 0.25 * fast_drift(parameter, seed)


def seen(first=0.0, second=0.0, reference=0.0, place=200.0, back=None):
    """Two drives in opposite directions whose own errors, or the reference, step by so many times STEP at a place."""
    random = np.random.default_rng(5)

    def stepped(at, size):
        inside = (at > place) & (at < (np.inf if back is None else back))
        return size * inside[:, None] * STEP

    def noise():
        return random.normal(0, 0.01, (len(AT), 3))

    one, two = drift(AT, 1) + stepped(AT, first), drift(400.0 - AT, 2) + stepped(AT, second)
    moved, none = stepped(AT, reference), np.zeros(len(AT))
    return NetworkObservations.joined([
        rows(0, AT, 1, 400.0 - AT, one - two + noise(), 0.01, TIE),
        rows(0, AT, NONE, none, one + moved + noise(), 0.01, REFERENCE),
        rows(1, 400.0 - AT, NONE, none, two + moved + noise(), 0.01, REFERENCE)])


def steps_of(observations):
    return reference_steps(observations, observations.parameter, observations.other_parameter)


def test_a_step_that_both_drives_show_is_the_references():
    observations = seen(reference=1.0)
    found = steps_of(observations)
    assert [step.drive for step in found] == [0, 1]
    assert [step.chainage for step in found] == pytest.approx([200.0, 200.0], abs=15.0)
    for step, sign in zip(found, (1.0, -1.0)):  # the second drive comes the other way
        assert step.change == pytest.approx(sign * STEP[:2], abs=0.1)
    kept = undisputed(observations, observations.parameter, found)
    assert not (kept & (observations.kind == REFERENCE)).any() and kept[observations.kind == TIE].all()


def test_a_step_of_one_drive_is_not_the_references():
    assert steps_of(seen(first=1.0)) == [] and steps_of(seen(second=1.0)) == [] and steps_of(seen()) == []


def test_markings_between_two_steps_that_undo_each_other_are_left_out_alone():
    observations = seen(reference=1.0, place=150.0, back=260.0)
    found = steps_of(observations)
    assert len(found) == 4
    kept = undisputed(observations, observations.parameter, found)
    of_first = (observations.kind == REFERENCE) & (observations.drive == 0)
    left = observations.parameter[of_first & ~kept]
    assert left.min() > 135.0 and left.max() < 275.0 and len(left) >= 9


def test_a_step_is_given_to_the_drive_that_steps_alone():
    nodes = np.arange(0.0, 405.0, 5.0)
    both = seen(second=2.0)
    ties = both.select(both.kind == TIE)
    assert observed_steps(ties, 0, nodes).any() and observed_steps(ties, 1, nodes).any()  # a tie alone: either
    assert not observed_steps(both, 0, nodes).any() and observed_steps(both, 1, nodes).any()


def test_five_control_points_on_the_other_drive_say_whose_the_step_is():
    nodes, both = np.arange(0.0, 405.0, 5.0), seen(second=2.0)
    where = np.array([20.0, 110.0, 190.0, 290.0, 380.0])
    control = rows(0, where, NONE, np.zeros(5), drift(where, 1), 0.02, CONTROL)
    observations = NetworkObservations.joined([both.select(both.kind == TIE), control])
    assert not observed_steps(observations, 0, nodes).any() and observed_steps(observations, 1, nodes).any()
