"""Data taken from one reference system into another: places, heights, accuracies, swapped axes."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from pyproj import Transformer

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.conversion.reprojection import (
    epsg_wkt,
    moved_geometries,
    plane_transform,
    resampled,
    seem_swapped,
    swapped_overlap,
)
from urbanmap_qgis.io.raster import RasterSampler, write_raster


def test_geometries_move_and_keep_their_heights():
    places = np.array([shapely.Polygon([(139.7, 35.6, 5), (139.701, 35.6, 6), (139.7, 35.601, 7)]), None], dtype=object)
    moved = moved_geometries(places, plane_transform(epsg_wkt(6668), epsg_wkt(6677)))
    corners = shapely.get_coordinates(moved[0], include_z=True)
    expected = Transformer.from_crs(6668, 6677, always_xy=True).transform([139.7, 139.701], [35.6, 35.6])
    assert corners[:2, 0] == pytest.approx(expected[0], abs=1e-6)
    assert corners[:2, 1] == pytest.approx(expected[1], abs=1e-6)
    assert corners[:3, 2].tolist() == [5, 6, 7] and moved[1] is None


def test_flat_geometries_stay_flat():
    moved = moved_geometries(np.array([shapely.Point(139.7, 35.6)], dtype=object),
                             plane_transform(epsg_wkt(6668), epsg_wkt(6677)))
    assert not shapely.has_z(moved[0])


def test_places_that_cannot_be_computed_are_refused():
    transform = plane_transform(epsg_wkt(6668), epsg_wkt(6677))
    with pytest.raises(InputError, match="outside of where"):
        moved_geometries(np.array([shapely.Point(35.6, 139.7)], dtype=object), transform)


def test_raster_in_degrees_has_its_heights_at_their_places(tmp_path):
    grid = Grid(139.7, 35.61, 0.2 / 3600, 180, 180)
    x, y = np.meshgrid(*grid.centres())
    write_raster(tmp_path / "a.tif", (1e4 * (x - 139.7) + 2e4 * (y - 35.6)).astype(np.float32), grid, epsg_wkt(6668))
    back = Transformer.from_crs(6677, 6668, always_xy=True)
    box = Transformer.from_crs(6668, 6677, always_xy=True).transform_bounds(139.702, 35.602, 139.708, 35.608)
    with RasterSampler(tmp_path / "a.tif") as source:
        made, heights = resampled(source, plane_transform(epsg_wkt(6668), epsg_wkt(6677)), box)
    assert made.cell == pytest.approx(6.16, abs=0.05)
    longitude, latitude = back.transform(*np.meshgrid(*made.centres()))
    assert np.abs(heights - (1e4 * (longitude - 139.7) + 2e4 * (latitude - 35.6))).max() < 0.01


def test_swapped_axes_are_seen():
    assert seem_swapped((35.6, 139.7, 35.7, 139.8)) and not seem_swapped((139.7, 35.6, 139.8, 35.7))
    assert not seem_swapped((4.3, 52.0, 4.4, 52.1))
    here, swapped = (-7000, -35000, -6900, -34900), (-35000, -7000, -34900, -6900)
    assert swapped_overlap(here, swapped) and not swapped_overlap(here, here)
    assert not swapped_overlap(here, (0, 0, 1, 1))


def test_cells_in_another_system_are_as_large_as_at_the_middle_of_the_box():
    """North there is y^2 + x y: a cell of 0.1 at x = 15, y = 5 is 2.51 high."""
    def curved(x, y, inverse=False):
        return (x, 0.5 * (np.sqrt(x * x + 4 * y) - x)) if inverse else (x, y * y + x * y)

    source = SimpleNamespace(grid=SimpleNamespace(cell=0.1), sample=lambda x, y: 10 * x + y)
    grid, heights = resampled(source, curved, (10.0, 90.0, 20.0, 110.0))
    columns, rows = grid.centres()
    assert grid.cell == pytest.approx(2.51)
    assert heights[3, 2] == pytest.approx(10 * columns[2] + curved(columns[2], rows[3], inverse=True)[1])
