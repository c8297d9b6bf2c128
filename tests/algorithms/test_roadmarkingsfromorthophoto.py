"""Road markings from an orthophoto through Processing."""

from __future__ import annotations

import numpy as np
import pytest

ALGORITHM = "urbanmap:roadmarkingsfromorthophoto"
X0, Y0, PIXEL = -7000.0, -34000.0, 0.12
LINES = 6


@pytest.fixture
def ortho(tmp_path):
    """`ortho(name, epsg, pixel)`: a grey street of 36 m with six white dashes of 3 m."""
    from osgeo import gdal, osr

    def make(name="正射.tif", epsg=6677, pixel=PIXEL, paint=210, bands=3, noise=2):
        rng = np.random.default_rng(0)
        image = 90 + rng.normal(0, noise, (300, 300))
        for row in range(30, 30 + 40 * LINES, 40):
            image[row:row + 2, 100:125] = paint
        path = tmp_path / name
        out = gdal.GetDriverByName("GTiff").Create(str(path), 300, 300, bands, gdal.GDT_Byte)
        out.SetGeoTransform((X0, pixel, 0, Y0, 0, -pixel))
        if epsg:
            reference = osr.SpatialReference()
            reference.ImportFromEPSG(epsg)
            out.SetProjection(reference.ExportToWkt())
        for band in range(bands):
            out.GetRasterBand(band + 1).WriteArray(image.clip(0, 255).astype(np.uint8))
        out.FlushCache()
        return path

    return make


def box(x_min, y_min, x_max, y_max):
    return f"Polygon (({x_min} {y_min}, {x_max} {y_min}, {x_max} {y_max}, {x_min} {y_max}, {x_min} {y_min}))"


def test_mask_and_polygons(run, ortho, tmp_path, read_layer):
    result = run(ALGORITHM, {"INPUT": str(ortho()), "OUTPUT": str(tmp_path / "白線.tif"),
                             "OUTPUT_POLYGONS": str(tmp_path / "白線.gpkg")})
    assert result["COUNT"] == LINES and result["SEARCHED_AREA"] == pytest.approx(36 * 36)
    assert result["MARKED_AREA"] == pytest.approx(LINES * 25 * 2 * PIXEL ** 2, rel=0.1)
    from osgeo import gdal

    mask = gdal.Open(result["OUTPUT"])
    values = mask.ReadAsArray()
    assert values.dtype == np.uint8 and set(np.unique(values)) == {0, 255}
    assert mask.GetGeoTransform() == (X0, PIXEL, 0, Y0, 0, -PIXEL)
    features = read_layer(result["OUTPUT_POLYGONS"])
    assert len(features) == LINES

    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(result["OUTPUT_POLYGONS"], "markings", "ogr")
    assert layer.crs().authid() == "EPSG:6677" and layer.renderer().type() == "categorizedSymbol"
    for feature in layer.getFeatures():
        assert feature["colour"] == "white" and feature["contrast"] > 50
        assert feature["length"] == pytest.approx(3.0, abs=0.2) and feature["width"] == pytest.approx(0.24, abs=0.05)


def test_heights_roads_and_buildings(run, ortho, polygon_layer, tmp_path):
    from osgeo import gdal
    from qgis.core import QgsVectorLayer

    ground = tmp_path / "ground.tif"
    out = gdal.GetDriverByName("GTiff").Create(str(ground), 50, 50, 1, gdal.GDT_Float32)
    out.SetGeoTransform((X0 - 5, 1, 0, Y0 + 5, 0, -1))
    out.SetProjection(gdal.Open(str(ortho())).GetProjection())
    out.GetRasterBand(1).WriteArray(np.full((50, 50), 12.5, np.float32))
    out.FlushCache()
    del out
    roads = polygon_layer([box(X0, Y0 - 36, X0 + 36, Y0 - 10)])
    buildings = polygon_layer([box(X0, Y0 - 36, X0 + 36, Y0 - 20)])
    result = run(ALGORITHM, {"INPUT": str(ortho()), "ROADS": roads, "BUILDINGS": buildings, "GROUND": str(ground),
                             "OUTPUT": str(tmp_path / "m.tif"), "OUTPUT_POLYGONS": str(tmp_path / "m.gpkg")})
    layer = QgsVectorLayer(result["OUTPUT_POLYGONS"], "markings", "ogr")
    assert result["COUNT"] == layer.featureCount() == 2
    for feature in layer.getFeatures():
        assert {vertex.z() for vertex in feature.geometry().vertices()} == {12.5}


