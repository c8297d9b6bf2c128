"""Trajectory files: CSV and SBET read, checked and written back; calibrations; image poses; time matching."""

import json

import laspy
import numpy as np
import pytest
from pyproj import CRS, Transformer

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.calibration import read_calibration, scanner_of, scanner_positions
from urbanmap_qgis.mobile.gps_time import shift_between, time_shift
from urbanmap_qgis.mobile.image_poses import move_images, read_image_poses, write_image_poses
from urbanmap_qgis.mobile.trajectory import Trajectory, body_to_map
from urbanmap_qgis.mobile.trajectory_files import read_trajectory, trajectory_from_columns, write_trajectory

HEAD = "time,x,y,z,roll,pitch,heading\n"
ROWS = ["10.0,1,2,3,0,0,359", "10.1,2,2,3,0,0,1", "10.2,3,2,3,0,0,3"]
ZONE = CRS.from_epsg(6677).to_wkt()


def csv_file(folder, rows, head=HEAD, name="軌跡.csv"):
    path = folder / name
    path.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")
    return path


def test_csv_is_read_and_written_back(tmp_path):
    read = read_trajectory(csv_file(tmp_path, ROWS))
    assert np.allclose(read.trajectory.angles[:, 2], [359, 361, 363])
    write_trajectory(tmp_path / "out.csv", read, read.trajectory)
    again = read_trajectory(tmp_path / "out.csv")
    assert np.array_equal(again.trajectory.place, read.trajectory.place)
    assert (tmp_path / "out.csv").read_text().startswith(HEAD)


def test_other_columns_delimiters_and_names_are_kept(tmp_path):
    rows = [row.replace(",", ";") + f";q{number}" for number, row in enumerate(ROWS)]
    path = csv_file(tmp_path, rows, "GPSTime;Easting;Northing;Height;Roll;Pitch;Yaw;quality\n")
    read = read_trajectory(path)
    moved = Trajectory(read.trajectory.time, read.trajectory.place + 1.0, read.trajectory.angles)
    write_trajectory(tmp_path / "out.csv", read, moved)
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[0] == "GPSTime;Easting;Northing;Height;Roll;Pitch;Yaw;quality"
    assert lines[2] == "10.100000;3.0000;3.0000;4.0000;0.000000;0.000000;1.000000;q1"


def test_rows_out_of_order_and_repeated_epochs_are_put_right_and_told(tmp_path):
    read = read_trajectory(csv_file(tmp_path, [ROWS[1], ROWS[0], ROWS[2], ROWS[2]]))
    assert np.allclose(read.trajectory.time, [10.0, 10.1, 10.2])
    assert any("out of order" in note for note in read.notes) and any("repeated" in note for note in read.notes)


@pytest.mark.parametrize(("rows", "head", "sentence"), [
    (ROWS, "time,x,y,z,roll,pitch,course\n", "has no column heading"),
    ([*ROWS, "10.3,4,2"], HEAD, "row 5 has 3 values"),
    ([*ROWS, "10.3,4,2,x,0,0,0"], HEAD, "is no number"),
    ([*ROWS, "10.3,4,2,nan,0,0,0"], HEAD, "has no number in row 5"),
    ([*ROWS, "10.2,9,9,3,0,0,3"], HEAD, r"two different poses for the time 10\.2000"),
    ([f"{10 + k // 5},{k},2,3,0,0,90" for k in range(20)], HEAD, "times of .* are rounded to 1 s: 16 epochs"),
    (ROWS[:1], HEAD, "at least two"),
    ([], "", "has no column time"),
])
def test_bad_csv_is_one_sentence(tmp_path, rows, head, sentence):
    with pytest.raises(InputError, match=sentence):
        read_trajectory(csv_file(tmp_path, rows, head))


def test_gap_and_jump_are_noted(tmp_path):
    notes = read_trajectory(csv_file(tmp_path, [*ROWS, "15.0,4,2,3,0,0,3", "15.1,400,2,3,0,0,3"])).notes
    assert any("no epochs for more than a second at 10.20 to 15.00 s" in note for note in notes)
    assert any("jumps at 15.00 to 15.10 s" in note for note in notes)


def sbet(path, longitude, latitude, heading):
    table = np.zeros((len(longitude), 17))
    table[:, 0] = 100.0 + np.arange(len(longitude))
    table[:, 1], table[:, 2], table[:, 3] = np.radians(latitude), np.radians(longitude), 50.0
    table[:, 9] = np.radians(heading)
    table[:, 4] = 7.5
    table.astype("<f8").tofile(path)
    return path


