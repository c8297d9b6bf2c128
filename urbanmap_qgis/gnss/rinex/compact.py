"""Compact RINEX of Y. Hatanaka (versions 1 and 3) made plain: observation files as archives keep them.

Texts are given as what differs from the line before, numbers as differences over time of up to the ninth order
(Hatanaka, A compression format and tools for GNSS observation data, Bulletin of the GSI 55, 2008).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...errors import InputError
from ...wording import say

_SATELLITES_AT = {1: 32, 3: 41}
"""Column at which the names of the satellites begin in an epoch's line, by the major version."""
_CLOCK_DECIMALS = {1: 9, 3: 12}
_EVENT = 1  # greatest flag of an epoch with observations
_LINE_2, _NAMES_2 = 5, 12  # observations and names of satellites a line of RINEX 2


class _Damaged(ValueError):
    """What cannot be in a compact file; its text says where."""


@dataclass
class _Series:
    """A number over time: its last value and differences, of increasing order up to `order`."""

    order: int
    differences: list[int]

    def next(self, change: int) -> int:
        """The next value, by its difference of the highest order so far."""
        if len(self.differences) <= self.order:
            self.differences.append(change)
        else:
            self.differences[-1] = change
        for number in range(len(self.differences) - 2, -1, -1):
            self.differences[number] += self.differences[number + 1]
        return self.differences[0]


@dataclass
class _Satellite:
    """What is carried on from epoch to epoch: a series for each type of observation, and the flags' text."""

    series: dict[int, _Series] = field(default_factory=dict)
    flags: str = ""


def is_compact(data: bytes) -> bool:
    """Whether the bytes begin as compact RINEX does."""
    return b"CRINEX VERS   / TYPE" in data[:80]


def plain_rinex(data: bytes, name: str) -> bytes:
    """The plain RINEX of a compact file; `name` for messages.

    Raises
    ------
    InputError : the file is damaged, or of a version that is not known.
    """
    lines = data.replace(b"\r\n", b"\n").decode("latin-1").split("\n")
    if lines and not lines[-1]:
        lines.pop()
    try:
        version = int(float(lines[0][:20]))
        end = next(k for k, line in enumerate(lines) if line[60:].startswith("END OF HEADER"))
        if version not in _SATELLITES_AT:
            raise _Damaged(say("its version is {version}", version=version))
        body = "\n".join(_epochs(lines, end + 1, version, _types(lines[2:end], version)))
    except (_Damaged, ValueError, IndexError, StopIteration) as error:
        raise InputError(say("{name} is damaged compact (Hatanaka) RINEX ({error}): fetch it again, or give plain "
                             "RINEX.", name=name, error=str(error) or "END OF HEADER")) from error
    header = "\n".join(lines[2:end + 1])
    return f"{header}\n{body}\n".encode("latin-1")


def _types(header: list[str], version: int) -> dict[str, int]:
    """Number of types of observation by the letter of the system; "" for all in version 1."""
    label = "SYS / # / OBS TYPES" if version == 3 else "# / TYPES OF OBSERV"
    rows = [line for line in header if line[60:].startswith(label)]
    if version == 3:
        return {line[0]: int(line[3:6]) for line in rows if line[0] != " "}
    return {"": int(rows[0][:6])}


