"""Fast changes of a correction: the drive's, the reference's, or either's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.simulated_windows import shifted, simulate
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.disagreements import DISAGREEMENT, HIDDEN, UNDECIDED
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
