"""urbanmap:overlayonimages in QGIS: on a sample city's strip image, frame and orthophoto, and with bad input."""

from __future__ import annotations

import pytest

STRIP = {"TRAJECTORY": "truth/lines_trajectory.csv", "CALIBRATION": "lines/calibration.json"}


def given(city, folder, **others):
    return {"IMAGES": [str(city / "lines/camera_1.png")], **{name: str(city / path) for name, path in STRIP.items()},
            "OUTPUT": str(folder / "重ね図"), "OUTPUT_REPORT": str(folder / "頁.html"), **others}


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
