"""Runs inside QGIS's desktop (`qgis --code`): the dock from dropped files to loaded results, noted for the tests.

URBANMAP_GUIDE names a JSON file: "city" (folder to drop), "report" (file to write after each step), "helpers"
(folder of `inside_qgis`).
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path

TASK = json.loads(Path(os.environ["URBANMAP_GUIDE"]).read_text(encoding="utf-8"))
CITY = Path(TASK["city"])
sys.path.insert(0, TASK["helpers"])

from inside_qgis import plugin, settle, steps_done, wait_until, wish  # noqa: E402


def drop(paths: list[Path]) -> None:
    """Drop files on the table, as a file manager does."""
    from qgis.PyQt.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
    from qgis.PyQt.QtGui import QDragEnterEvent, QDropEvent
    from qgis.PyQt.QtWidgets import QApplication

    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    tree = plugin().guide.files.tree
    how = Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    enter, event = QDragEnterEvent(QPoint(20, 20), *how), QDropEvent(QPointF(20, 20), *how)
    QApplication.sendEvent(tree.viewport(), enter)
    QApplication.sendEvent(tree.viewport(), event)


def states() -> dict:
    """State of each step, as the list shows it."""
    tree = plugin().guide.steps.tree
    rows = [tree.topLevelItem(row) for row in range(tree.topLevelItemCount())]
    return {row.toolTip(0): [row.text(1), row.text(2)] for row in rows}


def loaded() -> list:
    """Name, size and renderer of the project's layers."""
    from qgis.core import QgsProject, QgsVectorLayer

    found = []
    for layer in QgsProject.instance().mapLayers().values():
        vector = isinstance(layer, QgsVectorLayer)
        found.append([layer.name(), layer.featureCount() if vector else layer.width(), layer.renderer().type()])
    return sorted(found)


def opened() -> dict:
    """The button opens the dock."""
    plugin().guide_action.trigger()
    settle(1.0)
    return {"visible": plugin().guide.isVisible(), "steps": states()}


def dropped() -> dict:
    """The city's folder dropped on the table."""
    guide = plugin().guide
    drop([CITY])
    wait_until(lambda: guide.files.findings.facts and not guide.files.recognition.busy(), "files were not recognised")
    tree = guide.files.tree
    return {"groups": [tree.topLevelItem(row).text(0) for row in range(tree.topLevelItemCount())],
            "boxes": len(guide.files.map.placed()), "fit": guide.files.fit.text(), "hint": guide.files.hint.text()}


def planned() -> dict:
    """Buildings wished for; the first step's own dialog could run at once."""
    from qgis.core import QgsProcessingContext

    guide = plugin().guide
    guide.pages.setCurrentIndex(1)
    wish("buildings")
    found = {"steps": states(), "missing": guide.missing.text(), "job": str(guide.path), "kept": guide.path.is_file()}
    guide.open_step("buildings")
    settle(0.5)
    window = guide.dialog.window
    found["first"] = window.algorithm().checkParameterValues(guide.dialog.before, QgsProcessingContext())
    window.close()
    settle(0.2)
    return found


def ran() -> dict:
    """Run pressed, to the end."""
    guide, moves, progress = plugin().guide, [], []
    guide.runner.moved.connect(moves.append)
    guide.runner.moved.connect(lambda *_: progress.append(guide.steps.told.text()))
    guide.steps.run.click()
    wait_until(lambda: moves or not guide.runner.busy(), "no progress")
    settle(0.5)
    told = progress[0]
    wait_until(lambda: not guide.runner.busy(), "the run did not end")
    settle(0.5)
    told = [told, guide.steps.told.text()]
    guide.steps.tree.setCurrentItem(guide.steps.tree.topLevelItem(0))
    return {"steps": states(), "layers": loaded(), "moves": len(moves), "told": [*told, guide.steps.told.text()],
            "report": guide.steps.report.isEnabled()}


def listed() -> dict:
    """A report that a dialog made: QGIS opens its results viewer, which leaves the dock its height."""
    from processing.core.ProcessingResults import resultsList
    from qgis.PyQt.QtGui import QIcon
    from qgis.PyQt.QtWidgets import QDockWidget
    from qgis.utils import iface

    guide, viewer = plugin().guide, iface.mainWindow().findChild(QDockWidget, "ResultsViewer")
    before, report = guide.height(), guide.job.steps[0].outputs["OUTPUT_REPORT"]
    resultsList.addResult(icon=QIcon(), name="Report", timestamp=time.localtime(), result=report)
    settle(0.5)
    opened = viewer.isVisible()
    guide.raise_()
    settle(0.2)
    found = {"opened": opened, "before": before, "after": guide.height(), "hidden": guide.visibleRegion().isEmpty()}
    viewer.hide()
    return found


