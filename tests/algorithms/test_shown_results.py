"""What QGIS's window shows of results that are files, and which folders it asks for."""

from __future__ import annotations

import importlib
import shutil
from pathlib import Path

import pytest
import shapely


@pytest.fixture
def window(monkeypatch):
    """The runs are started in QGIS's window."""
    monkeypatch.setattr(importlib.import_module("qgis.utils"), "iface", object())


@pytest.fixture
def shown(plugin):
    return plugin("algorithms.framework.layers.shown_results")


@pytest.fixture
def context(qgis_app):
    from qgis.core import QgsProcessingContext, QgsProject

    made = QgsProcessingContext()
    made.setProject(QgsProject.instance())
    return made


@pytest.fixture
def als(small_city):
    return {"POINTS": [str(small_city / "als/als.laz")],
            "FOOTPRINTS": str(small_city / "footprints/gsi_buildings.gpkg"), "OUTPUT": "TEMPORARY_OUTPUT"}


def told_of_files(feedback):
    """Sentences about files that are not shown, and about those that do not stay."""
    return ([text for text in feedback.infos if "cannot show point clouds" in text],
            [text for text in feedback.warnings if "gone when QGIS ends" in text])


def test_the_window_says_what_it_cannot_show_and_what_will_not_stay(run, context, window, shown, als, monkeypatch):
    monkeypatch.setattr(shown, "can_show_points", lambda path: False)
    result = run("urbanmap:segmentbuildings", {**als, "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"}, context)["OUTPUT"]
    (hidden,), (passing,) = told_of_files(run.feedback)
    assert result in hidden and result in passing
    assert not context.willLoadLayerOnCompletion(result)


def test_a_named_file_stays(run, context, window, als, tmp_path):
    given = {**als, "OUTPUT": str(tmp_path / "points.laz"), "OUTPUT_BUILDINGS": str(tmp_path / "buildings.gpkg")}
    run("urbanmap:segmentbuildings", given, context)
    assert told_of_files(run.feedback)[1] == []


def test_point_clouds_are_loaded_where_there_is_a_reader(run, context, window, shown, als, monkeypatch):
    from qgis.core import QgsProcessingUtils

    monkeypatch.setattr(shown, "can_show_points", lambda path: True)
    result = run("urbanmap:segmentbuildings", {**als, "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"}, context)["OUTPUT"]
    details = context.layersToLoadOnCompletion()[result]
    assert details.layerTypeHint == QgsProcessingUtils.LayerHint.PointCloud
    assert details.name
    assert told_of_files(run.feedback)[0] == []


def test_the_steps_of_a_chain_show_nothing(run, context, window, shown, als, monkeypatch):
    monkeypatch.setattr(shown, "can_show_points", lambda path: True)
    run("urbanmap:buildingsfromals", {**als, "OUTPUT_CITYJSON": "TEMPORARY_OUTPUT"}, context)
    assert not [place for place in context.layersToLoadOnCompletion() if place.endswith(".laz")]
    (passing,) = told_of_files(run.feedback)[1]
    assert "CITYJSON" in passing.upper() and ".laz" not in passing


def test_without_a_window_nothing_is_said(run, context, als):
    run("urbanmap:segmentbuildings", {**als, "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"}, context)
    assert told_of_files(run.feedback) == ([], [])
    assert not context.layersToLoadOnCompletion()


@pytest.mark.parametrize(("providers", "name", "can"), [
    (["ogr", "ept"], "a.laz", False), (["ogr", "pdal"], "a.laz", True), (["copc"], "a.laz", False),
    (["copc"], "a.copc.laz", True)])
def test_readers_of_point_clouds(shown, monkeypatch, providers, name, can):
    class Registry:
        @staticmethod
        def instance():
            return Registry

        @staticmethod
        def providerList():
            return providers

    monkeypatch.setattr(shown, "QgsProviderRegistry", Registry)
    assert shown.can_show_points(Path(name)) is can


@pytest.mark.parametrize(("algorithm", "given"), [
    ("samplecity", {"OUTPUT": "TEMPORARY_OUTPUT"}),
    ("tiledrun", {"ALGORITHM": "surfacefromals", "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": "TEMPORARY_OUTPUT"})])
def test_the_window_asks_for_the_folder_of_a_long_run(qgis_app, context, als, window, algorithm, given, tmp_path):
    from qgis.core import QgsApplication

    item = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{algorithm}").create()
    given = {**(als if algorithm == "tiledrun" else {}), **given}
    accepted, message = item.checkParameterValues(given, context)
    assert not accepted and "choose a folder" in message
    name = "OUTPUT_FOLDER" if algorithm == "tiledrun" else "OUTPUT"
    accepted, message = item.checkParameterValues({**given, name: str(tmp_path / "own")}, context)
    assert accepted, message


def test_a_script_may_take_a_temporary_folder(qgis_app, context):
    from qgis.core import QgsApplication

    item = QgsApplication.processingRegistry().algorithmById("urbanmap:samplecity").create()
    assert item.checkParameterValues({"OUTPUT": "TEMPORARY_OUTPUT"}, context) == (True, "")


def test_the_sample_city_is_shown(run, context, window, plugin, small_city, monkeypatch, tmp_path):
    def made(folder, *_):
        shutil.copytree(small_city, folder, dirs_exist_ok=True)
        return {"city": {"buildings": 1}, "als": {"points": 1}, "mms": {}}

    monkeypatch.setattr(plugin("urbanmap_qgis.samplecity.write"), "make_city", made)
    run("urbanmap:samplecity", {"OUTPUT": str(tmp_path / "city")}, context)
    loaded = {details.name: (Path(place), details.postProcessor())
              for place, details in context.layersToLoadOnCompletion().items()}
    assert set(loaded) == {"Conventional orthophoto", "Official outlines"}
    assert all(place.is_file() and tmp_path / "city" in place.parents for place, _ in loaded.values())
    assert loaded["Official outlines"][1] is not None


