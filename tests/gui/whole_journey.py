"""A new user's whole way in QGIS's desktop on a virtual screen, with a picture of each step to be looked at.

The zip of an earlier version is installed into a fresh profile, packages are offered (and installed with `--install`),
the plugin is updated from the new zip while QGIS runs, the sample city is made, the dock leads to buildings and to the
survey, steps run a second and third time, and an acceptance report is printed as PDF:

    .venv/bin/python tests/gui/whole_journey.py FOLDER --zip NEW.zip --previous OLD.zip --language ja

FOLDER then holds the pictures, `report.json` with what each step found, and the job. The exit code is 1 where a step
failed. Zips are made by `scripts/package.py`. The script runs itself a second time inside QGIS (`qgis --code`), where
URBANMAP_WAY names its task.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import sysconfig
import time
import traceback
from pathlib import Path

PLUGIN, SIZE = "urbanmap_qgis", 100.0
PATIENCE = 900.0
LONGEST = 3600.0
"""s; one step, and the whole way, on a busy machine."""
TASK = json.loads(Path(os.environ["URBANMAP_WAY"]).read_text(encoding="utf-8")) if "URBANMAP_WAY" in os.environ else {}
if TASK:
    sys.path.insert(0, TASK["helpers"])

from inside_qgis import settle, wait_until  # noqa: E402


class Way:
    """The steps in their order; each gives what it found."""

    def __init__(self, task: dict):
        self.folder, self.task = Path(task["folder"]), task
        self.city = self.folder / "city"
        self.raised: list[str] = []

    @property
    def plugin(self):
        from qgis import utils

        return utils.plugins[PLUGIN]

    def picture(self, name: str, window=None) -> None:
        """A window as it looks, the main window if none is given."""
        from qgis.utils import iface

        settle(1.0)
        (window or iface.mainWindow()).grab().save(str(self.folder / f"{name}.png"))

    def show_dock(self) -> None:
        from qgis.PyQt.QtCore import Qt
        from qgis.PyQt.QtWidgets import QDockWidget
        from qgis.utils import iface

        window = iface.mainWindow()
        window.showNormal()
        window.resize(1380, 860)
        window.resizeDocks([self.plugin.guide, window.findChild(QDockWidget, "Layers")], [620, 250],
                           Qt.Orientation.Horizontal)
        settle(0.5)

    def state(self) -> dict:
        """Version and what the plugin offers."""
        from qgis import utils
        from qgis.core import QgsApplication

        provider = QgsApplication.processingRegistry().providerById("urbanmap")
        return {"version": utils.pluginMetadata(PLUGIN, "version"), "loaded": PLUGIN in utils.plugins,
                "algorithms": len(provider.algorithms()) if provider else 0}

    def layers(self) -> list[str]:
        from qgis.core import QgsProject

        return sorted(layer.name() for layer in QgsProject.instance().mapLayers().values())

    # The steps

    def install_zip(self) -> dict:
        """The earlier version by the plugin manager's own way; the line about packages above the map."""
        import pyplugin_installer
        from qgis.utils import iface

        pyplugin_installer.instance().installFromZipFile(self.task["previous"])
        settle(1.0)
        texts = [item.text() for item in iface.messageBar().items()]
        self.picture("01_installed")
        if self.task["install"]:
            self._install_packages()
        else:
            self._link_packages()
        return {**self.state(), "messages": texts}

    def _install_packages(self) -> None:
        from qgis.utils import plugins

        module = importlib.import_module(f"{PLUGIN}.algorithms.framework.packages.install")
        dialog = module.InstallDialog()
        dialog.show()
        self.picture("02_packages", dialog)
        dialog.start()
        wait_until(lambda: dialog.task is None, "packages were not installed", PATIENCE)
        self.picture("02_packages_installed", dialog)
        dialog.close()
        assert plugins[PLUGIN] and not dialog.missing, dialog.label.text()

    def _link_packages(self) -> None:
        module = importlib.import_module(f"{PLUGIN}.algorithms.framework.packages.dependencies")
        place = Path(module.profile_packages())
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(self.task["packages"], target_is_directory=True)
        module.activate_profile_packages()

    def update_plugin(self) -> dict:
        """The new zip over the one that is loaded, in the running QGIS, with the dock open."""
        import pyplugin_installer
        from qgis.utils import iface

        before = self.state()
        pyplugin_installer.instance().installFromZipFile(self.task["zip"])
        settle(1.0)
        iface.messageBar().clearWidgets()
        after = self.state()
        self.plugin.guide_action.setChecked(True)
        self.show_dock()
        self.picture("03_updated")
        assert after["loaded"] and after["algorithms"] >= before["algorithms"], (before, after)
        return {"before": before, "after": after}

    def sample_city(self) -> dict:
        """The sample city by its dialog."""
        results = self._run_dialog("samplecity", {"SIZE": SIZE, "OUTPUT": str(self.city)}, "04_sample_city")
        return {"files": len(list(self.city.rglob("*"))), "results": len(results), "layers": self.layers()}

    def _run_dialog(self, algorithm: str, parameters: dict, name: str) -> dict:
        import processing

        window = processing.createAlgorithmDialog(f"urbanmap:{algorithm}", parameters)
        window.show()
        results = self._press_run(window, name)
        window.close()
        return results

    def _press_run(self, window, name: str) -> dict:
        ended = []
        window.algorithmFinished.connect(lambda succeeded, results: ended.append((succeeded, results)))
        window.runButton().click()
        wait_until(lambda: ended, f"{name} did not end", PATIENCE)
        self.picture(name, window)
        assert ended[0][0], f"{name} failed"
        return dict(ended[0][1])

    def dropped(self) -> dict:
        """The city's folder given to the dock."""
        guide = self.plugin.guide
        self.show_dock()
        guide.files.add([str(self.city)])
        wait_until(lambda: guide.files.findings.facts and not guide.files.recognition.busy(), "not recognised")
        self.picture("05_files")
        row = next(row for row in guide.files._rows() if row.text(0) == "als_classified.laz")
        guide.files.tree.scrollToItem(row)
        guide.files.tree.setCurrentItem(row)
        self.picture("05_files_chosen")
        return {"fit": guide.files.fit.text(), "hint": guide.files.hint.text(), "played": row.text(1)}

    def buildings(self) -> dict:
        return self._wish("buildings", "06_buildings")

    def _wish(self, wish: str, name: str) -> dict:
        guide = self.plugin.guide
        guide.pages.setCurrentIndex(1)
        guide.wish.setCurrentIndex(guide.wish.findData(wish))
        settle()
        self.picture(f"{name}_planned")
        guide.steps.run.click()
        settle(2.0)
        self.picture(f"{name}_running")
        wait_until(lambda: not guide.runner.busy(), f"{wish} did not end", PATIENCE)
        self.picture(f"{name}_done")
        states = {step.id: [step.state, step.verdict or step.message] for step in guide.job.steps}
        assert all(state == "done" for state, _ in states.values()), states
        return {"steps": states, "layers": self.layers(), "missing": guide.missing.text()}

    def again(self) -> dict:
        """A step a second time from its own dialog and a third time with another setting by the dock."""
        guide = self.plugin.guide
        guide.open_step("buildings")
        settle(0.5)
        self._press_run(guide.dialog.window, "07_second_run")
        guide.dialog.window.close()
        settle()
        second = guide.job.step("buildings").state
        guide.open_step("buildings")
        settle(0.5)
        guide.dialog.window.setParameters({**guide.dialog.before, "MIN_ROOF_AREA": 30.0})
        guide.dialog.window.close()
        settle()
        between = guide.job.step("buildings").state
        third = self._wish("buildings", "08_third_run")
        assert (second, between) == ("done", "planned"), (second, between)
        return third

    def survey(self) -> dict:
        return self._wish("survey", "09_survey")

    def back(self) -> dict:
        """The earlier wish again: nothing runs anew."""
        guide = self.plugin.guide
        started = time.monotonic()
        found = self._wish("buildings", "10_back")
        assert time.monotonic() - started < 60 and guide.job.step("buildings").seconds
        return {"aside": [step.id for step in guide.job.aside], **found}

    def printed(self) -> dict:
        """The acceptance report as PDF, asked for in the step's own dialog, made by the dock's run."""
        guide = self.plugin.guide
        guide.wish.setCurrentIndex(guide.wish.findData("survey"))
        settle()
        guide.open_step("acceptance_1")
        settle(0.5)
        place = self.folder / "acceptance.pdf"
        guide.dialog.window.setParameters({**guide.dialog.before, "OUTPUT_PDF": str(place), "JOB": "Job 1"})
        self.picture("11_acceptance", guide.dialog.window)
        guide.dialog.window.close()
        settle()
        self._wish("survey", "11_printed")
        if shutil.which("pdftoppm"):
            subprocess.run(["pdftoppm", "-r", "60", "-png", str(place), str(self.folder / "12_page")], check=True)
        return {"bytes": place.stat().st_size, "kept": list(guide.job.step("acceptance_1").own)}

    def lane_map(self) -> dict:
        return self._wish("lanemap", "13_lane_map")

    def walls(self) -> dict:
        return self._wish("walls", "14_walls")

    def accuracy_map(self) -> dict:
        return self._wish("accuracymap", "15_accuracy_map")

    def road_model(self) -> dict:
        """The surface of a crossing, in a file that no name tells, said to be roads below the table of files."""
        from qgis.core import QgsFeature, QgsGeometry, QgsRasterLayer, QgsVectorFileWriter, QgsVectorLayer

        layer = QgsVectorLayer("Polygon?crs=EPSG:6677", "surfaces", "memory")
        crossing, middle = QgsFeature(), QgsRasterLayer(str(self.city / "aerial" / "ortho.tif")).extent().center()
        shape = QgsGeometry.fromWkt("POLYGON((-47 -3,-4 -3,-4 -47,4 -47,4 -3,47 -3,47 3,4 3,4 47,-4 47,-4 3,-47 3,"
                                    "-47 -3))")
        shape.rotate(-13.0, QgsGeometry.fromWkt("POINT(0 0)").asPoint())
        shape.translate(middle.x(), middle.y())
        crossing.setGeometry(shape)
        layer.dataProvider().addFeature(crossing)
        place = self.folder / "測量 成果" / "交差点 面.gpkg"
        place.parent.mkdir()
        QgsVectorFileWriter.writeAsVectorFormat(layer, str(place), "UTF-8", layer.crs(), "GPKG")
        guide = self.plugin.guide
        guide.pages.setCurrentIndex(0)
        guide.files.add([str(place)])
        wait_until(lambda: not guide.files.recognition.busy()
                   and any(item.path.name == place.name for item in guide.files.findings.facts), "not recognised")
        row = next(row for row in guide.files._rows() if row.text(0).startswith("交差点 面"))
        guide.files.tree.clearSelection()
        guide.files.tree.setCurrentItem(row)
        row.setSelected(True)
        settle()
        guide.files.use.setCurrentIndex(guide.files.use.findData("roads"))
        guide.files.use.activated.emit(guide.files.use.currentIndex())
        settle()
        self.picture("16_roads_said")
        return {"played": row.text(1), **self._wish("roadmodel", "17_road_model")}

    def street_objects(self) -> dict:
        return self._wish("streetobjects", "18_street_objects")

    def measured_roads(self) -> dict:
        return self._wish("measuredroads", "18_measured_roads")

    def once_more(self) -> dict:
        """The plugin put over itself with the dock open; the job opened again is done."""
        import pyplugin_installer

        path, before = str(self.plugin.guide.path), self.state()
        pyplugin_installer.instance().installFromZipFile(self.task["zip"])
        settle(1.0)
        self.plugin.guide_action.setChecked(True)
        guide = self.plugin.guide
        self.show_dock()
        guide.open_job(path)
        wait_until(lambda: guide.files.findings.facts and not guide.files.recognition.busy(), "not recognised")
        settle(0.5)
        self.picture("19_opened_again")
        states = {step.id: step.state for step in guide.job.steps}
        assert set(states.values()) == {"done"} and self.state() == before, (states, before, self.state())
        return {"steps": states, "opened": path, **before}

    STEPS = ("install_zip", "update_plugin", "sample_city", "dropped", "buildings", "again", "survey", "back",
             "printed", "lane_map", "walls", "accuracy_map", "road_model", "street_objects",
             "measured_roads", "once_more")

    def travel(self) -> None:
        """Do the steps, write the report, end QGIS."""
        from qgis import utils

        report = {}
        settle(1.0)
        # QGIS would wait in a window for somebody to read it.
        utils.showException = lambda *told, **_: self.raised.append("".join(traceback.format_exception(*told[:3])))
        for step in self.STEPS:
            started = time.monotonic()
            try:
                report[step] = getattr(self, step)()
            except BaseException:
                report[step] = {"error": traceback.format_exc()}
                self.picture(f"error_{step}")
            report[step]["took"] = round(time.monotonic() - started, 1)
            report["raised"] = self.raised
            (self.folder / "report.json").write_text(json.dumps(report, default=str, indent=1, ensure_ascii=False),
                                                     encoding="utf-8")
            if "error" in report[step]:
                break
        os._exit(0)  # QGIS would ask about the unsaved project


