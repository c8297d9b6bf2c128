"""Dates of outlines against the flight: a building that did not stand yet, or no more, shows no roof in the points.

Only clouds with full GPS times tell when they were flown; the date in a file's header is that of the file.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date, timedelta

import numpy as np

from ...errors import InputError
from ...io.points.pointcloud import PointCloud
from ...mobile.gps_time import ADJUSTMENT, EPOCH, WEEK, sampled_span
from ...wording import say

BEGINS = ("lfSpanFr", "yearOfConstruction", "oorspronkelijkbouwjaar", "start_date", "date_app")
"""Fields of the day or year from which a building stands: GSI, CityGML, BAG, OpenStreetMap, BD TOPO."""

ENDS = ("lfSpanTo", "yearOfDemolition", "end_date")
"""Fields of the day or year up to which it stood: GSI, CityGML, OpenStreetMap."""

_DAY = re.compile(r"\s*(\d{4})(?:[-/.]?(\d{2})[-/.]?(\d{2})|[-/.](\d{2}))?(?!\d)")


@dataclass(frozen=True)
class DatedOutlines:
    """What the dates say of n outlines.

    Attributes
    ----------
    flown : first and last day of the flight; None where the cloud does not tell.
    begins, ends : (n,) the first and last day that the building's begin and end may mean; None where not known.
    """

    flown: tuple[date, date] | None
    begins: tuple[tuple[date, date] | None, ...]
    ends: tuple[tuple[date, date] | None, ...]

    @property
    def younger(self) -> np.ndarray:
        """(n,) whether the building is dated after the flight."""
        return np.array([bool(self.flown and days and days[0] > self.flown[1]) for days in self.begins], bool)

    @property
    def gone(self) -> np.ndarray:
        """(n,) whether the building's end is dated before the flight."""
        return np.array([bool(self.flown and days and days[1] < self.flown[0]) for days in self.ends], bool)

    def notes(self, points: np.ndarray) -> list[str]:
        """(n,) sentences on buildings that the flight cannot show, empty for the others; `points` (n,) of each.

        Where most outlines are younger than the flight the date is that of the map, not of the buildings: then it is
        told of those without points only.
        """
        younger, gone = self.younger, self.gone
        telling = younger & ((points == 0) | (2 * younger.sum() < sum(days is not None for days in self.begins)))
        return [_younger(begin, self.flown) if new else _gone(end, self.flown) if old else ""
                for new, old, begin, end in zip(telling, gone, self.begins, self.ends)]


def dated_outlines(cloud: PointCloud, columns: Mapping[str, Sequence], count: int) -> DatedOutlines:
    """The dates that `count` outlines with these attribute columns have, against the cloud's flight."""
    names = {name.lower(): name for name in columns}

    def days(fields: tuple[str, ...]) -> tuple[tuple[date, date] | None, ...]:
        given = [columns[names[field.lower()]] for field in fields if field.lower() in names]
        return tuple(next(filter(None, (meant_days(column[row]) for column in given)), None) for row in range(count))

    return DatedOutlines(flight_days(cloud), days(BEGINS), days(ENDS))


def flight_days(cloud: PointCloud) -> tuple[date, date] | None:
    """First and last day (UTC) of the points by their full GPS times; None where they have none."""
    if int(cloud.headers[0].global_encoding.gps_time_type) != 1:
        return None
    try:
        first, last = sampled_span(cloud)
    except InputError:  # no times, or all of them 0: such a cloud tells no date
        return None
    if 0.0 <= first < WEEK:  # seconds of the week under a header that promises more
        return None
    return tuple(EPOCH.astype(date) + timedelta(seconds=second + ADJUSTMENT) for second in (first, last))


def meant_days(value: object) -> tuple[date, date] | None:
    """First and last day that a date, a year and month, or a year alone may mean; None where it is none of them."""
    if value is None or value != value:
        return None
    if isinstance(value, date):
        return value, value
    found = _DAY.match(str(int(value)) if isinstance(value, (float, np.floating)) else str(value))
    if not found:
        return None
    year, month, day, only_month = found.groups()
    try:
        if day:
            return (date(int(year), int(month), int(day)),) * 2
        return _month(int(year), int(only_month or 0))
    except ValueError:  # such as month 13, or the year 0000
        return None


def _month(year: int, month: int) -> tuple[date, date]:
    """First and last day of a month, or of the whole year where it is 0."""
    after = date(year + (month in (0, 12)), month % 12 + 1 if month else 1, 1)
    return date(year, month or 1, 1), after - timedelta(days=1)


def _younger(begin: tuple[date, date], flown: tuple[date, date]) -> str:
    return say("its outline is dated {begin}, after the flight of {flown}: what the points show may be what stood "
               "there before", begin=begin[0].isoformat(), flown=flown[1].isoformat())


def _gone(end: tuple[date, date], flown: tuple[date, date]) -> str:
    return say("its outline ended on {end}, before the flight of {flown}: the building may be gone",
               end=end[1].isoformat(), flown=flown[0].isoformat())
