"""Runs inside QGIS's desktop (`qgis --code`): what a stranger does with the dock, noted for the tests.

URBANMAP_STRANGER names a JSON file: "city" (folder with blanks and Japanese letters), "moved" (where it goes later),
"report" (file to write after each step), "helpers" (folder of `inside_qgis`).
"""

from __future__ import annotations

import json
import os
import shutil
import sys
from pathlib import Path

TASK = json.loads(Path(os.environ["URBANMAP_STRANGER"]).read_text(encoding="utf-8"))
CITY, MOVED = Path(TASK["city"]), Path(TASK["moved"])
sys.path.insert(0, TASK["helpers"])

from inside_qgis import plugin, settle, steps_done, wait_until, wish  # noqa: E402


def docks() -> list[bool]:
    """Whether each dock of the plugin in the window is seen."""
    from qgis.PyQt.QtWidgets import QDockWidget
    from qgis.utils import iface

    found = [dock for dock in iface.mainWindow().findChildren(QDockWidget) if dock.objectName() == "UrbanMapGuide"]
    return [dock.isVisible() for dock in found]


def states() -> dict:
    return {step.id: step.state for step in plugin().guide.job.steps}


def layers() -> list:
    """Name, number of features, file and reference system of the vector layers."""
    from qgis.core import QgsProject

    return sorted([layer.name(), layer.featureCount(), layer.source().partition("|")[0], layer.crs().authid()]
                  for layer in QgsProject.instance().mapLayers().values())


def recognised(guide) -> None:
    wait_until(lambda: guide.files.findings.facts and not guide.files.recognition.busy(), "files were not recognised")


def run() -> str:
    """Press Run and wait; what is told at the end."""
    guide = plugin().guide
    guide.steps.run.click()
    wait_until(lambda: not guide.runner.busy(), "the run did not end")
    settle(0.3)
    return guide.steps.told.text()


def set_in_dialog(step: str, values: dict) -> None:
    """Change settings in a step's own dialog and close it."""
    guide = plugin().guide
    guide.open_step(step)
    settle(0.5)
    guide.dialog.window.setParameters({**guide.dialog.before, **values})
    guide.dialog.window.close()
    settle(0.2)


def rest_of_tasks_threads(milliseconds: int) -> bool:
    """How long threads wait for a task before they end, as QGIS then starts them anew; whether it can be said."""
    from qgis.core import QgsApplication

    manager = QgsApplication.taskManager()
    if hasattr(manager, "threadPool"):
        manager.threadPool().setExpiryTimeout(milliseconds)
    return hasattr(manager, "threadPool")


def logins_asked_for() -> dict:
    """Threads of tasks that ask QGIS for logins, as its own do for the news, end and are started anew later: QGIS
    3.40.6 does not outlive them where it is left while they wait for more (half a minute), as it is at the end."""
    from qgis.core import QgsApplication, QgsTask

    if not rest_of_tasks_threads(200):  # 3.22: eight may wait for each other for ever
        return {"shortened": False, "raised": []}
    QgsApplication.authManager().configIds()  # opens the store of logins, for which threads would wait for each other
    answers: list[tuple] = []
    tasks = [QgsTask.fromFunction("logins", lambda task: [*QgsApplication.authManager().configIds()],
                                  on_finished=lambda *told: answers.append(told)) for _ in range(8)]
    for task in tasks:
        QgsApplication.taskManager().addTask(task)
    wait_until(lambda: len(answers) == len(tasks), "logins were not told")
    settle(1.0)
    return {"shortened": True, "raised": [told[0] for told in answers if told[0] is not None]}


def twice() -> dict:
    """The dock opened, closed and opened again, by its button."""
    action, seen = plugin().guide_action, []
    for _ in range(4):
        action.trigger()
        settle(0.3)
        seen.append(docks())
    action.setChecked(True)
    action.setChecked(True)
    settle(0.3)
    return {"seen": [*seen, docks()]}


