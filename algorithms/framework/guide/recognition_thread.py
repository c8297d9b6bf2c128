"""Files recognised in the background, in a thread that Python starts: pyproj 3.7 does not stand QGIS's own ones."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass

from qgis.PyQt.QtCore import QObject, pyqtSignal

from ....urbanmap_qgis.errors import Cancelled
from ....urbanmap_qgis.progress import Progress


@dataclass(frozen=True)
class Findings:
    """What the files are: the core's records, and of each west, south, east, north in degrees, or None."""

    facts: tuple
    extents: tuple


class Recognition(QObject):
    """Recognises files; `found` comes with the `Findings`, `moved` with the share that is done."""

    found = pyqtSignal(object)
    moved = pyqtSignal(float)
    _done = pyqtSignal(object, object)

    def __init__(self, parent=None):
        super().__init__(parent)
        self._done.connect(self._tell)
        self._stopped = threading.Event()
        self._thread = None

    def start(self, paths: Sequence[str]) -> None:
        """Begin with other paths; what was at work is left."""
        self.stop()
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._work, args=(tuple(paths), self._stopped), daemon=True,
                                        name="urbanmap recognition")
        self._thread.start()

    def stop(self) -> None:
        """Leave the work; nothing more is told of it."""
        self._stopped.set()

    def busy(self) -> bool:
        """Whether it is at work."""
        return self._thread is not None and self._thread.is_alive() and not self._stopped.is_set()

    def _work(self, paths: tuple[str, ...], stopped: threading.Event) -> None:
        from ....urbanmap_qgis.job.agreement import common_system, extent_in_degrees
        from ....urbanmap_qgis.job.recognition.contents import recognise_files

        try:
            facts = tuple(recognise_files(paths, Progress(report=self.moved.emit, cancelled=stopped.is_set)))
        except Cancelled:
            return
        assumed = common_system(facts)
        extents = tuple(extent_in_degrees(item, assumed) for item in facts)
        self._done.emit(Findings(facts, extents), stopped)

    def _tell(self, findings: Findings, stopped: threading.Event) -> None:
        """Comes from the thread by the window's queue, maybe after the work was left."""
        if not stopped.is_set():
            self.found.emit(findings)
