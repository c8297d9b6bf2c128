"""Times of the satellite systems, all taken to GPS time: seconds since 1980-01-06 00:00, without leap seconds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...mobile.gps_time import EPOCH, WEEK
from ...wording import say

DAY = 86400.0
UNIX_START = 315964800.0
"""The start of GPS time in seconds of Unix time."""

BEIDOU_OFFSET = 14.0
"""GPS time less BeiDou time, s."""

# Days on which UTC fell back by one more second, from 1980 on (IERS Bulletin C).
_LEAP_DAYS = np.array(["1981-07-01", "1982-07-01", "1983-07-01", "1985-07-01", "1988-01-01", "1990-01-01",
                       "1991-01-01", "1992-07-01", "1993-07-01", "1994-07-01", "1996-01-01", "1997-07-01",
                       "1999-01-01", "2006-01-01", "2009-01-01", "2012-07-01", "2015-07-01", "2017-01-01"],
                      "datetime64[D]")

_SCALES = {"GPS": "gps", "GAL": "gps", "QZS": "gps", "IRN": "gps", "BDT": "beidou", "BDS": "beidou", "GLO": "utc",
           "UTC": "utc"}


def calendar_seconds(year, month, day, hour, minute, second) -> np.ndarray:
    """Seconds since 1980-01-06 of a calendar time, in its own scale; arrays or numbers; years may have two digits."""
    year = np.asarray(year, np.int64)
    year = np.where(year < 80, year + 2000, np.where(year < 100, year + 1900, year))
    months = (year - 1970) * 12 + np.asarray(month, np.int64) - 1
    days = months.astype("datetime64[M]").astype("datetime64[D]") + (np.asarray(day, np.int64) - 1)
    whole = (days - EPOCH).astype(np.int64) * 86400 + np.asarray(hour, np.int64) * 3600
    return whole + np.asarray(minute, np.int64) * 60 + np.asarray(second, float)


def leap_seconds(utc: np.ndarray) -> np.ndarray:
    """GPS time less UTC, s, at times in seconds since 1980-01-06 counted in UTC's calendar."""
    starts = (_LEAP_DAYS - EPOCH).astype(np.int64) * 86400
    return np.searchsorted(starts, np.asarray(utc, float), side="right").astype(float)


def known_scale(scale: str) -> bool:
    """Whether a time scale of RINEX or SP3 ("GPS", "GLO", "BDT" ...) is known."""
    return scale in _SCALES


def to_gps(seconds: np.ndarray, scale: str) -> np.ndarray:
    """GPS seconds of calendar seconds (`calendar_seconds`) in a scale as RINEX names it: GPS, GLO, GAL, QZS, BDT, UTC.

    GLONASS files count in UTC. Raises KeyError for an unknown scale (see `known_scale`).
    """
    kind = _SCALES[scale]
    seconds = np.asarray(seconds, float)
    if kind == "utc":
        return seconds + leap_seconds(seconds)
    return seconds + BEIDOU_OFFSET if kind == "beidou" else seconds


def nearest_week(seconds_of_week: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Seconds since 1980-01-06 of seconds of week, in the week that brings them nearest to `near` (full seconds)."""
    return seconds_of_week + WEEK * np.round((near - seconds_of_week) / WEEK)


def calendar_text(gps: float) -> str:
    """A GPS time (full seconds) for a sentence: "2019-04-28 12:44:34"."""
    return str(EPOCH.astype("datetime64[s]") + int(np.floor(gps))).replace("T", " ")


def span_text(first: float, last: float) -> str:
    """A span of GPS time for a sentence: "2019-04-28 12:44:34 to 13:13:53"."""
    start, end = calendar_text(first), calendar_text(last)
    return f"{start} to {end[11:] if start[:10] == end[:10] else end}"


def spans_text(spans: Sequence[tuple[float, float]], most: int = 3) -> str:
    """Several spans of GPS time for a sentence, the first `most` of them."""
    text = ", and ".join(span_text(*span) for span in spans[:most])
    return text + say(" and {count} more", count=len(spans) - most) if len(spans) > most else text
