"""Numbers in the fixed columns of RINEX observation files, of many lines at once."""

from __future__ import annotations

import numpy as np

from ...progress import Progress
from .text_lines import RinexFile

_BATCH = 200_000
_WEIGHTS = np.array([1e9, 1e8, 1e7, 1e6, 1e5, 1e4, 1e3, 1e2, 1e1, 1.0, 0.0, 0.1, 0.01, 0.001])


def column_values(file: RinexFile, line: np.ndarray, column: int, progress: Progress) -> tuple[np.ndarray, int]:
    """(m,) numbers of an observation's column at satellites' first lines, NaN where blank; count of unreadable ones."""
    if file.version >= 3:
        offset = 3 + 16 * column
    else:
        line, offset = line + column // 5, 16 * (column % 5)
    values = np.empty(len(line))
    unread = 0
    for first in range(0, len(line), _BATCH):
        progress.check()
        some = line[first:first + _BATCH]
        values[first:first + _BATCH], bad = _numbers(_field(file, some, offset))
        unread += bad
    return values, unread


def strength_by_digit(file: RinexFile, line: np.ndarray, column: int) -> np.ndarray:
    """(m,) dB-Hz, in steps of 6, by the digit behind an observation; NaN where it is blank or 0, not known."""
    if file.version < 3:
        line = line + column // 5
    offset = 3 + 16 * column if file.version >= 3 else 16 * (column % 5)
    digit = _field(file, line, offset + 15, 1)[:, 0].astype(np.int64) - ord("0")
    return np.where((digit >= 1) & (digit <= 9), 6.0 * digit + 3.0, np.nan)


def _field(file: RinexFile, line: np.ndarray, offset: int, width: int = 14) -> np.ndarray:
    """(m, width) bytes of a field; blanks behind the end of a line, and where the file is cut within the field."""
    line = np.minimum(line, len(file) - 1)
    at = offset + np.arange(width)
    cut = (line == len(file) - 1) & file.cut & (file.length[line] < offset + width)
    length = np.where(cut, 0, file.length[line])
    index = np.minimum(file.start[line][:, None] + at, len(file.data) - 1)
    return np.where(at < length[:, None], file.data[index], np.uint8(ord(" ")))


def _numbers(field: np.ndarray) -> tuple[np.ndarray, int]:
    """(m,) numbers written as F14.3 in (m, 14) bytes, NaN where blank; and how many could not be read."""
    digit = field - np.uint8(ord("0"))
    is_digit = digit < 10
    blank = field == ord(" ")
    values = np.where(is_digit, digit, 0) @ _WEIGHTS
    usual = (field[:, 10] == ord(".")) & is_digit[:, 11:].all(axis=1) & (is_digit | blank)[:, :10].all(axis=1)
    usual &= ~(is_digit[:, :9] & blank[:, 1:10]).any(axis=1)
    empty = blank.all(axis=1)
    values[empty] = np.nan
    unread = 0
    for row in np.flatnonzero(~usual & ~empty):
        try:
            values[row] = float(field[row].tobytes())
        except ValueError:
            values[row] = np.nan
            unread += 1
    return values, unread
