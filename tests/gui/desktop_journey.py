"""Runs inside QGIS's desktop (`qgis --code`): what a user does in one sitting, written down for the tests.

URBANMAP_JOURNEY names a JSON file: "steps" (what to do, in order), "runs" (algorithm, parameters, how often in one
dialog, in how many new ones), "cancel" (algorithm, parameters) and "report", the file to write after each step.
"""

from __future__ import annotations

import json
import os
import sys
import time
import traceback
from pathlib import Path

JOURNEY = json.loads(Path(os.environ["URBANMAP_JOURNEY"]).read_text(encoding="utf-8"))
PLUGIN = "urbanmap_qgis"
PATIENCE = 120.0
"""Seconds in which a run of the small sample city must have ended."""


def settle(seconds: float = 0.02) -> None:
    """Let the windows work."""
    from qgis.PyQt.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(int(1000 * seconds), loop.quit)
    loop.exec()


def wait_until(done) -> None:
    """Let the windows work until something is so."""
    end = time.monotonic() + PATIENCE
    while not done():
        if time.monotonic() > end:
            raise TimeoutError("a run did not end")
        settle()


def listed() -> list[str]:
    """Ids of the plugin's algorithms and models."""
    from qgis.core import QgsApplication

    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    return sorted(item.id() for item in provider.algorithms()) if provider else []


def dialog_of(algorithm: str, parameters: dict):
    """The dialog that the toolbox opens, shown."""
    import processing

    window = processing.createAlgorithmDialog(algorithm, parameters)
    window.show()
    settle()
    return window


def dialogs() -> dict:
    """Every algorithm's dialog opened and closed; the titles by id."""
    titles = {}
    for algorithm in listed():
        window = dialog_of(algorithm, {})
        titles[algorithm] = window.windowTitle()
        window.close()
        window.deleteLater()
    return titles


def press_run(window) -> tuple[list, list]:
    """Press Run; whether it succeeded, and its progress, in lists that are filled later."""
    ended, moves = [], []
    window.algorithmFinished.connect(lambda succeeded, results: ended.append(succeeded))
    window.runButton().click()
    if hasattr(window, "feedback") and window.feedback is not None:
        window.feedback.progressChanged.connect(moves.append)
    return ended, moves


def wait_for(window, ended: list) -> None:
    """Wait until a run has ended, well or not."""
    wait_until(lambda: ended or (window.runButton().isEnabled() and not window.cancelButton().isEnabled()))
    settle()


def log_of(window) -> str:
    """What the window's log says, as text."""
    from qgis.PyQt.QtWidgets import QTextEdit

    return "\n".join(box.toPlainText() for box in window.findChildren(QTextEdit))


def run_in(window) -> dict:
    """Run once; what became of it: whether it succeeded, its log, and what was loaded."""
    from qgis.core import QgsProject

    project = QgsProject.instance()
    project.removeAllMapLayers()
    ended, moves = press_run(window)
    wait_for(window, ended)
    return {"succeeded": bool(ended and ended[-1]), "moves": len(moves), "log": log_of(window),
            "layers": sorted(map(told, project.mapLayers().values()), key=lambda item: item["name"])}


def told(layer) -> dict:
    """A layer's name, size, whether it lives in the window's thread, and how it is drawn."""
    from qgis.core import QgsApplication, QgsVectorLayer

    vector, renderer = isinstance(layer, QgsVectorLayer), layer.renderer()
    items = [item.label() for item in renderer.legendSymbolItems()] if vector and renderer else \
        [label for label, _ in renderer.legendSymbologyItems()] if renderer else []
    return {"name": layer.name(), "size": layer.featureCount() if vector else layer.width(),
            "renderer": renderer.type() if renderer else "", "legend": items,
            "at_home": layer.isValid() and layer.thread() == QgsApplication.instance().thread()}


def runs() -> list:
    """Each run some times from one dialog, then from new ones."""
    made = []
    for algorithm, parameters, same, others in JOURNEY["runs"]:
        window = dialog_of(algorithm, parameters)
        results = [run_in(window) for _ in range(same)]
        window.close()
        for _ in range(others):
            window = dialog_of(algorithm, parameters)
            results.append(run_in(window))
            window.close()
        made.append([algorithm, results])
    return made


def again() -> list:
    """Each run once more, from a new dialog."""
    return [[algorithm, [run_in(dialog_of(algorithm, parameters))]] for algorithm, parameters, *_ in JOURNEY["runs"]]


