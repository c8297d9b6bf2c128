"""Pieces of work, done one after another or on an executor, always given back in order."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import TypeVar

from .dependencies import activate
from .wording import use_catalogue

Piece = TypeVar("Piece")
Result = TypeVar("Result")

IN_FLIGHT = 4
"""Pieces handed to an executor before the first result is waited for: bounds the memory."""

_CHECK: ContextVar[Callable[[], None] | None] = ContextVar("urbanmap_check", default=None)


def checkpoint() -> None:
    """Called by long work at least once a second: ends it by raising, where the user wants to stop.

    What is asked is the `check` of the `in_order` that the work runs in. In a process of its own there is none: such
    a process is ended from outside.
    """
    check = _CHECK.get()
    if check is not None:
        check()


class _Checked:
    """Work during which `checkpoint` asks `check`."""

    def __init__(self, work: Callable, check: Callable[[], None]):
        self.work, self.check = work, check

    def __call__(self, piece: object) -> object:
        before = _CHECK.set(self.check)
        try:
            return self.work(piece)
        finally:
            _CHECK.reset(before)


def _result(future: Future[Result], check: Callable[[], None]) -> Result:
    """Result of a piece, waited for with an ear for `check`."""
    while not future.done():
        check()
        wait([future], timeout=0.2)
    return future.result()


def start_worker(packages: str = "", catalogue: str = "") -> None:
    """Called in a worker process when it starts: it leaves Ctrl-C to the process that started it, and ends with it.

    Parameters
    ----------
    packages : folder of installed packages, see `dependencies.activate`.
    catalogue : see `wording.use_catalogue`.
    """
    use_catalogue(catalogue or None)
    if packages:
        activate(packages)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait until the parent process is gone; without this, workers of a killed run would wait for work forever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def end_workers_but(others: set) -> None:
    """End the processes started since `others` were all: workers pass over a request to end, see `start_worker`."""
    for process in set(multiprocessing.active_children()) - others:
        process.kill()


@contextmanager
def without_collection() -> Iterator[Callable[[], object]]:
    """Python's search for cycles among dead objects is off inside: where millions of small objects are made, which all
    die without it, it takes a third of the time. The function given looks through the young ones: to be called
    now and then."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield partial(gc.collect, 0)
    finally:
        if was:
            gc.enable()


def in_order(work: Callable[[Piece], Result], pieces: Iterable[Piece],
             executor: Executor | None = None, check: Callable[[], None] = lambda: None) -> Iterator[Result]:
    """Results of `work` on each piece, in the order of the pieces.

    Without an executor the pieces are worked on here. The results do not depend on the executor or its
    number of workers. With processes, `work` and the pieces must be picklable. While results are waited for, `check`
    is called several times a second; what it raises ends the work. Work done in this process asks it at every
    `checkpoint`.
    """
    if executor is None:
        yield from map(_Checked(work, check), pieces)
        return
    checked: Callable = _Checked(work, check) if isinstance(executor, ThreadPoolExecutor) else work
    waiting: deque = deque()
    try:
        for piece in pieces:
            waiting.append(executor.submit(checked, piece))
            if len(waiting) >= IN_FLIGHT:
                yield _result(waiting.popleft(), check)
        while waiting:
            yield _result(waiting.popleft(), check)
    finally:
        for future in waiting:
            future.cancel()
