"""Outlines that are moved together, and the buffer that holds them."""

from __future__ import annotations

import numpy as np
import shapely

from urbanmap_qgis.tiling.outline_sets import buffers_needed
from urbanmap_qgis.tiling.tile_grid import TileGrid


def test_a_row_across_tiles_needs_a_buffer_to_its_end():
    grid = TileGrid(100.0, 20.0)
    row = [shapely.box(x, 40, x + 10, 50) for x in range(60, 250, 14)]  # gaps of 4 m, to x = 252
    alone = [shapely.box(20, 20, 30, 30), None, shapely.Polygon(), shapely.box(930, 930, 940, 940)]
    outlines = np.array([*row, *alone], dtype=object)
    tiles = [grid.tile(column, 0) for column in range(3)]
    needed = buffers_needed(outlines, grid, tiles, 5.0)
    end = max(shape.bounds[2] for shape in row)
    by_tile = (end - 100, max(100 - 60, end - 200), 200 - 60)
    expected = [by_tile[int(shape.centroid.x // 100)] for shape in row]
    assert np.allclose(needed[:len(row)], expected)
    assert needed[len(row)] == 0 and np.isnan(needed[len(row) + 1:]).all()
    assert (buffers_needed(outlines, grid, tiles, 3.0)[:len(row)] <= 10).all()


def test_the_order_of_outlines_does_not_matter():
    generator = np.random.default_rng(3)
    corners = generator.uniform(0, 300, (80, 2))
    outlines = shapely.box(*corners.T, *(corners + 9).T)
    grid = TileGrid(100.0, 10.0)
    tiles = grid.covering((0, 0, 310, 310))
    order = generator.permutation(80)
    assert np.array_equal(buffers_needed(outlines, grid, tiles, 5.0)[order],
                          buffers_needed(outlines[order], grid, tiles, 5.0))
