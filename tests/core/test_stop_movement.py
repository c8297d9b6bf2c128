"""What a standing vehicle's trajectory wanders is its error, and known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.simulated_windows import simulate, trajectory
from urbanmap_qgis.mobile.adjustment.drive_network import adjust_drives
from urbanmap_qgis.mobile.adjustment.network import CONTROL, NONE, NetworkObservations
from urbanmap_qgis.mobile.adjustment.records import AdjustmentRun
from urbanmap_qgis.mobile.adjustment.ties import Drive
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.trajectory_stops import STILL, links_along
from urbanmap_qgis.mobile.trajectory import interpolate
from urbanmap_qgis.progress import SILENT

WANDERED = np.array([0.3, -0.4, 0.1])


def wandering(waits, wandered, at):
    """A drive eastwards whose reported place wanders by (3,) m, evenly in the wait at a chainage; and that wait's ends.
    """
    true, chainage = trajectory(300.0, waits, None)
    standing = np.flatnonzero(chainage == chainage[np.searchsorted(chainage, at)])
    share = np.clip((true.time - true.time[standing[0]]) / np.ptp(true.time[standing]), 0.0, 1.0)
    return replace(true, place=true.place + share[:, None] * wandered), true.time[standing[[0, -1]]]


def test_what_a_standing_vehicle_wanders_is_found_and_what_it_drives_is_not():
    reported, (begin, end) = wandering({100.0: 20.0, 200.0: 10.0}, WANDERED, 100.0)
    time = np.array([0.0, begin - 2.0, begin + 5.0, end + 2.0, reported.time[-1]])
    made = links_along(reported, time)
    assert made.moved[1:3].sum(axis=0) == pytest.approx(WANDERED, abs=0.02)
    assert np.abs(made.moved[[0, 3]]).max() < 0.02  # the second wait does not wander
    assert made.moved[1] == pytest.approx(0.25 * WANDERED, abs=0.03)  # five of twenty seconds
    ahead = 0.25 * WANDERED[0]  # it drives eastwards: of that some may be true
    assert np.sqrt(made.stop_variance[1:3].sum()) == pytest.approx(STILL + ahead, rel=0.1)
    assert np.sqrt(made.stop_variance[3]) == pytest.approx(STILL, rel=0.1) and made.stop_variance[0] == 0.0


def test_the_correction_goes_on_over_a_wait_without_markings():
    drive = simulate(0, waits={250.0: 20.0}, gaps=((235.0, 500.0),), turn=None, crossings=20.0)
    standing = np.diff(drive.true.place[:, 0], prepend=-1.0) == 0
    first = np.flatnonzero(standing)
    share = np.clip((drive.true.time - drive.true.time[first[0]]) / np.ptp(drive.true.time[first]), 0.0, 1.0)
    wandered = np.array([-0.6, 0.8, 0.0])
    reported = replace(drive.reported, place=drive.reported.place + share[:, None] * wandered)
    error = drive.error.copy()
    error[drive.windows.chainage > 250.0, :3] -= wandered
    made = adjust_correction(drive.windows, reported)
    after = (made.chainage > 250.0) & (made.chainage < 260.0)
    off = (made.value - error)[after, :2]
    assert np.hypot(*off.T).max() < 0.35  # of a metre; the smooth drift over 25 m is left
    assert (np.abs(off) < 3.0 * made.sigma()[after, :2]).all()


def test_a_vehicle_whose_trajectory_goes_back_slowly_stands_and_one_that_creeps_ahead_drives():
    back, (begin, end) = wandering({100.0: 10.0}, np.array([-2.0, 0.0, 0.0]), 100.0)
    ahead, _ = wandering({100.0: 10.0}, np.array([2.0, 0.0, 0.0]), 100.0)
    time = np.array([begin + 1.0, end - 1.0])  # 0.2 m/s: more than a standing vehicle's trajectory wanders as a rule
    moved, none = (links_along(drive, time).moved.sum(axis=0) for drive in (back, ahead))
    assert moved == pytest.approx([-1.6, 0.0, 0.0], abs=0.02)
    assert np.abs(none[0]) < 0.1 * 1.6


def test_what_is_observed_amid_a_stop_places_a_drive_before_and_after_it():
    """Nodes lie 5 m of path apart, 5 s of a stop: in between the correction goes as the trajectory wanders."""
    reported, (begin, end) = wandering({100.0: 20.0}, WANDERED, 100.0)
    true = trajectory(300.0, {100.0: 20.0}, None)[0]
    drive, run = Drive("A", reported, None), AdjustmentRun()
    time = np.array([begin + 7.0, begin + 11.0, 20.0])
    value = np.column_stack([interpolate(true, time).place - interpolate(reported, time).place, np.full(3, np.nan)])
    parameter = np.interp(time, reported.time, run.path_parameters(reported))
    seen = NetworkObservations(np.zeros(3, int), parameter, np.zeros((3, 2)), np.full(3, NONE), np.zeros(3),
                               np.zeros((3, 2)), value, np.tile(1e-6 * np.eye(4), (3, 1, 1)), np.full(3, CONTROL))
    made = adjust_drives([drive], seen, run, SILENT).drives[0]
    stop = (reported.time > begin + 1.0) & (reported.time < end - 1.0)
    assert np.abs(made.corrected.place - true.place)[stop].max() < 0.02
