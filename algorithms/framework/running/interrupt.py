"""Ctrl-C and termination of a `qgis_process` run: a clean cancel instead of half-written files."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from qgis.core import QgsProcessingFeedback


@contextmanager
def signals_cancel(feedback: QgsProcessingFeedback) -> Iterator[list[int]]:
    """While the block runs, the first SIGINT or SIGTERM cancels through `feedback`, a second one ends the process.

    Gives a list that holds the signals received. Signals reach the main thread only, so in the desktop, where
    algorithms run in threads of their own, nothing is changed.
    """
    received: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield received
        return

    def cancel(number, _frame):
        if received:
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
        received.append(number)
        feedback.cancel()

    before = {number: signal.signal(number, cancel) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield received
    finally:
        for number, handler in before.items():
            # A handler that was not set from Python is None and cannot be set again.
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
