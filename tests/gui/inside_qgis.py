"""What the journeys inside QGIS's desktop share; they find this module by the folder that their task names."""

from __future__ import annotations

import json
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path


def settle(seconds: float = 0.05) -> None:
    """Let the windows work."""
    from qgis.PyQt.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(int(1000 * seconds), loop.quit)
    loop.exec()


def wait_until(done: Callable[[], bool], what: str, patience: float = 300.0) -> None:
    """Let the windows work until something is so, so many seconds at most."""
    end = time.monotonic() + patience
    while not done():
        if time.monotonic() > end:
            raise TimeoutError(what)
        settle()


def plugin():
    """The plugin as QGIS has loaded it."""
    from qgis import utils

    return utils.plugins["urbanmap_qgis"]


def wish(word: str) -> None:
    """Choose a wish in the dock."""
    box = plugin().guide.wish
    box.setCurrentIndex(box.findData(word))
    settle()


def steps_done(steps: Sequence[Callable[[], dict]], report_file: Path) -> Iterator[dict]:
    """Do the steps one after another; after each its entry of the report, which is written."""
    from qgis import utils

    raised: list[str] = []
    report: dict[str, object] = {"raised": raised}
    settle(1.0)
    # QGIS would wait in a window for somebody to read it.
    utils.showException = lambda *told, **_named: raised.append("".join(traceback.format_exception(*told[:3])))
    for step in steps:
        try:
            report[step.__name__] = step()
        except BaseException:
            report[step.__name__] = {"error": traceback.format_exc()}
        report_file.write_text(json.dumps(report, default=str), encoding="utf-8")
        yield report[step.__name__]
