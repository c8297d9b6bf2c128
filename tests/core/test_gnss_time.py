"""Time scales against Python's calendar and published leap seconds."""

from __future__ import annotations

from datetime import datetime

import numpy as np
import pytest

from urbanmap_qgis.gnss.rinex.gnss_time import (
    WEEK,
    calendar_seconds,
    calendar_text,
    leap_seconds,
    nearest_week,
    span_text,
    to_gps,
)


def by_calendar(*parts: int) -> float:
    return (datetime(*parts) - datetime(1980, 1, 6)).total_seconds()


def test_calendar_against_python():
    rng = np.random.default_rng(1)
    year, month, day = rng.integers(1980, 2079, 500), rng.integers(1, 13, 500), rng.integers(1, 29, 500)
    hour, minute, second = rng.integers(0, 24, 500), rng.integers(0, 60, 500), rng.integers(0, 60, 500)
    expected = [by_calendar(*(int(part) for part in parts)) for parts in zip(year, month, day, hour, minute, second)]
    assert np.array_equal(calendar_seconds(year, month, day, hour, minute, second + 0.25), np.array(expected) + 0.25)
    assert np.array_equal(calendar_seconds(year % 100, month, day, hour, minute, second), expected)


def test_seconds_and_minutes_run_over():
    assert calendar_seconds(2019, 12, 31, 23, 59, 60.0) == by_calendar(2020, 1, 1)


@pytest.mark.parametrize("day, leap", [((1980, 2, 1), 0), ((1999, 1, 1), 13), ((2005, 12, 31), 13), ((2006, 1, 1), 14),
                                       ((2016, 12, 31), 17), ((2017, 1, 1), 18), ((2024, 6, 1), 18)])
def test_leap_seconds(day, leap):
    utc = by_calendar(*day)
    assert leap_seconds(np.array([utc])) == leap
    assert to_gps(utc, "GLO") == utc + leap == to_gps(utc, "UTC")


def test_scales():
    assert to_gps(100.0, "BDT") == 114.0
    assert to_gps(100.0, "GAL") == to_gps(100.0, "QZS") == to_gps(100.0, "GPS") == 100.0
    with pytest.raises(KeyError):
        to_gps(100.0, "XYZ")


def test_nearest_week_over_its_end():
    near = np.array([2051 * WEEK + 10.0, 2051 * WEEK + WEEK - 10.0])
    assert np.array_equal(nearest_week(np.array([604799.0, 1.0]), near), [2051 * WEEK - 1.0, 2052 * WEEK + 1.0])


def test_texts():
    first = by_calendar(2019, 4, 28, 12, 44, 34)
    assert calendar_text(first + 0.9) == "2019-04-28 12:44:34"
    assert span_text(first, first + 60) == "2019-04-28 12:44:34 to 12:45:34"
    assert span_text(first, first + 86400) == "2019-04-28 12:44:34 to 2019-04-29 12:44:34"
