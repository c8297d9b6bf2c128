"""Runs at work and open dialogs of this plugin: ended before it is taken away.

QGIS deletes the provider with the plugin, but the algorithms of runs and of dialogs still ask the provider for its id:
QGIS ends at the next change of the project's layers.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from qgis.core import (
    QgsApplication,
    QgsProcessingAlgRunnerTask,
    QgsProcessingFeedback,
    QgsProcessingProvider,
    QgsTask,
)
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


def end_runs(provider: QgsProcessingProvider, longest: float = LONGEST_WAIT) -> bool:
    """Cancel the provider's runs and wait until QGIS has told their ends; whether they ended within `longest`, s."""
    names = [algorithm.displayName() for algorithm in provider.algorithms()]
    latest = time.monotonic() + longest
    while (tasks := _tasks(names)) or _AT_WORK:
        if time.monotonic() > latest:
            return False
        for run in (*_AT_WORK.values(), *tasks):
            run.cancel()
        QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents, 50)
    return True


def _tasks(names: Sequence[str]) -> list[QgsTask]:
    """Tasks that run an algorithm of these names: a run is over some time before QGIS tells its dialog."""
    return [task for task in QgsApplication.taskManager().tasks()
            if isinstance(task, QgsProcessingAlgRunnerTask) and any(name in task.description() for name in names)]


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