def test_feet(run, ortho, tmp_path):
    result = run(ALGORITHM, {"INPUT": str(ortho(epsg=2225, pixel=PIXEL / 0.3048)), "OUTPUT": str(tmp_path / "m.tif")})
    assert result["COUNT"] == LINES and result["SEARCHED_AREA"] == pytest.approx(36 * 36, rel=1e-4)


def test_empty_results_are_warned_of(run, ortho, polygon_layer, tmp_path):
    result = run(ALGORITHM, {"INPUT": str(ortho(paint=92)), "OUTPUT": str(tmp_path / "m.tif"),
                             "OUTPUT_POLYGONS": str(tmp_path / "m.gpkg")})
    assert result["COUNT"] == 0 and any("No markings were found" in line for line in run.feedback.warnings)
    away = polygon_layer([box(0, 0, 10, 10)])
    run(ALGORITHM, {"INPUT": str(ortho()), "ROADS": away, "OUTPUT": str(tmp_path / "m.tif")})
    assert any("left to look at" in line for line in run.feedback.warnings)


@pytest.mark.parametrize(("image", "parameters", "words"), [
    ({"epsg": 6668, "pixel": 1e-6}, {}, "degrees"),
    ({"epsg": None}, {}, "coordinate reference system is missing"),
    ({"pixel": 1.0}, {}, "cannot be seen"),
    ({}, {"ROADS": "EPSG:32654"}, "reproject"),
])
def test_one_sentence_for_what_cannot_be_done(run, ortho, polygon_layer, tmp_path, image, parameters, words):
    from qgis.core import QgsProcessingException

    layers = {name: polygon_layer([box(0, 0, 1, 1)], crs=crs) for name, crs in parameters.items()}
    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, {"INPUT": str(ortho(**image)), "OUTPUT": str(tmp_path / "m.tif"), **layers})
    assert not (tmp_path / "m.tif").exists()


def test_styles_are_readable(qgis_app, ortho, tmp_path):
    from pathlib import Path

    from qgis.core import QgsRasterLayer

    layer = QgsRasterLayer(str(ortho(bands=1)), "mask")
    style = Path(__file__).resolve().parents[2] / "resources" / "styles" / "marking_mask.qml"
    message, read = layer.loadNamedStyle(str(style))
    assert read, message
    assert {item.value: item.color.alpha() for item in layer.renderer().classes()} == {0: 0, 255: 255}


def test_trained_is_another_name_of_profile(run, ortho, tmp_path):
    for method in ("profile", "trained"):
        run(ALGORITHM, {"INPUT": str(ortho()), "METHOD": method, "OUTPUT": str(tmp_path / f"{method}.tif")})
    assert (tmp_path / "profile.tif").read_bytes() == (tmp_path / "trained.tif").read_bytes()


def test_paper_is_the_plain_threshold(run, ortho, tmp_path):
    """What our way leaves out, such as specks of noise and of one pixel, stays; the lines are there too."""
    import cv2
    from osgeo import gdal

    path = ortho(bands=1)
    image = gdal.Open(str(path)).ReadAsArray()
    image[10, 180:183], image[:, 200:220] = 200, 210  # enough paint for levels that do not depend on the sample
    source = gdal.Open(str(path), gdal.GA_Update)
    source.GetRasterBand(1).WriteArray(image)
    del source
    result = run(ALGORITHM, {"INPUT": str(path), "METHOD": "paper", "OUTPUT": str(tmp_path / "m.tif")})
    mask = gdal.Open(result["OUTPUT"]).ReadAsArray()
    low, high = np.percentile(image, (0.5, 99.5))
    levelled = np.clip((image - low) / (high - low) * 255, 0, 255).round().astype(np.uint8)
    expected = cv2.adaptiveThreshold(levelled, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, 21, -17)
    assert mask[10, 181] == 255 and (mask != expected).mean() < 0.002  # the levels come from samples
    assert result["COUNT"] > LINES


