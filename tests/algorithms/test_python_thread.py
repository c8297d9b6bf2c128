"""Runs in threads that Python did not start, as those of QGIS's dialogs, with a pyproj that cannot bear them."""

from __future__ import annotations

import importlib.metadata
import os
import subprocess
import sys
import sysconfig
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

CONFTEST = Path(__file__).with_name("conftest.py")

SITTING = """
import importlib.util, sys
from pathlib import Path
spec = importlib.util.spec_from_file_location("conftest", sys.argv[1])
conftest = importlib.util.module_from_spec(spec)
spec.loader.exec_module(conftest)
application, plugin = conftest.start_qgis(sys.argv[2])
from qgis.core import QgsApplication, QgsProcessingAlgRunnerTask, QgsProcessingContext, QgsProcessingFeedback, QgsTask
import processing

city = Path(sys.argv[3])
given = {"POINTS": [str(city / "als/als.laz")], "FOOTPRINTS": str(city / "footprints/gsi_buildings.gpkg"),
         "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"}
algorithm = QgsApplication.processingRegistry().algorithmById("urbanmap:segmentbuildings")
manager, ended, kept = QgsApplication.taskManager(), [], []
for number in range(3):
    context, feedback = QgsProcessingContext(), QgsProcessingFeedback(False)
    task = QgsProcessingAlgRunnerTask(algorithm, given, context, feedback)
    task.executed.connect(lambda fine, results: ended.append(fine and results["BUILDINGS"]))
    kept.append((task, context, feedback))
    manager.addTask(task)
    while len(ended) == number:
        application.processEvents()
for number in range(3):
    task = QgsTask.fromFunction("scripted", lambda task: processing.run(algorithm.create(), given)["BUILDINGS"],
                                on_finished=lambda error, result=None: ended.append(result))
    kept.append(task)
    manager.addTask(task)
    while len(ended) == number + 3:
        application.processEvents()
print("pyproj", sys.modules["pyproj"].__version__)
print("ended", *ended, flush=True)
"""
"""A sitting as a user's: tasks like those of dialogs, then those of a script, one after the other."""


SYSTEM = "/usr/lib/python3/dist-packages"
"""Packages that came with QGIS, where it came with the system."""


def pyprojs() -> dict[str, tuple[str, list[str]]]:
    """Python and the folders it searches first, by the version of pyproj that it then finds: ours, and QGIS's own."""
    found = {}
    for python, folders in ((sys.executable, []), ("/usr/bin/python3", [SYSTEM, sysconfig.get_path("purelib")])):
        first = next(iter(importlib.metadata.distributions(name="pyproj", path=folders[:1] or sys.path)), None)
        if first is not None:
            found.setdefault(first.version, (python, folders))
    return found


