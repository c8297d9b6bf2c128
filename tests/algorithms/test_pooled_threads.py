"""Threads that wait for tasks are gone when the plugin has been unloaded."""

from __future__ import annotations

import time


def test_threads_that_wait_for_tasks_end(plugin, qgis_app):
    from qgis.core import QgsApplication, QgsTask
    from qgis.PyQt.QtCore import QCoreApplication, QThread

    module = plugin("algorithms.framework.running.pooled_threads")
    threads = []
    task = QgsTask.fromFunction("note its thread", lambda task: threads.append(QThread.currentThread()))
    QgsApplication.taskManager().addTask(task)
    latest = time.monotonic() + 30.0
    while QgsApplication.taskManager().count() and time.monotonic() < latest:
        QCoreApplication.processEvents()
    (thread,) = threads
    ended = []
    thread.destroyed.connect(lambda: ended.append(True))
    assert thread.isRunning() and not ended
    assert module.end_pooled_threads() and ended == [True]


def test_tasks_at_work_are_not_waited_for_long(plugin, qgis_app, monkeypatch):
    import threading

    from qgis.core import QgsApplication, QgsTask

    module = plugin("algorithms.framework.running.pooled_threads")
    monkeypatch.setattr(module, "LONGEST_WAIT_MS", 100)
    begun, go_on = threading.Event(), threading.Event()
    task = QgsTask.fromFunction("work", lambda task: (begun.set(), go_on.wait(30.0)))
    QgsApplication.taskManager().addTask(task)
    assert begun.wait(30.0)
    try:
        assert not module.end_pooled_threads()
    finally:
        go_on.set()
    monkeypatch.setattr(module, "LONGEST_WAIT_MS", 30_000)
    assert module.end_pooled_threads()