def test_sbet_lies_where_projection_puts_it_and_heads_as_the_points_say(tmp_path):
    """A drive due true north: the heading from the grid is that of the line between the projected points."""
    latitude = 35.69 + np.arange(5) * 1e-4
    read = read_trajectory(sbet(tmp_path / "a.out", np.full(5, 139.2), latitude, np.zeros(5)), ZONE)
    x, y = Transformer.from_crs(6668, 6677, always_xy=True).transform(np.full(5, 139.2), latitude)
    assert np.allclose(read.trajectory.place, np.column_stack([x, y, np.full(5, 50.0)]), atol=1e-4)
    drawn = np.degrees(np.arctan2(np.diff(x), np.diff(y)))
    assert np.allclose(read.trajectory.angles[:4, 2], drawn, atol=1e-4)
    assert abs(drawn[0]) > 0.3


def test_sbet_carries_the_accuracies_of_its_rms_file(tmp_path):
    path = sbet(tmp_path / "sbet_drive.out", 139.75 + np.zeros(5), 35.69 + 1e-6 * np.arange(5), np.zeros(5))
    time = read_trajectory(path, ZONE).trajectory.time
    np.array([[t, *[1.0] * 6, 0.6, 0.6, 1.8] for t in time]).tofile(tmp_path / "smrmsg_drive.out")
    read = read_trajectory(path, ZONE)
    np.testing.assert_allclose(read.trajectory.angle_sigma, np.tile([0.01, 0.01, 0.03], (len(time), 1)))
    assert "smrmsg_drive.out states the accuracy" in read.applied


def test_sbet_is_written_back_as_sbet(tmp_path):
    rng = np.random.default_rng(0)
    path = sbet(tmp_path / "a.out", 139.75 + rng.uniform(0, 0.01, 20), 35.69 + rng.uniform(0, 0.01, 20),
                rng.uniform(-180, 180, 20))
    read = read_trajectory(path, ZONE)
    write_trajectory(tmp_path / "b.out", read, read.trajectory)
    first, second = (np.fromfile(name, "<f8").reshape(-1, 17) for name in (path, tmp_path / "b.out"))
    assert np.allclose(first, second, atol=1e-11, rtol=0)


@pytest.mark.parametrize(("size", "sentence"), [(100, "cut off"), (0, "cut off")])
def test_sbet_of_a_wrong_length(tmp_path, size, sentence):
    (tmp_path / "a.out").write_bytes(b"\0" * size)
    with pytest.raises(InputError, match=sentence):
        read_trajectory(tmp_path / "a.out", ZONE)


def test_sbet_needs_a_crs(tmp_path):
    with pytest.raises(InputError, match="coordinate reference system"):
        read_trajectory(sbet(tmp_path / "a.out", np.zeros(3), np.zeros(3), np.zeros(3)))


def test_columns_of_a_layer():
    columns = {"Time": [1, 2], "X": [0.0, 1.0], "Y": [0, 0], "Z": [5, 5], "roll": [0, 0], "pitch": [0, 0],
               "heading": [90, 90], "mode": ["a", "b"]}
    read = trajectory_from_columns(columns, "layer")
    assert read.format == "layer" and read.columns == {"mode": ["a", "b"]}


# Calibration

def calibration(folder, content):
    path = folder / "calibration.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def test_scanner_lies_at_its_lever_arm(tmp_path):
    path = calibration(tmp_path, {"scanners": [
        {"id": 1, "point_source_id": 7, "lever_arm_m": [1.0, 0.5, -0.2], "pitch": -25.0, "max_range": 60}]})
    scanner = scanner_of(read_calibration(path), 7)
    assert scanner.max_range == 60.0 and np.allclose(scanner.angles, [0, -25, 0])
    drive = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([0.0, 0.0, 90.0], (2, 1)))
    assert np.allclose(scanner_positions(drive, scanner, np.array([0.5])), [[1.0, -0.5, 0.2]])


