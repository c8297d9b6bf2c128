"""Outlines' dates against the flight's."""

from datetime import date

import laspy
import numpy as np
import pytest

from urbanmap_qgis.buildings.outlines.outline_dates import dated_outlines, flight_days, meant_days
from urbanmap_qgis.io.points.pointcloud import open_cloud

FLOWN = date(2020, 5, 2)
SECONDS = (FLOWN - date(1980, 1, 6)).days * 86_400 + 36_000 - 1e9  # ten in the morning, as LAS stores it


def flight(make_cloud, path, seconds=SECONDS, standard=True):
    times = seconds + np.linspace(0.0, 600.0, 50)
    file = make_cloud(path, np.arange(50.0), np.arange(50.0), np.zeros(50), gps_time=times)
    with laspy.open(file) as reader:
        las = reader.read()
    las.header.global_encoding.gps_time_type = laspy.header.GpsTimeType(int(standard))
    las.write(file)
    return open_cloud([file])


@pytest.mark.parametrize("value, days", [
    ("2023-10-01", ("2023-10-01", "2023-10-01")), ("2023/10/01 09:30", ("2023-10-01", "2023-10-01")),
    ("20231001", ("2023-10-01", "2023-10-01")), ("2023-02", ("2023-02-01", "2023-02-28")),
    ("2023-12", ("2023-12-01", "2023-12-31")), (1935, ("1935-01-01", "1935-12-31")),
    (1935.0, ("1935-01-01", "1935-12-31")), (date(2020, 2, 29), ("2020-02-29", "2020-02-29"))])
def test_days_that_a_date_may_mean(value, days):
    assert meant_days(value) == tuple(map(date.fromisoformat, days))


@pytest.mark.parametrize("value", [None, float("nan"), "", "unknown", "2023-13", "0000", "20231", "2023-02-30", 12])
def test_what_is_no_date(value):
    assert meant_days(value) is None


def test_flight_tells_its_day_by_full_times_only(make_cloud, tmp_path):
    assert flight_days(flight(make_cloud, tmp_path / "a.laz")) == (FLOWN, FLOWN)
    assert flight_days(flight(make_cloud, tmp_path / "b.laz", standard=False)) is None
    assert flight_days(flight(make_cloud, tmp_path / "week.laz", seconds=1000.0)) is None
    assert flight_days(open_cloud([make_cloud(tmp_path / "none.las", [0.0], [0.0], [0.0], point_format=0)])) is None


def test_buildings_that_the_flight_cannot_show_are_told(make_cloud, tmp_path):
    columns = {"LFSPANFR": ["2019-01-01", "2020-05-03", "2020", None, "2010-01-01"],
               "lfSpanTo": [None, "", "2020-05-01", None, "2020-05-02"]}
    dates = dated_outlines(flight(make_cloud, tmp_path / "a.laz"), columns, 5)
    assert dates.younger.tolist() == [False, True, False, False, False]
    assert dates.gone.tolist() == [False, False, True, False, False]
    notes = dates.notes(np.array([9, 9, 9, 0, 0]))
    assert "2020-05-03, after the flight of 2020-05-02" in notes[1]
    assert "ended on 2020-05-01, before the flight" in notes[2]
    assert [bool(note) for note in notes] == [False, True, True, False, False]


def test_date_of_a_whole_map_is_told_where_nothing_stands_only(make_cloud, tmp_path):
    dates = dated_outlines(flight(make_cloud, tmp_path / "a.laz"), {"lfSpanFr": ["2023-10-01"] * 3}, 3)
    assert [bool(note) for note in dates.notes(np.array([40, 0, 7]))] == [False, True, False]


def test_nothing_is_said_where_a_date_is_not_known(make_cloud, tmp_path):
    unknown = dated_outlines(flight(make_cloud, tmp_path / "b.laz", standard=False), {"lfSpanFr": ["2023-10-01"]}, 1)
    assert not unknown.younger.any() and unknown.notes(np.array([0])) == [""]
    bare = dated_outlines(flight(make_cloud, tmp_path / "a.laz"), {}, 2)
    assert not bare.younger.any() and not bare.gone.any() and bare.notes(np.zeros(2)) == ["", ""]
