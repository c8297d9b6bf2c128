"""Reads precise orbits (SP3-c and SP3-d) and interpolates them.

Places are of the centre of mass as the file tells them: the antenna's offset of one to two metres towards the earth
is not added, most of it goes into the receiver's clock.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.guard import first_not_finite, reads, unreadable_part
from ...wording import say
from ..rinex.gnss_time import calendar_seconds, known_scale, to_gps
from ..rinex.text_lines import read_bytes

NODES = 10
"""Epochs an interpolation uses: a polynomial of degree 9, within some mm at steps of 15 minutes."""

_NO_CLOCK = 999999.0


@dataclass(frozen=True)
class PreciseOrbits:
    """Places and clocks of satellites at regular epochs.

    Attributes
    ----------
    satellite : (s,) names.
    time : (e,) GPS seconds since 1980-01-06.
    place : (s, e, 3) earth-fixed, m; NaN where the file has none.
    clock : (s, e) s, without relativity; NaN where none.
    name : of the file.
    """

    satellite: np.ndarray
    time: np.ndarray
    place: np.ndarray
    clock: np.ndarray
    name: str


def is_sp3(path: str | os.PathLike) -> bool:
    """Whether a file looks like SP3 by its first bytes (plain or gzipped)."""
    data, _ = read_bytes(path)
    return data[:1] == b"#" and data[1:2] in b"acd" and data[2:3] in b"PV"


@reads("SP3 orbits")
def read_sp3(path: str | os.PathLike) -> PreciseOrbits:
    """Read an SP3-c or SP3-d file, plain or gzipped.

    Raises
    ------
    InputError : not an SP3 file, no orbit in it, or a time scale that is not known.
    """
    name = Path(path).name
    data, _ = read_bytes(path)
    lines = data.decode("latin-1").splitlines()
    if not lines or lines[0][:1] != "#" or lines[0][1:2] not in "acd":
        raise InputError(say("{name} is not an SP3 file of version c or d: check the file.", name=name))
    scale = next((line[9:12] for line in lines if line.startswith("%c")), "GPS")
    if scale == "ccc":
        scale = "GPS"
    if not known_scale(scale):
        raise InputError(say("{name} counts time in \"{scale}\", which is not known: use orbits in GPS time.",
                             name=name, scale=scale))
    times, rows = [], []
    for number, line in enumerate(lines, 1):
        try:
            if line.startswith("*"):
                parts = line[1:].split()
                times.append(float(calendar_seconds(*(int(part) for part in parts[:5]), float(parts[5]))))
            elif line.startswith("P") and times:
                rows.append((len(times) - 1, line[1:4].replace(" ", "0"),
                             *(float(line[4 + 14 * k:18 + 14 * k]) for k in range(4))))
        except (ArithmeticError, IndexError, ValueError) as error:
            # The last line may break off, and a position further up leaves a gap; without an epoch the positions after
            # it would be those of the epoch before.
            if line.startswith("*") and number < len(lines):
                raise unreadable_part(name, say("line {number}", number=number), error) from error
    # A position in words that are no number (NaN) is one that is not there, as 0 is.
    bad = first_not_finite([[0.0 if value != value else value for value in row[2:]] for row in rows])
    if bad is not None or not np.isfinite(times).all():
        where = "an epoch" if bad is None else f"the {bad + 1}. position, of {rows[bad][1]},"
        raise InputError(say("{name}: {where} is not finite; download the file again.", name=name, where=where))
    if not rows:
        raise InputError(say("{name} holds no satellite position: the file is not whole.", name=name))
    return _gridded(name, np.asarray(to_gps(np.array(times), scale)), rows)


def _gridded(name: str, times: np.ndarray, rows: list[tuple]) -> PreciseOrbits:
    time, epoch_of = np.unique(times, return_inverse=True)
    satellite, number = np.unique(np.array([row[1] for row in rows], "U3"), return_inverse=True)
    values = np.array([row[2:] for row in rows])
    epoch = epoch_of.ravel()[[row[0] for row in rows]]
    place = np.full((len(satellite), len(time), 3), np.nan)
    clock = np.full((len(satellite), len(time)), np.nan)
    known = (values[:, :3] != 0.0).any(axis=1)
    place[number.ravel()[known], epoch[known]] = 1e3 * values[known, :3]
    ticking = known & (np.abs(values[:, 3]) < _NO_CLOCK)
    clock[number.ravel()[ticking], epoch[ticking]] = 1e-6 * values[ticking, 3]
    return PreciseOrbits(satellite, time, place, clock, name)


def interpolate_orbits(orbits: PreciseOrbits, row: np.ndarray, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3), m, and clocks (n,), s, of satellites (rows of `orbits`) at GPS times (n,).

    Places by Lagrange's polynomial through the ten epochs round the time, clocks on the line between the two
    neighbours; NaN outside the file and where an epoch that is needed is missing.
    """
    row, time = np.asarray(row), np.asarray(time, float)
    count = min(NODES, len(orbits.time))
    before = np.searchsorted(orbits.time, time, side="right") - 1
    inside = (time >= orbits.time[0]) & (time <= orbits.time[-1])
    first = np.clip(before - (count // 2 - 1), 0, len(orbits.time) - count)
    index = first[:, None] + np.arange(count)
    weights = _lagrange(orbits.time[index] - time[:, None])
    place = np.einsum("nk,nkc->nc", weights, orbits.place[row[:, None], index])
    step = np.median(np.diff(orbits.time)) if len(orbits.time) > 1 else np.inf
    whole = inside & (count == NODES) & (np.ptp(orbits.time[index], axis=1) < (count - 0.5) * step)
    place[~whole] = np.nan
    left = np.clip(before, 0, max(len(orbits.time) - 2, 0))
    right = np.minimum(left + 1, len(orbits.time) - 1)
    span = orbits.time[right] - orbits.time[left]
    share = np.where(span > 0, (time - orbits.time[left]) / np.where(span > 0, span, 1.0), 0.0)
    clock = (1 - share) * orbits.clock[row, left] + share * orbits.clock[row, right]
    return place, np.where(inside & (span < 1.5 * step), clock, np.nan)


def _lagrange(offset: np.ndarray) -> np.ndarray:
    """(n, k) weights of k nodes at offsets (n, k) from where the value is wanted."""
    weights = np.ones_like(offset)
    for j in range(offset.shape[1]):
        for m in range(offset.shape[1]):
            if m != j:
                weights[:, j] *= offset[:, m] / (offset[:, m] - offset[:, j])
    return weights
