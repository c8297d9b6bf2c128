"""Layers that the dock loads: images below all else, rasters of heights below these, surveys told apart by name."""

from __future__ import annotations

import pytest


@pytest.fixture
def project(qgis_app):
    from qgis.core import QgsProject

    yield QgsProject.instance()
    QgsProject.instance().removeAllMapLayers()


def order(project):
    return [node.name() for node in project.layerTreeRoot().children()]


def test_rasters_go_below_and_names_tell_surveys_apart(project, plugin, small_city):
    from qgis.core import QgsRasterLayer, QgsVectorLayer

    arrange = plugin("algorithms.framework.guide.step_runner").arrange_layers

    def load(layer):
        project.addMapLayer(layer)
        return layer.id()

    def raster(place, name):
        return load(QgsRasterLayer(str(small_city / place), name))

    def lines(name):
        return load(QgsVectorLayer("LineString?crs=EPSG:6677", name, "memory"))

    lines("Drawn before")
    image = raster("aerial/ortho.tif", "Image before")
    arrange({image}, "")
    patches, ground = lines("Patches"), raster("truth/ground.tif", "Ground")
    arrange({patches, ground}, "survey_1")
    assert order(project) == ["Patches (survey_1)", "Drawn before", "Image before", "Ground (survey_1)"]
    arrange({raster("aerial/ortho.tif", "Orthophoto")}, "")
    assert order(project) == ["Patches (survey_1)", "Drawn before", "Orthophoto", "Image before", "Ground (survey_1)"]
    below = QgsVectorLayer("Point?crs=EPSG:6677", "Residuals", "memory")
    project.addMapLayer(below, False)
    project.layerTreeRoot().addLayer(below)  # QGIS 3.40 adds it below the layer that is chosen, here below the ground
    arrange({below.id()}, "")
    assert order(project) == ["Residuals", "Patches (survey_1)", "Drawn before", "Orthophoto", "Image before",
                              "Ground (survey_1)"]
    assert len(project.mapLayers()) == 6


def test_points_go_above_lines_above_areas(project, plugin):
    from qgis.core import QgsVectorLayer

    arrange = plugin("algorithms.framework.guide.step_runner").arrange_layers
    ids = {}
    for kind, name in (("LineString", "Before"), ("Point", "Findings"), ("LineString", "Bounds"), ("Polygon", "Lanes"),
                       ("LineString", "Centres"), ("Polygon", "Areas")):
        layer = QgsVectorLayer(f"{kind}?crs=EPSG:6677", name, "memory")
        project.addMapLayer(layer)  # each above the one before
        ids[name] = layer.id()
    arrange({layer for name, layer in ids.items() if name != "Before"}, "")
    assert order(project) == ["Findings", "Centres", "Bounds", "Areas", "Lanes", "Before"]


def test_what_adds_to_a_result_goes_above_it_in_whatever_order_they_load(project, plugin, tmp_path):
    from qgis.core import QgsVectorFileWriter, QgsVectorLayer

    arrange = plugin("algorithms.framework.guide.step_runner").arrange_layers
    files = [str(tmp_path / name) for name in ("merged.gpkg", "walls.gpkg")]
    for place in files:
        empty = QgsVectorLayer("Polygon?crs=EPSG:6677", "made", "memory")
        options = QgsVectorFileWriter.SaveVectorOptions()
        QgsVectorFileWriter.writeAsVectorFormatV3(empty, place, project.transformContext(), options)
    for order_of_loading in (files, files[::-1]):
        ids = set()
        for place in order_of_loading:
            layer = QgsVectorLayer(place, place.rpartition("/")[2], "ogr")
            project.addMapLayer(layer)
            ids.add(layer.id())
        arrange(ids, "", files)
        assert order(project)[:2] == ["walls.gpkg", "merged.gpkg"]
