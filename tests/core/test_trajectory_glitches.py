"""One wrong row of a trajectory is named, and costs no memory."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

HEADER = "time,x,y,z,roll,pitch,heading"


def write(path, rows):
    path.write_text("\n".join([HEADER, *(",".join(f"{value:.4f}" for value in row) for row in rows)]), encoding="utf-8")
    return path


def drive():
    time = 100.0 + 0.01 * np.arange(2000)
    return np.column_stack([time, -7000 + 12 * (time - 100), np.full(2000, -35000.0), np.full(2000, 10.0),
                            np.zeros((2000, 2)), np.full(2000, 90.0)])


@pytest.mark.parametrize("row", [0, 1, 700, 1998, 1999])
@pytest.mark.parametrize("column", [1, 2, 3])
@pytest.mark.parametrize("value", [99_999_999.0, -1e15, 1e300])
def test_a_place_where_no_vehicle_can_be_is_named(tmp_path, row, column, value):
    rows = drive()
    rows[row, column] = value
    tracemalloc.start()
    with pytest.raises(InputError, match=rf"t\.csv: row {row + 2} .*km from its neighbour"):
        read_trajectory(write(tmp_path / "t.csv", rows))
    assert tracemalloc.get_traced_memory()[1] < 50e6
    tracemalloc.stop()


@pytest.mark.parametrize("value", [1e9, 1e15, -1e9])
def test_a_time_weeks_away_is_named_also_in_a_file_out_of_order(tmp_path, value):
    rows = drive()
    rows[700, 0] = value
    with pytest.raises(InputError, match=r"row 702 lies more than a week"):
        read_trajectory(write(tmp_path / "t.csv", rows))


@pytest.mark.parametrize(("column", "value"), [(4, 1e12), (5, -1e300), (6, 100_001.0)])
def test_an_angle_that_is_none_is_named(tmp_path, column, value):
    rows = drive()
    rows[700, column] = value
    with pytest.raises(InputError, match=r"t\.csv: row 702 .*has an angle of .* degrees, which no vehicle has"):
        read_trajectory(write(tmp_path / "t.csv", rows))
    rows[:, 4:] = [0.0, 0.0, 90.0 + 360.0 * 20]  # counted on over twenty turns
    assert len(read_trajectory(write(tmp_path / "t.csv", rows)).trajectory) == 2000


def test_what_navigation_does_is_let_pass(tmp_path):
    rows = drive()
    rows[1000:, 1] += 8.0  # it starts anew, in 10 ms
    rows[1500:, 0] += 86_400.0  # a night's rest
    rows[1500:, 1] += 40_000.0  # on another side of the town
    file = read_trajectory(write(tmp_path / "t.csv", rows))
    assert len(file.trajectory) == 2000 and any("jumps" in note for note in file.notes)
