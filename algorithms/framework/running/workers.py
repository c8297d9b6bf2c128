"""Several workers for the heavy stages: processes on the command line, threads inside QGIS's window."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager

from ....urbanmap_qgis.errors import UrbanMapError
from ....urbanmap_qgis.execution import end_workers_but, start_worker
from ....urbanmap_qgis.wording import catalogue_path
from ..declaring.parameters import tr
from ..packages.dependencies import profile_packages
from .cluster import cluster_executor, scheduler_address


@contextmanager
def workers(count: int) -> Iterator[Executor | None]:
    """An executor of `count` workers, None for one; that of a cluster in a run with one. Results do not depend on it.

    A second process started from QGIS's window would open a second window on some systems, therefore threads there.
    """
    if scheduler_address():
        with cluster_executor() as executor:
            yield executor
        return
    if count < 2:
        yield None
        return
    others = set(multiprocessing.active_children())
    with _in_window(count) if _has_window() else _processes(count) as executor:
        try:
            yield executor
        except BaseException as error:
            executor.shutdown(wait=False, cancel_futures=True)
            end_workers_but(others)
            if isinstance(error, BrokenExecutor):
                raise UrbanMapError(tr("A worker ended before its work was done, for lack of memory or because "
                                       "Python could not start it; run again with one worker.")) from None
            raise


def _has_window() -> bool:
    from qgis.utils import iface

    return iface is not None


def _in_window(count: int) -> Executor:
    return ThreadPoolExecutor(count, thread_name_prefix="urbanmap")


def _processes(count: int) -> Executor:
    from ....urbanmap_qgis.dependencies import python_executable

    context = multiprocessing.get_context("spawn")
    context.set_executable(python_executable())
    executor = ProcessPoolExecutor(count, mp_context=context, initializer=start_worker,
                                   initargs=(str(profile_packages()), str(catalogue_path() or "")))
    with _signals_blocked():
        # A worker is started when work comes; here all are, so that none meets a Ctrl-C while it is still importing.
        for _ in range(count):
            executor.submit(os.getpid)
    return executor


@contextmanager
def _signals_blocked() -> Iterator[None]:
    """Processes started in the block never see Ctrl-C or a request to end, where the system knows signal masks."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
