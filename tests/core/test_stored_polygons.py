"""Polygons and figures in files, and markings that leave the memory as soon as they are whole."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings import marking_polygons
from urbanmap_qgis.aerial.markings.marking_polygons import TilePolygons, merge_tile_polygons
from urbanmap_qgis.aerial.markings.stored_polygons import StoredPolygons, StoredRows, batches

SIDE, ROWS = 100, 12
NORTH_UP = Affine(1, 0, 0, 0, -1, 0)


def boxes(count):
    return shapely.box(np.arange(count), 0, np.arange(count) + 0.5, np.arange(count) + 1.0)


def test_what_is_stored_comes_back(tmp_path):
    store, made = StoredPolygons(tmp_path), boxes(30)
    store.add(made[:20])
    store.add(made[:0])
    store.add(made[20:])
    assert len(store) == 30 and shapely.equals_exact(store[:], made).all()
    assert store[7].equals(made[7]) and [item.area for item in store] == [item.area for item in made]
    assert [len(batch) for batch in batches(store, 12)] == [12, 12, 6]
    order = np.arange(29, 0, -2)
    store.sort(order)
    assert len(store) == 15 and shapely.equals_exact(store[3:9], made[order][3:9]).all()


def test_heights_and_holes_are_kept(tmp_path):
    ring = shapely.force_3d(shapely.Point(0, 0).buffer(2).difference(shapely.Point(0, 0).buffer(1)), 5.0)
    first = StoredPolygons(tmp_path)
    first.add(np.array([ring, shapely.box(0, 0, 1, 1)], object))
    other = first.like(batch for batch in batches(first, 1))
    assert other[0].equals(ring) and other[0].has_z and not other[1].has_z


def test_nothing_stored(tmp_path):
    store = StoredPolygons(tmp_path)
    assert len(store) == 0 and len(store[:]) == 0 and list(store) == []
    assert len(StoredRows(tmp_path, 3).column(1)) == 0


def test_rows(tmp_path):
    rows, made = StoredRows(tmp_path, 3), np.arange(75_000.0).reshape(-1, 3)
    rows.add(made[:10])
    rows.add(made[10:])
    assert np.array_equal(rows.column(2), made[:, 2])


def test_no_file_is_left(tmp_path):
    store = StoredPolygons(tmp_path)
    store.add(boxes(3))
    store.close()
    rows = StoredRows(tmp_path, 1)
    rows.close()
    assert not list(tmp_path.iterdir())


def tile_of(row, line):
    """Tile of `SIDE` pixels with a whole marking, the half of one over its lower seam, that of one over its upper, and
    a part of a line through all tiles; without `line` the last ends in the tile."""
    top, bottom = row * SIDE, (row + 1) * SIDE
    parts = np.array([shapely.box(10, top + 40, 12, top + 44), shapely.box(30, bottom - 3, 33, bottom),
                      shapely.box(30, top, 33, top + 3),
                      shapely.box(60, top, 61, bottom if line else top + 50)], object)
    seam = np.array([False, True, True, True])
    box = shapely.bounds(parts)
    measures = np.column_stack([shapely.area(parts), shapely.length(parts), -box[:, 1] - 0.5, box[:, 0] + 0.5])
    pixels = shapely.area(parts)
    return TilePolygons(parts, seam, pixels, 50.0 * pixels, np.zeros(4), 0.5 * pixels, measures, top)


def test_markings_are_joined_and_leave_the_memory(tmp_path, monkeypatch):
    waited = []
    closed = marking_polygons._closed

    def watched(waiting, top):
        left, done = closed(waiting, top)
        waited.append((len(left[0]), len(done[0])))
        return left, done

    monkeypatch.setattr(marking_polygons, "_closed", watched)
    found = merge_tile_polygons((tile_of(row, row < ROWS - 1) for row in range(ROWS)), NORTH_UP, 1.0, 0.0, tmp_path)
    # Whole markings, those over a seam, the ends at the image's rims, and one line.
    assert len(found) == ROWS + (ROWS - 1) + 2 + 1
    assert np.array_equal(np.sort(found.area)[-1:], [(ROWS - 1) * SIDE + 50])
    assert np.sum(np.isclose(found.area, 18)) == ROWS - 1 and np.allclose(found.contrast, 50)
    tops = np.array([shapely.bounds(outline)[3] for outline in found.polygons])
    assert (np.diff(tops) <= 0).all()
    # What goes on below a row is one half a row and the line; all else is finished there.
    assert [left for left, _ in waited] == [row + 2 for row in range(ROWS - 1)]
    assert all(done > 0 for _, done in waited)
    assert not list(tmp_path.iterdir())


def test_a_markings_outline_does_not_depend_on_its_neighbours(tmp_path):
    pair = [tile_of(row, False) for row in range(2)]
    alone = merge_tile_polygons(pair, NORTH_UP, 1.0, 0.0, tmp_path)
    among = merge_tile_polygons([tile_of(row, False) for row in range(5)], NORTH_UP, 1.0, 0.0, tmp_path)
    first = [outline for outline in alone.polygons if outline.bounds[3] > -101.5 and outline.area == pytest.approx(18)]
    again = [outline for outline in among.polygons if outline.bounds[3] > -101.5 and outline.area == pytest.approx(18)]
    assert len(first) == len(again) == 1 and first[0].equals_exact(again[0], 0)
