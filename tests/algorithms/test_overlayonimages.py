"""urbanmap:overlayonimages in QGIS: on a sample city's strip image, frame and orthophoto, and with bad input."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

STRIP = {"TRAJECTORY": "truth/lines_trajectory.csv", "CALIBRATION": "lines/calibration.json"}


def given(city, folder, **others):
    return {"IMAGES": [str(city / "lines/camera_1.png")], **{name: str(city / path) for name, path in STRIP.items()},
            "OUTPUT": str(folder / "重ね図"), "OUTPUT_REPORT": str(folder / "頁.html"), **others}


@pytest.mark.once
def test_before_and_after_on_all_kinds_of_images(run, small_city, tmp_path):
    models = run("urbanmap:loadcitymodel", {"INPUT": str(small_city / "models/buildings.city.json"),
                                            "OUTPUT": "memory:",
                                            "OUTPUT_MODELS": str(tmp_path / "建物.gpkg")})["OUTPUT_MODELS"]
    result = run("urbanmap:overlayonimages", given(
        small_city, tmp_path, LINES=models, POINTS=[str(small_city / "mms/survey_01.laz")],
        TRAJECTORY_BEFORE=str(small_city / "lines/trajectory.csv"), FRAMES=[str(small_city / "aerial/frame_01.tif")],
        CAMERA=str(small_city / "aerial/camera.json"), EXTERIOR=str(small_city / "aerial/exterior.csv"),
        ORTHOPHOTO=str(small_city / "aerial/ortho.tif"), PICTURES=3))
    assert result["DRAWN"] == 3 and result["EMPTY"] == 0
    names = {path.name for path in (tmp_path / "重ね図").iterdir()}
    assert {"camera_1_before.jpg", "camera_1_after.jpg", "frame_01_after.jpg", "ortho_after.jpg"} <= names
    page = (tmp_path / "頁.html").read_text(encoding="utf-8")
    assert page.count('class="switch"') == 3 and "Trajectory before" in page and "How this was made" in page


@pytest.mark.parametrize(("others", "message"), [
    ({"IMAGES": []}, "No image was given"),
    ({}, "nothing to draw"),
    ({"CALIBRATION": None}, "Calibration: is needed"),
    ({"LINES_BEFORE": "city:truth/footprints.gpkg", "POINTS": ["city:mms/survey_01.laz"]}, "give both"),
    ({"LINES": "city:truth/footprints.gpkg"}, "have no heights"),
])
def test_what_is_missing_is_told(run, small_city, tmp_path, others, message):
    from qgis.core import QgsProcessingException

    def placed(value):
        if isinstance(value, list):
            return [placed(item) for item in value]
        return str(small_city / value[5:]) if isinstance(value, str) and value.startswith("city:") else value

    others = {name: placed(value) for name, value in others.items()}
    with pytest.raises(QgsProcessingException, match=message):
        run("urbanmap:overlayonimages", given(small_city, tmp_path, **others))
    assert not (tmp_path / "重ね図").exists()


def loaded_models(run, city, folder):
    return run("urbanmap:loadcitymodel", {"INPUT": str(city / "models/buildings.city.json"), "OUTPUT": "memory:",
                                          "OUTPUT_MODELS": str(folder / "建物.gpkg")})["OUTPUT_MODELS"]


def test_a_rectified_trajectory_shows_the_frames_over_its_line_images(run, small_city, tmp_path):
    city, page = small_city, tmp_path / "r.html"
    given = {"TRAJECTORY": str(city / "lines/trajectory.csv"), "TIE_POINTS": str(city / "lines/tie_points.csv"),
             "CRS": "EPSG:6677", "OUTPUT": str(tmp_path / "t.csv"), "OUTPUT_REPORT": str(page),
             "IMAGES": [str(city / "lines/camera_1.png")], "LINES": loaded_models(run, city, tmp_path)}
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="Calibration: is needed"):
        run("urbanmap:rectifytrajectory", given)
    run("urbanmap:rectifytrajectory", {**given, "CALIBRATION": str(city / "lines/calibration.json")})
    text = page.read_text(encoding="utf-8")
    assert text.count('class="switch"') >= 1 and text.count("data:image/jpeg") % 3 == 0 and ">before<" in text


def test_merged_models_are_shown_over_the_orthophoto(run, small_city, tmp_path):
    models = loaded_models(run, small_city, tmp_path)
    walls = measured_wall(models)
    run("urbanmap:mergebuildingmodels", {"MODELS": models, "WALLS": walls, "OUTPUT": "memory:",
                                         "ORTHOPHOTO": str(small_city / "aerial/ortho.tif"),
                                         "OUTPUT_REPORT": str(tmp_path / "m.html")})
    text = (tmp_path / "m.html").read_text(encoding="utf-8")
    assert "1 of 15 buildings have walls that lie on measured ones" in text
    assert text.count("data:image/jpeg") in (3, 6)


def measured_wall(models):
    """A layer with one wall 0.3 m before the longest upright face of the first model."""
    from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer

    faces = shapely.get_parts(shapely.from_wkb(bytes(next(QgsVectorLayer(models, "m", "ogr").getFeatures())
                                                     .geometry().asWkb())))
    upright = max((face for face in faces if shapely.area(face) < 0.01), key=shapely.length)
    ring = shapely.get_coordinates(upright, include_z=True)
    along = ring[np.argmax(np.hypot(*np.diff(ring[:, :2], axis=0).T)) + 1] - ring[np.argmax(
        np.hypot(*np.diff(ring[:, :2], axis=0).T))]
    normal = np.array([along[1], -along[0], 0.0]) / np.hypot(*along[:2])
    layer = QgsVectorLayer("PolygonZ?crs=EPSG:6677&field=status:string&field=rmse:double&field=sigma:double", "walls",
                           "memory")
    feature = QgsFeature(layer.fields())
    feature.setAttributes(["ok", 0.01, 0.01])
    geometry = QgsGeometry()
    geometry.fromWkb(shapely.to_wkb(shapely.Polygon(ring + 0.3 * normal)))
    feature.setGeometry(geometry)
    layer.dataProvider().addFeature(feature)
    return layer
