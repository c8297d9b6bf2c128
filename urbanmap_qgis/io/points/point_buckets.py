"""Sorting more points than memory holds: records put into buckets, on disk once they grow large."""

from __future__ import annotations

import tempfile
from io import BufferedIOBase
from pathlib import Path

import numpy as np

from .whole_records import put_records, record_rows

MEMORY_LIMIT = 300_000_000
"""Bytes of records held in memory before the buckets move to disk."""


def fill_from(stream: BufferedIOBase, part: memoryview) -> None:
    """Read bytes until a part of memory is full.

    Raises
    ------
    OSError : there are no more.
    """
    while len(part):
        number = stream.readinto(part)
        if not number:
            raise OSError("a scratch file of points is cut off")
        part = part[number:]


def stable_order(keys: np.ndarray) -> np.ndarray:
    """Order (n,) that sorts whole numbers, equal ones as they came; numbers of 16 bits numpy sorts by their digits."""
    low, high = (int(keys.min()), int(keys.max())) if len(keys) else (0, 0)
    return np.argsort((keys - low).astype(np.uint16) if high - low < 2**16 else keys, kind="stable")


class PointBuckets:
    """Records grouped by an integer key, each group in the order of arrival.

    Use as a context manager: temporary files are removed at the end.

    Parameters
    ----------
    dtype : structured type of the records.
    memory_limit : bytes kept in memory before everything held is written to temporary files.
    folder : where these are put; None for the system's place for temporary files.
    """

    def __init__(self, dtype: np.dtype, memory_limit: int = MEMORY_LIMIT, *, folder: Path | None = None):
        self.dtype = dtype
        self.memory_limit = memory_limit
        self._parent = folder
        self._pieces: dict[int, list[np.ndarray]] = {}
        self._held = 0
        self._folder: tempfile.TemporaryDirectory | None = None

    def __enter__(self) -> PointBuckets:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._pieces.clear()
        if self._folder is not None:
            self._folder.cleanup()

    def add(self, keys: np.ndarray, records: np.ndarray) -> dict[int, int]:
        """Put records (n,) into the buckets that `keys` (n,) name; they must not be changed after that.

        Returns how many went into each bucket.
        """
        if not len(records):
            return {}
        if (keys[1:] < keys[:-1]).any():
            order = stable_order(keys)
            keys, records = keys[order], record_rows(records, order)
        starts = np.flatnonzero(keys[1:] != keys[:-1]) + 1
        counts = {}
        for name, piece in zip(keys[np.r_[0, starts]].tolist(), np.split(records, starts)):
            self._pieces.setdefault(name, []).append(piece)
            counts[name] = len(piece)
        self._held += records.nbytes
        if self._held > self.memory_limit:
            self._spill()
        return counts

    def read(self, key: int, rows: slice = slice(None)) -> np.ndarray:
        """The records of a bucket, or some that follow each other, in the order in which they came; empty if none."""
        stored, waiting = self._path(key), self._pieces.get(key, [])
        on_disk = stored.stat().st_size // self.dtype.itemsize if stored and stored.exists() else 0
        start, stop, _ = rows.indices(on_disk + sum(map(len, waiting)))
        records = np.empty(max(stop - start, 0), dtype=self.dtype)
        place = max(min(stop, on_disk) - start, 0)
        if place:
            with stored.open("rb", buffering=0) as stream:
                stream.seek(start * self.dtype.itemsize)
                fill_from(stream, memoryview(records[:place].view(np.uint8)))
        before = on_disk
        for piece in waiting:
            wanted = piece[max(start - before, 0):max(stop - before, 0)]
            before += len(piece)
            if len(wanted):
                place = put_records(records, place, wanted)
        return records

    def pop(self, key: int) -> np.ndarray:
        """All records of a bucket as `read` gives them; the bucket is empty after that."""
        in_memory, stored = self._pieces.get(key, []), self._path(key)
        alone = len(in_memory) == 1 and not (stored and stored.exists())
        records = in_memory[0] if alone else self.read(key)
        self._held -= sum(piece.nbytes for piece in self._pieces.pop(key, []))
        if stored:
            stored.unlink(missing_ok=True)
        return records

    def _path(self, key: int) -> Path | None:
        return Path(self._folder.name, str(key)) if self._folder else None

    def _spill(self) -> None:
        """Append everything held in memory to one temporary file a bucket."""
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="urbanmap-", dir=self._parent)
        for key, pieces in self._pieces.items():
            with self._path(key).open("ab") as stream:
                for piece in pieces:
                    piece.tofile(stream)
        self._pieces.clear()
        self._held = 0
