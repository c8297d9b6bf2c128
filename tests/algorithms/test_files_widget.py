"""Several files in QGIS's dialogs: presets and batch files keep them, layers of the project can be chosen."""

from __future__ import annotations

import json
from types import SimpleNamespace

import pytest

FILES = ["/data/点群 1.laz", "/data/b.laz"]


def file_lists():
    """Algorithm and parameter for each that takes several files."""
    from qgis.core import QgsApplication, QgsProcessing

    return [(algorithm, item.name())
            for algorithm in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
            if hasattr(algorithm, "compute") for item in algorithm.parameterDefinitions()
            if item.type() == "multilayer" and item.layerType() == QgsProcessing.SourceType.TypeFile]


def wrapper_of(algorithm, name):
    from processing.gui.wrappers import WidgetWrapperFactory
    from qgis.core import QgsProcessingContext, QgsProject
    from qgis.PyQt.QtWidgets import QDialog

    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    wrapper = WidgetWrapperFactory.create_wrapper(algorithm.parameterDefinition(name), QDialog())
    return wrapper, wrapper.widget, context


def test_every_list_of_files_is_kept(qgis_app):
    asked = 0
    for algorithm, name in file_lists():
        wrapper, field, context = wrapper_of(algorithm, name)
        assert wrapper.parameterValue() is None
        for given, kept in ((FILES, FILES), (FILES[0], FILES[:1]), (None, None)):
            wrapper.setParameterValue(given, context)
            assert wrapper.parameterValue() == kept, (algorithm.name(), name)
        wrapper.setParameterValue(FILES, context)
        assert field.line.toolTip().split("\n") == FILES
        asked += 1
    assert asked > 30


def test_a_dialog_is_filled_with_what_a_history_says(qgis_app):
    from processing.gui.AlgorithmDialog import AlgorithmDialog
    from qgis.core import QgsApplication

    dialog = AlgorithmDialog(QgsApplication.processingRegistry().algorithmById("urbanmap:groundfrommms").create())
    dialog.setParameters({"POINTS": FILES, "THRESHOLD": 0.3})
    values = (dialog.createProcessingParameters() if hasattr(dialog, "createProcessingParameters")
              else dialog.getParameterValues())
    assert values["POINTS"] == FILES and values["THRESHOLD"] == 0.3
    dialog.close()


def test_a_batch_file_is_read_and_its_rows_run(run, qgis_app, make_cloud, tmp_path, monkeypatch):
    """As saved by QGIS's batch window, read into its table, each row run with what the table then says."""
    import numpy as np
    from processing.gui import BatchPanel as batch
    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog
    from qgis.core import QgsApplication, QgsProcessingContext, QgsProject

    axis = np.arange(0.0, 40.0, 0.4)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    clouds = [str(make_cloud(tmp_path / f"{name}.laz", x, y, 0.01 * x)) for name in "ab"]
    later = hasattr(batch.BatchPanel, "CURRENT_FORMAT")  # values as they are instead of their text
    rows = [{"PARAMETERS": {"POINTS": clouds[:count + 1] if later else repr(clouds[:count + 1])},
             "OUTPUTS": {"OUTPUT": str(tmp_path / f"ground {count}.laz")}} for count in range(2)]
    if later:
        rows = {batch.BatchPanel.FORMAT: batch.BatchPanel.CURRENT_FORMAT, batch.BatchPanel.ROWS: rows}
    saved = tmp_path / "batch.json"
    saved.write_text(json.dumps(rows), encoding="utf-8")
    monkeypatch.setattr(batch.QFileDialog, "getOpenFileName", lambda *_: (str(saved), ""))
    dialog = BatchAlgorithmDialog(QgsApplication.processingRegistry().algorithmById("urbanmap:groundfrommms").create())
    panel = dialog.mainWidget()
    panel.load()
    assert panel.batchRowCount() == 2
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    for number in range(2):
        parameters, ready = panel.parametersForRow(number, context)
        assert ready and parameters["POINTS"] == clouds[:number + 1]
        made = run("urbanmap:groundfrommms", parameters)
        assert made["OUTPUT"] == str(tmp_path / f"ground {number}.laz")
    dialog.close()


def test_layers_of_the_project_are_offered(plugin, monkeypatch):
    widget = plugin("algorithms.framework.declaring.files_widget")
    from pathlib import Path

    layers = {"1": SimpleNamespace(name=lambda: "survey"), "2": SimpleNamespace(name=lambda: "image")}
    monkeypatch.setattr(widget, "QgsProject", SimpleNamespace(
        instance=lambda: SimpleNamespace(mapLayers=lambda: layers)))
    monkeypatch.setattr(widget, "file_of_layer", lambda layer: Path(
        "/data/survey.laz" if layer.name() == "survey" else "/data/image.tif"))
    offered = widget.layer_files()
    assert offered == {"/data/survey.laz": "survey"}
    dialog = widget.FilesDialog("Points", FILES, offered)
    assert dialog.list.count() == 3 and dialog.chosen() == FILES
    from qgis.PyQt.QtCore import Qt

    dialog.list.item(2).setCheckState(Qt.CheckState.Checked)
    dialog.list.item(0).setCheckState(Qt.CheckState.Unchecked)
    assert dialog.chosen() == [FILES[1], "/data/survey.laz"]


