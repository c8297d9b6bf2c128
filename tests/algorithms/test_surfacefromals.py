"""Surface and ground from ALS through Processing."""

from __future__ import annotations

import numpy as np
import pytest

ALGORITHM = "urbanmap:surfacefromals"
X0, Y0 = -8_000.0, -34_000.0


@pytest.fixture
def town(make_cloud, tmp_path):
    """A square of 60 m on a level of 10 m with a building 20 m higher; unclassified."""
    def make(name="点群.laz", **attributes):
        rng = np.random.default_rng(1)
        x, y = rng.random((2, 20_000)) * 60
        z = np.where((x > 20) & (x < 40) & (y > 20) & (y < 40), 30.0, 10.0)
        return make_cloud(tmp_path / name, X0 + x, Y0 + y, z, **attributes)
    return make


def raster_at(path, x, y):
    from qgis.core import QgsPointXY, QgsRasterLayer

    layer = QgsRasterLayer(str(path), "raster")
    assert layer.isValid()
    value, found = layer.dataProvider().sample(QgsPointXY(X0 + x, Y0 + y), 1)
    return value if found else None


def test_surface_ground_and_mesh(run, town, tmp_path):
    result = run(ALGORITHM, {"POINTS": [str(town())], "RESOLUTION": 1.0, "OUTPUT": str(tmp_path / "表面.tif"),
                             "OUTPUT_GROUND": str(tmp_path / "地盤.tif"), "OUTPUT_MESH": str(tmp_path / "m.ply")})
    assert raster_at(result["OUTPUT"], 30, 30) == pytest.approx(30.0)
    assert raster_at(result["OUTPUT"], 10, 30) == pytest.approx(10.0)
    assert raster_at(result["OUTPUT_GROUND"], 30, 30) == pytest.approx(10.0, abs=0.01)
    assert result["POINTS_READ"] == result["POINTS_USED"] == 20_000
    assert result["GROUND_SHARE"] == pytest.approx(1 - 400 / 3600, abs=0.01)
    assert result["EMPTY_SHARE"] < 0.05 and result["TRIANGLES"] > 5_000 and result["TRIANGLES_LEFT_OUT"] == 0

    from qgis.core import QgsMeshLayer, QgsRasterLayer

    assert QgsRasterLayer(result["OUTPUT"], "surface").crs().authid() == "EPSG:6677"
    mesh = QgsMeshLayer(result["OUTPUT_MESH"], "mesh", "mdal")
    assert mesh.isValid() and mesh.dataProvider().faceCount() == result["TRIANGLES"]


def test_only_the_surface_of_several_files(run, town, tmp_path):
    result = run(ALGORITHM, {"POINTS": [str(town("a.laz")), str(town("b.las"))], "OUTPUT": str(tmp_path / "dsm.tif"),
                             "OUTPUT_GROUND": None})
    assert result["POINTS_READ"] == 40_000
    assert "OUTPUT_GROUND" not in result and "OUTPUT_MESH" not in result
    assert sorted(path.name for path in tmp_path.glob("*.tif")) == ["dsm.tif"]


def test_temporary_outputs(run, town):
    result = run(ALGORITHM, {"POINTS": [str(town())], "OUTPUT": "TEMPORARY_OUTPUT",
                             "OUTPUT_GROUND": "TEMPORARY_OUTPUT"})
    assert raster_at(result["OUTPUT_GROUND"], 30, 30) == pytest.approx(10.0, abs=0.01)


@pytest.mark.parametrize(("attributes", "parameters", "words"), [
    ({"classification": 6}, {}, "no ground points"),
    ({"classification": 7}, {}, "no usable points"),
    ({}, {"GROUND_SOURCE": "classes"}, "cloth filter"),
    ({"epsg": None}, {}, "coordinate reference system"),
    ({"epsg": 6668}, {}, "degrees"),
])
def test_one_sentence_for_what_cannot_be_done(run, town, tmp_path, attributes, parameters, words):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, {"POINTS": [str(town(**attributes))], "OUTPUT": str(tmp_path / "dsm.tif"),
                        "OUTPUT_GROUND": str(tmp_path / "ground.tif"), **parameters})
    assert not list(tmp_path.glob("*.tif"))


def test_cancel_leaves_nothing(run, feedback, town, tmp_path):
    feedback.cancel_at = 30
    run(ALGORITHM, {"POINTS": [str(town())], "OUTPUT": str(tmp_path / "dsm.tif"),
                    "OUTPUT_GROUND": str(tmp_path / "ground.tif")})
    assert not list(tmp_path.glob("*.tif"))
