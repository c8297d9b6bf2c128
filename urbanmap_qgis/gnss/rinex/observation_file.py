"""Reads RINEX 2.11 and 3.x observation files: code ranges and carrier to noise densities.

The layout is that of "RINEX: The Receiver Independent Exchange Format" (IGS), versions 2.11 and 3.00 to 3.05. Epochs
are walked one after another; the numbers of all satellites are cut out of the file's bytes and converted at once.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.files.guard import reads
from ...progress import SILENT, Progress
from ...wording import say
from .columns import column_values, strength_by_digit
from .gnss_time import calendar_seconds, known_scale, to_gps
from .text_lines import RinexFile, headers_within, read_rinex

MEGAHERTZ = {
    "G": {"1": 1575.42, "2": 1227.60, "5": 1176.45}, "J": {"1": 1575.42, "2": 1227.60, "5": 1176.45},
    "R": {"1": 1602.0},
    "E": {"1": 1575.42, "7": 1207.14, "5": 1176.45}, "C": {"2": 1561.098, "7": 1207.14, "6": 1268.52}}
"""Carriers (MHz) whose group delay is broadcast, by system and RINEX 3 band, the preferred one first."""

BESIDE_ONLY = {"G": "5", "J": "5"}
"""Bands whose group delay only the CNAV messages tell: they serve as second ones."""

USELESS_SHARE = 0.05
"""Observations of a system without a code that can serve are told from this share on."""

_ATTRIBUTES = "CSLXBAPWIQYMDNZ"
_SYSTEM_SCALE = {"R": "GLO", "E": "GAL", "C": "BDT", "J": "QZS"}
_EPOCH_2 = re.compile(r"^ [ \d]\d [ \d]\d [ \d]\d [ \d]\d [ \d]\d[ \d]{2}\d\.\d[ \d]{6}  [01][ \d]{2}\d")
_EVENT_2 = re.compile(r"^.{28}[2-6][ \d]{2}\d")
_SATELLITE = re.compile(r"[GREJCSI ][ \d]\d")


_Factors = dict[tuple[str, str], float]


@dataclass(frozen=True)
class Observations:
    """Code observations of one file, one band for each system, and what a second one has beside it.

    Attributes
    ----------
    name : of the file.
    time : (e,) epochs, seconds since 1980-01-06 in GPS time by the receiver's clock, increasing.
    epoch : (n,) row in `time`, not decreasing.
    satellite : (n,) names such as "G05".
    code : (n,) code range, m.
    cn0 : (n,) carrier to noise density, dB-Hz, where the file has no S observation by its strength digit in steps of
        6; NaN where it tells neither.
    second_code : (n,) code range on the system's second band, m; NaN where there is none.
    bands, second_bands : RINEX 3 bands that were taken, by system, for those in the file.
    notes : sentences on damage that was worked around and on what was left out.
    """

    name: str
    time: np.ndarray
    epoch: np.ndarray
    satellite: np.ndarray
    code: np.ndarray
    cn0: np.ndarray
    second_code: np.ndarray
    bands: dict[str, str]
    second_bands: dict[str, str]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class _Codes:
    """Of the rows (n,): code ranges on the first band and their strengths, codes on the second, both bands by system;
    how many numbers could not be read; by system how many of all its rows have no code that can serve."""

    code: np.ndarray
    cn0: np.ndarray
    second: np.ndarray
    bands: dict[str, str]
    second_bands: dict[str, str]
    unread: int
    useless: dict[str, tuple[int, int]]


@dataclass(frozen=True)
class _Rows:
    """Where the observations of satellites stand: (n,) first line, name, epoch, and which list of types holds."""

    line: np.ndarray
    satellite: np.ndarray
    epoch: np.ndarray
    types: np.ndarray


@reads("RINEX observations")
def read_observations(path: str | os.PathLike, systems: str = "GRECJ", progress: Progress = SILENT) -> Observations:
    """Read the code observations of a RINEX file, plain or gzipped.

    A file that breaks off is read up to there, damaged lines are left out; both with a note.

    Raises
    ------
    InputError : not a RINEX observation file, or one that cannot be read.
    InsufficientDataError : it holds no code observation of the systems.
    """
    file = read_rinex(path)
    if file.kind != "O":
        raise InputError(say("{file} is a RINEX file but holds no observations: give it as another parameter.",
                             file=file.name))
    walk = _Walk(file)
    rows = walk.rows()
    progress.step(0.3)
    scale = _time_scale(file)
    factors = _scale_factors(file)
    codes = _values(file, rows, walk.types, systems, factors, progress.part(0.3, 1.0))
    notes = [*file.notes, *walk.notes()]
    if codes.unread:
        notes.append(say("{file}: {unread} numbers cannot be read and are left out.", file=file.name,
                         unread=codes.unread))
    for system, (count, total) in codes.useless.items():
        if count > USELESS_SHARE * total:
            kinds = sorted({kind for types in walk.types for kind in types.get(system if file.version >= 3 else "2", [])
                            if kind[0] in "CP"})
            notes.append(say(
                "{file}: {count} of {total} observations of system {system} are left out: their codes (of {kinds}) are "
                "on no band whose group delay the navigation messages tell (bands {bands}).", file=file.name,
                count=count, total=total, system=system, kinds=" ".join(kinds) or "-",
                bands=", ".join(band for band in MEGAHERTZ[system] if band != BESIDE_ONLY.get(system))))
    found = _in_order(file.name, to_gps(np.array(walk.times), scale), rows, codes, notes)
    if not len(found.code):
        raise InsufficientDataError(" ".join([say(
            "{file} holds no code observation of the chosen systems: check the file.", file=file.name), *notes]))
    return found


def _time_scale(file: RinexFile) -> str:
    stated = [content[48:51] for content in file.contents("TIME OF FIRST OBS")]
    scale = stated[0] if stated and stated[0].strip() else _SYSTEM_SCALE.get(file.system, "GPS")
    if not known_scale(scale):
        raise InputError(say("{file} counts time in \"{scale}\", which is not known: convert it to GPS time.",
                             file=file.name, scale=scale))
    return scale


def _in_order(name: str, times: np.ndarray, rows: _Rows, codes: _Codes, notes: list[str]) -> Observations:
    """Observations that hold a code, epochs in the order of time, each satellite once at an epoch."""
    with_code = np.flatnonzero(np.isfinite(codes.code))
    epochs, number = np.unique(times[rows.epoch[with_code]], return_inverse=True)
    names, satellite = np.unique(rows.satellite[with_code], return_inverse=True)
    _, first = np.unique(number.ravel() * len(names) + satellite.ravel(), return_index=True)
    if len(first) < len(with_code):
        notes.append(say("{name}: {kept_count} observations are there twice and are used once.", name=name,
                         kept_count=len(with_code) - len(first)))
    with_code, number = with_code[first], number.ravel()[first]
    return Observations(name, epochs, number, rows.satellite[with_code], codes.code[with_code], codes.cn0[with_code],
                        codes.second[with_code], codes.bands, codes.second_bands, tuple(notes))


class _Walk:
    """Goes through a file's epochs; collects their times, the lines of their satellites and changes of the types."""

    def __init__(self, file: RinexFile):
        self.file = file
        self.times: list[float] = []
        self.types: list[dict[str, list[str]]] = [_types_of(file.header, file)]
        self._first: list[np.ndarray] = []
        self._names: list[list[str]] = []
        self._counts: list[int] = []
        self._versions: list[int] = []
        self._skipped = 0
        self._short = 0
        self._left_out = 0
        kept = ~_comments(file)
        self._headers: list[tuple[int, RinexFile]] = []
        headers = headers_within(file)
        for (first, stop, part), following in zip(headers, [first for first, *_ in headers[1:]] + [len(file)]):
            if _read_alike(part, file):
                self._headers.append((stop, part))
            else:
                self._left_out += following - stop
                stop = following
            kept[first:stop] = False
        self._kept = np.flatnonzero(kept)

    def rows(self) -> _Rows:
        """The lines of all satellites."""
        if self.file.version >= 3:
            self._walk_3()
        else:
            self._walk_2()
        if not self.times:
            raise InsufficientDataError(say("{file} holds no epoch with observations: check the file.",
                                            file=self.file.name))
        line = np.concatenate(self._first)
        counts = np.array(self._counts)
        names = (_names_3(self.file, line) if self.file.version >= 3
                 else np.array([name for names in self._names for name in names], "U3"))
        epoch, version = (np.repeat(values, counts) for values in (np.arange(len(counts)), self._versions))
        return _Rows(line, names, epoch, version)

    def notes(self) -> list[str]:
        """Sentences on what was damaged."""
        name = self.file.name
        notes = []
        if self._short:
            notes.append(say("{name}: {short} epochs are not whole and are used as far as they go.", name=name,
                             short=self._short))
        if self._skipped:
            notes.append(say("{name}: {skipped} lines fit in no epoch and are left out.", name=name,
                             skipped=self._skipped))
        if self._left_out:
            notes.append(say("{name} is made of several files: {left_out} lines behind a header with another version, "
                             "kind, time or scale are left out; give its parts as files of their own.", name=name,
                             left_out=self._left_out))
        return notes

    def _obey_headers(self, line: int) -> None:
        """From a header within the body on its types of observations hold."""
        while self._headers and self._headers[0][0] <= line:
            self.types.append(_types_of(self._headers[0][1].header, self._headers.pop(0)[1]))

    def _add(self, time: float, first: np.ndarray, names: list[str], version: int) -> None:
        self.times.append(time)
        self._first.append(first)
        self._names.append(names)
        self._counts.append(len(first))
        self._versions.append(version)

    def _event(self, first: int, count: int) -> None:
        """Header lines within the body may change the types of observations."""
        lines = [self.file.line(i) for i in range(first, min(first + count, len(self.file)))]
        header = tuple((line[60:].strip(), line[:60]) for line in lines)
        changed = _types_of(header, self.file)
        if changed:
            self.types.append(self.types[-1] | changed)

    def _walk_3(self) -> None:
        file, lines = self.file, self._kept
        heads = lines[(file.length[lines] > 0) & (file.data[np.minimum(file.start[lines], len(file.data) - 1)]
                                                  == ord(">"))]
        self._skipped += int(np.searchsorted(lines, heads[0])) if len(heads) else len(lines)
        ends = np.append(heads[1:], len(file))
        # Of the lines that are not comments: the first behind each head, and the first of the next epoch.
        behind, stop = np.searchsorted(lines, heads + 1), np.searchsorted(lines, ends)
        for head, low, high in zip(heads.tolist(), behind.tolist(), stop.tolist()):
            self._obey_headers(head)
            text = file.line(head)
            try:
                flag, count = int(text[31]), int(text[32:35])
                time = _epoch_3(text) if flag <= 1 else 0.0
                if not math.isfinite(time):
                    raise ValueError("an epoch that is not finite")
            except (ValueError, IndexError):
                self._skipped += high - low + 1
                continue
            if flag > 1:
                if flag < 6:
                    self._event(head + 1, count)
                continue
            self._short += high - low < count
            self._skipped += max(high - low - count, 0)
            self._add(time, lines[low:min(low + count, high)], [], len(self.types) - 1)

    def _walk_2(self) -> None:
        file, lines = self.file, self._kept
        place = 0
        while place < len(lines):
            self._obey_headers(lines[place])
            text = file.line(lines[place])
            if _EPOCH_2.match(text):
                place = self._epoch_2(text, place)
            elif _EVENT_2.match(text) and not text[:28].replace(" ", "").replace(".", "").strip("0123456789"):
                count = int(text[29:32])
                if text[28] == "6":
                    place += 1 + self._lines_2(count) + count * self._lines_each()
                else:
                    self._event(int(lines[place]) + 1, count)
                    place = int(np.searchsorted(lines, lines[place] + 1 + count))
            else:
                self._skipped += bool(text.strip())
                place += 1

    def _lines_each(self) -> int:
        return -(-len(self.types[-1].get("2", ())) // 5)

    @staticmethod
    def _lines_2(count: int) -> int:
        """Further lines that the list of so many satellites fills."""
        return max(-(-count // 12) - 1, 0)

    def _epoch_2(self, text: str, place: int) -> int:
        """Take an epoch of RINEX 2 whose first line is the one at `place`; the place behind it."""
        lines, each = self._kept, self._lines_each()
        count = int(text[29:32])
        more = self._lines_2(count)
        if place + more >= len(lines):
            self._short += 1
            return len(lines)
        listed = "".join(self.file.line(lines[place + i])[32:68].ljust(36) for i in range(more + 1))
        names = [listed[3 * i:3 * i + 3] for i in range(count)]
        if not all(_SATELLITE.fullmatch(name) for name in names):
            self._skipped += 1
            return place + 1
        single = self.file.system if self.file.system in "GRECJS" else "G"
        names = [(single if name[0] == " " else name[0]) + f"{int(name[1:]):02d}" for name in names]
        first = place + 1 + more + each * np.arange(count)
        whole = first + each <= len(lines)
        self._short += not whole.all()
        self._add(_epoch_2(text), lines[first[whole]], names[:int(whole.sum())], len(self.types) - 1)
        return place + 1 + more + each * count


def _read_alike(part: RinexFile, file: RinexFile) -> bool:
    """Whether what follows a header within a file can be read as the file is, by that header's types."""
    if (part.kind, int(part.version), part.version < 3.03) != (file.kind, int(file.version), file.version < 3.03):
        return False
    return (bool(_types_of(part.header, part)) and _time_scale(part) == _time_scale(file)
            and _scale_factors(part) == _scale_factors(file) and (file.version >= 3 or part.system == file.system))


def _comments(file: RinexFile) -> np.ndarray:
    """Which lines of the body are comments (label in column 61)."""
    found = np.zeros(len(file), bool)
    long = np.flatnonzero(file.length >= 67)
    label = np.frombuffer(b"COMMENT", np.uint8)
    at = file.start[long][:, None] + 60 + np.arange(7)
    found[long] = (file.data[at] == label).all(axis=1)
    return found


def _epoch_3(text: str) -> float:
    return float(calendar_seconds(int(text[2:6]), int(text[7:9]), int(text[10:12]), int(text[13:15]),
                                  int(text[16:18]), float(text[18:29])))


def _epoch_2(text: str) -> float:
    return float(calendar_seconds(int(text[1:3]), int(text[4:6]), int(text[7:9]), int(text[10:12]),
                                  int(text[13:15]), float(text[15:26])))


def _names_3(file: RinexFile, line: np.ndarray) -> np.ndarray:
    """(n,) satellites by the first three columns of lines; a blank stands for 0."""
    letters = file.data[np.minimum(file.start[line][:, None] + np.arange(3), len(file.data) - 1)].copy()
    letters[:, 1:][letters[:, 1:] == ord(" ")] = ord("0")
    return letters.astype(np.uint32).view("U3").ravel()


def _types_of(header: tuple[tuple[str, str], ...], file: RinexFile) -> dict[str, list[str]]:
    """Types of observations by system; RINEX 2 has one list for all, under "2"."""
    types: dict[str, list[str]] = {}
    system = ""
    for label, content in header:
        if label == "SYS / # / OBS TYPES" and file.version >= 3:
            if content[:1].strip():
                system = content[0]
                types[system] = []
            types.setdefault(system, []).extend(content[6:60].split())
        elif label == "# / TYPES OF OBSERV" and file.version < 3:
            if content[:6].strip():
                types["2"] = []
            types.setdefault("2", []).extend(content[6:60].split())
    if header is file.header and not types:
        raise InputError(say("{file} does not tell its types of observations: its header is not whole.",
                             file=file.name))
    return types


def _scale_factors(file: RinexFile) -> _Factors:
    """By what the numbers of a system and type have been multiplied; the type "" stands for all of the system."""
    factors: _Factors = {}
    system, factor = "", 1.0
    for content in file.contents("SYS / SCALE FACTOR"):
        try:
            if content[:1].strip():
                system, factor = content[0], float(content[2:6])
                if not int(content[8:10].strip() or 0):
                    factors[system, ""] = factor
        except ValueError as error:
            raise InputError(say("{file} has a scale factor that cannot be read: check its header.",
                                 file=file.name)) from error
        factors.update(((system, kind), factor) for kind in content[10:60].split())
    return factors


def _band_of(system: str, kind: str, version: float) -> str | None:
    """RINEX 3 band of a code observation ("C1C", or "P1" of RINEX 2); None where it is no code of a band we use."""
    if kind[0] not in "CP" or (kind[0] == "P" and version >= 3):
        return None
    band = kind[1:2]
    # BeiDou's B1I was band 1 before RINEX 3.03; later 1P, 1D, 1X are the new B1C, whose group delay is another.
    if system == "C" and band == "1" and (version < 3.03 or kind[2:] in ("I", "Q")):
        band = "2"
    return band if band in MEGAHERTZ[system] else None


def _candidates(system: str, types: list[str], version: float) -> Iterator[tuple[str, int, int | None]]:
    """(band, column of the code, column of its strength) by system, the preferred signal of a band first."""

    def rank(kind: str) -> int:
        attribute = kind[2:3] or kind[0]
        return _ATTRIBUTES.find(attribute) % 99

    for kind in sorted(types, key=rank):
        band = _band_of(system, kind, version)
        if band:
            strength = "S" + kind[1:]
            yield band, types.index(kind), types.index(strength) if strength in types else None


def _values(file: RinexFile, rows: _Rows, types: list[dict[str, list[str]]], systems: str,
            factors: _Factors, progress: Progress) -> _Codes:
    """Code and strength of the band with most to offer, and codes of the one with most beside it."""
    code, cn0, second = (np.full(len(rows.line), np.nan) for _ in range(3))
    bands: dict[str, str] = {}
    second_bands: dict[str, str] = {}
    useless: dict[str, tuple[int, int]] = {}
    unread = 0
    letter = rows.satellite.astype("U1")
    present = [system for system in systems if system in MEGAHERTZ]
    for step, system in enumerate(present):
        mine = np.flatnonzero(letter == system)
        found, bad = _bands(file, rows.line[mine], rows.types[mine], system, types, factors, progress)
        unread += bad
        beside = BESIDE_ONLY.get(system)
        band = _best_band(system, {name: columns for name, columns in found.items() if name != beside})
        if not band:
            if len(mine):
                useless[system] = (len(mine), len(mine))
            continue
        if beside in found:
            alone = (found[beside][0] > 0) & ~np.any([codes > 0 for name, (codes, _) in found.items()
                                                      if name != beside], axis=0)
            useless[system] = (int(alone.sum()), len(mine))
        code[mine], cn0[mine] = found.pop(band)
        bands[system] = band
        other = _best_band(system, found)
        if other:
            second[mine] = found[other][0]
            second_bands[system] = other
        progress.step((step + 1) / len(present))
    code[~(code > 1e6)] = np.nan
    second[~(second > 1e6)] = np.nan
    return _Codes(code, np.where(cn0 > 0, cn0, np.nan), second, bands, second_bands, unread, useless)


def _bands(file: RinexFile, line: np.ndarray, version: np.ndarray, system: str, types: list[dict[str, list[str]]],
           factors: _Factors, progress: Progress) -> tuple[dict[str, tuple[np.ndarray, np.ndarray]], int]:
    """Codes and strengths (m,) of a system's satellites (first lines and lists of types (m,)) by band; of several
    signals on a band the preferred one that is there."""
    found: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    unread = 0
    for number in np.unique(version):
        some = np.flatnonzero(version == number)
        kinds = types[number].get(system if file.version >= 3 else "2", [])
        scale = [factors.get((system, kind), factors.get((system, ""), 1.0)) for kind in kinds]
        for band, column, strength in _candidates(system, kinds, file.version):
            codes, strengths = found.setdefault(band, (np.full(len(line), np.nan), np.full(len(line), np.nan)))
            empty = some[np.isnan(codes[some])]
            values, bad = column_values(file, line[empty], column, progress)
            codes[empty] = values / scale[column]
            unread += bad
            if strength is None:
                strengths[empty] = strength_by_digit(file, line[empty], column)
            else:
                values, bad = column_values(file, line[empty], strength, progress)
                strengths[empty] = values / scale[strength]
                unread += bad
    return found, unread


def _best_band(system: str, found: dict[str, tuple[np.ndarray, np.ndarray]]) -> str | None:
    """The first band in the order of preference that has at least half as many codes as the fullest."""
    counts = {band: int(np.count_nonzero(codes > 0)) for band, (codes, _) in found.items()}
    most = max(counts.values(), default=0)
    return next((band for band in MEGAHERTZ[system] if most and counts.get(band, 0) * 2 >= most), None)
