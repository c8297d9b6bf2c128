"""Reads RINEX 2.11, 3.x and 4.x navigation files: orbits and clocks of the satellites, coefficients of the ionosphere.

Layouts by the IGS's RINEX 2.11, 3.05 and 4.02. Records of GPS, QZSS, Galileo and BeiDou are Keplerian, those of GLONASS
are state vectors. Of RINEX 4 the messages that RINEX 3 has too are used, and the group delays of the newer ones of GPS
and QZSS (CNAV and CNV2); the other new messages, times and earth rotation are passed over.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

import numpy as np

from ...errors import InputError
from ...io.files.guard import reads
from ...mobile.gps_time import WEEK
from ...wording import say
from .civil_delays import MESSAGES as CIVIL_MESSAGES
from .civil_delays import NO_DELAYS, CivilDelays, civil_delays, joined_delays
from .gnss_time import BEIDOU_OFFSET, calendar_seconds, leap_seconds, nearest_week, to_gps
from .text_lines import RinexFile, read_rinex

_SCALE = {"G": "GPS", "E": "GAL", "J": "QZS", "C": "BDT", "R": "UTC"}
_KINDS_2 = {"N": "G", "G": "R", "L": "E", "E": "E", "C": "C", "J": "J", "Q": "J"}
_MESSAGES = {"LNAV", "FNAV", "INAV", "IFNV", "D1", "D2", "D1D2", "FDMA"}
"""Messages of RINEX 4 whose orbits stand in the columns of RINEX 3."""
_KLOBUCHAR = {("G", "LNAV"): "GPS", ("J", "LNAV"): "QZS", ("C", "D1D2"): "BDS"}
"""Messages of RINEX 4 with coefficients of the Klobuchar model, by system."""
_COLUMNS = {"af0": (0, 0), "af1": (0, 1), "af2": (0, 2), "crs": (1, 1), "delta_n": (1, 2), "m0": (1, 3), "cuc": (2, 0),
            "e": (2, 1), "cus": (2, 2), "sqrt_a": (2, 3), "toe_own": (3, 0), "cic": (3, 1), "omega0": (3, 2),
            "cis": (3, 3), "i0": (4, 0), "crc": (4, 1), "omega": (4, 2), "omega_dot": (4, 3), "i_dot": (5, 0),
            "source": (5, 1), "health": (6, 1), "delay_a": (6, 2), "delay_b": (6, 3)}


@dataclass(frozen=True)
class KeplerRecords:
    """Broadcast Keplerian elements, (m,) each; m, s and rad as broadcast.

    Attributes
    ----------
    satellite : names.
    toe, toc : reference times of orbit and clock, seconds since 1980-01-06 in GPS time.
    toe_own : reference time in seconds of week in the system's own time.
    source : Galileo's data source bits.
    health : as broadcast, 0 is healthy.
    delay_a, delay_b : group delays, s: GPS and QZSS TGD and none; Galileo BGD E5a/E1 and E5b/E1; BeiDou TGD1 and TGD2.
        The others carry the names of the interface documents.
    """

    satellite: np.ndarray
    toe: np.ndarray
    toc: np.ndarray
    toe_own: np.ndarray
    af0: np.ndarray
    af1: np.ndarray
    af2: np.ndarray
    sqrt_a: np.ndarray
    e: np.ndarray
    i0: np.ndarray
    omega0: np.ndarray
    omega: np.ndarray
    m0: np.ndarray
    delta_n: np.ndarray
    i_dot: np.ndarray
    omega_dot: np.ndarray
    cuc: np.ndarray
    cus: np.ndarray
    crc: np.ndarray
    crs: np.ndarray
    cic: np.ndarray
    cis: np.ndarray
    source: np.ndarray
    health: np.ndarray
    delay_a: np.ndarray
    delay_b: np.ndarray

    def __len__(self) -> int:
        return len(self.satellite)


@dataclass(frozen=True)
class GlonassRecords:
    """Broadcast states of GLONASS satellites, (m,) or (m, 3) each, in m, m/s, m/s2 and s.

    Attributes
    ----------
    satellite : names.
    toe : reference time, seconds since 1980-01-06 in GPS time.
    clock, drift : of the satellite (-tau and gamma).
    health : 0 is healthy.
    channel : of the carrier.
    place, velocity, acceleration : earth-fixed (PZ-90).
    """

    satellite: np.ndarray
    toe: np.ndarray
    clock: np.ndarray
    drift: np.ndarray
    health: np.ndarray
    channel: np.ndarray
    place: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray

    def __len__(self) -> int:
        return len(self.satellite)


@dataclass(frozen=True)
class Ionosphere:
    """Coefficients of the Klobuchar model from a file's header.

    Attributes
    ----------
    source : "GPS", "QZS" or "BDS", whose model they belong to.
    alpha, beta : four each.
    time : median reference time of the file's records, GPS seconds: which of several files is nearest.
    """

    source: str
    alpha: tuple[float, ...]
    beta: tuple[float, ...]
    time: float


@dataclass(frozen=True)
class NavigationRecords:
    """What navigation files tell together."""

    kepler: KeplerRecords
    glonass: GlonassRecords
    ionosphere: tuple[Ionosphere, ...]
    notes: tuple[str, ...]
    civil: CivilDelays = NO_DELAYS


@reads("RINEX navigation")
def read_navigation_files(paths: Sequence[str | os.PathLike]) -> NavigationRecords:
    """Read RINEX navigation files of any systems, plain or gzipped, and put them together.

    Records that are not whole or make no orbit are left out with a note.

    Raises
    ------
    InputError : a file is not a RINEX navigation file or holds no record of a system that is known.
    """
    parts = [_read_one(path) for path in paths]
    return NavigationRecords(_joined(KeplerRecords, [part.kepler for part in parts]),
                             _joined(GlonassRecords, [part.glonass for part in parts]),
                             tuple(model for part in parts for model in part.ionosphere),
                             tuple(note for part in parts for note in part.notes),
                             joined_delays(part.civil for part in parts))


def _joined(kind: type, parts: list):
    if not parts:
        return kind(*(np.zeros(0, "U3") if item.name == "satellite" else np.zeros(
            (0, 3) if item.name in ("place", "velocity", "acceleration") else 0) for item in fields(kind)))
    return kind(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(kind)))


def _read_one(path: str | os.PathLike) -> NavigationRecords:
    file = read_rinex(path)
    if file.kind == "O":
        raise InputError(say("{file} holds observations: give a navigation file here.", file=file.name))
    if file.kind not in (_KINDS_2 if file.version < 3 else "N"):
        raise InputError(say("{file} is a RINEX file but no navigation file: give one of type N.", file=file.name))
    records = defaultdict(list)
    broken = 0
    for name, stamp, rows in _records(file):
        if name[0] not in _SCALE:
            continue
        need = 4 if name[0] == "R" else 8
        try:
            numbers = [[_number(field) for field in row] for row in rows[:need]]
            seconds = _stamp_seconds(stamp)
        except ValueError:
            broken += 1
            continue
        if len(rows) < need or (name[0] != "R" and not _sound(numbers)):
            broken += 1
            continue
        records["R" if name[0] == "R" else "K"].append((name, seconds, numbers))
    notes = (*file.notes, *((say("{file}: {broken} records of satellites are not whole and are left out.",
                                 file=file.name, broken=broken),)
                            if broken else ()))
    if not records:
        raise InputError(say("{file} holds no record of a satellite that can be used: give another navigation file.",
                             file=file.name))
    kepler, glonass = _kepler(records["K"]), _glonass(records["R"])
    middle = float(np.median(np.concatenate([kepler.toe, glonass.toe])))
    return NavigationRecords(kepler, glonass, tuple(_ionosphere(file, middle)), notes,
                             civil_delays(_civil_records(file)))


def _civil_records(file: RinexFile) -> Iterator[tuple[str, float, list[list[float]]]]:
    """Satellite, calendar seconds and numbers, NaN where blank, of the messages with delays of civil signals."""
    if file.version < 4:
        return
    for name, stamp, rows in _records(file, CIVIL_MESSAGES):
        try:
            yield name, _stamp_seconds(stamp), [[_number(field) if field.strip() else np.nan for field in row]
                                                for row in rows]
        except ValueError:
            continue  # Its orbit is not used: what it lacks is a delay that is not told.


def _records(file: RinexFile, messages: set[str] = _MESSAGES) -> Iterator[tuple[str, str, list[list[str]]]]:
    """Satellite, time and the number fields, row by row, of each record; in RINEX 4 of these messages."""
    lead = 4 if file.version >= 3 else 3
    system = _KINDS_2.get(file.kind, "G")
    name, stamp, rows = "", "", []
    used = True
    for i in range(len(file)):
        line = file.line(i)
        if line[:1] == ">" and file.version >= 4:
            kind, _, message = [*line[1:].split(), "", "", ""][:3]
            used = kind == "EPH" and message in messages
            continue
        if not used:
            continue
        starts = line[:1].isalpha() if file.version >= 3 else line[:2].strip().isdigit()
        if i == len(file) - 1 and file.cut and len(line.rstrip()) < lead + 19:
            break
        if starts:
            if name:
                yield name, stamp, rows
            number = line[1:3] if file.version >= 3 else line[:2]
            name = (line[0] if file.version >= 3 else system) + number.strip().zfill(2)
            stamp = line[lead - 1:23] if file.version >= 3 else line[2:22]
            first = line[23:] if file.version >= 3 else line[22:]
            rows = [[first[19 * k:19 * k + 19] for k in range(3)]]
        elif name and line.strip():
            rows.append([line[lead + 19 * k:lead + 19 * k + 19] for k in range(4)])
    if name:
        yield name, stamp, rows


def _number(field: str) -> float:
    """A number with an exponent by D or E; 0 where blank."""
    field = field.strip()
    return float(field.replace("D", "E").replace("d", "e")) if field else 0.0


def _stamp_seconds(stamp: str) -> float:
    """Calendar seconds of a record's time, in its own scale."""
    parts = stamp.split()
    if len(parts) != 6:
        raise ValueError(stamp)
    year, month, day, hour, minute = (int(part) for part in parts[:5])
    if not (1 <= month <= 12 and 1 <= day <= 31):
        raise ValueError(stamp)
    return float(calendar_seconds(year, month, day, hour, minute, float(parts[5])))


