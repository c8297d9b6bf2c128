"""Accuracies of the angles that a trajectory states: columns of a table, and the RMS file beside an SBET."""

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.trajectory_accuracy import rms_file_of, sigma_of_rms_file
from urbanmap_qgis.mobile.trajectory_files import read_trajectory, write_trajectory

ROWS = [(10.0 + k, 100.0 + 5 * k, 200.0, 3.0, 0.1, 0.2, 90.0) for k in range(4)]


def table(path, sigma, header="sd_roll,sd_pitch,sd_heading"):
    lines = [f"time,x,y,z,roll,pitch,heading,{header}"]
    lines += [",".join(str(value) for value in (*row, *sigma)) for row in ROWS]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def rms_file(path, time, minutes):
    """As POSPac writes it: ten doubles a record, angles in minutes of arc."""
    np.array([[t, 0.5, 0.6, 0.7, 0.01, 0.01, 0.01, *minutes] for t in time]).tofile(path)
    return path


def test_columns_of_a_table_are_read_and_written_back(tmp_path):
    read = read_trajectory(table(tmp_path / "a.csv", (0.01, 0.02, 0.05), "SD_Roll,SD_Pitch,sd_heading"))
    np.testing.assert_allclose(read.trajectory.angle_sigma, np.tile([0.01, 0.02, 0.05], (4, 1)))
    assert "heading 0.050" in read.applied
    write_trajectory(tmp_path / "b.csv", read, read.trajectory)
    again = read_trajectory(tmp_path / "b.csv")
    np.testing.assert_allclose(again.trajectory.angle_sigma, read.trajectory.angle_sigma)


def test_a_table_without_them_states_none(tmp_path):
    assert read_trajectory(table(tmp_path / "a.csv", (1, 1, 1), "a,b,c")).trajectory.angle_sigma is None


@pytest.mark.parametrize(("header", "sigma", "sentence"), [
    ("sd_roll,sd_pitch,other", (0.01, 0.01, 0.01), "but no sd_heading"),
    ("sd_roll,sd_pitch,sd_heading", (0.01, 0.0, 0.01), "not above 0"),
    ("sd_roll,sd_pitch,sd_heading", (0.01, "good", 0.01), "is no number")])
def test_wrong_columns_are_refused(tmp_path, header, sigma, sentence):
    with pytest.raises(InputError, match=sentence):
        read_trajectory(table(tmp_path / "a.csv", sigma, header))


def test_rms_file_is_found_by_name(tmp_path):
    wanted = rms_file(tmp_path / "smrmsg_Mission 1.out", [1.0, 2.0], (1, 1, 1))
    assert rms_file_of(tmp_path / "sbet_Mission 1.out") == wanted
    assert rms_file_of(tmp_path / "sbet_Mission 2.out") is None
    assert rms_file_of(tmp_path / "Mission 1.out") == wanted


def test_rms_file_is_in_minutes_of_arc_and_between_its_records(tmp_path):
    np.array([[0.0, *[1.0] * 6, 0.6, 1.2, 3.0], [10.0, *[1.0] * 6, 1.2, 1.2, 6.0]]).tofile(tmp_path / "r.out")
    made, places = sigma_of_rms_file(tmp_path / "r.out", np.array([0.0, 5.0]))
    np.testing.assert_allclose(made, [[0.01, 0.02, 0.05], [0.015, 0.02, 0.075]])
    np.testing.assert_allclose(places, np.ones((2, 2)))


@pytest.mark.parametrize("header", ["sd_x,sd_y", "SDEast,SDNorth", "sd_north,sd_east"])
def test_accuracy_of_places_by_columns(tmp_path, header):
    read = read_trajectory(table(tmp_path / "a.csv", (0.03, 0.04), header))
    wanted = [0.04, 0.03] if header.startswith("sd_north") else [0.03, 0.04]
    np.testing.assert_allclose(read.trajectory.place_sigma, np.tile(wanted, (4, 1)))
    assert read.trajectory.angle_sigma is None and "0.04 m (median)" in read.applied


@pytest.mark.parametrize(("header", "sigma", "sentence"), [
    ("sd_x,other", (0.03, 0.03), "accuracy of sd_x alone"), ("sd_x,sd_y", (0.03, 0.0), "not above 0 m"),
    ("sd_x,sd_y", (0.03, "good"), "is no number")])
def test_wrong_accuracies_of_places_are_refused(tmp_path, header, sigma, sentence):
    with pytest.raises(InputError, match=sentence):
        read_trajectory(table(tmp_path / "a.csv", sigma, header))


def test_rms_file_of_another_survey_or_cut_off_is_refused(tmp_path):
    path = rms_file(tmp_path / "r.out", [500.0, 501.0], (1, 1, 1))
    with pytest.raises(InputError, match="does not belong to the trajectory"):
        sigma_of_rms_file(path, np.array([0.0, 100.0]))
    path.write_bytes(path.read_bytes()[:-8])
    with pytest.raises(InputError, match="cut off"):
        sigma_of_rms_file(path, np.array([500.0, 501.0]))
