"""Occlusion map through Processing."""

from __future__ import annotations

import json
import warnings

import numpy as np
import pytest

ALGORITHM = "urbanmap:occlusionmap"
X0, Y0 = -7_000.0, -34_000.0


@pytest.fixture
def flight(tmp_path):
    """A box of 10 x 10 x 40 m, 50 m east of the nadir of a frame 1000 m up; 5 pixels a metre."""
    import rasterio
    from rasterio.errors import NotGeoreferencedWarning

    from urbanmap_qgis.geometry.grid import Grid
    from urbanmap_qgis.io.raster import write_raster

    grid = Grid(X0 - 100, Y0 + 100, 0.5, 400, 400)
    x, y = np.meshgrid(*grid.centres())
    z = np.where((np.abs(x - X0 - 55) < 5) & (np.abs(y - Y0) < 5), 40.0, 0.0).astype(np.float32)
    wkt = rasterio.crs.CRS.from_epsg(6677).to_wkt()
    files = {name: tmp_path / file for name, file in (
        ("FRAME", "写真.tif"), ("CAMERA", "camera.json"), ("EXTERIOR", "外部.csv"), ("DSM", "dsm.tif"),
        ("GROUND", "ground.tif"))}
    write_raster(files["DSM"], z, grid, wkt)
    write_raster(files["GROUND"], np.zeros_like(z), grid, wkt)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotGeoreferencedWarning)
        with rasterio.open(files["FRAME"], "w", driver="GTiff", width=900, height=800, count=1, dtype="uint8") as out:
            out.write(np.zeros((1, 800, 900), np.uint8))
    files["CAMERA"].write_text(json.dumps({"focal_length_mm": 100, "pixel_pitch_mm": 0.02, "image_width": 900,
                                           "image_height": 800, "principal_point_mm": [0, 0]}))
    files["EXTERIOR"].write_text(f"image,x,y,z,omega,phi,kappa\n写真.tif,{X0},{Y0},1000,0,0,0\n", encoding="utf-8")
    return {name: str(path) for name, path in files.items()}


def read_mask(path):
    from osgeo import gdal

    return gdal.Open(str(path)).ReadAsArray()


def test_mask_of_a_box(run, flight, tmp_path):
    result = run(ALGORITHM, {**flight, "OUTPUT": str(tmp_path / "影.tif")})
    mask = read_mask(result["OUTPUT"])
    assert mask.shape == (800, 900) and set(np.unique(mask)) == {0, 255}
    columns = np.flatnonzero(mask[399])
    assert columns[0] == pytest.approx(449.5 + 250, abs=1) and columns[-1] == pytest.approx(449.5 + 311, abs=1)
    assert result["HIDDEN_SHARE"] == pytest.approx((mask > 0).mean()) and result["UNCOVERED_SHARE"] == 0


def test_threshold_and_outlines(run, flight, polygon_layer, tmp_path):
    output = str(tmp_path / "o.tif")
    assert run(ALGORITHM, {**flight, "HEIGHT_THRESHOLD": 50, "OUTPUT": output})["HIDDEN_SHARE"] == 0
    x, y = X0 + 50, Y0 - 5
    outlines = polygon_layer([f"POLYGON(({x} {y},{x + 10} {y},{x + 10} {y + 10},{x} {y + 10},{x} {y}))",
                              f"POLYGON(({x - 40} {y},{x - 30} {y},{x - 30} {y + 9},{x - 40} {y}))"])
    result = run(ALGORITHM, {**flight, "HEIGHT_THRESHOLD": 50, "FOOTPRINTS": outlines, "OUTPUT": output})
    assert result["HIDDEN_SHARE"] > 0 and (result["FOOTPRINTS_RAISED"], result["FOOTPRINTS_FLAT"]) == (1, 1)


@pytest.mark.parametrize(("name", "text", "sentence"), [
    ("EXTERIOR", "image,x,y,z,omega,phi,kappa\nother.tif,0,0,9,0,0,0\n", "no line for 写真.tif"),
    ("EXTERIOR", f"image,x,y,z,omega,phi,kappa\n写真.tif,{X0},{Y0},900,0.01,0.02,3.1\n", "radians"),
    ("EXTERIOR", "image,x,y,z,omega,phi,kappa\n写真.tif,0,0,900,0,0,0\n", "looks past"),
    ("CAMERA", '{"focal_length_mm": 100, "pixel_pitch_mm": 0.02, "image_width": 90, "image_height": 80}', "900 x 800"),
    ("CAMERA", "f = 100", "JSON"), ("FRAME", "no image", "cannot be read as an image"),
])
def test_bad_input_is_told_in_a_sentence(run, flight, tmp_path, name, text, sentence):
    from qgis.core import QgsProcessingException

    with open(flight[name], "w", encoding="utf-8") as file:
        file.write(text)
    with pytest.raises(QgsProcessingException, match=sentence):
        run(ALGORITHM, {**flight, "OUTPUT": str(tmp_path / "o.tif")})
    assert not (tmp_path / "o.tif").exists()


def test_outlines_in_another_crs(run, flight, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingException

    outlines = polygon_layer(["POLYGON((0 0,10 0,10 10,0 10,0 0))"], crs="EPSG:6678")
    with pytest.raises(QgsProcessingException, match="Surface"):
        run(ALGORITHM, {**flight, "FOOTPRINTS": outlines, "OUTPUT": str(tmp_path / "o.tif")})


def test_walls_can_be_left_as_the_surface_has_them(run, flight, tmp_path):
    def share(**more):
        return run(ALGORITHM, {**flight, **more, "OUTPUT": str(tmp_path / "o.tif")})["HIDDEN_SHARE"]

    paper = share(METHOD="paper")
    assert paper == share(LOW_PARTS=False, STEEP_WALLS=False, SHIFT_WALLS=False)
    assert len({paper, share(), share(STEEP_WALLS=False, SHIFT_WALLS=False), share(SHIFT_WALLS=False)}) >= 2
    assert paper > share()  # the wall's foot stands a cell farther out
