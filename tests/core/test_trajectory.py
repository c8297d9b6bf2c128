"""Trajectories and how accurate they say they are."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.trajectory import (
    Trajectory,
    attitude_angles,
    body_to_map,
    gaps,
    interpolate,
    jumps,
    move_points,
    path_chainage,
    rotations,
)
from urbanmap_qgis.mobile.trajectory_accuracy import rms_file_of, sigma_of_rms_file
from urbanmap_qgis.mobile.trajectory_files import read_trajectory, write_trajectory


def straight(speed=10.0, seconds=10.0, rate=10.0):
    time = 100.0 + np.arange(int(seconds * rate) + 1) / rate
    place = np.column_stack([speed * (time - 100.0), np.zeros(len(time)), np.full(len(time), 5.0)])
    return Trajectory(time, place, np.tile([0.0, 0.0, 90.0], (len(time), 1)))


def matrix(roll, pitch, heading):
    """Rz(heading) Ry(pitch) Rx(roll) in north, east, down, then as east, north, up."""
    r, p, h = np.radians([roll, pitch, heading])
    about_x = np.array([[1, 0, 0], [0, np.cos(r), -np.sin(r)], [0, np.sin(r), np.cos(r)]])
    about_y = np.array([[np.cos(p), 0, np.sin(p)], [0, 1, 0], [-np.sin(p), 0, np.cos(p)]])
    about_z = np.array([[np.cos(h), -np.sin(h), 0], [np.sin(h), np.cos(h), 0], [0, 0, 1]])
    return np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]) @ about_z @ about_y @ about_x


def test_axes_of_the_body():
    level_east = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([0.0, 0.0, 90.0], (2, 1)))
    ahead, right, down = body_to_map(level_east, np.full(3, 0.5), np.eye(3))
    assert np.allclose(ahead, [1, 0, 0])
    assert np.allclose(right, [0, -1, 0])
    assert np.allclose(down, [0, 0, -1])


def test_nose_up_and_right_side_down():
    up = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([0.0, 10.0, 0.0], (2, 1)))
    assert body_to_map(up, np.array([0.5]), np.array([1.0, 0, 0]))[0, 2] > 0.17
    leaning = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([10.0, 0.0, 0.0], (2, 1)))
    assert body_to_map(leaning, np.array([0.5]), np.array([0, 1.0, 0]))[0, 2] < -0.17


def test_turns_are_those_of_the_matrices():
    rng = np.random.default_rng(1)
    angles = rng.uniform([-60, -80, 0], [60, 80, 360], (50, 3))
    expected = np.array([matrix(*row) for row in angles])
    assert np.allclose(rotations(angles), expected, atol=1e-12)
    assert np.allclose(attitude_angles(expected), angles, atol=1e-9)
    body = rng.normal(size=(50, 3))
    still = [Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile(row, (2, 1))) for row in angles]
    turned = np.array([body_to_map(one, np.array([0.3]), b)[0] for one, b in zip(still, body)])
    assert np.allclose(turned, np.einsum("nij,nj->ni", expected, body), atol=1e-12)


def test_between_epochs_and_outside():
    drive = straight()
    pose = interpolate(drive, np.array([100.05, 109.99]))
    assert np.allclose(pose.place[:, 0], [0.5, 99.9])
    with pytest.raises(InputError, match=r"runs from 100.000 to 110.000 s, but a pose is needed at 111.000"):
        interpolate(drive, np.array([101.0, 111.0]))
    assert np.allclose(interpolate(drive, np.array([111.0]), "hold").place[0], [100.0, 0, 5])
    assert np.isnan(interpolate(drive, np.array([99.0]), "nan").place).all()


def test_heading_through_north_is_the_short_way():
    drive = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.array([[0, 0, 350.0], [0, 0, 370.0]]))
    assert interpolate(drive, np.array([0.5])).angles[0, 2] == pytest.approx(360.0)


def test_points_move_with_the_body():
    rng = np.random.default_rng(2)
    reported = straight()
    corrected = Trajectory(reported.time, reported.place + np.array([1.0, -2.0, 0.5]),
                           reported.angles + np.array([1.0, -0.5, 3.0]))
    time = rng.uniform(100.0, 110.0, 200)
    body = rng.normal(scale=10.0, size=(200, 3))
    moved = move_points(body_to_map(reported, time, body), time, reported, corrected)
    assert np.allclose(moved, body_to_map(corrected, time, body), atol=1e-9)
    back = move_points(moved, time, corrected, reported)
    assert np.allclose(back, body_to_map(reported, time, body), atol=1e-9)


def test_way_leaves_out_the_wander_of_a_standing_vehicle():
    rng = np.random.default_rng(3)
    drive, noise = straight(seconds=10.0), 0.003
    stand = np.tile(drive.place[-1], (600, 1)) + noise * rng.standard_normal((600, 3))
    time = np.concatenate([drive.time, drive.time[-1] + 0.1 * np.arange(1, 601)])
    waits = Trajectory(time, np.vstack([drive.place, stand]), np.tile(drive.angles[0], (len(time), 1)))
    assert path_chainage(waits)[-1] == pytest.approx(100.0, abs=0.3)
    assert (np.diff(path_chainage(waits)) >= 0).all()


def test_gaps_and_jumps_are_found():
    drive = straight()
    kept = np.r_[0:30, 55:len(drive)]
    holed = Trajectory(drive.time[kept], drive.place[kept], drive.angles[kept])
    assert np.allclose(gaps(holed), [[102.9, 105.5]])
    place = drive.place.copy()
    place[50:] += [0.0, 30.0, 0.0]
    assert np.allclose(jumps(Trajectory(drive.time, place, drive.angles)), [[104.9, 105.0]])
    assert len(gaps(drive)) == len(jumps(drive)) == 0


def test_rotations_do_not_depend_on_where_results_lie_in_memory():
    """numpy's sine of a column of a table differed in its last digit where the result came to lie just behind it."""
    rng = np.random.default_rng(5)
    angles = rng.normal(size=(237, 3)) * [1, 1, 100]
    kept, made = [], set()
    for _ in range(1500):
        kept.append(np.empty(int(rng.integers(1, 3000))))
        if len(kept) > 50:
            kept.pop(int(rng.integers(0, 50)))
        made.add(rotations(angles).tobytes())
    assert len(made) == 1


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