def reopened() -> dict:
    """A new job, then the kept one opened and run again: nothing is done anew."""
    guide = plugin().guide
    path = guide.path
    guide.new_job()
    wait_until(lambda: not guide.files.findings.facts, "files were not cleared")
    emptied = states()
    guide.open_job(str(path))
    wait_until(lambda: guide.files.findings.facts and not guide.files.recognition.busy(), "files were not recognised")
    settle(0.5)
    shown = states()
    guide.steps.run.click()
    wait_until(lambda: not guide.runner.busy(), "the run did not end")
    return {"empty": emptied, "steps": shown, "after": states(), "layers": loaded(), "told": guide.steps.told.text()}


def tuned() -> dict:
    """A step's own dialog, filled in; a setting changed there is kept in the job."""
    guide = plugin().guide
    guide.open_step("buildings")
    settle(0.5)
    dialog = guide.dialog
    filled, untouched = {name: str(value) for name, value in dialog.before.items()}, dialog.values()
    dialog.window.setParameters({**dialog.before, "MIN_ROOF_AREA": 30.0})
    dialog.window.close()
    settle(0.2)
    return {"filled": filled, "untouched": untouched, "steps": states(),
            "kept": guide.job.step("buildings").parameters.get("MIN_ROOF_AREA")}


def cancelled() -> dict:
    """Another wish, whose first step is stopped."""
    guide = plugin().guide
    wish("survey")
    before, moves = states(), []
    guide.runner.moved.connect(moves.append)
    guide.steps.run.click()
    wait_until(lambda: moves or not guide.runner.busy(), "no progress")
    guide.steps.stop.click()
    started = time.monotonic()
    wait_until(lambda: not guide.runner.busy(), "it did not stop")
    return {"before": before, "after": states(), "told": guide.steps.told.text(),
            "seconds": time.monotonic() - started}


def unticked() -> dict:
    """Without the airborne points buildings are told to lack them."""
    from qgis.PyQt.QtCore import Qt

    guide = plugin().guide
    wish("buildings")
    tree = guide.files.tree
    for group in range(tree.topLevelItemCount()):
        for row in range(tree.topLevelItem(group).childCount()):
            item = tree.topLevelItem(group).child(row)
            if item.text(0).startswith("als"):
                item.setCheckState(0, Qt.CheckState.Unchecked)
    settle()
    return {"missing": guide.missing.text(), "run": guide.steps.run.isEnabled(), "left_out": len(guide.job.left_out)}


def used() -> dict:
    """A survey's cloud said to be airborne in the drop-down below the table, and left to the program again."""
    guide = plugin().guide
    tree, box = guide.files.tree, guide.files.use
    before = box.isEnabled()
    tree.clearSelection()
    row, = [item for item in guide.files._rows() if item.text(0) == "survey_01.laz"]
    row.setSelected(True)
    settle()
    offered, played = [box.itemText(number) for number in range(box.count())], row.text(1)

    def choose(use: str) -> list:
        box.setCurrentIndex(box.findData(use))
        box.activated.emit(box.currentIndex())
        settle()
        return [row.text(1), dict(guide.job.used_as), guide.missing.text(), guide.steps.run.isEnabled()]

    return {"before": before, "offered": offered, "played": played, "said": choose("als"), "again": choose("")}


def imported() -> dict:
    """A table of another program made into a trajectory, its way of reading kept by name and chosen again."""
    guide = plugin().guide
    table = CITY / "table.txt"
    lines = (CITY / "mms/survey_01_trajectory.csv").read_text(encoding="utf-8").splitlines()[1:400]
    rows = [line.replace(",", ";") for line in lines]
    table.write_bytes("\r\n".join(["作成 測量", "時刻;東;北;標高;ロール;ピッチ;未定", *rows]).encode("cp932"))
    guide.import_table()
    dialog = guide.importing
    dialog.open_file(str(table))
    guessed = dialog.way()
    box = dialog.table.cellWidget(0, 6)
    refused = dialog.write(str(CITY / "out.csv"))
    sentence = dialog.told.text()
    box.setCurrentIndex(box.findData("heading"))
    dialog.name.setText("社内")
    before = len(guide.files.given)
    written = dialog.write(str(CITY / "out.csv"))
    wait_until(lambda: not guide.files.recognition.busy(), "files were not recognised")
    dialog.close()
    guide.import_table()
    again = guide.importing
    again.path.setText(str(table))
    again.kept.setCurrentIndex(again.kept.findText("社内"))
    again._take_kept()
    found = again.way()
    again.close()
    return {"guessed": [guessed.encoding, guessed.delimiter, guessed.skip, sorted(guessed.columns)],
            "refused": [refused, sentence], "written": written, "kept": sorted(found.columns),
            "given": len(guide.files.given) - before,
            "head": (CITY / "out.csv").read_text(encoding="utf-8").splitlines()[0]}


