"""Polygons and their figures in temporary files: any number of them in little memory."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
import shapely

BATCH = 10_000
"""Polygons that are in memory at a time."""


class StoredPolygons(Sequence):
    """Polygons in a file that vanishes with this object; a slice is an (n,) array of shapely's."""

    def __init__(self, folder: str | os.PathLike):
        # In the results' folder: many systems keep the folder for temporary files in memory.
        self._file = tempfile.TemporaryFile(prefix=".urbanmap-", dir=Path(folder))  # noqa: SIM115
        self._folder = folder
        self._end = 0
        self._starts: list[np.ndarray] = []
        self._sizes: list[np.ndarray] = []

    def add(self, polygons: np.ndarray) -> None:
        """Put an array of polygons at the end."""
        pieces = shapely.to_wkb(polygons, output_dimension=3)
        sizes = np.fromiter(map(len, pieces), np.int32, len(pieces))
        self._file.seek(self._end)
        self._file.write(b"".join(pieces))
        self._starts.append(self._end + np.cumsum(sizes, dtype=np.int64) - sizes)
        self._sizes.append(sizes)
        self._end += int(sizes.sum(dtype=np.int64))

    def sort(self, order: np.ndarray) -> None:
        """Keep those of the indices `order`, in this order."""
        starts, sizes = self._index()
        self._starts, self._sizes = [starts[order]], [sizes[order]]

    def _index(self) -> tuple[np.ndarray, np.ndarray]:
        """Where each polygon starts in the file, and its bytes."""
        if len(self._starts) != 1:
            self._starts = [np.concatenate([np.empty(0, np.int64), *self._starts])]
            self._sizes = [np.concatenate([np.empty(0, np.int32), *self._sizes])]
        return self._starts[0], self._sizes[0]

    def __len__(self) -> int:
        return sum(map(len, self._starts))

    def __getitem__(self, which: int | slice) -> shapely.Polygon | np.ndarray:
        starts, sizes = self._index()
        if not isinstance(which, slice):
            return shapely.from_wkb(self._bytes(starts[which], sizes[which]))
        wkb = np.array([self._bytes(*place) for place in zip(starts[which].tolist(), sizes[which].tolist())], object)
        return shapely.from_wkb(wkb)

    def __iter__(self) -> Iterator[shapely.Polygon]:
        for batch in batches(self):
            yield from batch

    def _bytes(self, start: int, size: int) -> bytes:
        self._file.seek(start)
        return self._file.read(size)

    def like(self, batches: Iterable[np.ndarray]) -> StoredPolygons:
        """Another file beside this one, of the arrays of polygons given."""
        other = StoredPolygons(self._folder)
        for polygons in batches:
            other.add(polygons)
        return other

    def close(self) -> None:
        """Remove the file."""
        self._file.close()

    def __del__(self) -> None:
        file = getattr(self, "_file", None)  # none where it could not be made
        if file is not None:
            file.close()


def batches(polygons: Sequence, size: int = BATCH) -> Iterator[np.ndarray]:
    """Polygons of an array or a file, `size` at a time."""
    for start in range(0, len(polygons), size):
        yield polygons[start:start + size]


class StoredRows:
    """Rows of numbers in a file that vanishes with this object."""

    def __init__(self, folder: str | os.PathLike, columns: int):
        self._file = tempfile.TemporaryFile(prefix=".urbanmap-", dir=Path(folder))  # noqa: SIM115
        self._columns = columns
        self._count = 0

    def add(self, rows: np.ndarray) -> None:
        """Put (n, columns) rows at the end."""
        self._count += len(rows)
        self._file.write(np.ascontiguousarray(rows, dtype=np.float64).tobytes())

    def column(self, number: int) -> np.ndarray:
        """One column, float64."""
        self._file.seek(0)
        values = np.empty(self._count)
        for start in range(0, self._count, BATCH):
            block = np.frombuffer(self._file.read(8 * self._columns * BATCH))
            values[start:start + BATCH] = block.reshape(-1, self._columns)[:, number]
        return values

    def close(self) -> None:
        """Remove the file."""
        self._file.close()
