"""Rows of structured arrays moved whole: numpy copies them field by field, which takes ten to fifty times as long."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def record_rows(records: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """What `records[rows]` gives: a copy of the rows (m,) of records (n,), numbers or a mask (n,)."""
    return records.compress(rows) if rows.dtype == bool else records.take(rows)


def copied_records(records: np.ndarray) -> np.ndarray:
    """A copy of records (n,)."""
    return _whole(records).copy().view(records.dtype)


def joined_records(pieces: Sequence[np.ndarray]) -> np.ndarray:
    """Records of one layout, one piece behind the other; there is at least one piece."""
    return np.concatenate([_whole(piece) for piece in pieces]).view(pieces[0].dtype)


def put_records(records: np.ndarray, place: int, piece: np.ndarray) -> int:
    """Put a piece (m,) of the same layout into records from a place on; the place behind it is given back."""
    end = place + len(piece)
    _whole(records)[place:end] = _whole(piece)
    return end


def _whole(records: np.ndarray) -> np.ndarray:
    """The same memory as rows without fields."""
    return records.view(np.dtype((np.void, records.dtype.itemsize)))
