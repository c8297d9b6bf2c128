"""Surface and ground of real clouds, against their own classes and against the simulated city's truth."""

from __future__ import annotations

import laspy
import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.geometry.sampling import sample
from urbanmap_qgis.io.raster import read_raster
from urbanmap_qgis.settings.terrain import SurfaceSettings
from urbanmap_qgis.terrain.cloth import classify_ground
from urbanmap_qgis.terrain.surface import ground_raster
from urbanmap_qgis.terrain.surface_files import surfaces_from_files


def points_of(path):
    las = laspy.read(path)
    return (*(np.array(las[name]) for name in "xyz"), np.array(las.classification))


@pytest.fixture(scope="module")
def delft(real_data):
    return points_of(real_data / "als" / "delft_west" / "points.laz")


def test_cloth_agrees_with_the_makers_ground_in_delft(delft):
    x, y, z, classes = delft
    ground, truth = classify_ground(x, y, z), classes == 2
    assert (~ground & truth).sum() / truth.sum() < 0.03
    assert ground[classes == 6].mean() < 0.004
    assert (ground != truth).mean() < 0.02


def test_cloth_among_trees(real_data):
    x, y, z, classes = points_of(real_data / "als" / "bratislava" / "strip_204623.copc.laz")
    ground = classify_ground(x, y, z)
    assert (~ground & (classes == 2)).sum() / (classes == 2).sum() < 0.07
    assert ground[np.isin(classes, (4, 5, 6))].mean() < 0.001


@pytest.mark.parametrize("name", ["points_2_per_m2.laz", "points_1_per_m2.laz"])
def test_thinned_clouds_have_the_same_ground(real_data, delft, name):
    x, y, z, classes = delft
    grid = Grid.covering(x.min(), y.min(), x.max(), y.max(), 1.0)
    full = ground_raster(x, y, z, classes, grid)
    thin_x, thin_y, thin_z, _classes = points_of(real_data / "als" / "delft_west" / name)
    thin = ground_raster(thin_x, thin_y, thin_z, None, grid)
    assert np.isfinite(thin).all()
    assert np.median(np.abs(thin - full)) < 0.05


@pytest.mark.parametrize("name", ["als.laz", "als_classified.laz"])
def test_city_ground_against_truth(real_data, tmp_path, name):
    summary = surfaces_from_files([real_data / "city" / "als" / name], tmp_path / "dsm.tif", tmp_path / "ground.tif")
    assert summary.ground_method == ("cloth" if name == "als.laz" else "classes")
    truth, truth_grid, _wkt = read_raster(real_data / "city" / "truth" / "ground.tif")
    ground, grid, _wkt = read_raster(tmp_path / "ground.tif")
    cx, cy = truth_grid.centres()
    x, y = (axis.ravel()[::7] for axis in np.meshgrid(cx, cy))
    error = sample(grid, ground, x, y) - truth.ravel()[::7]
    error = error[~np.isnan(error)]
    assert len(error) > 100_000
    assert np.sqrt(np.mean(error ** 2)) < 0.04 and abs(error.mean()) < 0.01


def test_surface_passes_through_flat_roofs(real_data, delft, tmp_path):
    path = real_data / "als" / "delft_west" / "points.laz"
    surfaces_from_files([path], tmp_path / "dsm.tif", settings=SurfaceSettings())
    surface, grid, _wkt = read_raster(tmp_path / "dsm.tif")
    x, y, z, classes = delft
    roof = classes == 6
    off = sample(grid, surface, x[roof], y[roof]) - z[roof]
    assert abs(np.nanmedian(off)) < 0.05
    # A quarter of the class are points of walls and of lower parts in the same cells.
    assert np.nanmedian(np.abs(off)) < 0.15


def test_building_points_alone_are_refused(real_data, tmp_path):
    path = next((real_data / "als" / "delft_cells").glob("*.laz"))
    with pytest.raises(InsufficientDataError, match="no ground points"):
        surfaces_from_files([path], tmp_path / "dsm.tif", tmp_path / "ground.tif")
