"""RINEX and SP3: from the header, and of observations the last epoch from the file's end."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from pyproj import Transformer

from ...errors import InputError
from ...geometry.earth import WGS84
from ...gnss.orbits.sp3 import read_sp3
from ...gnss.rinex.compact import is_compact
from ...gnss.rinex.gnss_time import calendar_seconds
from ...gnss.rinex.navigation import read_navigation_files
from ...gnss.rinex.text_lines import BYTE_ORDER_MARK, RinexFile, read_rinex
from ...io.conversion.reprojection import epsg_wkt
from ...wording import say
from ..file_facts import NAVIGATION, OBSERVATIONS, ORBITS, OTHER, FileFacts

_SP3 = re.compile(rb"^#[a-d][PV ]\d{4} ")
_EPOCH_3 = re.compile(r"^> (\d{4}) ([ \d]\d) ([ \d]\d) ([ \d]\d) ([ \d]\d) *(\d+\.\d+)")
_EPOCH_2 = re.compile(r"^ ([ \d]\d) ([ \d]\d) ([ \d]\d) ([ \d]\d) ([ \d]\d) ([ \d]\d\.\d{7})  [01]")
_EARTH_FIXED = 4978
_LEAST_RADIUS = 6.0e6  # m; an approximate position nearer to the Earth's centre is none


def is_gnss(head: bytes) -> bool:
    """Whether a file begins as RINEX, compact RINEX or SP3."""
    head = head.removeprefix(BYTE_ORDER_MARK)
    return b"RINEX VERSION / TYPE" in head[:85] or is_compact(head) or bool(_SP3.match(head))


def gnss_facts(path: Path, head: bytes) -> list[FileFacts]:
    """What a RINEX or SP3 file is.

    Raises
    ------
    InputError : it is damaged.
    """
    if _SP3.match(head.removeprefix(BYTE_ORDER_MARK)):
        orbits = read_sp3(path)
        return [FileFacts(path, ORBITS, detail="SP3", times=(float(orbits.time[0]), float(orbits.time[-1])),
                          count=len(orbits.time))]
    file = read_rinex(path)
    detail = f"RINEX {file.version:.2f}"
    if file.kind == "O":
        return [_observations(path, file, detail)]
    if file.kind in "NGLEHPCJ":
        records = read_navigation_files([path])
        times = np.concatenate([records.kepler.toe, records.glonass.toe])
        return [FileFacts(path, NAVIGATION, detail=detail, count=len(times), notes=tuple(file.notes),
                          times=(float(times.min()), float(times.max())) if len(times) else None)]
    return [FileFacts(path, OTHER, detail=detail)]


def _observations(path: Path, file: RinexFile, detail: str) -> FileFacts:
    first = _header_time(file)
    last, epochs = first, 0
    pattern = _EPOCH_3 if file.version >= 3.0 else _EPOCH_2
    for number in range(len(file)):
        found = pattern.match(file.line(number))
        if found:
            epochs, stamp = epochs + 1, found
    if not epochs:
        raise InputError(say("{name} holds no epoch of observations: it is cut off or damaged; fetch it again.",
                             name=path.name))
    last = _seconds(stamp.groups())
    place = _place(file)
    return FileFacts(path, OBSERVATIONS, detail=detail, crs_wkt=epsg_wkt(WGS84) if place else "",
                     heights="ellipsoidal" if place else "unknown", extent=place, count=epochs,
                     times=(last if first is None else first, last), notes=tuple(file.notes))


def _header_time(file: RinexFile) -> float | None:
    stated = file.contents("TIME OF FIRST OBS")
    parts = stated[0][:43].split() if stated else []
    return _seconds(parts[:6]) if len(parts) >= 6 else None


def _seconds(parts) -> float:
    return float(calendar_seconds(*(int(part) for part in parts[:5]), float(parts[5])))


def _place(file: RinexFile) -> tuple[float, float, float, float] | None:
    """Longitude and latitude twice, of the approximate position that the header states."""
    stated = file.contents("APPROX POSITION XYZ")
    parts = [float(part) for part in stated[0].split()[:3]] if stated else []
    if len(parts) < 3 or sum(part * part for part in parts) < _LEAST_RADIUS**2:
        return None
    longitude, latitude, _ = Transformer.from_crs(_EARTH_FIXED, 4979, always_xy=True).transform(*parts)
    return (longitude, latitude, longitude, latitude)