def _sound(numbers: list[list[float]]) -> bool:
    """Whether Keplerian elements make an orbit of a navigation satellite."""
    if len(numbers) < 8:
        return False
    return 4000.0 < numbers[2][3] < 8000.0 and 0.0 <= numbers[2][1] < 0.9 and 0.0 <= numbers[3][0] <= WEEK


def _kepler(records: list[tuple[str, float, list[list[float]]]]) -> KeplerRecords:
    table = np.array([[numbers[row][column] for row, column in _COLUMNS.values()] for _, _, numbers in records])
    values = dict(zip(_COLUMNS, table.reshape(-1, len(_COLUMNS)).T))
    names = np.array([name for name, _, _ in records], "U3")
    toc = np.array([float(to_gps(seconds, _SCALE[name[0]])) for name, seconds, _ in records])
    # The week is taken from the clock's calendar date: week numbers roll over and differ between writers.
    system_offset = np.where(names.astype("U1") == "C", BEIDOU_OFFSET, 0.0)
    toe = nearest_week(values["toe_own"] + system_offset, toc)
    return KeplerRecords(satellite=names, toe=toe, toc=toc, **values)


def _glonass(records: list[tuple[str, float, list[list[float]]]]) -> GlonassRecords:
    names = np.array([name for name, _, _ in records], "U3")
    utc = np.array([seconds for _, seconds, _ in records])
    first = np.array([rows[0][:2] for _, _, rows in records]).reshape(-1, 2)
    state = np.array([rows[1:4] for _, _, rows in records]).reshape(-1, 3, 4)
    return GlonassRecords(names, utc + leap_seconds(utc), first[:, 0], first[:, 1], state[:, 0, 3],
                          state[:, 1, 3], *(1000.0 * state[:, :, k] for k in range(3)))


