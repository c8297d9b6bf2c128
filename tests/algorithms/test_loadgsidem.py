"""Load GSI elevation models through Processing, and the heights that results carry."""

from __future__ import annotations

import pytest

from tests.core import gsi_dem_writer as writer

ALGORITHM = "urbanmap:loadgsidem"
CODE = "53394611"



@pytest.fixture
def folder(tmp_path):
    """A folder with a Japanese name and one mesh, level at 12.5 m but for a row of water."""
    made = tmp_path / "標高"
    made.mkdir()
    lines = ["地表面,12.50"] * (150 * 225)
    lines[:225] = ["内水面,-9999.00"] * 225
    (made / "FG-GML-5339-46-11-DEM5A-20161001.xml").write_text(writer.dem_xml(CODE, lines, 150, 225), encoding="utf-8")
    return made


@pytest.mark.parametrize("parameter", ["INPUT", "INPUT_FOLDER"])
def test_folder_to_raster_in_the_fitting_zone(run, plugin, folder, tmp_path, parameter):
    from qgis.core import QgsRasterLayer

    target = tmp_path / "地面.tif"
    result = run(ALGORITHM, {parameter: str(folder), "OUTPUT": str(target)})
    assert (result["MESHES"], result["HEIGHTS"]) == (1, "JGD2011")
    assert 0.0 < result["EMPTY"] < 0.1
    layer = QgsRasterLayer(str(target), "ground")
    crs = plugin("algorithms.framework.layers.crs")
    assert crs.horizontal(layer.crs()).authid() == "EPSG:6677"
    assert layer.dataProvider().sample(layer.extent().center(), 1) == (12.5, True)


def test_degrees_and_cell_size_as_chosen(run, folder, tmp_path):
    from qgis.core import QgsRasterLayer

    result = run(ALGORITHM, {"INPUT": str(folder), "CRS": "EPSG:6668", "OUTPUT": str(tmp_path / "a.tif")})
    layer = QgsRasterLayer(result["OUTPUT"], "degrees")
    assert (layer.width(), layer.height()) == (225, 150)
    run(ALGORITHM, {"INPUT": str(folder), "RESOLUTION": 25, "OUTPUT": str(tmp_path / "b.tif")})
    assert QgsRasterLayer(str(tmp_path / "b.tif"), "coarse").rasterUnitsPerPixelX() == 25


def test_other_datum_is_told_with_its_accuracy(run, feedback, folder, tmp_path):
    run(ALGORITHM, {"INPUT": str(folder), "CRS": "EPSG:32654", "OUTPUT": str(tmp_path / "a.tif")})
    assert any("accurate to 1 m" in text for text in feedback.warnings)


def test_nothing_given_or_nothing_there_is_one_sentence(run, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="No file was given"):
        run(ALGORITHM, {"OUTPUT": str(tmp_path / "a.tif")})
    with pytest.raises(QgsProcessingException, match="holds no .xml file"):
        run(ALGORITHM, {"INPUT_FOLDER": str(tmp_path), "OUTPUT": str(tmp_path / "a.tif")})
