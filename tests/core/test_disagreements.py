"""Sharp steps between reference and survey: found, told, and nothing beside them called registered."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from tests.core.simulated_windows import shifted, simulate
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.patch_status import DISTRUSTED, REGISTERED
from urbanmap_qgis.mobile.registration.correction.reference_steps import (
    CHANGED,
    DISAGREEMENT,
    HIDDEN,
    UNDECIDED,
    CorrectionStep,
)
from urbanmap_qgis.mobile.registration.disagreement_areas import area_table
from urbanmap_qgis.mobile.trajectory import Trajectory


def plan_error(drive, correction):
    return np.hypot(*(correction.value - drive.error)[:, :2].T)


def far_off(drive, correction):
    """Patches that are called registered and off by more than 0.1 m."""
    return int(((correction.status == REGISTERED) & (plan_error(drive, correction) > 0.1)).sum())


@pytest.mark.parametrize("seed", range(4))
def test_a_drive_without_faults_has_no_steps(seed):
    made = adjust_correction((drive := simulate(seed, crossings=25.0, turn=None)).windows, drive.reported)
    assert made.steps == () and (made.status == REGISTERED).mean() > 0.9


@pytest.mark.paper("J 6.2, features")
def test_markings_that_changed_between_the_flight_and_the_drive():
    drive = shifted(simulate(1, crossings=25.0, turn=None), 100.0, 200.0, (0.3, 0.4))
    made = adjust_correction(drive.windows, drive.reported)
    assert [step.kind for step in made.steps] == [CHANGED, CHANGED]
    assert [step.place for step in made.steps] == pytest.approx([100.0, 200.0], abs=4.0)
    assert [step.size for step in made.steps] == pytest.approx([0.5, 0.5], abs=0.06)
    assert made.steps[0].direction == pytest.approx(np.degrees(np.arctan2(0.3, 0.4)), abs=10.0)
    inside = (drive.windows.chainage > 104) & (drive.windows.chainage < 196)
    assert not (made.status[inside] == REGISTERED).any() and far_off(drive, made) == 0
    assert plan_error(drive, made).max() < 3 * made.plan_sigma().max()
    assert not (made.status == REGISTERED).any()  # or all others did: of 500 m that is no proof
    assert 0.5 < made.steps[0].probability < 0.95 and made.plan_sigma().min() > 0.2
    assert plan_error(drive, made).max() < 0.12  # the likelier of both is what the correction takes


def test_a_stretch_of_a_long_drive_is_surely_the_one_that_changed():
    drive = shifted(simulate(1, length=1900.0, crossings=25.0, turn=None), 900.0, 1000.0, (0.3, 0.4))
    made = adjust_correction(drive.windows, drive.reported)
    inside = (drive.windows.chainage > 896) & (drive.windows.chainage < 1004)
    assert [step.kind for step in made.steps] == [CHANGED, CHANGED] and made.steps[0].probability > 0.95
    assert (made.status[~inside] == REGISTERED).mean() > 0.85 and far_off(drive, made) == 0


@pytest.mark.parametrize("stretches", [((-1.0, 190.0), (310.0, 501.0)), ((62.0, 438.0),)])
def test_the_larger_part_that_is_off_is_called_right_by_nobody(stretches):
    """A quarter that is right looks as a block that changed does: both alternatives are in the accuracy."""
    drive = wrong = simulate(2, crossings=25.0, turn=None)
    for begin, end in stretches:
        wrong = shifted(wrong, begin, end, (0.2, 0.3))
    made = adjust_correction(wrong.windows, drive.reported)
    assert made.steps and not (made.status == REGISTERED).any()
    assert (plan_error(drive, made) < 3 * made.plan_sigma()).mean() > 0.98


def test_a_change_of_two_decimetres_is_noticed():
    drive = shifted(simulate(1, crossings=25.0, turn=None), 150.0, 250.0, (0.12, 0.16))
    made = adjust_correction(drive.windows, drive.reported)
    assert [step.kind for step in made.steps] == [CHANGED, CHANGED] and far_off(drive, made) == 0


GAP, CHANGE = (212.0, 224.0), (0.45, -0.3)


@pytest.mark.parametrize("seed", [2, 5])
def test_nobody_calls_a_side_right_where_no_evidence_tells_whose_a_step_is(seed):
    drive = shifted(simulate(seed, crossings=25.0, turn=None, gaps=(GAP,)), 218.0, 600.0, CHANGE)
    made = adjust_correction(drive.windows, drive.reported)
    assert {step.kind for step in made.steps} & {UNDECIDED, DISAGREEMENT}
    assert far_off(drive, made) == 0 and (plan_error(drive, made) < 3 * made.plan_sigma()).mean() > 0.98


def test_a_change_at_a_stop_is_told_and_neither_side_is_called_right():
    """Whether the drive or the reference changed while the vehicle stood no marking tells."""
    drive = simulate(4, waits={215.0: 12.0}, crossings=25.0, turn=None)
    assert (adjust_correction(drive.windows, drive.reported).status == REGISTERED).mean() > 0.8
    made = adjust_correction(shifted(drive, 215.0, 600.0, CHANGE).windows, drive.reported)
    assert made.steps and far_off(drive, made) == 0


@pytest.mark.parametrize("size", [0.36, 0.25])
def test_a_reference_that_jumps_and_stays(size):
    drive = shifted(simulate(2, crossings=25.0, turn=None), 220.0, 600.0, (0.6 * size, -0.8 * size))
    made = adjust_correction(drive.windows, drive.reported)
    assert [step.kind for step in made.steps] == [DISAGREEMENT]
    assert made.steps[0].size == pytest.approx(size, abs=0.05)
    assert not (made.status == REGISTERED).any()
    off, sigma = plan_error(drive, made), made.plan_sigma()
    assert (off < 3 * sigma).mean() > 0.98  # either side may be the wrong one


def slipping(drive, begin, length, change):
    """The reported trajectory of a drive whose correction changes by (2,) m over some path, which it slipped by."""
    reported = drive.reported
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(drive.true.place[:, :2], axis=0).T))])
    share = np.clip((way - begin) / length, 0.0, 1.0)[:, None]
    return replace(reported, place=reported.place - share * np.array([*change, 0.0]))


def test_a_fix_of_the_trajectory_is_no_disagreement():
    drive = simulate(3, crossings=25.0, turn=None)
    ramp = np.clip((drive.windows.chainage - 240.0) / 20.0, 0.0, 1.0)[:, None] * np.array([1.2, 0.5, 0, 0, 0, 0])
    windows = drive.windows
    for name in ("linearised", "correction"):
        getattr(windows, name)[:] += ramp
    windows.modes[:, 0] += ramp[:, :2]
    made = adjust_correction(windows, slipping(drive, 240.0, 20.0, (1.2, 0.5)))
    assert not [step for step in made.steps if step.kind != HIDDEN]
    assert (made.status == REGISTERED).mean() > 0.8


def test_a_step_that_hides_where_there_are_no_markings():
    drive = shifted(simulate(4, crossings=25.0, turn=None, gaps=((200.0, 285.0),)), 285.0, 600.0, (1.2, -0.9))
    made = adjust_correction(drive.windows, slipping(drive, 230.0, 20.0, (1.2, -0.9)))
    assert [step.kind for step in made.steps] == [HIDDEN]
    inside = (drive.windows.chainage > 202) & (drive.windows.chainage < 283)
    assert (made.status[inside] == DISTRUSTED).all()
    assert (made.status[~inside] == REGISTERED).mean() > 0.85
    calm = simulate(4, crossings=25.0, turn=None, gaps=((200.0, 285.0),))
    assert adjust_correction(calm.windows, calm.reported).steps == ()


@pytest.mark.slow
def test_a_hidden_step_that_the_drive_did_not_slip_by_is_the_references():
    drive = shifted(simulate(4, crossings=25.0, turn=None, gaps=((200.0, 285.0),)), 285.0, 600.0, (1.2, -0.9))
    made = adjust_correction(drive.windows, drive.reported)
    assert sorted({step.kind for step in made.steps}) == sorted({HIDDEN, DISAGREEMENT})
    assert not (made.status == REGISTERED).any()
    assert (plan_error(drive, made) < 3 * made.plan_sigma()).mean() > 0.98


# Areas in which reference and survey disagree: where, how long and how wide


SIDE = 6.0


def survey(*steps):
    """A drive northwards at 10 m/s over 400 m, corrected by a metre east, markings 6 m to either side."""
    time = np.arange(0.0, 40.0, 0.1)
    place, angles = np.outer(time, [0.0, 10.0, 0.0]), np.zeros((len(time), 3))
    seen = np.arange(0.0, 39.0, 0.01)
    side = np.where(np.arange(len(seen)) % 2, SIDE, -SIDE)
    none = np.zeros(len(seen))
    markings = MarkingPoints(side, 10.0 * seen, none, seen, none, none)
    return SimpleNamespace(reported=Trajectory(time, place, angles),
                           trajectory=Trajectory(time, place + np.array([1.0, 0.0, 0.0]), angles), markings=markings,
                           correction=SimpleNamespace(chainage=np.arange(0.25, 399.0, 0.5), steps=steps))


def step(place, kind, span=None):
    return CorrectionStep(place, place / 10.0, 0.3, 0.4, 0.02, kind, span)


def test_changed_markings_are_one_area_from_edge_to_edge():
    columns, areas = area_table(survey(step(100.0, CHANGED, (100.0, 180.0)), step(180.0, CHANGED)))
    assert columns["kind"] == [CHANGED] and columns["size"] == [pytest.approx(0.5)]
    assert columns["direction"] == [pytest.approx(np.degrees(np.arctan2(0.3, 0.4)))]
    assert areas[0].bounds == pytest.approx((1.0 - SIDE, 100.0, 1.0 + SIDE, 180.0), abs=0.1)
    assert areas[0].area == pytest.approx(80.0 * 2 * SIDE, rel=0.01)


def test_a_single_step_is_the_road_about_it_and_a_hidden_one_its_stretch():
    columns, areas = area_table(survey(step(10.0, DISAGREEMENT), step(300.0, HIDDEN, (280.0, 320.0))))
    assert list(zip(columns["begin"], columns["end"])) == [(0.0, 30.0), (280.0, 320.0)]
    assert [shapely.get_coordinates(area)[:, 1].max() for area in areas] == pytest.approx([30.0, 320.0], abs=0.1)


def test_an_area_is_as_wide_as_the_markings_of_its_whole_length():
    drive = survey(step(100.0, CHANGED, (100.0, 180.0)))
    drive.markings.x[drive.markings.y > 140.0] *= 2.0
    _, (area,) = area_table(drive)
    assert area.bounds == pytest.approx((1.0 - 2 * SIDE, 100.0, 1.0 + 2 * SIDE, 180.0), abs=0.1)


def test_where_nothing_disagrees_there_is_no_area():
    columns, areas = area_table(survey())
    assert len(areas) == 0 and all(len(column) == 0 for column in columns.values())