def placed() -> dict:
    """A table in latitude and longitude: the job's system is offered, heights are asked for, where it lies is shown."""
    from pyproj import Transformer

    guide = plugin().guide
    table, back = CITY / "degrees.txt", Transformer.from_crs(6677, 6668, always_xy=True)
    lines = (CITY / "mms/survey_01_trajectory.csv").read_text(encoding="utf-8").splitlines()[1:400]
    rows = [line.split(",")[:7] for line in lines]
    for row in rows:
        longitude, latitude = back.transform(float(row[1]), float(row[2]))
        row[1:3] = [f"{latitude:.9f}", f"{longitude:.9f}"]
    table.write_text("\n".join(["time,lat,lon,height,roll,pitch,heading", *map(",".join, rows)]), encoding="utf-8")
    guide.import_table()
    dialog = guide.importing
    dialog.open_file(str(table))
    settle(0.2)
    offered, place = dialog.crs.crs().authid(), dialog.placed.text()
    shown = [widget.isVisible() for widget in (dialog.crs, dialog.north, dialog.heights, dialog.geoid)]
    refused = [dialog.write(str(CITY / "laid.csv")), dialog.told.text()]
    dialog.heights.setCurrentIndex(dialog.heights.findData("ellipsoidal"))
    settle(0.1)
    shown.append(dialog.geoid.isVisible())
    written = dialog.write(str(CITY / "laid.csv"))
    dialog.close()
    first = (CITY / "laid.csv").read_text(encoding="utf-8").splitlines()[1].split(",")[1:4]
    off = [float(value) - float(true) for value, true in zip(first, lines[0].split(",")[1:4])]
    return {"offered": offered, "place": place, "shown": shown, "refused": refused, "written": written,
            "told": dialog.told.text(), "off": off}


def previewed() -> dict:
    """Control points as a Japanese spreadsheet saves them: told in the list, opened from it, imported."""
    guide = plugin().guide
    table = CITY / "成果　表.csv"
    table.write_bytes("点名,X座標,Y座標,標高,区分\r\nA,-34000.5,-7000.5,3,標定点\r\nB,-34001,-7001,4,検証点".encode("cp932"))
    drop([table])
    wait_until(lambda: not guide.files.recognition.busy() and any(
        item.path.name == table.name for item in guide.files.findings.facts), "the table was not recognised")
    said = guide.files.fit.text()
    row = next(item for item in guide.files._rows() if item.text(0) == table.name)
    guide.files.tree.clearSelection()
    row.setSelected(True)
    guide.files.tree.itemDoubleClicked.emit(row, 0)
    dialog = guide.importing
    told, place, target = dialog.order.text(), dialog.placed.text(), dialog.way().target
    written = dialog.write(str(CITY / "成果.csv"))
    wait_until(lambda: not guide.files.recognition.busy(), "files were not recognised")
    dialog.close()
    return {"said": said, "told": told, "place": place, "target": target, "written": written,
            "lines": (CITY / "成果.csv").read_text(encoding="utf-8").splitlines()[:2]}


def changed_elsewhere() -> dict:
    """The job's file changed by another window, then something changed here: that is not written over."""
    guide = plugin().guide
    path = guide.path
    content = path.read_text(encoding="utf-8") + "\n"
    path.write_text(content, encoding="utf-8")
    wish("survey" if guide.wish.currentData() != "survey" else "buildings")
    return {"kept": path.read_text(encoding="utf-8") == content, "told": guide.place.text()}


def unloaded() -> dict:
    """The plugin taken away with the dock open, files just recognised and not yet shown, and loaded again."""
    from qgis import utils
    from qgis.PyQt.QtWidgets import QDockWidget

    window, guide = utils.iface.mainWindow(), plugin().guide
    drop([CITY / "footprints"])
    guide.files.recognition._thread.join()
    utils.unloadPlugin("urbanmap_qgis")
    settle(0.5)
    left = [dock.objectName() for dock in window.findChildren(QDockWidget) if dock.objectName() == "UrbanMapGuide"]
    utils.loadPlugin("urbanmap_qgis")
    utils.startPlugin("urbanmap_qgis")
    plugin().guide_action.trigger()
    settle(0.5)
    return {"left": left, "again": plugin().guide.isVisible()}


STEPS = (opened, dropped, planned, ran, listed, reopened, tuned, cancelled, unticked, used, imported, placed, previewed,
         changed_elsewhere, unloaded)


def travel() -> None:
    """Do the steps, write the report, end QGIS."""
    for _ in steps_done(STEPS, Path(TASK["report"])):
        pass
    os._exit(0)  # QGIS would ask about the unsaved project


from qgis.PyQt.QtCore import QTimer  # noqa: E402

QTimer.singleShot(500, travel)
