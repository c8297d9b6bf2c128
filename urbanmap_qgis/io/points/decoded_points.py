"""Points of LAZ files kept decoded in a scratch file, so that what reads a cloud several times decodes it once.

Decoding a LAZ costs some hundred times as much as reading the records from a file. The scratch file has no name: it is
gone when the block ends, however the program ends.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import BinaryIO

import laspy
import numpy as np

from .point_buckets import fill_from

_SPARE = 2.0
"""Times the records' size that must be free on the disk: the outputs may go to the same one."""

FileState = tuple[str, int, int]
"""Path, bytes and time of the last change: a file that differs in one of them is read anew."""


def file_state(path: str | os.PathLike) -> FileState:
    """What tells whether a file is still the one that was read."""
    status = os.stat(path)
    return os.path.abspath(path), status.st_size, status.st_mtime_ns


class DecodedPoints:
    """Records of files that were read to their end, in one nameless file."""

    def __init__(self, file: BinaryIO):
        self._file = file
        self._places: dict[FileState, int] = {}
        self._end = 0
        self._writing = False

    def chunks(self, path: Path, header: laspy.LasHeader,
               chunk_points: int) -> Iterator[laspy.ScaleAwarePointRecord] | None:
        """The points of a file in chunks; None where it is not held."""
        start = self._places.get(file_state(path))
        return None if start is None else self._read(start, header, chunk_points)

    def _read(self, start: int, header: laspy.LasHeader, chunk_points: int) -> Iterator[laspy.ScaleAwarePointRecord]:
        kind = header.point_format.dtype()
        for first in range(0, header.point_count, chunk_points):
            records = np.empty(min(chunk_points, header.point_count - first), kind)
            self._file.seek(start + first * kind.itemsize)
            fill_from(self._file, memoryview(records.view(np.uint8)))
            yield laspy.ScaleAwarePointRecord(records, header.point_format, header.scales, header.offsets)

    def remember(self, path: Path, header: laspy.LasHeader,
                 chunks: Iterator[laspy.ScaleAwarePointRecord]) -> Iterator[laspy.ScaleAwarePointRecord]:
        """The same chunks; once all were taken they are held, where the disk has room and no other file is being read.

        What is not held is decoded again: only time depends on it.
        """
        size = header.point_count * header.point_format.dtype().itemsize
        if self._writing or not size or _SPARE * size > shutil.disk_usage(tempfile.gettempdir()).free:
            yield from chunks
            return
        state, start, self._writing = file_state(path), self._end, True
        try:
            whole = True
            for chunk in chunks:
                whole = whole and self._append(memoryview(np.ascontiguousarray(chunk.array).view(np.uint8)))
                yield chunk
            if whole and self._end - start == size:
                self._places[state] = start
        finally:
            self._writing = False
            if state not in self._places:
                self._end = start

    def _append(self, part: memoryview) -> bool:
        """Write bytes behind all others; False where the disk takes no more."""
        try:
            self._file.seek(self._end)
            while len(part):
                number = self._file.write(part)
                self._end += number
                part = part[number:]
        except OSError:
            return False
        return True


_KEPT: ContextVar[DecodedPoints | None] = ContextVar("decoded_points", default=None)


@contextmanager
def decoded_once() -> Iterator[None]:
    """In the block, `pointcloud.iter_chunks` decodes each LAZ file once; inside another such block nothing is added."""
    if _KEPT.get() is not None:
        yield
        return
    with tempfile.TemporaryFile(prefix="urbanmap-", buffering=0) as file:
        token = _KEPT.set(DecodedPoints(file))
        try:
            yield
        finally:
            _KEPT.reset(token)


def decoded_points() -> DecodedPoints | None:
    """Where decoded points are held in the block that is going on, if there is one."""
    return _KEPT.get()
