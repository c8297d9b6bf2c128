"""Group delays of GPS's and QZSS's civil signals, from the CNAV and CNV2 messages of RINEX 4 (4.02, A.11 and A.12)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np

from .gnss_time import to_gps

MESSAGES = {"CNAV", "CNV2"}
"""Messages of RINEX 4 that tell them, in the same columns."""

_SCALE = {"G": "GPS", "J": "QZS"}
_COLUMNS = {"tgd": (6, 2), "isc_l1ca": (7, 0), "isc_l2c": (7, 1), "isc_l5i5": (7, 2), "isc_l5q5": (7, 3)}
_ABSENT = -(2.0**-23)
"""The most negative number that fits into the message says that the value is not available (IS-GPS-200,
30.3.3.3.1.1)."""


@dataclass(frozen=True)
class CivilDelays:
    """Of m messages; a signal's group delay is `tgd` less its inter-signal correction (IS-GPS-705, 20.3.3.3.1.2).

    Attributes
    ----------
    satellite : names.
    time : reference time of the clock, seconds since 1980-01-06 in GPS time.
    tgd, isc_l1ca, isc_l2c, isc_l5i5, isc_l5q5 : (m,) s, NaN where not available.
    """

    satellite: np.ndarray
    time: np.ndarray
    tgd: np.ndarray
    isc_l1ca: np.ndarray
    isc_l2c: np.ndarray
    isc_l5i5: np.ndarray
    isc_l5q5: np.ndarray

    @property
    def isc_l5(self) -> np.ndarray:
        """(m,) of L5, s: of both its parts, or of the one that is told (they differ by some tenths of a ns)."""
        both = np.stack([self.isc_l5i5, self.isc_l5q5])
        told = np.isfinite(both)
        count = told.sum(axis=0)
        return np.where(count > 0, np.where(told, both, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan)


NO_DELAYS = CivilDelays(np.zeros(0, "U3"), *(np.zeros(0) for _ in range(6)))


def civil_delays(records: Iterable[tuple[str, float, list[list[float]]]]) -> CivilDelays:
    """Of messages: satellite, calendar seconds of its clock, and the numbers row by row, NaN where blank."""
    whole = [record for record in records if record[0][0] in _SCALE and len(record[2]) > 7]
    if not whole:
        return NO_DELAYS
    table = np.array([[numbers[row][column] for row, column in _COLUMNS.values()] for _, _, numbers in whole])
    table[table <= _ABSENT] = np.nan
    time = np.array([float(to_gps(seconds, _SCALE[name[0]])) for name, seconds, _ in whole])
    return CivilDelays(np.array([name for name, _, _ in whole], "U3"), time, *table.T)


def joined_delays(parts: Iterable[CivilDelays]) -> CivilDelays:
    """Those of several files together."""
    parts = [NO_DELAYS, *parts]
    return CivilDelays(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(CivilDelays)))