def together() -> list:
    """Two dialogs at work at a time."""
    algorithm, parameters, *_ = JOURNEY["runs"][0]
    windows = [dialog_of(algorithm, parameters) for _ in range(2)]
    ends = [press_run(window)[0] for window in windows]
    for window, ended in zip(windows, ends):
        wait_for(window, ended)
        window.close()
    return ends


def cancel() -> dict:
    """A long run that is cancelled when it has begun: whether it ended as one that succeeded, and its log."""
    algorithm, parameters = JOURNEY["cancel"]
    window = dialog_of(algorithm, parameters)
    ended, moves = press_run(window)
    wait_until(lambda: moves or ended)
    window.cancelButton().click()
    started = time.monotonic()
    wait_for(window, ended)
    return {"ended": ended, "seconds": time.monotonic() - started, "log": log_of(window)}


def left_behind() -> dict:
    """Own modules that are loaded, but for the plugin itself, which QGIS always takes away."""
    return {name: module for name, module in sys.modules.items() if name.startswith(f"{PLUGIN}.")}


def reloads() -> dict:
    """Ids listed at first, then each time after the plugin was taken away and loaded again; own modules in between.

    Then the same with what an earlier version that did not take its modules away left: those that QGIS has no note of.
    """
    from qgis import utils

    found, between = [listed()], []
    for leaves in (False, False, True):
        before = {name: module for name, module in left_behind().items() if name not in utils._plugin_modules[PLUGIN]}
        utils.unloadPlugin(PLUGIN)
        found.append(listed())
        between.append(sorted(left_behind()))
        assert before, "QGIS has note of all modules, so that nothing is tried"
        if leaves:
            sys.modules.update(before)
        utils.loadPlugin(PLUGIN)
        utils.startPlugin(PLUGIN)
        found.append(listed())
    return {"listed": found, "between": between}


def plugin_menu() -> dict:
    """The plugin's entries of the menu, by text."""
    from qgis import utils

    return {action.text(): action for action in utils.plugins[PLUGIN].actions}


def distances() -> dict:
    """Labels and boxes of units in a dialog with distances, of an algorithm and of a model."""
    from qgis.PyQt.QtWidgets import QComboBox, QLabel

    found = {}
    for algorithm in ("urbanmap:segmentbuildings", "urbanmap:buildingsfromals_model"):
        window = dialog_of(algorithm, {})
        units = [box.currentText() for box in window.findChildren(QComboBox)]
        found[algorithm] = {"labels": [label.text() for label in window.findChildren(QLabel)], "boxes": units}
        window.close()
    return found


def models() -> dict:
    """Each shipped model opened by the menu, as a copy without a file; the toolbox's menu; a run with given files."""
    from processing.gui.ProviderActions import ProviderContextMenuActions
    from processing.modeler.ModelerDialog import ModelerDialog
    from qgis.core import QgsApplication

    opened = {}
    for action in plugin_menu()["Open a chain in the modeller"].menu().actions():
        action.trigger()
        settle(0.2)
        window = ModelerDialog.dlgs[-1]
        copy = window.model()
        opened[action.text()] = {"name": copy.name(), "file": copy.sourceFilePath(),
                                 "steps": len(copy.childAlgorithms()), "sound": copy.validate()[0],
                                 "shown": window.isVisible()}
        window.close()
    entries, registry = [], QgsApplication.processingRegistry()
    for identity in ("urbanmap:buildingsfromals_model", "urbanmap:buildingsfromals"):
        for entry in ProviderContextMenuActions.actions:
            entry.setData(registry.algorithmById(identity), None)
            if not entry.is_separator and entry.isEnabled():
                entries.append([identity, entry.name])
    return {"opened": opened, "entries": entries,
            "run": run_in(dialog_of("urbanmap:buildingsfromals_model", JOURNEY["model"]))}


STEPS = {"dialogs": dialogs, "runs": runs, "again": again, "together": together, "cancel": cancel, "reloads": reloads,
         "models": models, "distances": distances}


def travel() -> None:
    """Do the steps, write the report, end QGIS."""
    report = []
    settle(1.0)
    for step in JOURNEY["steps"]:
        started, told_of = time.monotonic(), {"step": step}
        try:
            told_of["result"] = STEPS[step]()
        except BaseException:
            told_of["error"] = traceback.format_exc()
        report.append({**told_of, "seconds": time.monotonic() - started})
        Path(JOURNEY["report"]).write_text(json.dumps(report), encoding="utf-8")
    os._exit(0)  # QGIS would ask about the unsaved project


from qgis.PyQt.QtCore import QTimer  # noqa: E402

QTimer.singleShot(500, travel)
