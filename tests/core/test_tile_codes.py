"""Tiles on Japan's meshes and map sheets: known codes, every point and pixel one tile's own."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from pyproj import CRS, Transformer

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import read_raster, write_raster
from urbanmap_qgis.tiling.map_sheets import SHEET_PARTS, SheetGrid, plane_system
from urbanmap_qgis.tiling.mosaic_tiles import mosaic_tiles, write_tile_raster
from urbanmap_qgis.tiling.regional_meshes import MESH_PARTS, MeshGrid

WKT = CRS.from_epsg(6677).to_wkt()
TOKYO_STATION = (139.7671, 35.6812)


def place(longitude, latitude, epsg=6677):
    return Transformer.from_crs(CRS.from_epsg(epsg).geodetic_crs, epsg, always_xy=True).transform(longitude, latitude)


def tile_at(grid, x, y):
    column, row = grid.numbers(np.array([x]), np.array([y]))
    return grid.tile(int(column[0]), int(row[0]))


@pytest.mark.parametrize(("kind", "code"), [("mesh1km", "53394611"), ("mesh500m", "533946113"),
                                            ("mesh250m", "5339461132")])
def test_meshes_of_tokyo_station(kind, code):
    """By hand: 35.6812 x 120 = 4281.744: of the row the upper half and in it the lower half (0.488 of it); 39.7671 x
    80 = 3181.368: of the column the left half and in it the right half (0.736 of it)."""
    assert tile_at(MeshGrid.of(kind, WKT, 0.0), *place(*TOKYO_STATION)).name == code


@pytest.mark.parametrize(("level", "code"), [(5000, "09LD18"), (2500, "09LD184"), (1000, "09LD184C"),
                                             (500, "09LD1885")])
def test_sheets_of_tokyo_station(level, code):
    """The station lies 35.4 km south and 5.9 km west of the origin of system 9: in the row L (30 to 60 km south) and
    the column D (0 to 40 km west), 5.4 km below its upper and 34.0 km from its left edge."""
    x, y = place(*TOKYO_STATION)
    assert (round(x / 1000, 1), round(y / 1000, 1)) == (-6.0, -35.4)
    assert tile_at(SheetGrid.of(level, WKT, 0.0), -5950.0, -35450.0).name == code


def test_sheets_begin_in_the_north_west():
    for level, code in ((5000, "09AA00"), (2500, "09AA001"), (1000, "09AA000A"), (500, "09AA0000")):
        grid = SheetGrid.of(level, WKT, 5.0)
        tile = tile_at(grid, -159_999.0, 299_999.0)
        assert tile.name == code
        width, height = 4000 / SHEET_PARTS[level], 3000 / SHEET_PARTS[level]
        assert tile.core == (-160_000.0, 300_000.0 - height, -160_000.0 + width, 300_000.0)
        assert tile.outer[0] == -160_005.0
    assert tile_at(SheetGrid.of(500, WKT, 0.0), 159_999.0, -299_999.0).name == "09TH9999"


@pytest.mark.parametrize(("epsg", "number"), [(6669, 1), (6677, 9), (6687, 19), (2451, 9), (30169, 9), (6697, None),
                                              (32654, None), (28992, None)])
def test_systems_are_known_by_their_projection(epsg, number):
    wkt = CRS.from_epsg(epsg).to_wkt()
    if number:
        assert plane_system(wkt) == number
    else:
        with pytest.raises(InputError, match="plane rectangular"):
            plane_system(wkt)


def test_all_nineteen_systems_in_their_order():
    assert [plane_system(CRS.from_epsg(6668 + number).to_wkt()) for number in range(1, 20)] == list(range(1, 20))


@pytest.mark.parametrize("grid", [*(MeshGrid.of(kind, WKT, 20.0) for kind in MESH_PARTS),
                                  *(SheetGrid.of(level, WKT, 20.0) for level in SHEET_PARTS)])
def test_every_point_is_owned_by_one_tile(grid):
    x, y = np.random.default_rng(2).uniform(-7000, -5000, (2, 3000))
    x, y = x, y - 29_500
    x[:50] = -6000.0
    tiles = grid.covering((x.min(), y.min(), x.max(), y.max()))
    owned = np.array([tile.owns(x, y) for tile in tiles])
    assert (owned.sum(axis=0) == 1).all()
    assert len({tile.name for tile in tiles}) == len(tiles)
    column, row = grid.numbers(x, y)
    for tile, own in zip(tiles, owned):
        assert np.array_equal(own, (column == tile.column) & (row == tile.row))
        assert (tile.reads(x, y) | ~own).all()
        near = shapely.distance(shapely.points(x[own], y[own]), tile.square)
        assert not len(near) or near.max() < 0.002


def test_a_raster_over_meshes_is_put_together_as_it_was(tmp_path):
    """Meshes lie askew in the plane: the boxes round them overlap."""
    x, y = place(139.9, 35.7)
    grid = Grid(round(x) - 700.0, round(y) + 700.0, 7.0, 200, 200)
    values = np.random.default_rng(5).normal(10, 3, grid.shape).astype(np.float32)
    write_raster(tmp_path / "whole.tif", values, grid, WKT)
    parts = []
    for tile in MeshGrid.of("mesh500m", WKT, 20.0).covering(grid.bounds):
        path = tmp_path / f"{tile.name}.tif"
        if write_tile_raster(tmp_path / "whole.tif", tile.outer, path):
            parts.append((path, tile))
    mosaic_tiles(parts, tmp_path / "again.tif")
    again, where, _ = read_raster(tmp_path / "again.tif")
    assert where.shape == grid.shape and np.array_equal(again, values)
    assert len(parts) >= 9 and not parts[0][1].fills_core


def test_places_outside_are_told():
    with pytest.raises(InputError, match="not in the range"):
        MeshGrid.of("mesh1km", CRS.from_epsg(28992).to_wkt(), 0.0).covering((84_000, 447_000, 85_000, 448_000))
    with pytest.raises(InputError, match="leaves the area"):
        SheetGrid.of(500, WKT, 0.0).covering((159_000, 0, 161_000, 10))
    with pytest.raises(InputError, match="more than a million"):
        MeshGrid.of("mesh250m", WKT, 0.0).covering((-400_000, -400_000, 400_000, 400_000))
