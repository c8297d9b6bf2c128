"""Whose a step is: of one drive or of the other one."""

from __future__ import annotations

import numpy as np

from tests.core.test_network import drift as fast_drift
from tests.core.test_network import rows
from urbanmap_qgis.mobile.adjustment.network import CONTROL, NONE, REFERENCE, TIE, NetworkObservations
from urbanmap_qgis.mobile.adjustment.steps import observed_steps

AT = np.arange(5.0, 400.0, 10.0)
STEP = np.array([0.6, -0.8, 0.0])


def drift(parameter, seed):
    """As real trajectories drift: 2 mm a metre."""
    return 0.25 * fast_drift(parameter, seed)


def seen(step):
    """Two drives in opposite directions, of which the second one's own error steps by so many times STEP at 200 m."""
    random = np.random.default_rng(5)

    def noise():
        return random.normal(0, 0.01, (len(AT), 3))

    one, two = drift(AT, 1), drift(400.0 - AT, 2) + step * (AT > 200.0)[:, None] * STEP
    none = np.zeros(len(AT))
    return NetworkObservations.joined([
        rows(0, AT, 1, 400.0 - AT, one - two + noise(), 0.01, TIE),
        rows(0, AT, NONE, none, one + noise(), 0.01, REFERENCE),
        rows(1, 400.0 - AT, NONE, none, two + noise(), 0.01, REFERENCE)])


def test_a_step_is_given_to_the_drive_that_steps_alone():
    nodes = np.arange(0.0, 405.0, 5.0)
    both = seen(2.0)
    ties = both.select(both.kind == TIE)
    assert observed_steps(ties, 0, nodes).any() and observed_steps(ties, 1, nodes).any()  # a tie alone: either
    assert not observed_steps(both, 0, nodes).any() and observed_steps(both, 1, nodes).any()


def test_five_control_points_on_the_other_drive_say_whose_the_step_is():
    nodes, both = np.arange(0.0, 405.0, 5.0), seen(2.0)
    where = np.array([20.0, 110.0, 190.0, 290.0, 380.0])
    control = rows(0, where, NONE, np.zeros(5), drift(where, 1), 0.02, CONTROL)
    observations = NetworkObservations.joined([both.select(both.kind == TIE), control])
    assert not observed_steps(observations, 0, nodes).any() and observed_steps(observations, 1, nodes).any()
