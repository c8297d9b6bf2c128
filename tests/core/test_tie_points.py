"""Tie points from tables, and which of them can be used."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.lines.tie_points import ends_of, pairs_within, read_tie_points, tie_points_from_columns
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress

ROWS = "set,time,x_mms,y_mms,x_ref,y_ref\nb,12,1,2,3,4\nb,11,5,6,7,8\n角,3,9,10,11,12\n"
DRIVE = Trajectory(np.array([0.0, 1, 2, 3, 4, 10, 11, 12]), np.zeros((8, 3)), np.zeros((8, 3)))


def test_tables_are_read_in_the_order_of_time(tmp_path):
    for name, text in (("t.csv", ROWS), ("t.txt", ROWS.replace(",", ";")), ("b.csv", "﻿" + ROWS.upper())):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        ties = read_tie_points(path)
        assert ties.time.tolist() == [3, 11, 12] and ties.measured[0].tolist() == [9, 10]
        names, number = ties.numbers()
        assert [item.lower() for item in names] == ["角", "b"] and number.tolist() == [0, 1, 1]


def test_lines_run_from_survey_to_reference():
    ends = ends_of([shapely.LineString([(1, 2), (0, 0), (3, 4)]), shapely.from_wkt("MULTILINESTRING((5 6,7 8))"), None])
    np.testing.assert_array_equal(ends["x_mms"], [1, 5, np.nan])
    np.testing.assert_array_equal(ends["y_ref"], [4, 8, np.nan])


@pytest.mark.parametrize(("text", "sentence"), [
    ("set,time,x_mms,y_mms,x_ref\n1,2,3,4,5\n", "no column y_ref"), (ROWS.replace("5", "x"), "no number"),
    (ROWS.replace("5", ""), "no number"), ("set,time,x_mms,y_mms,x_ref,y_ref\n", "no tie points"),
    (ROWS.replace("11,12", "11"), "as many values"), (ROWS.replace("11,12", "11,500"), "set 角 survey and reference"),
])
def test_bad_tables(tmp_path, text, sentence):
    (tmp_path / "t.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=sentence):
        read_tie_points(tmp_path / "t.csv")


def ties_at(*times):
    count = len(times)
    return tie_points_from_columns({"set": [str(k) for k in range(count)], "time": times, **dict.fromkeys(
        ("x_mms", "y_mms", "x_ref", "y_ref"), [0.0] * count)})


def test_pairs_outside_the_time_or_in_gaps_are_left_out_and_told():
    told = []
    left = pairs_within(ties_at(-1.0, 2.5, 7.0, 11.0, 99.0), DRIVE, Progress(warn=told.append))
    assert left.time.tolist() == [2.5, 11.0]
    assert "2 tie points lie outside" in told[0] and "(set 0, 4)" in told[0] and "gap" in told[1]


def test_no_pair_within_the_time_is_refused():
    with pytest.raises(InputError, match="one survey"):
        pairs_within(ties_at(50.0, 60.0), DRIVE)
    with pytest.raises(InputError, match="gaps"):
        pairs_within(ties_at(7.0), DRIVE)


def test_times_of_the_week_and_adjusted_times_are_brought_together():
    """Tie points in adjusted standard time, the trajectory in seconds of the week."""
    start = 2200 * 604800.0 - 1e9
    told = []
    left = pairs_within(ties_at(start + 1.0, start + 2.5), DRIVE, Progress(warn=told.append))
    assert f"{-start:.0f} s were added" in told[0]
    np.testing.assert_allclose(left.time, [1.0, 2.5])
