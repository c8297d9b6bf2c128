"""Polygons over tiles: each once and whole, however long, whatever tile saw how much of it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.tiling.joined_polygons import at_edge, cut_at_tile, joined, share_of_fields
from urbanmap_qgis.tiling.tile_grid import TileGrid


def over_tiles(polygons, grid, sees=lambda polygon, tile: polygon):
    """Polygons cut by tiles of what each tile sees of them, and put together again; with their fields."""
    whole, fields, pieces, names, columns = [], [], [], [], {"area": [], "length": [], "width": [], "colour": []}
    for tile in grid.covering(shapely.total_bounds(polygons)):
        seen = [sees(polygon, tile) for polygon in polygons]
        seen = [polygon for polygon in seen if polygon is not None and not polygon.is_empty]
        if not seen:
            continue
        given = {"area": [polygon.area for polygon in seen], "length": [polygon.length / 2 for polygon in seen],
                 "width": [0.15] * len(seen), "colour": ["white"] * len(seen)}
        parts, rows, shares = cut_at_tile(seen, tile)
        own = share_of_fields(given, rows, shares)
        edge = at_edge(parts, tile)
        for number, part in enumerate(parts):
            if not edge[number]:
                whole.append(part)
                fields.append("")
                continue
            pieces.append(part)
            names.append(tile.name)
            for name in columns:
                columns[name].append(own[name][number])
    polygons, made = joined(np.array(pieces, object), names, columns) if pieces else ([], {"seam": []})
    return whole, polygons, made


def test_a_line_longer_than_any_buffer_is_one_again():
    line = shapely.box(-130.0, 12.0, 277.0, 12.15)
    grid = TileGrid(50.0, 10.0)
    whole, polygons, fields = over_tiles([line], grid, lambda polygon, tile: shapely.intersection(
        polygon, shapely.box(*tile.outer)))
    assert not whole and len(polygons) == 1 and fields["seam"] == ["joined"]
    assert polygons[0].symmetric_difference(line).area < 1e-6
    assert fields["area"][0] == pytest.approx(line.area) and fields["width"][0] == pytest.approx(0.15)
    assert fields["colour"] == ["white"]


def test_markings_on_edges_and_corners_are_there_once():
    rng = np.random.default_rng(8)
    middles = rng.uniform(-90, 90, (80, 2))
    middles[:10, 0], middles[5:15, 1] = 50.0, -50.0
    given = [shapely.affinity.rotate(shapely.box(x - 1.5, y - 0.3, x + 1.5, y + 0.3), angle)
             for (x, y), angle in zip(middles, rng.uniform(0, 180, 80))]
    given = [polygon for number, polygon in enumerate(given)
             if not any(polygon.distance(other) < 0.1 for other in given[:number])]
    whole, polygons, fields = over_tiles(given, TileGrid(50.0, 5.0))
    assert set(fields["seam"]) == {"joined"} and len(whole) + len(polygons) == len(given)
    for polygon in given:
        assert min(polygon.symmetric_difference(other).area for other in [*whole, *polygons]) < 1e-4
    assert sum(fields["length"]) == pytest.approx(3.6 * len(polygons), rel=1e-6)


def test_what_one_tile_does_not_see_is_marked_as_cut():
    line = shapely.box(40.0, 12.0, 60.0, 12.3)
    _, polygons, fields = over_tiles([line], TileGrid(50.0, 10.0), lambda polygon, tile: polygon
                                     if tile.column == 0 else None)
    assert fields["seam"] == ["cut"] and polygons[0].bounds[2] == 50.0
    assert fields["area"][0] == pytest.approx(3.0)


def test_neighbours_in_one_tile_and_touching_corners_stay_apart():
    squares = [shapely.box(45, 5, 50, 10), shapely.box(50, 10, 55, 15), shapely.box(45, 20, 50, 30)]
    _, polygons, fields = over_tiles(squares, TileGrid(50.0, 10.0))
    assert len(polygons) == 3 and set(fields["seam"]) == {"cut"}


def test_heights_stay():
    line = shapely.force_3d(shapely.box(40.0, 12.0, 60.0, 12.3), 7.5)
    _, (polygon,), _ = over_tiles([line], TileGrid(50.0, 30.0))
    assert polygon.has_z and np.allclose(shapely.get_coordinates(polygon, include_z=True)[:, 2], 7.5)


def test_nothing_is_nothing():
    pieces, rows, shares = cut_at_tile([], TileGrid(50.0, 10.0).tile(0, 0))
    assert len(pieces) == len(rows) == len(shares) == len(at_edge(pieces, TileGrid(50.0, 10.0).tile(0, 0))) == 0
    pieces, _, _ = cut_at_tile([None, shapely.box(60, 0, 70, 10)], TileGrid(50.0, 10.0).tile(0, 0))
    assert not len(pieces)