@pytest.mark.parametrize("name", ["POINTS"])
def test_the_modeller_keeps_its_own_field(qgis_app, name):
    """Which offers outputs of earlier steps."""
    from processing.gui.wrappers import WidgetWrapperFactory
    from qgis.core import QgsApplication, QgsProcessingContext, QgsProcessingModelAlgorithm
    from qgis.PyQt.QtWidgets import QDialog

    algorithm = QgsApplication.processingRegistry().algorithmById("urbanmap:groundfrommms")
    window = QDialog()
    window.model, window.childId, window.context = QgsProcessingModelAlgorithm("a", "b"), "", QgsProcessingContext()
    made = WidgetWrapperFactory.create_wrapper(algorithm.parameterDefinition(name), window)
    assert type(made).__name__ == "QgsProcessingModelerParameterWidget"


def test_field_takes_pasted_and_dropped_files(qgis_app, plugin):
    from qgis.PyQt.QtCore import QMimeData, QPoint, Qt, QUrl
    from qgis.PyQt.QtGui import QDropEvent

    module = plugin("algorithms.framework.declaring.files_widget")
    field, told = module.FilesField("Points"), []
    field.changed.connect(lambda: told.append(list(field.files)))
    field.line.setText('"/data/a b.laz" "/data/c.laz"')
    field.line.editingFinished.emit()
    assert field.files == ["/data/a b.laz", "/data/c.laz"]
    field.line.editingFinished.emit()  # "2 files" is what the field says, not a path
    assert len(told) == 1 and field.line.text() == "2 files"
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile("/data/d.laz"), QUrl("https://example.org/e.laz")])
    field.dropEvent(QDropEvent(QPoint(1, 1), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton,
                               Qt.KeyboardModifier.NoModifier))
    assert field.files == ["/data/d.laz"] == module.paths_in("file:///data/d.laz")
    assert module.paths_in(" /a.laz ; /b.laz\n/c.laz ") == ["/a.laz", "/b.laz", "/c.laz"]
    assert module.paths_in("'/点 群/a.laz' '/b.laz' ") == ["/点 群/a.laz", "/b.laz"]
    assert module.paths_in("/Mary's/a.laz;/Tom's/b.laz") == ["/Mary's/a.laz", "/Tom's/b.laz"]


def test_what_is_pasted_beside_the_number_of_files_is_no_part_of_a_path(plugin, qgis_app):
    module = plugin("algorithms.framework.declaring.files_widget")
    field = module.FilesField("Points")
    for pasted, files in (('"/a.laz" "/b.laz"', ["/a.laz", "/b.laz"]),
                          ("/点 群/c.laz", ["/a.laz", "/b.laz", "/点 群/c.laz"])):
        field.line.end(False)
        field.line.insert(pasted)
        field.line.editingFinished.emit()
        assert field.files == files
    field.line.clear()
    field.line.editingFinished.emit()
    assert field.files == [] and field.line.text() == ""


def test_every_dialog_shows_the_right_files_first(qgis_app):
    """A file that is asked for without saying which endings it has is one of hundreds."""
    from qgis.core import QgsApplication, QgsProcessing, QgsProcessingParameterFile

    without, several = [], {}
    for algorithm in QgsApplication.processingRegistry().providerById("urbanmap").algorithms():
        for item in algorithm.parameterDefinitions():
            named = f"{algorithm.id()} {item.name()}"
            if item.type() == "file" and item.behavior() == QgsProcessingParameterFile.Behavior.File:
                without += [named] if "*." not in item.fileFilter().replace("*.*", "") else []
            elif item.type() == "fileDestination":
                without += [named] if not item.fileFilter() else []
            elif item.type() == "multilayer" and item.layerType() == QgsProcessing.SourceType.TypeFile:
                several[named] = item.metadata().get("urbanmap_filter", "")
    assert without == []
    wrong = {named: shown for named, shown in several.items() if "*." not in shown or not shown.endswith("(*)")}
    assert len(several) > 20 and not wrong
    assert "*.laz" in several["urbanmap:buildingsfromals_model POINTS"]


def test_the_chooser_asks_for_the_files_of_its_field(qgis_app, plugin, monkeypatch):
    from qgis.core import QgsApplication

    widget = plugin("algorithms.framework.declaring.files_widget")
    algorithm = QgsApplication.processingRegistry().algorithmById("urbanmap:segmentbuildings")
    points = algorithm.parameterDefinition("POINTS")
    asked = []
    monkeypatch.setattr(widget.QFileDialog, "getOpenFileNames", lambda *said: asked.append(said) or (["/a.laz"], ""))
    dialog = widget.FilesDialog("Points", [], {}, points.metadata()["urbanmap_filter"])
    dialog._browse()
    assert dialog.chosen() == ["/a.laz"] and asked[0][3].startswith("Point clouds (*.las *.laz")
