"""Geoid models of all forms give the same heights, and refuse places beyond them."""

import struct

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.conversion.geoid import Geoid, read_geoid

SOUTH, WEST, STEPS = 35.0, 139.0, (1 / 60, 1 / 40)
ROWS, COLUMNS = 61, 41
HEIGHTS = 36.0 + 0.02 * np.arange(ROWS)[:, None] - 0.03 * np.arange(COLUMNS)


def geotiff(path):
    place = Affine(STEPS[1], 0, WEST - STEPS[1] / 2, 0, -STEPS[0], SOUTH + (ROWS - 0.5) * STEPS[0])
    with rasterio.open(path, "w", driver="GTiff", width=COLUMNS, height=ROWS, count=1, dtype="float64",
                       crs="EPSG:6668", transform=place) as target:
        target.write(HEIGHTS[::-1], 1)


def gtx(path):
    head = struct.pack(">4d2i", SOUTH, WEST, *STEPS, ROWS, COLUMNS)
    path.write_bytes(head + HEIGHTS.astype(">f4").tobytes())


def gsi(path):
    rows = "\n".join(" ".join(f"{value:.4f}" for value in row) for row in HEIGHTS)
    path.write_text(f"  35.00000  139.00000 0.016667 0.025000   {ROWS}   {COLUMNS} 1 ver2.1\n{rows}\n")


def isg(path):
    rows = "\n".join(" ".join(f"{value:.4f}" for value in row) for row in HEIGHTS[::-1])
    path.write_text(f"""begin_of_head =====
model name     : made up
lat min        =  35°00'00"
lat max        =  36°00'00"
lon min        = 139°00'00"
lon max        = 140°00'00"
delta lat      =   0°01'00"
delta lon      =   0°01'30"
nrows          = {ROWS}
ncols          = {COLUMNS}
nodata         = -9999.0000
end_of_head =====
{rows}
""", encoding="utf-8")


@pytest.mark.parametrize(("write", "name"), [(geotiff, "a.tif"), (gtx, "a.gtx"), (gsi, "a.asc"), (isg, "a.isg")])
def test_every_form_gives_the_same_heights(tmp_path, write, name):
    write(tmp_path / name)
    geoid = read_geoid(tmp_path / name)
    row, column = np.array([0.0, 10.25, 59.9]), np.array([0.0, 20.5, 39.9])
    found = geoid.interpolate(WEST + column * STEPS[1], SOUTH + row * STEPS[0])
    assert np.allclose(found, 36.0 + 0.02 * row - 0.03 * column, atol=1e-4)
    with pytest.raises(InputError, match="does not reach latitude 34.9000, longitude 139.5"):
        geoid.interpolate(np.array([139.5]), np.array([34.9]))


def test_longitudes_may_run_round_the_globe():
    heights = np.tile(np.arange(36.0), (3, 1))
    geoid = Geoid("globe", heights, -10.0, 0.0, (10.0, 10.0))
    assert geoid.interpolate(np.array([-5.0, 355.0, 5.0]), np.zeros(3)) == pytest.approx([17.5, 17.5, 0.5])


def test_one_height_holds_everywhere():
    heights = Geoid.constant(36.5).interpolate(np.array([0.0, 139.0]), np.array([80.0, -35.0]))
    assert heights == pytest.approx([36.5, 36.5])


def test_what_is_no_geoid_is_refused(tmp_path):
    (tmp_path / "short.asc").write_text("35 139 0.1 0.1 3 3 1 x\n1 2 3 4\n")
    with pytest.raises(InputError, match="holds 4 heights, its header says 9"):
        read_geoid(tmp_path / "short.asc")
    (tmp_path / "text.asc").write_text("no numbers\n")
    with pytest.raises(InputError, match="text.asc: line 1 cannot be read"):
        read_geoid(tmp_path / "text.asc")
    (tmp_path / "text.tif").write_text("no raster")
    with pytest.raises(InputError, match="cannot be read as a geoid model"):
        read_geoid(tmp_path / "text.tif")
    with rasterio.open(tmp_path / "dem.tif", "w", driver="GTiff", width=5, height=5, count=1, dtype="float32",
                       crs="EPSG:6677", transform=Affine(1, 0, 0, 0, -1, 0)) as target:
        target.write(np.ones((5, 5), np.float32), 1)
    with pytest.raises(InputError, match="along latitude and longitude"):
        read_geoid(tmp_path / "dem.tif")
    (tmp_path / "high.asc").write_text("35 139 0.1 0.1 2 2 1 x\n500 500 500 500\n")
    with pytest.raises(InputError, match="is no geoid model"):
        read_geoid(tmp_path / "high.asc")