@pytest.fixture
def yard(tmp_path):
    """A grey yard of 24 white lines and 24 cold ones, odd ones white: its path."""
    from osgeo import gdal, osr

    rng = np.random.default_rng(2)
    image = np.repeat(90 + rng.normal(0, 2, (1, 900, 900)), 3, axis=0)
    for number in range(48):
        row, column = 60 + 130 * (number // 8), 40 + 105 * (number % 8)
        image[:, row:row + 2, column:column + 30] = np.reshape((112, 112, 112) if number % 2 else (110, 114, 112),
                                                               (3, 1, 1))
    path = tmp_path / "yard.tif"
    out = gdal.GetDriverByName("GTiff").Create(str(path), 900, 900, 3, gdal.GDT_Byte)
    out.SetGeoTransform((X0, PIXEL, 0, Y0, 0, -PIXEL))
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(6677)
    out.SetProjection(reference.ExportToWkt())
    for band in range(3):
        out.GetRasterBand(band + 1).WriteArray(image[band].clip(0, 255).round().astype(np.uint8))
    out.FlushCache()
    return path


def test_doubtful_markings_come_with_the_most_area_in_doubt_first(run, yard, tmp_path):
    """What taught a run in earlier versions is still taken, changes nothing, and is told."""
    from qgis.core import NULL, QgsVectorLayer

    first = run(ALGORITHM, {"INPUT": str(yard), "OUTPUT": str(tmp_path / "a.tif"), "MIN_CONFIDENCE": 1.0,
                            "OUTPUT_DOUBTFUL": str(tmp_path / "doubtful.gpkg")})
    doubtful = list(QgsVectorLayer(first["OUTPUT_DOUBTFUL"]).getFeatures())
    assert first["COUNT"] == 0 and len(doubtful)
    doubt = [item.geometry().area() * item["confidence"] * (1 - item["confidence"]) for item in doubtful]
    assert (np.diff(doubt) <= 0.02 * max(doubt)).all() and all(item["paint"] == NULL for item in doubtful)
    assert min(item["confidence"] for item in doubtful) >= 0.2 - 1e-6
    run(ALGORITHM, {"INPUT": str(yard), "OUTPUT": str(tmp_path / "b.tif"), "MIN_CONFIDENCE": 1.0,
                    "LABELS": first["OUTPUT_DOUBTFUL"], "OUTPUT_WEIGHTS": str(tmp_path / "w.json")})
    warned = [text for text in run.feedback.warnings if "no longer used" in text]
    assert len(warned) == 2 and "LABELS" in warned[0] and "MIN_CONFIDENCE" in warned[0]
    assert (tmp_path / "a.tif").read_bytes() == (tmp_path / "b.tif").read_bytes()


def test_doubtful_markings_are_answered_with_yes_or_no(run, yard, tmp_path):
    """The layer opened from its file offers yes and no, and keeps what is chosen in its form."""
    from qgis.core import NULL, QgsVectorLayer
    from qgis.gui import QgsGui
    from qgis.PyQt.QtWidgets import QComboBox, QWidget

    first = run(ALGORITHM, {"INPUT": str(yard), "OUTPUT": str(tmp_path / "a.tif"), "MIN_CONFIDENCE": 1.0,
                            "OUTPUT_DOUBTFUL": str(tmp_path / "doubtful.gpkg")})
    layer = QgsVectorLayer(first["OUTPUT_DOUBTFUL"], "doubtful")
    place, features = layer.fields().indexOf("paint"), list(layer.getFeatures())
    assert layer.editorWidgetSetup(place).type() == "ValueMap" and len(features) >= 10
    if not QgsGui.editorWidgetRegistry().factories():
        QgsGui.editorWidgetRegistry().initEditors()
    holder, layer_edited = QWidget(), layer.startEditing()
    form = QgsGui.editorWidgetRegistry().create(layer, place, None, holder)
    box = form.widget()
    assert layer_edited and isinstance(box, QComboBox)
    assert [box.itemText(row) for row in range(box.count())] == ["not answered", "yes", "no"]
    for number, feature in enumerate(features):
        form.setFeature(feature)
        assert box.currentText() == "not answered" and form.value() == NULL
        box.setCurrentText(("yes", "no")[number % 2])
        assert layer.changeAttributeValue(feature.id(), place, form.value())
    assert layer.commitChanges()
    assert [item["paint"] for item in layer.getFeatures()] == [1 - number % 2 for number in range(len(features))]
    drawn = [rule.filterExpression() for rule in layer.renderer().rootRule().children()]
    assert drawn == ['"paint" = 1', '"paint" = 0', '"paint" IS NULL']