@pytest.mark.parametrize("version", list(pyprojs()))
def test_one_sitting_of_several_runs_ends_well(version, small_city, tmp_path):
    python, folders = pyprojs()[version]
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(tmp_path), "QT_QPA_PLATFORM": "offscreen",
                   "QGIS_NO_OVERRIDE_IMPORT": "1", "PYTHONPATH": os.pathsep.join(folders)}
    done = subprocess.run([python, "-c", SITTING, str(CONFTEST), str(tmp_path / "profile"), str(small_city)],
                          capture_output=True, text=True, timeout=300, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    assert f"pyproj {version}" in done.stdout.splitlines()
    said = done.stdout.splitlines()[-1].split()
    assert said[0] == "ended" and len(said) == 7 and len(set(said[1:])) == 1 and int(said[1]) > 5, done.stdout


@pytest.fixture
def module(plugin):
    return plugin("algorithms.framework.running.python_thread")


@pytest.fixture
def in_pool(qgis_app):
    """`in_pool(work)`: what `work()` returns or raises in a thread of Qt's, while the window works."""
    from qgis.core import QgsTask

    def run(work):
        from qgis.core import QgsApplication

        outcome, tasks = [], []

        def do(_task):
            try:
                outcome.append((work(), None))
            except BaseException as error:
                outcome.append((None, error))

        tasks.append(QgsTask.fromFunction("trial", do))
        QgsApplication.taskManager().addTask(tasks[0])
        end = time.monotonic() + 120
        while not outcome and time.monotonic() < end:
            qgis_app.processEvents()
        result, error = outcome[0]
        if error is not None:
            raise error
        return result

    return run


@pytest.fixture
def example(plugin, monkeypatch, module):
    """An algorithm that tells its thread, and the fault of pyproj is taken to be there."""
    base = plugin("algorithms.framework.base").UrbanMapAlgorithm
    errors = plugin("urbanmap_qgis.errors")
    layers = plugin("algorithms.framework.layers.layers")
    monkeypatch.setattr(module, "_pyproj_needs_it", lambda: True)

    class Example(base):
        ID = "threadexample"
        NAME = "Thread example"
        HELP = "Tells its thread."
        REQUIRES = ("numpy",)

        def groupId(self):
            return "start"

        def declare(self):
            self.add_polygons("LAYER", "Polygons", "Any.")
            self.add_text("FAULT", "Fault", "Which error to raise.", "", optional=True)
            self.add_layer_output("OUTPUT", "Copy", "The same polygons.")
            self.add_text_output("THREAD", "Thread", "Its name.")

        def compute(self, parameters, context, feedback):
            progress = self.progress(feedback)
            fault = self.parameterAsString(parameters, "FAULT", context)
            table = self.read_polygons(parameters, "LAYER", context)
            for number in range(100):
                progress.step(number / 100)
            if fault == "wait":
                while True:
                    progress.check()
                    time.sleep(0.001)
            if fault == "input":
                raise errors.InputError("The input is wrong; give another.")
            if fault == "bug":
                raise ZeroDivisionError("a mistake in the program")
            layer = self.write_layer(parameters, "OUTPUT", context, layers.make_fields(base=table.fields),
                                     table.columns, table.crs, table.geometries, "Polygon")
            return {**layer, "THREAD": threading.current_thread().name}

    return Example


@pytest.fixture
def square(polygon_layer, save_outlines, tmp_path):
    import shapely

    return str(save_outlines(tmp_path / "square.gpkg", [shapely.box(0, 0, 10, 10)]))


def run_task(application, algorithm, parameters, feedback, during=lambda: None):
    """As a dialog runs it: (succeeded, results, context)."""
    from qgis.core import QgsApplication, QgsProcessingAlgRunnerTask, QgsProcessingContext

    context, ended = QgsProcessingContext(), []
    task = QgsProcessingAlgRunnerTask(algorithm, parameters, context, feedback)
    task.executed.connect(lambda succeeded, results: ended.append((succeeded, results)))
    QgsApplication.taskManager().addTask(task)
    end = time.monotonic() + 120
    while not ended and time.monotonic() < end:
        application.processEvents()
        during()
    return (*ended[0], context)


def test_results_come_home_from_the_thread(qgis_app, example, feedback, square):
    succeeded, results, context = run_task(qgis_app, example().create(), {"LAYER": square, "OUTPUT": "memory:"},
                                           feedback)
    assert succeeded, feedback.errors
    assert results["THREAD"] == "urbanmap run"
    layer = context.getMapLayer(results["OUTPUT"])
    assert layer.featureCount() == 1
    home = qgis_app.instance().thread()
    assert layer.thread() == home and layer.dataProvider().thread() == home and context.thread() == home


def test_progress_arrives(qgis_app, example, feedback, square):
    run_task(qgis_app, example().create(), {"LAYER": square, "OUTPUT": "memory:"}, feedback)
    assert len(feedback.steps) > 50 and feedback.steps == sorted(feedback.steps)


def test_cancel_arrives(qgis_app, example, feedback, square):
    def press():
        if feedback.steps:
            feedback.cancel()

    _, results, _ = run_task(qgis_app, example().create(), {"LAYER": square, "FAULT": "wait", "OUTPUT": "memory:"},
                             feedback, press)
    assert "THREAD" not in results


@pytest.mark.parametrize(("fault", "said"), [("input", "The input is wrong; give another."),
                                             ("bug", "ZeroDivisionError")])
def test_errors_come_home_from_the_thread(qgis_app, example, feedback, square, fault, said, capfd):
    succeeded, *_ = run_task(qgis_app, example().create(), {"LAYER": square, "FAULT": fault, "OUTPUT": "memory:"},
                             feedback)
    assert not succeeded
    assert any(said in text for text in feedback.errors), feedback.errors


def test_steps_of_a_chain_stay_in_its_thread(qgis_app, module, monkeypatch, feedback, small_city, in_pool):
    import processing

    monkeypatch.setattr(module, "_pyproj_needs_it", lambda: True)
    given = {"POINTS": [str(small_city / "als/als.laz")], "OUTPUT": "TEMPORARY_OUTPUT",
             "FOOTPRINTS": str(small_city / "footprints/gsi_buildings.gpkg"),
             "OUTPUT_CITYJSON": "TEMPORARY_OUTPUT", "OUTPUT_REPORT": "TEMPORARY_OUTPUT"}
    seen = []
    handed = module._handed_over
    monkeypatch.setattr(module, "_handed_over", lambda work, context: seen.append(1) or handed(work, context))
    results = in_pool(lambda: processing.run("urbanmap:buildingsfromals", given))
    assert Path(results["OUTPUT_CITYJSON"]).stat().st_size > 1000
    assert len(seen) == 2, "its parameters are checked, then all its steps run in the one thread"


def test_steps_of_a_model_report_their_progress(qgis_app, module, monkeypatch, feedback, small_city):
    from qgis.core import QgsApplication

    monkeypatch.setattr(module, "_pyproj_needs_it", lambda: True)
    registry = QgsApplication.processingRegistry()
    model = next(item for item in registry.providerById("urbanmap").algorithms()
                 if not hasattr(item, "compute") and "als" in item.id().lower() and "building" in item.id().lower())
    given = {"POINTS": [str(small_city / "als/als.laz")],
             "FOOTPRINTS": str(small_city / "footprints/gsi_buildings.gpkg")}
    given |= {item.name(): "TEMPORARY_OUTPUT" for item in model.destinationParameterDefinitions()}
    succeeded, *_ = run_task(qgis_app, model, given, feedback)
    assert succeeded, feedback.errors
    steps = model.childAlgorithms()
    inside = [value for value in feedback.steps if all(abs(value - 100 * number / len(steps)) > 0.5
                                                       for number in range(len(steps) + 1))]
    assert len(inside) > len(steps), feedback.steps


def test_threads_of_python_and_the_main_one_work_themselves(module, monkeypatch):
    from qgis.core import QgsProcessingContext

    monkeypatch.setattr(module, "_pyproj_needs_it", lambda: True)
    context = QgsProcessingContext()
    assert module.in_python_thread(threading.get_ident, context) == threading.get_ident()
    with ThreadPoolExecutor(1) as pool:
        own = pool.submit(threading.get_ident).result()
        assert pool.submit(lambda: module.in_python_thread(threading.get_ident, context)).result() == own


def test_a_thread_of_qt_hands_over_only_where_pyproj_needs_it(module, monkeypatch, in_pool):
    from qgis.core import QgsProcessingContext

    def where():
        context = QgsProcessingContext()
        return module.in_python_thread(threading.get_ident, context) == threading.get_ident()

    for version, stays in (("3.4.1", True), ("3.6.1", True), ("3.7.0", False), ("3.7.2", False), ("3.8.0", True)):
        monkeypatch.setattr(sys.modules["pyproj"], "__version__", version)
        assert in_pool(where) is stays, version


def test_variables_of_the_run_are_there(module, monkeypatch, in_pool):
    from contextvars import ContextVar

    from qgis.core import QgsProcessingContext

    monkeypatch.setattr(module, "_pyproj_needs_it", lambda: True)
    variable = ContextVar("trial", default="")

    def ask():
        variable.set("kept")
        return module.in_python_thread(variable.get, QgsProcessingContext())

    assert in_pool(ask) == "kept"
