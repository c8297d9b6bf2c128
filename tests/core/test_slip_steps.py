"""A step of the reference that the smooth drift hides: correction and slip of the trajectory go together, or do not."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.correction.gauss_markov import StopMovement
from urbanmap_qgis.mobile.registration.correction.side_slip import SideSlip
from urbanmap_qgis.mobile.registration.correction.slip_steps import slip_steps
from urbanmap_qgis.mobile.trajectory import Trajectory

WAY = np.arange(0.0, 500.0, 0.4)
NODES = np.linspace(0.0, 500.0, 251)
STILL = StopMovement(np.zeros((250, 3)), np.zeros(250))


def ramp(way, size, at=200.0, length=30.0):
    return size * np.clip((way - at) / length + 0.5, 0.0, 1.0)


def slip_of(error):
    """A drive northwards at 8 m/s whose reported place is off by an error (e,) m to the east; heading 0.2 degrees."""
    place = np.column_stack([error, WAY, 0.0 * WAY])
    wander = 0.01 * np.sin(WAY / 60.0)
    return SideSlip.of(Trajectory(WAY / 8.0, place, np.column_stack([0.0 * WAY, 0.0 * WAY, 0.2 + wander])), WAY)


def course(correction, sigma=0.01):
    def at(path_parameter):
        east = np.interp(path_parameter, WAY, correction)
        return np.column_stack([east, 0.0 * east]), np.tile(sigma**2 * np.eye(2), (len(east), 1, 1))
    return at


DRIFT = 0.3 * np.sin(WAY / 90.0)


def test_a_correction_that_undoes_its_drives_own_error_is_no_step():
    error = DRIFT + ramp(WAY, 0.3)
    assert slip_steps(slip_of(error), course(-error), STILL, NODES) == []


def test_a_decimetre_of_the_reference_over_thirty_metres_is_found():
    found = slip_steps(slip_of(DRIFT), course(-DRIFT + ramp(WAY, 0.12)), STILL, NODES)
    assert len(found) == 1
    assert NODES[found[0].node] == pytest.approx(200.0, abs=10.0)
    assert found[0].change == pytest.approx([0.12, 0.0], abs=0.03)


def test_not_where_the_correction_is_not_known_so_well():
    assert slip_steps(slip_of(DRIFT), course(-DRIFT + ramp(WAY, 0.12), sigma=0.03), STILL, NODES) == []


def test_what_the_place_wanders_in_a_stop_is_no_step():
    moved = np.zeros((250, 3))
    moved[100, 0] = -0.12  # and the correction undoes it
    stops = StopMovement(moved, np.where(np.arange(250) == 100, 1e-4, 0.0))
    stepped = course(-DRIFT + ramp(WAY, 0.12, length=1.0))
    assert slip_steps(slip_of(DRIFT), stepped, stops, NODES) == []
    assert len(slip_steps(slip_of(DRIFT), stepped, STILL, NODES)) == 1