def test_a_layer_of_the_project_shows_the_file_that_a_run_has_put_in_its_place(run, context, qgis_app, tmp_path, als):
    from processing.gui.Postprocessing import handleAlgorithmResults
    from qgis.core import QgsApplication, QgsProcessingContext, QgsProcessingOutputLayerDefinition, QgsProject

    project, seen, told = QgsProject.instance(), [], []
    item = QgsApplication.processingRegistry().algorithmById("urbanmap:surfacefromals").create()
    for resolution in (4.0, 8.0):
        context = QgsProcessingContext()
        context.setProject(project)
        target = QgsProcessingOutputLayerDefinition(str(tmp_path / "dsm.tif"), project)
        run("urbanmap:surfacefromals", {"POINTS": als["POINTS"], "RESOLUTION": resolution, "OUTPUT": target}, context)
        assert handleAlgorithmResults(item, context)
        told.append(sorted(path.name for path in tmp_path.iterdir()))
        layer, = (one for one in project.mapLayers().values() if one.source() == str(tmp_path / "dsm.tif"))
        seen.append((layer.id(), layer.rasterUnitsPerPixelX()))
        layer.dataProvider().bandStatistics(1)  # kept beside the file when it is closed
    project.removeMapLayer(layer)
    assert [size for _, size in seen] == [4.0, 8.0] and seen[0][0] == seen[1][0]
    assert told == [["dsm.tif"]] * 2


def test_a_result_whose_edits_were_dropped_may_be_replaced(context, als, tmp_path):
    from qgis.core import QgsApplication, QgsProject, QgsVectorLayer

    target = tmp_path / "shown.gpkg"
    shutil.copy(als["FOOTPRINTS"], target)
    layer = QgsProject.instance().addMapLayer(QgsVectorLayer(str(target), "shown", "ogr"))
    item = QgsApplication.processingRegistry().algorithmById("urbanmap:segmentbuildings").create()
    given = {**als, "OUTPUT_BUILDINGS": str(target)}
    assert layer.startEditing() and layer.deleteFeature(next(layer.getFeatures()).id())
    accepted, message = item.checkParameterValues(given, context)
    assert not accepted and "is edited" in message and layer.isEditable() and layer.isModified()
    assert layer.rollBack() and item.checkParameterValues(given, context) == (True, "")
    QgsProject.instance().removeMapLayer(layer)


def test_a_layer_of_features_reads_its_file_again(context, feedback, plugin, tmp_path):
    from qgis.core import QgsVectorLayer

    from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage

    def write(name, sides):
        squares = [shapely.box(0, 0, side, side) for side in sides]
        write_geopackage(tmp_path / name, [Layer("one", squares, {"side": sides})], "EPSG:6677")

    write("shown.gpkg", [1.0, 2.0])
    layer = QgsVectorLayer(str(tmp_path / "shown.gpkg"), "shown", "ogr")
    assert layer.extent().width() == len(list(layer.getFeatures())) == 2
    write("new.gpkg", [5.0])
    (tmp_path / "new.gpkg").replace(tmp_path / "shown.gpkg")
    plugin("algorithms.framework.layers.styles").FilePostProcessor().postProcessLayer(layer, context, feedback)
    assert layer.isValid() and layer.extent().width() == 5 and [item["side"] for item in layer.getFeatures()] == [5.0]


def test_reports_have_names_of_their_own(qgis_app):
    from qgis.core import QgsApplication

    own = [item.create() for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
           if hasattr(item, "compute") and not item.SUCCESSOR]
    reports = [output.description() for item in own for output in item.outputDefinitions()
               if output.type() == "outputHtml"]
    assert len(reports) > 10 and len(set(reports)) == len(reports)


def test_reports_are_offered_under_names_of_their_own(run, context, window, plugin, small_city, monkeypatch):
    links, offered = plugin("algorithms.framework.report_links"), []
    taker = type("Taker", (), {"made": type("Signal", (), {"emit": staticmethod(lambda *told: offered.append(told))})})
    monkeypatch.setattr(links.ReportLinks, "current", taker)
    result = run("urbanmap:checkaccuracy", {
        "TRAJECTORY": str(small_city / "mms/survey_01_trajectory.csv"), "CRS": "EPSG:6677",
        "CONTROL": str(small_city / "truth/control_survey_01.csv"),
        "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_REPORT": "TEMPORARY_OUTPUT"}, context)
    assert offered == [("Acceptance report: Report of the residuals", result["OUTPUT_REPORT"])]
    assert Path(result["OUTPUT_REPORT"]).name == "checkaccuracy_report.html" and Path(result["OUTPUT_REPORT"]).is_file()


def test_layers_of_models_have_the_names_of_outputs(qgis_app, context, shown, tmp_path):
    """QGIS 3.22 gives the layers of a model's steps the key of the output for a name."""
    from qgis.core import QgsApplication, QgsProcessingContext, QgsProject

    algorithm = QgsApplication.processingRegistry().createAlgorithmById("urbanmap:buildingmodels")
    places = [str(tmp_path / f"{number}.gpkg") for number in range(3)]
    for place, name in zip(places, ("OUTPUT", "My models")):
        context.addLayerToLoadOnCompletion(place, QgsProcessingContext.LayerDetails(
            name, QgsProject.instance(), "OUTPUT"))
    for place in places:  # the last is not loaded
        shown.name_layers(algorithm, {"OUTPUT": place, "BUILDINGS": 3}, context)
    names = {place: details.name for place, details in context.layersToLoadOnCompletion().items()}
    assert names == dict(zip(places, ("Building models", "My models")))
