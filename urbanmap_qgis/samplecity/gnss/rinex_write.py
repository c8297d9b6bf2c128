"""Writes RINEX 3.04 observation and navigation files."""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from .atmosphere import ALPHA, BETA
from .orbits import TIME_OFFSET, Orbits

PROGRAM = "UrbanMap"
CODES = {"G": ("C1C", "S1C"), "E": ("C1C", "S1C"), "J": ("C1C", "S1C"), "C": ("C2I", "S2I")}
"""Code range and carrier to noise density of the simulated signal of each system."""

SECOND_CODES = {"G": "C2L", "E": "C5Q", "J": "C2L", "C": "C7I"}
"""Code range on the second band of each system, where the receiver has one."""

LEAP_SECONDS = 18
BEIDOU_WEEK = 1356
"""GPS week in which BeiDou time began."""

_GPS_START = datetime(1980, 1, 6)


def calendar(week: int, seconds: float) -> datetime:
    """Calendar time, in the time of the satellites, of a GPS week and its seconds."""
    return _GPS_START + timedelta(weeks=week, seconds=float(seconds))


def write_observations(path: Path, week: int, epochs: np.ndarray, satellite: np.ndarray, tracked: np.ndarray,
                       code: np.ndarray, strength: np.ndarray, approximate: np.ndarray, marker: str,
                       second_code: np.ndarray | None = None) -> None:
    """Write an observation file.

    Parameters
    ----------
    week, epochs : GPS week and (m,) its seconds by the receiver's clock.
    satellite : (n,) names such as "G05".
    tracked, code, strength : (m, n) whether there is an observation, code range (m), carrier to noise (dB-Hz).
    approximate : (3,) earth-fixed place of the antenna, m.
    marker : name of the survey.
    second_code : (m, n) code range on the second band, m.
    """
    lines = _observation_header(week, epochs, satellite[tracked.any(axis=0)], approximate, marker,
                                second_code is not None)
    for row, seconds in enumerate(epochs):
        seen = np.flatnonzero(tracked[row])
        lines.append(f"> {_epoch(calendar(week, seconds))}  0{len(seen):3d}")
        for column in seen:
            level = strength[row, column]
            digit = min(max(int(level // 6), 1), 9)
            second = "" if second_code is None else f"  {second_code[row, column]:14.3f}"
            lines.append(f"{satellite[column]}{code[row, column]:14.3f} {digit}{level:14.3f}{second}")
    path.write_bytes(("\n".join(lines) + "\n").encode("ascii"))


def _observation_header(week: int, epochs: np.ndarray, satellite: np.ndarray, approximate: np.ndarray,
                        marker: str, two_bands: bool) -> list[str]:
    codes = {name: (*kinds, SECOND_CODES[name]) if two_bands else kinds for name, kinds in CODES.items()}
    first, last = calendar(week, epochs[0]), calendar(week, epochs[-1])
    systems = [system for system in CODES if any(name[0] == system for name in satellite)]
    return [
        _header(f"{3.04:9.2f}           OBSERVATION DATA    M: Mixed", "RINEX VERSION / TYPE"),
        _header(f"{PROGRAM:<20}{'':<20}{first:%Y%m%d %H%M%S} GPS", "PGM / RUN BY / DATE"),
        _header("Simulated observations of the UrbanMap sample city", "COMMENT"),
        _header(marker, "MARKER NAME"),
        _header("GROUND_CRAFT", "MARKER TYPE"),
        _header(f"{'':<20}UrbanMap sample city", "OBSERVER / AGENCY"),
        _header(f"{'1':<20}{'simulated':<20}{'1':<20}", "REC # / TYPE / VERS"),
        _header(f"{'1':<20}{'simulated':<20}", "ANT # / TYPE"),
        _header("".join(f"{value:14.4f}" for value in approximate), "APPROX POSITION XYZ"),
        _header(f"{0:14.4f}{0:14.4f}{0:14.4f}", "ANTENNA: DELTA H/E/N"),
        *(_header(f"{system}  {len(codes[system]):3d}" + "".join(f" {code}" for code in codes[system]),
                  "SYS / # / OBS TYPES") for system in systems),
        _header("DBHZ", "SIGNAL STRENGTH UNIT"),
        _header(f"{1:10.3f}", "INTERVAL"),
        _header(_time_of(first), "TIME OF FIRST OBS"),
        _header(_time_of(last), "TIME OF LAST OBS"),
        *(_header(system, "SYS / PHASE SHIFT") for system in systems),
        _header(f"{LEAP_SECONDS:6d}", "LEAP SECONDS"),
        _header("", "END OF HEADER")]


def write_navigation(path: Path, week: int, records: Orbits) -> None:
    """Write a mixed navigation file; the records in the order of time and satellite."""
    first = calendar(week, records.toe.min())
    lines = [
        _header(f"{3.04:9.2f}           N: GNSS NAV DATA    M: MIXED", "RINEX VERSION / TYPE"),
        _header(f"{PROGRAM:<20}{'':<20}{first:%Y%m%d %H%M%S} GPS", "PGM / RUN BY / DATE"),
        _header("Simulated satellites of the UrbanMap sample city", "COMMENT"),
        _header("GPSA " + "".join(_short(value) for value in ALPHA), "IONOSPHERIC CORR"),
        _header("GPSB " + "".join(_short(value) for value in BETA), "IONOSPHERIC CORR"),
        _header(f"{LEAP_SECONDS:6d}", "LEAP SECONDS"),
        _header("", "END OF HEADER")]
    for number in np.lexsort((np.arange(len(records)), records.toe - records.constant(TIME_OFFSET))):
        lines += _record(week, records.select(np.array([number])))
    path.write_bytes(("\n".join(lines) + "\n").encode("ascii"))


def _record(week: int, one: Orbits) -> list[str]:
    name = str(one.satellite[0])
    system = name[0]
    value = {key: float(getattr(one, key)[0]) for key in Orbits.__dataclass_fields__ if key != "satellite"}
    seconds = value["toe"] - TIME_OFFSET[system]
    issue = int(seconds // 600) % 128 if system == "E" else int(seconds // 7200) % 200
    rows = [
        (issue, value["crs"], value["delta_n"], value["m0"]),
        (value["cuc"], value["e"], value["cus"], value["sqrt_a"]),
        (seconds, value["cic"], value["omega0"], value["cis"]),
        (value["i0"], value["crc"], value["omega"], value["omega_dot"])]
    rows += _system_rows(system, week, value, issue, seconds)
    clock = "".join(_number(term) for term in (value["af0"], value["af1"], 0.0))
    toc = calendar(week, seconds)
    return [f"{name} {toc:%Y %m %d %H %M %S}{clock}",
            *("    " + "".join(_number(term) for term in row) for row in rows)]


def _system_rows(system: str, week: int, value: dict[str, float], issue: int,
                 seconds: float) -> list[tuple[float, ...]]:
    """The last three lines of a record, whose meaning differs by system."""
    sent = seconds - 7200.0
    if system == "E":
        # Data source 517: I/NAV of E1-B, clock for E1 and E5b; `delay` is BGD E5b/E1, the one that goes with it.
        return [(value["i_dot"], 517, week, 0), (3.12, 0, value["delay2"], value["delay"]), (sent,)]
    if system == "C":
        return [(value["i_dot"], 0, week - BEIDOU_WEEK, 0), (2.0, 0, value["delay"], value["delay2"]), (sent, issue)]
    code = 2 if system == "J" else 1
    fit = 0 if system == "J" else 4
    return [(value["i_dot"], code, week, 0), (2.0, 0, value["delay"], issue), (sent, fit)]


def _header(text: str, label: str) -> str:
    return f"{text:<60}{label:<20}"


def _epoch(time: datetime) -> str:
    return f"{time:%Y %m %d %H %M} {time.second:2d}.{time.microsecond * 10:07d}"


def _time_of(time: datetime) -> str:
    return (f"{time.year:6d}{time.month:6d}{time.day:6d}{time.hour:6d}{time.minute:6d}"
            f"{time.second:5d}.{time.microsecond * 10:07d}     GPS")


def _number(value: float) -> str:
    return f"{value:19.12E}".replace("E", "D")


def _short(value: float) -> str:
    return f"{value:12.4E}".replace("E", "D")
