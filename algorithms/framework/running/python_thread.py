"""Work that begins in a thread of QGIS's own, handed over to a thread of Python's where pyproj needs that.

pyproj 3.7 notes PROJ's context with the system's thread, but deletes it with Python's record of the thread. Of a thread
that Python did not start, such as the pooled ones in which QGIS runs what a dialog starts, that record lasts only
while Python works in it: the next run in the same thread takes the deleted context, and QGIS ends (pyproj's issues
1509 and 1541). A thread that Python started has its record until it ends.
"""

from __future__ import annotations

import contextvars
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from qgis.core import QgsProcessingContext
from qgis.PyQt.QtCore import QEventLoop, QMetaObject, Qt, QThread

from ....urbanmap_qgis.dependencies import PACKAGES, installed_version, version_numbers

Result = TypeVar("Result")

FIRST_WITH_FAULT, FIRST_WITHOUT = (3, 7), (3, 8)
"""Versions of pyproj that need it: from the first one on, below the second one."""


def in_python_thread(work: Callable[[], Result], context: QgsProcessingContext) -> Result:
    """What `work()` returns or raises; done in a thread of Python's where this is none and pyproj needs one.

    `context` and its layers live in that thread meanwhile, and in this one again afterwards.
    """
    if not _is_foreign() or not _pyproj_needs_it():
        return work()
    return _handed_over(work, context)


def _is_foreign() -> bool:
    """Whether Python did not start this thread; it did start the main one."""
    return isinstance(threading.current_thread(), threading._DummyThread)


def _pyproj_needs_it() -> bool:
    loaded = sys.modules.get("pyproj")
    numbers = version_numbers(getattr(loaded, "__version__", "") or installed_version(PACKAGES["pyproj"]))
    return FIRST_WITH_FAULT <= numbers < FIRST_WITHOUT


def _handed_over(work: Callable[[], Result], context: QgsProcessingContext) -> Result:
    caller = QThread.currentThread()
    moves = context.thread() == caller
    outcome: Future = Future()
    runner: Future = Future()
    begin, loop = threading.Event(), QEventLoop()
    variables = contextvars.copy_context()

    def in_thread() -> None:
        runner.set_result(QThread.currentThread())
        begin.wait()
        try:
            outcome.set_result(variables.run(work))
        except BaseException as error:  # raised again where it belongs
            outcome.set_exception(error)
        if moves:
            context.pushToThread(caller)
        QMetaObject.invokeMethod(loop, "quit", Qt.ConnectionType.QueuedConnection)

    thread = threading.Thread(target=in_thread, name="urbanmap run")
    thread.start()
    if moves:
        context.pushToThread(runner.result())
    begin.set()
    # Models count their steps' progress in this thread: so its events go on, until the last has come.
    loop.exec()
    thread.join()
    return outcome.result()
