"""Fast changes of a correction: the drive's, the reference's, or either's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.simulated_windows import shifted, simulate
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.disagreements import DISAGREEMENT, HIDDEN, UNDECIDED, NodeStep
from urbanmap_qgis.mobile.registration.correction.fast_changes import FastChange
from urbanmap_qgis.mobile.registration.correction.patch_status import REGISTERED

CHANGE = (0.45, -0.3)
GAP = (212.0, 224.0)


def drive_with_step_in_gap(seed):
    """A drive past a short stretch without markings behind which the reference lies elsewhere."""
    return shifted(simulate(seed, crossings=25.0, turn=None, gaps=(GAP,)), 218.0, 600.0, CHANGE)


def slipping(drive, begin, length):
    """The reported trajectory as if the change were the drive's: it slips by as much."""
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(drive.true.place[:, :2], axis=0).T))])
    share = np.clip((way - begin) / length, 0.0, 1.0)[:, None]
    return replace(drive.reported, place=drive.reported.place - share * np.array([*CHANGE, 0.0]))


@pytest.mark.parametrize("seed", [2, 5])
def test_nobody_calls_a_side_right_where_no_evidence_tells_whose_a_step_is(seed):
    drive = drive_with_step_in_gap(seed)
    made = adjust_correction(drive.windows, drive.reported)
    assert {step.kind for step in made.steps} & {UNDECIDED, DISAGREEMENT}
    off = np.hypot(*(made.value - drive.error)[:, :2].T)
    assert not ((made.status == REGISTERED) & (off > 0.1)).any()
    assert (off < 3 * made.plan_sigma()).mean() > 0.98


@pytest.mark.slow
def test_a_drive_that_slips_by_its_change_mostly_stays_registered():
    """Where the noise of the slip leaves it open the change is told as anybody's, and nothing wrong is registered."""
    registered = []
    for seed in (2, 3, 6, 7):
        drive = drive_with_step_in_gap(seed)
        made = adjust_correction(drive.windows, slipping(drive, 210.0, 16.0))
        told = {step.kind for step in made.steps if step.kind != HIDDEN}
        assert told <= {UNDECIDED}
        if not told:
            registered.append((made.status == REGISTERED).mean())
    assert len(registered) >= 3 and min(registered) > 0.8


def test_a_change_at_a_stop_beyond_its_wandering_is_told_and_neither_side_is_called_right():
    """Whether the drive or the reference changed while the vehicle stood no marking tells."""
    drive = simulate(4, waits={215.0: 12.0}, crossings=25.0, turn=None)
    made = adjust_correction(drive.windows, drive.reported)
    assert (made.status == REGISTERED).mean() > 0.8
    moved = shifted(drive, 215.0, 600.0, CHANGE)
    made = adjust_correction(moved.windows, drive.reported)
    off = np.hypot(*(made.value - drive.error)[:, :2].T)
    assert made.steps and not ((made.status == REGISTERED) & (off > 0.1)).any()


@pytest.mark.parametrize(("gap", "told"), [((208.0, 222.0), True), ((185.0, 245.0), False)])
def test_a_stop_in_a_stretch_without_markings_that_has_room_for_a_fix_takes_registration_from_neither_side(gap, told):
    """The trajectory may be fixed anew within 20 m of it; a shorter one leaves no room."""
    drive = simulate(5, waits={215.0: 12.0}, crossings=25.0, turn=None, gaps=(gap,))
    made = adjust_correction(shifted(drive, 215.0, 600.0, (0.29, -0.19)).windows, drive.reported)
    assert bool({step.kind for step in made.steps} & {UNDECIDED, DISAGREEMENT}) == told
    assert ((made.status == REGISTERED).mean() > 0.8) == (not told)


@pytest.mark.parametrize(("left", "at_stake"), [((0.11, 0.06), (0.42, -0.17)), ((0.5, -0.2), (0.5, -0.2)),
                                                ((-0.11, 0.06), (-0.11, 0.06))])
def test_beside_a_stop_the_whole_change_is_at_stake(left, at_stake):
    """The drift that a stop sets free explains much of a step, of which either side may be wrong by all."""
    whole = NodeStep(7, np.array([0.42, -0.17]), np.eye(2), 20.0)
    found = FastChange(5, 9, whole, 13.0, 39.0).at_stake(NodeStep(7, np.array(left), 0.01 * np.eye(2), 12.0))
    assert found.change == pytest.approx(at_stake) and found.square == 12.0
    assert FastChange(5, 9, whole, 13.0, 39.0).at_stake(None) is whole
