"""Runs at work and open dialogs of this plugin: ended before it is taken away.

QGIS deletes the provider with the plugin, but the algorithms of runs and of dialogs still ask the provider for its id:
QGIS ends at the next change of the project's layers.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from qgis.core import QgsApplication, QgsProcessingAlgRunnerTask, QgsProcessingFeedback, QgsTask
from qgis.PyQt.QtCore import QCoreApplication, QEvent, QEventLoop

LONGEST_WAIT = 30.0
"""A run that was cancelled is waited for so long, s; runs end within a second or two."""

_AT_WORK: dict[object, QgsProcessingFeedback] = {}


@contextmanager
def at_work(feedback: QgsProcessingFeedback) -> Iterator[None]:
    """Note that a run with this feedback is at work."""
    run = object()
    _AT_WORK[run] = feedback
    try:
        yield
    finally:
        del _AT_WORK[run]


def end_runs(longest: float = LONGEST_WAIT) -> bool:
    """Cancel all runs at work and wait until QGIS has done with them; whether they ended within `longest`, s."""
    latest = time.monotonic() + longest
    while (_AT_WORK or _ending()) and time.monotonic() < latest:
        for feedback in tuple(_AT_WORK.values()):
            feedback.cancel()
        QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents, 50)
    return not _AT_WORK


def _ending() -> bool:
    """Whether a run is over whose end QGIS has yet to tell."""
    over = (QgsTask.TaskStatus.Complete, QgsTask.TaskStatus.Terminated)
    return any(isinstance(task, QgsProcessingAlgRunnerTask) and task.status() in over
               for task in QgsApplication.taskManager().tasks())


def close_dialogs(provider: str) -> None:
    """Close and delete the dialogs of a provider's algorithms, also those that are only hidden."""
    from qgis.gui import QgsProcessingAlgorithmDialogBase
    from qgis.PyQt.QtWidgets import QApplication

    for window in QApplication.topLevelWidgets():
        algorithm = window.algorithm() if isinstance(window, QgsProcessingAlgorithmDialogBase) else None
        if algorithm is not None and algorithm.id().partition(":")[0] == provider:
            window.close()
            window.deleteLater()
            QCoreApplication.sendPostedEvents(window, QEvent.Type.DeferredDelete)
