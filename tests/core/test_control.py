"""Control points, their figures, and landmark updating."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.mobile.accuracy_report import write_accuracy_report
from urbanmap_qgis.mobile.control import (
    ControlPoints,
    accuracy,
    control_from_columns,
    in_survey_time,
    read_control,
    residuals,
)
from urbanmap_qgis.mobile.landmark_update import update_by_landmarks
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.trajectory import Trajectory

HEADER = "id,x,y,z,time,x_mms,y_mms,z_mms\n"


def straight(seconds=100.0, heading=90.0):
    time = np.arange(0.0, seconds + 0.05, 0.1)
    place = np.column_stack([8.0 * time, np.zeros_like(time), np.full_like(time, 2.0)])
    return Trajectory(time, place, np.tile([0.0, 0.0, heading], (len(time), 1)))


def points_of(trajectory, times, error):
    """Control points 5 m left of the vehicle, surveyed with an error (n, 3)."""
    true = np.column_stack([np.interp(times, trajectory.time, trajectory.place[:, 0]), np.full(len(times), 5.0),
                            np.zeros(len(times))])
    return ControlPoints(tuple(map(str, range(len(times)))), true, np.asarray(times, float), true + error)


@pytest.mark.paper("J 3.3.5, eq. 12")
def test_figures_of_known_errors():
    errors = np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, np.nan]])
    figures = accuracy(errors)
    assert (figures.points, figures.points_3d) == (3, 2)
    assert figures.mean_2d == pytest.approx(2.0) and figures.max_2d == pytest.approx(5.0)
    assert figures.std_2d == pytest.approx(np.sqrt(((5 - 2) ** 2 + (0 - 2) ** 2 + (1 - 2) ** 2) / 2))
    assert figures.mean_3d == pytest.approx(3.5) and figures.max_3d == pytest.approx(5.0)
    assert np.allclose(figures.bias, [1.0, 5.0 / 3.0, 1.0])
    assert np.isnan(accuracy(errors[:1]).std_2d)
    with pytest.raises(InsufficientDataError, match="nothing to measure"):
        accuracy(np.empty((0, 3)))


def test_correction_with_a_turn_moves_control_points_like_points():
    reported = straight()
    control = points_of(reported, [10.0, 50.0], 0.0)
    turned = Trajectory(reported.time, reported.place, reported.angles + np.array([0.0, 0.0, 1.0]))  # clockwise
    errors = residuals(control, correction_between(reported, turned))
    # 5 m to the left of a vehicle that drives east: a turn by 1 degree to the right pulls it forward.
    assert np.allclose(errors[:, :2], [5 * np.sin(np.radians(1)), 5 * (np.cos(np.radians(1)) - 1)], atol=1e-5)


def test_read_csv_with_and_without_heights(tmp_path):
    (tmp_path / "c.csv").write_text(HEADER + "A,1,2,3,10,1.5,2,3\nB,1,2,,11,1,2,\n", encoding="utf-8-sig")
    control = read_control(tmp_path / "c.csv")
    assert control.id == ("A", "B") and np.isnan(control.true[1, 2])
    figures = accuracy(residuals(control))
    assert figures.mean_2d == pytest.approx(0.25) and figures.points_3d == 1


@pytest.mark.parametrize(("text", "words"), [
    ("id,x,y\nA,1,2\n", "no column time, x_mms, y_mms"),
    (HEADER, "no column|no control point"),
    (HEADER + "A,one,2,3,10,1,2,3\n", "no number"),
    (HEADER + "A,1,2,3,,1,2,3\n", "row 1 has no number in the column time"),
])
def test_bad_tables_in_one_sentence(tmp_path, text, words):
    (tmp_path / "c.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        read_control(tmp_path / "c.csv")


def test_points_of_another_survey_are_refused():
    reported = straight()
    with pytest.raises(InputError, match="give those of one survey"):
        in_survey_time(points_of(reported, [500.0, 520.0], 0.0), reported)
    kept, left_out = in_survey_time(points_of(reported, [10.0, 50.0, 101.0], 0.0), reported)
    assert len(kept) == 2 and left_out == 1
    with pytest.raises(InputError, match="same coordinate reference system"):
        residuals(points_of(reported, [10.0], 5000.0))


def test_time_of_the_week_is_matched():
    reported = straight()
    control = points_of(reported, [10.0, 50.0], 0.3)
    later = ControlPoints(control.id, control.true, control.time + 3 * 604800.0, control.surveyed)
    assert np.allclose(in_survey_time(later, reported)[0].time, control.time)


@pytest.mark.paper("J 3.1, 3.3.5, landmark update")
def test_landmark_updating_is_exact_at_landmarks_linear_between_and_rigid_outside():
    reported = straight()
    error = np.array([[1.0, -0.5, 0.4], [2.0, 0.5, 0.2]])
    control = points_of(reported, [20.0, 60.0], error)
    updated = update_by_landmarks(reported, control)
    assert np.abs(residuals(control, correction_between(reported, updated))).max() < 1e-5
    moved = updated.place - reported.place
    at = {t: moved[np.searchsorted(reported.time, t - 1e-6)] for t in (0.0, 40.0, 100.0)}
    assert np.allclose(at[0.0], -error[0]) and np.allclose(at[100.0], -error[1])
    assert np.allclose(at[40.0], -error.mean(axis=0))
    assert np.array_equal(updated.angles, reported.angles)


def test_landmarks_of_one_epoch_are_averaged_and_heights_may_be_missing():
    reported = straight()
    control = points_of(reported, [20.0, 20.2, 60.0], np.array([[1.0, 0, 0], [2.0, 0, np.nan], [0, 0, 0.6]]))
    moved = update_by_landmarks(reported, control).place - reported.place
    assert np.allclose(moved[0], [-1.5, 0.0, 0.0])
    assert np.allclose(moved[-1], [0.0, 0.0, -0.6])
    with pytest.raises(InsufficientDataError, match="cannot be updated"):
        update_by_landmarks(reported, control.select(np.zeros(3, bool)))


def test_report_shows_before_and_after(tmp_path):
    reported = straight()
    control = points_of(reported, np.arange(5.0, 95.0, 5.0), np.array([0.7, 0.2, 0.1]))
    before = residuals(control)
    write_accuracy_report(tmp_path / "r.html", control, {"as reported": before, "corrected": before / 10}, left_out=2)
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "0.728" in text and "0.073" in text and "2 control points were not measured" in text
    assert text.count("<circle") == 2 * len(control)


def test_layer_columns_in_any_case():
    columns = {"ID": ["a"], "X": ["1"], "Y": [2], "Time": [3.0], "x_MMS": [1.0], "y_mms": [2.5]}
    assert accuracy(residuals(control_from_columns(columns))).mean_2d == pytest.approx(0.5)
