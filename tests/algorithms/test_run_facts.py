"""What reports tell of their run."""

from __future__ import annotations

import pytest

SQUARE = "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))"


@pytest.fixture
def stage(plugin, qgis_app):
    base = plugin("algorithms.framework.base")

    class Told(base.UrbanMapAlgorithm):
        ID = "told"
        NAME = "Told"
        HELP = "Tells."

        def declare(self):
            self.add_polygons("FOOTPRINTS", "Outlines", "Polygons.")
            self.add_file("TABLE", "Table", "A file.", optional=True)
            self.add_number("RATIO", "Ratio", "A number.", 0.5, unit="m2")
            self.add_boolean("EXACT", "Exact", "Yes or no.", True)
            self.add_choice("METHOD", "Method", "How.", ("full", "paper"), "full")
            self.add_workers()
            self.add_file_output("OUTPUT_REPORT", "Report", "A page.", "HTML (*.html)", optional=True)

    made = Told()
    made.initAlgorithm()
    return made


def test_inputs_and_settings_are_in_the_users_words(stage, plugin, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingContext, QgsProject

    layer = polygon_layer([SQUARE])
    layer.setName("建物外周線")
    QgsProject.instance().addMapLayer(layer)
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    table = tmp_path / "表.csv"
    table.write_text("a")
    facts = plugin("algorithms.framework.running.run_facts").run_facts(
        stage, {"FOOTPRINTS": layer.id(), "TABLE": str(table), "RATIO": 2.0}, context)
    assert facts.inputs == {"Outlines": "建物外周線", "Table": "表.csv"}
    assert facts.settings == {"Ratio": "2 m²", "Exact": "yes", "Method": "full method"}
    assert facts.work == "Told" and facts.version and facts.crs.startswith(layer.crs().authid())
    assert facts.heights == "not stated by the inputs"
    QgsProject.instance().removeMapLayer(layer.id())


def test_temporary_results_are_not_told_by_their_names(plugin, qgis_app):
    from qgis.core import NULL, QgsProcessingContext

    facts = plugin("algorithms.framework.running.run_facts")
    text = facts.value_text("Outlines_1a2b3c4d_0000_1111_2222_123456789abc", QgsProcessingContext())
    assert text == "result of an earlier step"
    assert facts.value_text(["/a/b.laz", "/c/d.laz"], QgsProcessingContext()) == "b.laz, d.laz"
    assert facts.value_text(NULL, QgsProcessingContext()) == ""  # what a window gives for a setting that was left out
    assert facts.value_text("/a/b.gpkg|layername=屋根", QgsProcessingContext()) == "b.gpkg, 屋根"


def test_distances_have_their_unit_in_reports_of_the_window_too(qgis_app, plugin, monkeypatch):
    """There the label has none, as QGIS shows it in a box beside the field."""
    import importlib

    from qgis.core import QgsApplication, QgsProcessingContext

    facts = plugin("algorithms.framework.running.run_facts")
    algorithm = QgsApplication.processingRegistry().algorithmById("urbanmap:segmentbuildings")
    told = facts.run_facts(algorithm.create(), {"EXPANSION": 1.5}, QgsProcessingContext()).settings["Expansion"]
    monkeypatch.setattr(importlib.import_module("qgis.utils"), "iface", object())
    shown = algorithm.create()
    assert shown.parameterDefinition("EXPANSION").description() == "Expansion"
    assert facts.run_facts(shown, {"EXPANSION": 1.5}, QgsProcessingContext()).settings["Expansion"] == told == "1.5 m"
