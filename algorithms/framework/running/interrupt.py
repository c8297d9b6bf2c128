"""Ctrl-C and termination of a `qgis_process` run: a clean cancel instead of half-written files."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from qgis.core import QgsProcessingFeedback

_runs: list[QgsProcessingFeedback] = []
_received: list[int] = []
_before: dict[int, object] = {}


@contextmanager
def signals_cancel(feedback: QgsProcessingFeedback) -> Iterator[list[int]]:
    """While the block runs, the first SIGINT or SIGTERM cancels through `feedback`, a second one ends the process.

    A process has one handler and one list of signals: a run inside another, such as a tile of many, is cancelled
    together with it, whichever of the two had the signal. Gives the list of the signals received. Signals reach the
    main thread only, so in the desktop, where algorithms run in threads of their own, nothing is changed.
    """
    if threading.current_thread() is not threading.main_thread():
        yield []
        return
    if not _runs:
        _received.clear()
        _before.update({number: signal.signal(number, _cancel) for number in (signal.SIGINT, signal.SIGTERM)})
    _runs.append(feedback)
    try:
        yield _received
    finally:
        _runs.pop()
        if not _runs:
            _restore()


def _cancel(number: int, _frame) -> None:
    """Cancel all runs that are open, the outermost too."""
    if _received:
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    _received.append(number)
    for feedback in _runs:
        feedback.cancel()


def _restore() -> None:
    for number, handler in _before.items():
        # A handler that was not set from Python is None and cannot be set again.
        signal.signal(number, signal.SIG_DFL if handler is None else handler)
    _before.clear()