def bare() -> dict:
    """No reference system of the project, a folder with blanks and Japanese letters: buildings, loaded."""
    from qgis.core import QgsCoordinateReferenceSystem, QgsProject

    QgsProject.instance().setCrs(QgsCoordinateReferenceSystem())
    guide = plugin().guide
    guide.files.add([str(CITY)])
    recognised(guide)
    wish("buildings")
    told = run()
    return {"told": told, "states": states(), "layers": layers(), "job": str(guide.path),
            "crs": QgsProject.instance().crs().authid()}


def over_itself() -> dict:
    """Once more into the files that are loaded, with another setting."""
    set_in_dialog("buildings", {"MIN_ROOF_AREA": 30.0})
    between = states()
    told = run()
    return {"between": between, "told": told, "states": states(), "layers": layers()}


def by_relative_paths() -> dict:
    """Files named from the folder that QGIS works in, as somebody types them."""
    import processing

    os.chdir(CITY)
    done = processing.run("urbanmap:segmentbuildings", {
        "POINTS": ["als/als.laz"], "FOOTPRINTS": "footprints/gsi_buildings.gpkg", "OUTPUT": "結果 1.laz",
        "OUTPUT_BUILDINGS": "./結果 1.gpkg"})
    found = sorted(str(path.relative_to(CITY)) for path in CITY.rglob("結果*"))
    for path in found:
        (CITY / path).unlink()
    os.chdir("/")
    return {"outputs": {name: str(value) for name, value in done.items()}, "found": found}


def stopped_and_resumed() -> dict:
    """Stopped in the middle, and run again."""
    guide, moves = plugin().guide, []
    set_in_dialog("buildings", {"MIN_ROOF_AREA": 20.0})
    guide.runner.moved.connect(moves.append)
    guide.steps.run.click()
    wait_until(lambda: moves or not guide.runner.busy(), "no progress")
    guide.steps.stop.click()
    wait_until(lambda: not guide.runner.busy(), "it did not stop")
    stopped, told = states(), guide.steps.told.text()
    hidden = [path.name for path in CITY.rglob(".*")]
    return {"stopped": stopped, "told": told, "hidden": hidden, "again": run(), "states": states()}


def moved_with_its_data() -> dict:
    """The folder with job, data and results put elsewhere, and the job opened there."""
    from qgis.core import QgsProject

    guide = plugin().guide
    name = guide.path.name
    guide.new_job()
    QgsProject.instance().removeAllMapLayers()
    wait_until(lambda: not guide.files.recognition.busy(), "files were not cleared")
    MOVED.parent.mkdir()
    shutil.move(CITY, MOVED)
    guide.open_job(str(MOVED / name))
    recognised(guide)
    settle(0.5)
    opened = states()
    told = run()
    inputs = [source for sources in guide.job.inputs.values() for source in sources]
    outputs = [str(value) for value in guide.job.step("buildings").outputs.values() if "/" in str(value)]
    return {"opened": opened, "told": told, "states": states(),
            "elsewhere": [path for path in (*inputs, *outputs) if not path.startswith(str(MOVED))],
            "there": all(Path(path).exists() for path in outputs), "outputs": len(outputs)}


def updated_while_running() -> dict:
    """The plugin loaded anew while a step is at work; the job opened again and run to its end."""
    from qgis import utils

    guide, moves = plugin().guide, []
    path = str(guide.path)
    set_in_dialog("buildings", {"MIN_ROOF_AREA": 40.0})
    guide.runner.moved.connect(moves.append)
    guide.steps.run.click()
    wait_until(lambda: moves or not guide.runner.busy(), "no progress")
    busy = guide.runner.busy()
    utils.reloadPlugin("urbanmap_qgis")
    settle(3.0)
    plugin().guide_action.setChecked(True)
    guide = plugin().guide
    guide.open_job(path)
    recognised(guide)
    settle(0.5)
    opened = states()
    return {"busy": busy, "docks": docks(), "opened": opened, "told": run(), "states": states()}


