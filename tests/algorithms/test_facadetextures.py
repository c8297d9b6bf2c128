"""urbanmap:facadetextures in QGIS: on a sample city's strip image and frames, and with bad input."""

from __future__ import annotations

import json

import pytest
import shapely

NAMES = {"TRAJECTORY": "truth/lines_trajectory.csv", "CALIBRATION": "lines/calibration.json"}


@pytest.fixture(scope="module")
def blocks(small_city, tmp_path_factory):
    """GeoPackage of the true outlines raised to blocks."""
    from qgis.core import QgsVectorFileWriter, QgsVectorLayer

    source = QgsVectorLayer(str(small_city / "truth/footprints.gpkg"), "outlines", "ogr")
    layer = QgsVectorLayer("MultiPolygonZ?crs=EPSG:6677&field=building_id:integer", "blocks", "memory")
    for feature in source.getFeatures():
        add_block(layer, shapely.from_wkb(bytes(feature.geometry().asWkb())), feature["building"], feature["z_ground"],
                  feature["z_max"])
    path = tmp_path_factory.mktemp("blocks") / "建物.gpkg"
    QgsVectorFileWriter.writeAsVectorFormatV3(layer, str(path), layer.transformContext(),
                                              QgsVectorFileWriter.SaveVectorOptions())
    return path


def add_block(layer, outline, number, base, top):
    """The faces of an outline raised from `base` to `top`."""
    from qgis.core import QgsFeature, QgsGeometry

    plan = shapely.force_2d(shapely.get_parts(outline)[0])
    ring = shapely.get_coordinates(shapely.Polygon(plan.exterior).normalize().exterior)
    ring = ring if shapely.is_ccw(shapely.linearrings(ring)) else ring[::-1]
    faces = [[(x, y, top) for x, y in ring], [(x, y, base) for x, y in ring[::-1]]]
    for (x0, y0), (x1, y1) in zip(ring, ring[1:]):
        faces.append([(x0, y0, base), (x1, y1, base), (x1, y1, top), (x0, y0, top), (x0, y0, base)])
    feature = QgsFeature(layer.fields())
    feature.setAttributes([number])
    geometry = QgsGeometry()
    geometry.fromWkb(shapely.to_wkb(shapely.MultiPolygon([shapely.Polygon(face) for face in faces])))
    feature.setGeometry(geometry)
    layer.dataProvider().addFeature(feature)


def given(small_city, blocks, folder, **others):
    return {"IMAGES": [str(small_city / "lines/camera_1.png")], "BUILDINGS": str(blocks), "RESOLUTION": 0.2,
            **{name: str(small_city / path) for name, path in NAMES.items()}, "OUTPUT": str(folder / "町.glb"),
            "OUTPUT_FACADES": str(folder / "facades.gpkg"), **others}


def test_strip_images_and_frames_texture_the_street(run, small_city, blocks, tmp_path, read_layer):
    result = run("urbanmap:facadetextures", given(
        small_city, blocks, tmp_path, FRAMES=[str(small_city / "aerial")],
        CAMERA=str(small_city / "aerial/camera.json"),
        EXTERIOR=str(small_city / "aerial/exterior.csv"), OUTPUT_FOLDER=str(tmp_path / "all")))
    facades = read_layer(result["OUTPUT_FACADES"])
    assert len(facades) == result["FACADES"] > 40
    textured = [item.attributes for item in facades if item.attributes["status"] != "not seen"]
    assert len(textured) == result["TEXTURED"] >= 4 and 0 < result["SEEN"] < 1
    assert any("camera_1.png" in item["images"] for item in textured)
    assert all(item.attributes["reason"] for item in facades if item.attributes["status"] == "not seen")
    assert any("have no texture" in text for text in run.feedback.warnings)
    content = json.loads((tmp_path / "all/model.city.json").read_text(encoding="utf-8"))
    for texture in content["appearance"]["textures"]:
        assert (tmp_path / "all" / texture["image"]).is_file()
    assert (tmp_path / "町.glb").stat().st_size > 10_000


def test_workers_change_nothing(run, small_city, blocks, tmp_path, monkeypatch, plugin):
    workers = plugin("algorithms.framework.running.workers")
    monkeypatch.setattr(workers, "_processes", workers._in_window)
    for count in (1, 2):
        run("urbanmap:facadetextures", given(small_city, blocks, tmp_path, WORKERS=count, RESOLUTION=0.4,
                                             OUTPUT=str(tmp_path / f"{count}.glb")))
    assert (tmp_path / "1.glb").read_bytes() == (tmp_path / "2.glb").read_bytes()


@pytest.mark.parametrize(("others", "sentence"), [
    ({"IMAGES": None}, "No image was given"),
    ({"TRAJECTORY": None}, "Trajectory: is needed"),
    ({"OUTPUT": "x.dae"}, "must end in .glb"),
    ({"FRAMES": [__file__]}, "Camera, Exterior orientation: is needed"),
])
def test_missing_parts_are_one_sentence(run, small_city, blocks, tmp_path, others, sentence):
    from qgis.core import QgsProcessingException

    if others.get("OUTPUT"):
        others = {"OUTPUT": str(tmp_path / others["OUTPUT"])}
    with pytest.raises(QgsProcessingException, match=sentence):
        run("urbanmap:facadetextures", given(small_city, blocks, tmp_path, **others))


def test_a_trajectory_of_another_day_is_refused(run, small_city, blocks, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="give those of one survey"):
        run("urbanmap:facadetextures", given(small_city, blocks, tmp_path,
                                             TRAJECTORY=str(small_city / "mms/survey_01_trajectory.csv")))


def test_outlines_without_heights_are_refused(run, small_city, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="has no heights"):
        run("urbanmap:facadetextures", given(small_city, small_city / "truth/footprints.gpkg", tmp_path))


def test_models_elsewhere_are_no_result(run, small_city, qgis_app, tmp_path):
    from qgis.core import QgsProcessingException, QgsVectorLayer

    layer = QgsVectorLayer("MultiPolygonZ?crs=EPSG:6677&field=building_id:integer", "far", "memory")
    add_block(layer, shapely.box(9000, 9000, 9020, 9010), 1, 0.0, 20.0)
    with pytest.raises(QgsProcessingException, match="None of the 4 facades is seen in an image"):
        run("urbanmap:facadetextures", {**given(small_city, "", tmp_path), "BUILDINGS": layer})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["IMAGES", "FRAMES"])
def test_missing_image_is_named(run, small_city, blocks, tmp_path, name):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="nowhere.png does not exist; check its name"):
        run("urbanmap:facadetextures", given(
            small_city, blocks, tmp_path, CAMERA=str(small_city / "aerial/camera.json"),
            EXTERIOR=str(small_city / "aerial/exterior.csv"), **{name: [str(tmp_path / "nowhere.png")]}))