def _ionosphere(file: RinexFile, time: float) -> Iterator[Ionosphere]:
    found: dict[str, tuple[float, ...]] = {}
    for label, content in file.header:
        if label == "IONOSPHERIC CORR":
            found.setdefault(content[:4], tuple(_coefficient(content[5 + 12 * k:17 + 12 * k]) for k in range(4)))
        elif label in ("ION ALPHA", "ION BETA"):
            key = "GPSA" if label == "ION ALPHA" else "GPSB"
            found.setdefault(key, tuple(_coefficient(content[2 + 12 * k:14 + 12 * k]) for k in range(4)))
    if file.version >= 4:
        found.update(_klobuchar_messages(file))
    for source in ("GPS", "QZS", "BDS"):
        alpha, beta = found.get(source + "A"), found.get(source + "B")
        if alpha and beta and np.all(np.isfinite(alpha + beta)) and any(beta):
            yield Ionosphere(source, alpha, beta, time)


def _klobuchar_messages(file: RinexFile) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Coefficients of RINEX 4 by the names that RINEX 3 has for them; of each system those of its first message."""
    known = set()
    for i in range(len(file) - 3):
        line = file.line(i)
        if line[:5] != "> ION":
            continue
        source = _KLOBUCHAR.get((line[6:7], [*line[1:].split(), "", ""][2]))
        if source is None or source in known:
            continue
        first, second, third = (file.line(i + k) for k in (1, 2, 3))
        fields = [first[23 + 19 * k:42 + 19 * k] for k in range(3)] + [
            second[4 + 19 * k:23 + 19 * k] for k in range(4)] + [third[4:23]]
        values = tuple(_coefficient(field) for field in fields)
        known.add(source)
        yield source + "A", values[:4]
        yield source + "B", values[4:]


def _coefficient(field: str) -> float:
    try:
        return _number(field)
    except ValueError:
        return float("nan")
