"""Ways of counting angles are told by the direction of travel; a geoid lowers the heights of SBET."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.conversion.geoid import Geoid
from urbanmap_qgis.io.conversion.height_conversion import height_conversion
from urbanmap_qgis.io.reference.height_systems import HeightSystem
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory, write_trajectory
from urbanmap_qgis.mobile.trajectory_reading import ANGLES, TrajectoryReading, from_file_angles, to_file_angles

ZONE = CRS.from_epsg(6677).to_wkt()


def drive(course=40.0, turn=90.0, n=400):
    """A drive of 100 m that turns by `turn` degrees."""
    heading = course + np.linspace(0.0, turn, n)
    step = 0.25 * np.column_stack([np.sin(np.radians(heading)), np.cos(np.radians(heading))])
    place = np.column_stack([np.cumsum(step, axis=0), np.full(n, 5.0)])
    time = 100.0 + 0.02 * np.arange(n)
    return Trajectory(time, place, np.column_stack([np.full(n, 1.5), np.full(n, -2.0), heading]))


def written(path, trajectory, counted):
    angles = to_file_angles(trajectory.angles, counted)
    rows = [",".join(f"{value:.8f}" for value in row) for row in
            np.column_stack([trajectory.time, trajectory.place, angles])]
    path.write_text("time,x,y,z,roll,pitch,heading\n" + "\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize("counted", ANGLES)
def test_angles_come_back_as_they_were_counted(counted):
    angles = np.array([[1.0, -2.0, 350.0], [0.0, 3.0, 10.0]])
    assert np.allclose(from_file_angles(to_file_angles(angles, counted), counted), angles)


@pytest.mark.parametrize("counted", ANGLES[1:])
@pytest.mark.parametrize(("course", "turn"), [(40.0, 90.0), (0.0, 300.0), (180.0, 0.0), (100.0, 2.0)])
def test_another_way_of_counting_is_refused_and_read_when_it_is_stated(tmp_path, counted, course, turn):
    true = drive(course, turn)
    path = written(tmp_path / "a.csv", true, counted)
    with pytest.raises(InputError, match=f"beside the direction of travel.*{counted.split('_')[0]}"):
        read_trajectory(path)
    read = read_trajectory(path, reading=TrajectoryReading(counted))
    assert np.allclose(np.cos(np.radians(read.trajectory.angles - true.angles)), 1.0, atol=1e-9) and not read.notes
    write_trajectory(tmp_path / "b.csv", read, read.trajectory)
    first, second = (np.loadtxt(tmp_path / name, delimiter=",", skiprows=1) for name in ("a.csv", "b.csv"))
    turned = 2 * np.pi if counted.startswith("radians") else 360.0
    difference = (second[:, 4:] - first[:, 4:] + turned / 2) % turned - turned / 2
    assert np.abs(difference).max() < 2e-6


@pytest.mark.parametrize("course", [0.0, 45.0, 190.0, 300.0])
def test_degrees_from_north_are_taken_without_a_word(tmp_path, course):
    assert not read_trajectory(written(tmp_path / "a.csv", drive(course), "degrees")).notes


def test_degrees_that_are_said_to_be_radians_are_refused(tmp_path):
    path = written(tmp_path / "a.csv", drive(), "degrees")
    with pytest.raises(InputError, match="are no radians"):
        read_trajectory(path, reading=TrajectoryReading("radians"))


def test_backwards_and_sidewards_are_told(tmp_path):
    true = drive()
    for turned, sentence in ((180.0, "drove backwards"), (70.0, "70° beside the direction of travel")):
        angles = true.angles + np.array([0, 0, turned])
        path = written(tmp_path / f"{turned}.csv", Trajectory(true.time, true.place, angles), "degrees")
        note, = read_trajectory(path).notes
        assert sentence in note


@pytest.mark.parametrize("heading", [0.0, 40.0])
def test_a_file_without_attitude_is_told(tmp_path, heading):
    true = drive()
    still = Trajectory(true.time, true.place, np.full_like(true.angles, (0.0, 0.0, heading)))
    note, = read_trajectory(written(tmp_path / "a.csv", still, "degrees")).notes
    assert "holds no attitude" in note


def sbet(path, heading_unit=1.0):
    n = 60
    table = np.zeros((n, 17))
    table[:, 0] = 100.0 + 0.1 * np.arange(n)
    table[:, 1], table[:, 2], table[:, 3] = np.radians(35.69 + np.arange(n) * 1e-5), np.radians(139.75), 50.0
    table[:, 9] = np.radians(200.0) * heading_unit if heading_unit != 1.0 else 0.0
    table.astype("<f8").tofile(path)
    return path


def test_a_geoid_lowers_sbet_and_is_put_back(tmp_path):
    geoid = Geoid("a model", np.array([[36.0, 37.0], [36.0, 37.0]]), 35.0, 139.0, (1.0, 1.0))
    read = read_trajectory(sbet(tmp_path / "a.out"), ZONE, TrajectoryReading(geoid=geoid))
    assert np.allclose(read.trajectory.place[:, 2], 50.0 - 36.75, atol=1e-6)
    assert "lowered by 36.750 to 36.750 m" in read.applied and "a model" in read.applied
    write_trajectory(tmp_path / "b.out", read, read.trajectory)
    first, second = (np.fromfile(tmp_path / name, "<f8").reshape(-1, 17) for name in ("a.out", "b.out"))
    assert np.allclose(first, second, atol=1e-9, rtol=0)


def test_a_geoid_says_that_it_leaves_other_heights(tmp_path):
    path = written(tmp_path / "a.csv", drive(), "degrees")
    read = read_trajectory(path, reading=TrajectoryReading(geoid=Geoid.constant(36.0)))
    assert np.allclose(read.trajectory.place[:, 2], 5.0) and "SBET only" in read.notes[0]


def test_sbet_with_degrees_is_refused(tmp_path):
    with pytest.raises(InputError, match="its angles are no radians"):
        read_trajectory(sbet(tmp_path / "a.out", 57.3), ZONE)


@pytest.mark.parametrize(("reverse", "change"), [(False, 0.4), (True, -0.4)])
def test_corrections_between_foreign_heights_go_as_they_are_told(reverse, change):
    grid = Geoid("0.4", np.array([[0.4]]))
    systems = HeightSystem("other", 5709, "NAP height"), HeightSystem("other", 7837, "DHHN2016 height")
    found = height_conversion(CRS.from_epsg(25832).to_wkt(), *systems, grid, reverse)
    assert found.heights([500_000.0], [5_600_000.0]) == pytest.approx([change])


def test_corrections_between_japanese_heights_go_by_their_age():
    grid, older, newer = Geoid("0.4", np.array([[0.4]])), HeightSystem("JGD2011"), HeightSystem("JGD2024")
    wkt = CRS.from_epsg(6677).to_wkt()
    assert height_conversion(wkt, older, newer, grid).heights([0.0], [0.0]) == pytest.approx([0.4])
    assert height_conversion(wkt, newer, older, grid).heights([0.0], [0.0]) == pytest.approx([-0.4])
    with pytest.raises(InputError, match="Against the grid"):
        height_conversion(wkt, older, newer, grid, reverse=True)


# One wrong row of a trajectory is named, and costs no memory


HEADER = "time,x,y,z,roll,pitch,heading"


def write(path, rows):
    path.write_text("\n".join([HEADER, *(",".join(f"{value:.4f}" for value in row) for row in rows)]), encoding="utf-8")
    return path


def rows_of_a_drive():
    time = 100.0 + 0.01 * np.arange(2000)
    return np.column_stack([time, -7000 + 12 * (time - 100), np.full(2000, -35000.0), np.full(2000, 10.0),
                            np.zeros((2000, 2)), np.full(2000, 90.0)])


@pytest.mark.parametrize("row", [0, 1, 700, 1998, 1999])
@pytest.mark.parametrize("column", [1, 2, 3])
@pytest.mark.parametrize("value", [99_999_999.0, -1e15, 1e300])
def test_a_place_where_no_vehicle_can_be_is_named(tmp_path, row, column, value):
    rows = rows_of_a_drive()
    rows[row, column] = value
    tracemalloc.start()
    with pytest.raises(InputError, match=rf"t\.csv: row {row + 2} .*km from its neighbour"):
        read_trajectory(write(tmp_path / "t.csv", rows))
    assert tracemalloc.get_traced_memory()[1] < 50e6
    tracemalloc.stop()


@pytest.mark.parametrize("value", [1e9, 1e15, -1e9])
def test_a_time_weeks_away_is_named_also_in_a_file_out_of_order(tmp_path, value):
    rows = rows_of_a_drive()
    rows[700, 0] = value
    with pytest.raises(InputError, match=r"row 702 lies more than a week"):
        read_trajectory(write(tmp_path / "t.csv", rows))


@pytest.mark.parametrize(("column", "value"), [(4, 1e12), (5, -1e300), (6, 100_001.0)])
def test_an_angle_that_is_none_is_named(tmp_path, column, value):
    rows = rows_of_a_drive()
    rows[700, column] = value
    with pytest.raises(InputError, match=r"t\.csv: row 702 .*has an angle of .* degrees, which no vehicle has"):
        read_trajectory(write(tmp_path / "t.csv", rows))
    rows[:, 4:] = [0.0, 0.0, 90.0 + 360.0 * 20]  # counted on over twenty turns
    assert len(read_trajectory(write(tmp_path / "t.csv", rows)).trajectory) == 2000


def test_what_navigation_does_is_let_pass(tmp_path):
    rows = rows_of_a_drive()
    rows[1000:, 1] += 8.0  # it starts anew, in 10 ms
    rows[1500:, 0] += 86_400.0  # a night's rest
    rows[1500:, 1] += 40_000.0  # on another side of the town
    file = read_trajectory(write(tmp_path / "t.csv", rows))
    assert len(file.trajectory) == 2000 and any("jumps" in note for note in file.notes)
