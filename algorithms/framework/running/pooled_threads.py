"""Threads of QGIS's tasks ended while QGIS is whole.

QGIS lets the end of each thread that has asked for stored logins clean up in their database, does so again where the
pool starts the same thread anew later, and does not take that back when it deletes the database. Left while such a
thread waits for tasks (half a minute after the last one), QGIS 3.40.6 ends with signal 11, with no plugin at all: its
welcome page asks for logins in such a thread. Its change 62429 mends later versions.
"""

from __future__ import annotations

from collections.abc import Iterator

from qgis.core import QgsApplication
from qgis.PyQt.QtCore import QThreadPool

LONGEST_WAIT_MS = 1000
"""Tasks at work, which are those of others, are waited for so long: QGIS asks about them before it ends."""


def end_pooled_threads() -> bool:
    """Let the threads that wait for tasks end; to be called when QGIS unloads the plugin, as it does when it is left.

    Returns whether all have ended.
    """
    ended = [pool.waitForDone(LONGEST_WAIT_MS) for pool in _pools()]
    return all(ended)


def _pools() -> Iterator[QThreadPool]:
    """Tasks have a pool of their own in later versions of QGIS."""
    manager = QgsApplication.taskManager()
    if hasattr(manager, "threadPool"):
        yield manager.threadPool()
    yield QThreadPool.globalInstance()