def started_from_outside() -> int:
    """Make a profile, start QGIS, tell what each step found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path, help="a new folder for pictures, data and the report")
    parser.add_argument("--zip", type=Path, required=True, help="the plugin, of scripts/package.py")
    parser.add_argument("--previous", type=Path, help="an earlier one, installed first; the same if none is given")
    parser.add_argument("--language", default="en", help="of QGIS: en or ja")
    parser.add_argument("--install", action="store_true", help="install the packages by pip, as a user does")
    given = parser.parse_args()
    if given.language == "ja" and not subprocess.run(["fc-list", ":lang=ja"], capture_output=True, check=False).stdout:
        print("There is no Japanese font: the pictures show boxes; apt install fonts-ipaexfont", file=sys.stderr)
    given.folder.mkdir(parents=True)
    folder = given.folder.resolve()
    path = Path(__file__).resolve().parents[2] / "scripts" / "make_tutorial_pictures.py"
    spec = importlib.util.spec_from_file_location("urbanmap_windows", path)
    windows = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = windows
    spec.loader.exec_module(windows)
    profile = windows.profile_of(folder, given.language)
    (profile / "plugins" / PLUGIN).unlink()
    settings = profile / "config/profiles/default/QGIS/QGIS3.ini"
    settings.write_text(settings.read_text(encoding="utf-8").replace(f"{PLUGIN}=true\n", ""), encoding="utf-8")
    task = {"folder": str(folder), "zip": str(given.zip.resolve()), "install": given.install,
            "previous": str((given.previous or given.zip).resolve()), "helpers": str(path.parents[1] / "tests" / "gui"),
            "packages": sysconfig.get_path("purelib")}
    (folder / "task.json").write_text(json.dumps(task), encoding="utf-8")
    windows.open_desktop(Path(__file__).resolve(), folder, profile, LONGEST,
                         URBANMAP_WAY=str(folder / "task.json"))
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    print(json.dumps(report, indent=1, ensure_ascii=False))
    done = all("error" not in report.get(step, {"error": ""}) for step in Way.STEPS)
    return 0 if done and not report["raised"] else 1


if TASK:
    from qgis.PyQt.QtCore import QTimer

    WAY = Way(TASK)
    QTimer.singleShot(500, lambda: WAY.travel())  # Qt would not keep the object of a bound method
elif __name__ == "__main__":
    sys.exit(started_from_outside())
