"""Open files that all pieces of a job read: opened once in each worker, be it a thread or a process."""

from __future__ import annotations

import tempfile
import threading
import uuid
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np
import shapely

Opened = TypeVar("Opened")

_worker = threading.local()


@dataclass(frozen=True)
class WorkerResource(Generic[Opened]):
    """Something that a worker opens when its first piece comes, and keeps until one of another `job` comes.

    Open raster files may not be used by two threads, nor sent to another process; so what is sent is how to open them.
    """

    job: str
    open_all: Callable[[ExitStack], Opened]

    def get(self) -> Opened:
        """What this worker opened."""
        if getattr(_worker, "job", None) != self.job:
            close_worker()
            with ExitStack() as stack:
                _worker.opened = self.open_all(stack)
                _worker.stack = stack.pop_all()
            _worker.job = self.job
        return _worker.opened


def close_worker() -> None:
    """Close what this thread has opened."""
    stack = getattr(_worker, "stack", None)
    _worker.job = _worker.opened = _worker.stack = None
    if stack is not None:
        stack.close()


@contextmanager
def worker_resource(open_all: Callable[[ExitStack], Opened]) -> Iterator[WorkerResource[Opened]]:
    """For the time of a job, what `open_all` opens and puts on the stack.

    It goes to the workers with every piece: it must be picklable and small (see `sent_polygons`).
    """
    try:
        yield WorkerResource(uuid.uuid4().hex, open_all)
    finally:
        close_worker()


class SentPolygons(Sequence):
    """Polygons (or None) in a file, read when they are asked for; a worker is sent the file's path alone."""

    def __init__(self, path: Path):
        self.path = path

    def _polygons(self) -> list[shapely.Geometry | None]:
        with np.load(self.path, allow_pickle=False) as stored:
            ends, data = np.cumsum(stored["lengths"]), stored["wkb"].tobytes()
        return [shapely.from_wkb(data[end - length:end]) if length else None
                for end, length in zip(ends, np.diff(ends, prepend=0))]

    def __len__(self) -> int:
        return len(self._polygons())

    def __getitem__(self, index):
        return self._polygons()[index]

    def __iter__(self) -> Iterator[shapely.Geometry | None]:
        return iter(self._polygons())


@contextmanager
def sent_polygons(polygons: Sequence[shapely.Geometry | None] | None) -> Iterator[SentPolygons | None]:
    """For the time of a job, polygons in a file for its workers; None for None."""
    if polygons is None:
        yield None
        return
    packed = [b"" if polygon is None else shapely.to_wkb(polygon) for polygon in polygons]
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
        path = Path(folder) / "polygons.npz"
        np.savez(path, lengths=np.array([len(item) for item in packed], np.int64),
                 wkb=np.frombuffer(b"".join(packed), np.uint8))
        yield SentPolygons(path)
