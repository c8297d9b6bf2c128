"""Several workers for the heavy stages: processes on the command line, threads inside QGIS's window."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager


@contextmanager
def workers(count: int) -> Iterator[Executor | None]:
    """An executor of `count` workers, None for one. Results do not depend on it.

    A second process started from QGIS's window would open a second window on some systems, therefore threads there.
    """
    if count < 2:
        yield None
        return
    with _in_window(count) if _has_window() else _processes(count) as executor:
        try:
            yield executor
        except BaseException:
            executor.shutdown(wait=False, cancel_futures=True)
            raise


def _has_window() -> bool:
    from qgis.utils import iface

    return iface is not None


def _in_window(count: int) -> Executor:
    return ThreadPoolExecutor(count, thread_name_prefix="urbanmap")


def _processes(count: int) -> Executor:
    from ..urbanmap_qgis.dependencies import python_executable

    context = multiprocessing.get_context("spawn")
    context.set_executable(python_executable())
    return ProcessPoolExecutor(count, mp_context=context)