def dialogs() -> int:
    """Windows of algorithms that there are, also hidden ones."""
    from qgis.gui import QgsProcessingAlgorithmDialogBase
    from qgis.PyQt.QtWidgets import QApplication

    return sum(isinstance(window, QgsProcessingAlgorithmDialogBase) for window in QApplication.topLevelWidgets())


def updated_with_open_dialogs() -> dict:
    """The plugin loaded anew with a dialog open and another at work; then the layers change that dialogs offer."""
    import processing
    from qgis import utils
    from qgis.core import QgsProject, QgsVectorLayer

    before = dialogs()
    layer = QgsVectorLayer("Polygon?crs=EPSG:6677&field=name:string", "outlines", "memory")
    QgsProject.instance().addMapLayer(layer)
    windows = [processing.createAlgorithmDialog(f"urbanmap:{name}", values) for name, values in (
        ("buildingmodels", {"FOOTPRINTS": layer.id()}), ("segmentbuildings", {
            "POINTS": [str(MOVED / "als/als.laz")], "FOOTPRINTS": str(MOVED / "footprints/gsi_buildings.gpkg")}))]
    for window in windows:
        window.show()
    settle(0.5)
    windows[1].runButton().click()
    settle(0.3)
    busy, path = not windows[1].runButton().isEnabled(), str(plugin().guide.path)
    utils.reloadPlugin("urbanmap_qgis")
    left = dialogs()
    QgsProject.instance().removeMapLayer(layer.id())
    settle(0.5)
    plugin().guide_action.setChecked(True)
    plugin().guide.open_job(path)
    recognised(plugin().guide)
    settle(0.5)
    return {"before": before, "busy": busy, "left": left, "states": states()}


def closed_while_running() -> dict:
    """QGIS left by its own entry while a step is at work: it asks, and is told to end the step; then left once more."""
    from qgis.core import QgsProject
    from qgis.PyQt.QtCore import QTimer
    from qgis.PyQt.QtWidgets import QApplication, QMessageBox
    from qgis.utils import iface

    guide, moves, asked = plugin().guide, [], []
    rest_of_tasks_threads(30_000)
    set_in_dialog("buildings", {"MIN_ROOF_AREA": 50.0})
    guide.runner.moved.connect(moves.append)
    guide.steps.run.click()
    wait_until(lambda: moves or not guide.runner.busy(), "no progress")
    busy = guide.runner.busy()

    def answer() -> None:
        box = QApplication.activeModalWidget()
        if isinstance(box, QMessageBox):
            asked.append(box.text())
            box.button(QMessageBox.StandardButton.Yes).click()
        else:
            QTimer.singleShot(200, answer)

    QTimer.singleShot(200, answer)
    QgsProject.instance().setDirty(False)
    iface.actionExit().trigger()
    wait_until(lambda: not guide.runner.busy(), "the step did not end")
    QgsProject.instance().removeAllMapLayers()  # those in the folder for temporary files are asked about
    QgsProject.instance().setDirty(False)
    QTimer.singleShot(1000, iface.actionExit().trigger)
    return {"busy": busy, "asked": asked, "states": states(), "told": guide.steps.told.text()}


STEPS = (logins_asked_for, twice, bare, over_itself, by_relative_paths, stopped_and_resumed, moved_with_its_data,
         updated_while_running, updated_with_open_dialogs, closed_while_running)


def travel() -> None:
    """Do the steps and write the report; the last one ends QGIS."""
    for result in steps_done(STEPS, Path(TASK["report"])):
        if "error" in result:
            os._exit(3)  # QGIS would ask about the unsaved project


from qgis.PyQt.QtCore import QTimer  # noqa: E402

QTimer.singleShot(500, lambda: travel())
