"""GeoTIFF writing, reading and sampling."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import rasterio
from hypothesis import given, settings
from hypothesis import strategies as st
from pyproj import CRS

from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.geometry.sampling import sample
from urbanmap_qgis.io.raster import NODATA, RasterSampler, read_raster, write_raster
from urbanmap_qgis.progress import notices_to

WKT = CRS.from_epsg(6677).to_wkt()
GRID = Grid(-7000.0, -34000.0, 0.5, 300, 700)


def plane(grid):
    cx, cy = grid.centres()
    return (0.1 * (cx[None, :] - grid.x_min) - 0.2 * (cy[:, None] - grid.y_max)).astype(np.float32)


def test_round_trip(tmp_path):
    raster = plane(GRID)
    raster[5:9, 3] = np.nan
    write_raster(tmp_path / "標高.tif", raster, GRID, WKT)
    back, grid, wkt = read_raster(tmp_path / "標高.tif")
    assert np.array_equal(back, raster, equal_nan=True) and grid == GRID
    assert CRS.from_wkt(wkt).to_epsg() == 6677
    with rasterio.open(tmp_path / "標高.tif") as source:
        assert source.nodata == NODATA and source.profile["tiled"] and source.compression.name == "deflate"
        assert source.read(1)[5, 3] == NODATA


@pytest.mark.parametrize("value", [NODATA, -32768.0, 3.4028235e38, -3.4028235e38, 1e20])
def test_values_that_are_no_heights_are_empty_and_told(tmp_path, value):
    raster, told = plane(GRID), []
    raster[5:9, 3] = value
    write_raster(tmp_path / "a.tif", raster, GRID, WKT, nodata=None)
    with notices_to(told.append):
        back, *_ = read_raster(tmp_path / "a.tif")
    assert np.isnan(back[5:9, 3]).all() and np.isnan(back).sum() == 4
    assert len(told) == 1 and "taken as empty" in told[0]


def test_whole_numbers(tmp_path):
    mask = (np.arange(GRID.rows * GRID.columns).reshape(GRID.shape) % 2 * 255).astype(np.uint8)
    write_raster(tmp_path / "mask.tif", mask, GRID, WKT, nodata=None)
    assert np.array_equal(read_raster(tmp_path / "mask.tif")[0], mask)


def test_sampler_equals_sampling_in_memory(tmp_path):
    raster = plane(GRID)
    raster[100:120, 200:240] = np.nan
    write_raster(tmp_path / "a.tif", raster, GRID, WKT)
    x, y = np.random.default_rng(0).random((2, 3000)) * [[400], [200]] + [[-7020], [-34170]]
    x[0], y[1] = np.nan, np.inf
    with RasterSampler(tmp_path / "a.tif") as source:
        heights = source.sample(x, y)
    np.testing.assert_allclose(heights, sample(GRID, raster, x, y), atol=1e-5)
    assert np.isnan(heights[:2]).all()


def test_a_raster_of_one_row_has_samples_at_the_cells_of_a_grid(tmp_path):
    write_raster(tmp_path / "a.tif", np.arange(5, dtype=np.float32)[None], Grid(0.0, 1.0, 1.0, 1, 5), WKT)
    with RasterSampler(tmp_path / "a.tif") as source:
        heights = source.sample_cells(Grid(1.0, 1.0, 0.5, 2, 3))
    assert heights.tolist() == [[0.75, 1.25, 1.75]] * 2


def test_plane_is_sampled_exactly():
    x = np.random.default_rng(1).uniform(-6999.5, -6651, 500)
    y = np.random.default_rng(2).uniform(-34149, -34001, 500)
    expected = 0.1 * (x - GRID.x_min) - 0.2 * (y - GRID.y_max)
    np.testing.assert_allclose(sample(GRID, plane(GRID), x, y), expected, atol=1e-4)


def test_sampling_at_borders_gaps_and_outside():
    grid = Grid(0.0, 2.0, 1.0, 2, 2)
    raster = np.array([[1.0, np.nan], [3.0, 5.0]])
    x, y = np.array([0.0, 0.1, 1.0, 2.5, 1.9, np.nan]), np.array([2.0, 0.1, 1.0, 1.0, 1.9, 1.0])
    np.testing.assert_allclose(sample(grid, raster, x, y), [1.0, 3.0, 3.0, np.nan, np.nan, np.nan])
    one = sample(Grid(0.0, 1.0, 1.0, 1, 1), np.array([[7.0]]), np.array([0.2, 1.0]), np.array([0.9, 0.0]))
    assert one.tolist() == [7.0, 7.0]


@given(st.integers(1, 6), st.integers(1, 6), st.floats(0, 1), st.floats(0, 1), st.integers(0, 1000))
@settings(deadline=None)
def test_samples_lie_between_the_values(rows, columns, u, v, seed):
    grid = Grid(10.0, 20.0, 0.5, rows, columns)
    raster = np.random.default_rng(seed).random(grid.shape)
    x_min, y_min, x_max, y_max = grid.bounds
    height = sample(grid, raster, np.array([x_min + u * (x_max - x_min)]), np.array([y_min + v * (y_max - y_min)]))
    assert raster.min() - 1e-12 <= height[0] <= raster.max() + 1e-12


def test_refusals(tmp_path):
    (tmp_path / "text.tif").write_text("no raster")
    for path in (tmp_path / "text.tif", tmp_path / "missing.tif"):
        with pytest.raises(InputError, match=path.name):
            read_raster(path)
    write_raster(tmp_path / "a.tif", plane(GRID), GRID, WKT)
    with pytest.raises(InputError, match="no band 2"):
        read_raster(tmp_path / "a.tif", 2)
    with pytest.raises(OutputError):
        write_raster(tmp_path / "nowhere" / "a.tif", plane(GRID), GRID, WKT)
    with pytest.raises(InputError, match="coordinate reference system"):
        write_raster(tmp_path / "b.tif", plane(GRID), GRID, "nonsense")
    assert not (tmp_path / "b.tif").exists()


def test_turned_raster_is_refused(tmp_path):
    transform = rasterio.Affine(0.94, -0.34, 0.0, -0.34, -0.94, 0.0)
    with rasterio.open(tmp_path / "turned.tif", "w", driver="GTiff", width=3, height=3, count=1, dtype="float32",
                       transform=transform) as target:
        target.write(np.zeros((1, 3, 3), dtype=np.float32))
    with pytest.raises(InputError, match="turned"):
        read_raster(tmp_path / "turned.tif")


def test_foreign_proj_and_gdal_folders_do_no_harm(tmp_path):
    """QGIS's PROJ_LIB and GDAL_DATA may hold another version's data."""
    code = ("import sys, numpy as np\n"
            "from urbanmap_qgis.io.raster import read_raster, write_raster\n"
            "from urbanmap_qgis.geometry.grid import Grid\n"
            "write_raster(sys.argv[1], np.zeros((4, 4), np.float32), Grid(0., 4., 1., 4, 4), sys.argv[2])\n"
            "print(len(read_raster(sys.argv[1])[2]))\n")
    environment = {**os.environ, "PROJ_LIB": str(tmp_path), "PROJ_DATA": str(tmp_path), "GDAL_DATA": str(tmp_path)}
    run = subprocess.run([sys.executable, "-c", code, str(tmp_path / "a.tif"), WKT], env=environment,
                         cwd=Path(__file__).resolve().parents[2], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert int(run.stdout) > 100


@pytest.mark.parametrize("empty", range(4))
def test_heights_beside_an_empty_cell_are_weighted_among_the_others(empty):
    grid = Grid(0.0, 2.0, 1.0, 2, 2)
    raster, weight = np.array([1.0, 2.0, 3.0, 7.0]), np.array([0.75 * 0.4, 0.25 * 0.4, 0.75 * 0.6, 0.25 * 0.6])
    left = np.arange(4) != empty
    wanted = weight[left] @ raster[left] / weight[left].sum()
    raster[empty] = np.nan
    assert sample(grid, raster.reshape(2, 2), np.array([0.75]), np.array([0.9])) == pytest.approx([wanted])
