"""The sample city through Processing."""

from __future__ import annotations

import json

import pytest

ALGORITHM = "urbanmap:samplecity"


@pytest.mark.once
def test_a_small_city_whose_files_qgis_opens(run, tmp_path):
    folder = tmp_path / "見本の町"
    result = run(ALGORITHM, {"SEED": 2, "SIZE": 60, "SCENE": "canyon", "WORKERS": 1, "OUTPUT": str(folder)})
    from qgis.core import QgsApplication, QgsRasterLayer, QgsVectorLayer

    algorithm = QgsApplication.processingRegistry().algorithmById(ALGORITHM)
    assert {item.name() for item in algorithm.outputDefinitions()} == set(result)
    assert result["OUTPUT"] == str(folder) and result["MMS_POINTS"] > 100_000
    from pathlib import Path

    assert all(Path(value).exists() for value in result.values() if isinstance(value, str))
    for place, name, count in (("footprints/gsi_buildings.gpkg", "BldA", result["BUILDINGS"]),
                               ("truth/roofs.gpkg", "roofs", None), ("truth/markings.gpkg", "mms", None)):
        layer = QgsVectorLayer(f"{folder / place}|layername={name}", name, "ogr")
        assert layer.isValid() and layer.crs().authid() == "EPSG:6677"
        assert layer.featureCount() == count if count else layer.featureCount() > 5
        assert all(feature.geometry().isGeosValid() for feature in layer.getFeatures())
    ortho = QgsRasterLayer(result["ORTHOPHOTO"], "ortho")
    assert ortho.isValid() and ortho.crs().authid() == "EPSG:6677" and ortho.bandCount() == 3
    assert json.loads((folder / "truth/summary.json").read_text(encoding="utf-8"))["seed"] == 2


@pytest.mark.parametrize(("parameters", "words"), [
    ({"SIZE": -5}, "60 to 600 m, not -5"),
    ({"SIZE": 10_000}, "60 to 600 m"),
    ({"SCENE": "moon"}, "Scene: moon is none of"),
    ({"OUTPUT": "full"}, "not empty"),
    ({"OUTPUT": "full/mine.txt"}, "is a file"),
    ({"OUTPUT": "missing/city"}, "does not exist"),
    ({"OUTPUT": "/proc/city"}, "cannot be written"),
])
def test_one_sentence_for_what_cannot_be_done(run, tmp_path, parameters, words):
    from qgis.core import QgsProcessingException

    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("keep")
    place = parameters.get("OUTPUT", "city")
    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, {"SIZE": 60, **parameters, "OUTPUT": str(tmp_path / place)})
    assert [path.name for path in tmp_path.rglob("*")] == ["full", "mine.txt"]


def test_cancel_leaves_nothing(run, feedback, tmp_path):
    feedback.cancel_at = 5
    result = run(ALGORITHM, {"SIZE": 60, "WORKERS": 1, "OUTPUT": str(tmp_path / "city")})
    assert result.get("OUTPUT") is None or not list(tmp_path.iterdir())
    assert not list(tmp_path.iterdir())