def _epochs(lines: list[str], first: int, version: int, types: dict[str, int]) -> Iterator[str]:
    """Lines of the plain body."""
    row, epoch = first, ""
    satellites: dict[str, _Satellite] = {}
    clock: _Series | None = None
    while row < len(lines):
        start = lines[row]
        if start[:1] in "&>" and start:
            epoch, satellites, clock = start.replace("&", " ", 1) if version == 1 else start, {}, None
        else:
            epoch = _merged(epoch, start)
        flag = int(epoch[31] if version == 3 else epoch[28])
        count = int(epoch[32:35] if version == 3 else epoch[29:32])
        row += 1
        if flag > _EVENT:
            yield epoch.rstrip()
            yield from lines[row:row + count]
            row += count
            continue
        text, clock = _clock(lines[row], clock, _CLOCK_DECIMALS[version])
        names = _names(epoch[_SATELLITES_AT[version]:], count, row)
        records = lines[row + 1:row + 1 + count]
        if len(records) < count:
            return  # breaks off within an epoch, which is then left out
        satellites = {key: satellites.get(key, _Satellite()) for key in names}
        values = [_values(line, satellites[key], types.get(key[0] if version == 3 else "", 0), row + 2 + k)
                  for k, (key, line) in enumerate(zip(names, records))]
        yield from _plain_epoch(epoch, text, names, values, version)
        row += 1 + count


def _names(text: str, count: int, row: int) -> list[str]:
    names = [text[3 * k:3 * k + 3] for k in range(count)]
    if any(len(name) < 3 or not name[1:].strip().isdigit() for name in names):
        raise _Damaged(say("line {row} does not name its satellites", row=row))
    return names


def _merged(old: str, change: str) -> str:
    """A text with its changes: a blank keeps a letter, & makes it blank, others replace it."""
    width = max(len(old), len(change))
    return "".join(before if letter == " " else " " if letter == "&" else letter
                   for before, letter in zip(old.ljust(width), change.ljust(width)))


def _clock(line: str, series: _Series | None, decimals: int) -> tuple[str, _Series | None]:
    """The receiver's clock offset as it stands in the plain file, and its series; none where the line is empty."""
    if not line.strip():
        return "", None
    value, series = _number(line.strip(), series, 0)
    return _fixed(value, decimals), series


def _fixed(value: int, decimals: int) -> str:
    """A whole number of the last decimal as a decimal number."""
    whole, rest = divmod(abs(value), 10**decimals)
    return f"{'-' if value < 0 else ''}{whole}.{rest:0{decimals}d}"


def _number(text: str, series: _Series | None, row: int) -> tuple[int, _Series]:
    """A number, by an entry of a line, and its series."""
    order, sign, start = text.partition("&")
    if sign:
        return int(start), _Series(int(order), [int(start)])
    if series is None:
        raise _Damaged(say("line {row} changes a number that was not given", row=row))
    return series.next(int(text)), series


def _values(line: str, satellite: _Satellite, count: int, row: int) -> list[str]:
    """The fields of 16 characters of a satellite's observations."""
    if not count:
        raise _Damaged(say("line {row} is of a system whose types are not in the header", row=row))
    entries = line.split(" ", count)
    flags = entries[count] if len(entries) > count else ""
    satellite.flags = _merged(satellite.flags, flags).ljust(2 * count)
    fields = []
    for k, text in enumerate((*entries[:count], *[""] * (count - len(entries)))):
        if not text:
            satellite.series.pop(k, None)
            fields.append(" " * 16)  # the flags of what is missing are kept for later, not shown
            continue
        value, satellite.series[k] = _number(text, satellite.series.get(k), row)
        fields.append(f"{_fixed(value, 3):>14}{satellite.flags[2 * k:2 * k + 2]}")
    return fields


def _plain_epoch(epoch: str, clock: str, names: list[str], values: list[list[str]], version: int) -> Iterator[str]:
    """An epoch's lines as RINEX 3 or 2 has them."""
    if version == 3:
        yield (epoch[:41].ljust(41) + (f"{clock:>15}" if clock else "")).rstrip()
        yield from ((name + "".join(fields)).rstrip() for name, fields in zip(names, values))
        return
    for first in range(0, len(names), _NAMES_2):
        line = (epoch[:32] if not first else " " * 32) + "".join(names[first:first + _NAMES_2])
        yield f"{line:<68}{clock:>12}".rstrip() if clock and not first else line.rstrip()
    for fields in values:
        for first in range(0, len(fields), _LINE_2):
            yield "".join(fields[first:first + _LINE_2]).rstrip()
