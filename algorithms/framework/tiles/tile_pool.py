"""Tiles worked on one after another here, or side by side in processes each with a QGIS of its own."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, ProcessPoolExecutor, wait
from pathlib import Path

from qgis.core import QgsApplication

from ....urbanmap_qgis.dependencies import python_executable
from ....urbanmap_qgis.errors import Cancelled
from ....urbanmap_qgis.execution import end_workers_but
from ....urbanmap_qgis.tiling.journal import FAILED, TileRecord, new_tile_folder, publish
from ..declaring.parameters import tr
from ..packages.dependencies import profile_packages
from ..running.cluster import check_cluster, scheduler_address
from .tile_process import start_application
from .tile_work import TileJob, work_on_tile

IN_HAND = 2
"""Tiles handed to each worker at a time: one at work, one waiting."""
RENEWED = 100
"""Tiles after which a process makes room for a new one: QGIS and its libraries keep about 1 MB of each."""


def run_tiles(jobs: Sequence[TileJob], count: int, cancelled: Callable[[], bool]) -> Iterator[TileRecord]:
    """Records of the tiles as they are done. A tile that kills its process is one that failed; the others go on."""
    if count < 2:
        for job in jobs:
            if cancelled():
                raise Cancelled()
            yield work_on_tile(job, cancelled)
        return
    waiting, suspects = list(reversed(jobs)), []
    while waiting:
        batch = waiting[-RENEWED * count:]
        del waiting[-RENEWED * count:]
        suspects += yield from _until_broken(batch, count, cancelled)
        waiting += batch  # what a broken pool has left
    for job in suspects:  # one of them ended its process: each once more, alone
        alone = [job]
        if (yield from _until_broken(alone, 1, cancelled)):
            yield _killed(job)


def _until_broken(waiting: list[TileJob], count: int, cancelled: Callable[[], bool]
                  ) -> Iterator[TileRecord]:
    """Take jobs from the end of `waiting` until all are done or a process ends; gives back those lost with it."""
    others = set(multiprocessing.active_children())
    executor = _processes(count)
    at_work = {}
    try:
        while waiting or at_work:
            while waiting and len(at_work) < IN_HAND * count:
                job = waiting.pop()
                at_work[executor.submit(work_on_tile, job)] = job
            if cancelled():
                raise Cancelled()
            for future in wait(at_work, timeout=0.2, return_when=FIRST_COMPLETED).done:
                record = future.result()
                del at_work[future]
                yield record
    except BrokenExecutor:
        end_workers_but(others)  # a broken pool asks them to end, and would wait for ever
        return list(at_work.values())
    except BaseException:
        end_workers_but(others)
        raise
    finally:
        executor.shutdown(wait=False, cancel_futures=True)
    return []


def _killed(job: TileJob) -> TileRecord:
    reason = tr("The process that worked on this tile was ended, by lack of memory or a fault in a library; make the "
                "tiles smaller.")
    record = TileRecord(job.tile.name, FAILED, reason, job.fingerprint)
    with new_tile_folder(job.run_folder, job.tile) as folder:
        publish(job.run_folder, job.tile, record, folder)
    return record


def _processes(count: int) -> ProcessPoolExecutor:
    context = multiprocessing.get_context("spawn")
    context.set_executable(python_executable())
    plugins = str(Path(QgsApplication.pkgDataPath()) / "python" / "plugins")
    return ProcessPoolExecutor(count, mp_context=context, initializer=start_application, initargs=(
        QgsApplication.prefixPath(), plugins, str(profile_packages()), __package__.rsplit(".", 3)[0],
        scheduler_address(), check_cluster()))
