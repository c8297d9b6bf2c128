"""Open files that all pieces of a job read: opened once in each worker, be it a thread or a process."""

from __future__ import annotations

import pickle
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

Opened = TypeVar("Opened")

_worker = threading.local()


@dataclass(frozen=True)
class WorkerResource(Generic[Opened]):
    """Something that a worker opens when its first piece comes, and keeps.

    Open raster files may not be used by two threads, nor sent to another process; so what is sent is how to open them.
    It is written to a file once, because it may hold many polygons.
    """

    plan: Path

    def get(self) -> Opened:
        """What this worker opened."""
        if getattr(_worker, "plan", None) != self.plan:
            close_worker()
            # Our own file of a moment ago.
            open_all = pickle.loads(self.plan.read_bytes())
            with ExitStack() as stack:
                _worker.opened = open_all(stack)
                _worker.stack = stack.pop_all()
            _worker.plan = self.plan
        return _worker.opened


def close_worker() -> None:
    """Close what this thread has opened."""
    stack = getattr(_worker, "stack", None)
    _worker.plan = _worker.opened = _worker.stack = None
    if stack is not None:
        stack.close()


@contextmanager
def worker_resource(open_all: Callable[[ExitStack], Opened]) -> Iterator[WorkerResource[Opened]]:
    """For the time of a job, what `open_all` (which must be picklable) opens and puts on the stack."""
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
        plan = Path(folder) / "plan"
        plan.write_bytes(pickle.dumps(open_all))
        try:
            yield WorkerResource(plan)
        finally:
            close_worker()