@pytest.mark.parametrize(("content", "sentence"), [
    ("{", "cannot be read as a calibration"),
    ({"lasers": []}, "needs an entry"),
    ({"scanners": [{"id": 1}]}, "lever_arm_m"),
    ({"scanners": [{"id": 1, "lever_arm_m": [950, 0, 0]}]}, "must be in metres"),
    ({"scanners": [{"id": 1, "lever_arm_m": [1, 0, 0], "roll": "x"}]}, "“roll” of 1 is no number"),
])
def test_bad_calibration_is_one_sentence(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read_calibration(calibration(tmp_path, content))


@pytest.mark.parametrize("cameras", [
    {"camera": {"id": "front", "lever_arm_m": "lost"}}, {"camera": None}, {"cameras": "none"},
    {"cameras": [{"id": 1}, {"id": 2, "lever_arm_m": [0, 0, 0]}]}])
def test_a_damaged_camera_does_not_keep_the_scanners_from_being_read(tmp_path, cameras):
    read = read_calibration(calibration(tmp_path, {"scanners": [{"id": 1, "lever_arm_m": [0, 0, 0]}], **cameras}))
    assert scanner_of(read, 1).id == "1" and len(read.damaged_cameras) == 1
    assert [camera.id for camera in read.cameras] == (["2"] if isinstance(cameras.get("cameras"), list) else [])


def test_unknown_scanner_is_refused(tmp_path):
    path = calibration(tmp_path, {"scanners": [{"id": 1, "lever_arm_m": [0, 0, 0]}]})
    with pytest.raises(InputError, match=r"point source id 3 \(it has: 1\)"):
        scanner_of(read_calibration(path), 3)


# Time

def drive_from(start):
    time = start + np.arange(101.0)
    return Trajectory(time, np.zeros((101, 3)), np.zeros((101, 3)))


def timed_cloud(make_cloud, folder, start, standard=False):
    time = start + np.linspace(0, 90, 50)
    path = make_cloud(folder / "t.laz", np.zeros(50), np.zeros(50), np.zeros(50), gps_time=time)
    if standard:
        las = laspy.read(path)
        las.header.global_encoding.gps_time_type = laspy.header.GpsTimeType.STANDARD
        las.write(path)
    return open_cloud([path])


FULL = 2_341 * 604_800.0 + 361_400.0


@pytest.mark.parametrize(("cloud_start", "standard", "drive_start", "shift"), [
    (361_400.0, False, 361_395.0, 0.0),
    (FULL - 1e9, True, FULL - 1e9, 0.0),
    (FULL - 1e9, True, 361_400.0, 361_400.0 - (FULL - 1e9)),
    (361_400.0, False, FULL - 1e9, FULL - 1e9 - 361_400.0),
    (FULL - 1e9, True, FULL, 1e9),
    (20.0, False, 604_810.0, 604_800.0),
])
def test_ways_of_counting_gps_time_are_matched(make_cloud, tmp_path, cloud_start, standard, drive_start, shift):
    cloud = timed_cloud(make_cloud, tmp_path, cloud_start, standard)
    assert time_shift(cloud, drive_from(drive_start)) == pytest.approx(shift, abs=1e-3)


def test_no_overlap_is_refused_with_both_spans(make_cloud, tmp_path):
    cloud = timed_cloud(make_cloud, tmp_path, 1000.0)
    with pytest.raises(InputError, match=r"measured from 1003.7 to 1086.3 s of the GPS week, but the trajectory runs"):
        time_shift(cloud, drive_from(5000.0))
    with pytest.raises(InputError, match="give those of one survey"):
        shift_between((0.0, 100.0), (60.0, 160.0), "The points")


def test_few_points_without_a_time_tell_nothing(make_cloud, tmp_path):
    """Zero and -1 as some programs write them: such points lie outside of the trajectory."""
    time = np.linspace(1000.0, 1090.0, 1000)
    time[::50], time[7::90] = 0.0, -1.0
    path = make_cloud(tmp_path / "t.laz", *np.zeros((3, 1000)), gps_time=time)
    assert time_shift(open_cloud([path]), drive_from(1000.0)) == 0.0


def test_points_without_time_are_refused(make_cloud, tmp_path):
    path = make_cloud(tmp_path / "t.laz", np.zeros(5), np.zeros(5), np.zeros(5), point_format=0)
    with pytest.raises(InputError, match="carry no GPS time"):
        time_shift(open_cloud([path]), drive_from(0.0))
    path = make_cloud(tmp_path / "z.laz", np.zeros(5), np.zeros(5), np.zeros(5))
    with pytest.raises(InputError, match="are zero"):
        time_shift(open_cloud([path]), drive_from(0.0))


# Image poses

def test_images_move_with_the_body_and_keep_their_columns(tmp_path):
    time = np.arange(3.0)
    reported = Trajectory(time, np.column_stack([10 * time, 0 * time, 0 * time]), np.tile([0, 0, 90.0], (3, 1)))
    corrected = Trajectory(time, reported.place + np.array([0.5, 1.0, -0.2]),
                           reported.angles + np.array([0, 0, 2.0]))
    at = np.array([0.5, 1.5])
    place = body_to_map(reported, at, np.array([1.0, 0.0, -0.3]))
    rows = [f"img_{k},{at[k]},{','.join(map(str, place[k]))},0,0,90,front" for k in range(2)]
    (tmp_path / "poses.csv").write_text("id,time,x,y,z,roll,pitch,heading,camera\n" + "\n".join(rows) + "\n")
    moved = move_images(read_image_poses(tmp_path / "poses.csv"), reported, corrected)
    assert np.allclose(moved.place, body_to_map(corrected, at, np.array([1.0, 0.0, -0.3])))
    assert np.allclose(moved.angles[:, 2], 92.0)
    write_image_poses(tmp_path / "out.csv", moved)
    again = read_image_poses(tmp_path / "out.csv")
    assert again.others == {"camera": ("front", "front")} and np.allclose(again.place, moved.place, atol=1e-4)
