"""Outlines of markings: finer than pixels, whole across seams, measured."""

from __future__ import annotations

import tempfile

import cv2
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from pyproj import CRS
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_polygons import (
    merge_tile_polygons,
    most_in_doubt,
    tile_polygons,
    with_heights,
)
from urbanmap_qgis.aerial.markings.road_markings import (
    Markings,
    MarkingSettings,
    find_markings,
    level_adjustment_of,
    paint_brightness,
)
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import RasterSampler, write_raster

PIXEL = 0.12
PLACE = Affine(PIXEL, 0, 100.0, 0, -PIXEL, 200.0)


def drawn(shapes, rows=160, columns=160, fine=32, coarse=8):
    """Image (1, rows, columns) of bright polygons (in the CRS), as square pixels behind a soft lens see them.

    Painted in `fine` parts a pixel, so that paint's own edge is true to 1/64 pixel; the lens acts on `coarse` parts.
    """
    image = np.zeros((rows * fine, columns * fine), np.uint8)
    for shape in shapes:
        xy = np.array(shape.exterior.coords)
        pixels = np.column_stack(~PLACE * xy.T) * fine - 0.5
        cv2.fillPoly(image, [np.round(pixels * 16).astype(np.int32)], 255, shift=4)
    parts = cv2.resize(image, (columns * coarse, rows * coarse), interpolation=cv2.INTER_AREA).astype(np.float32) / 255
    soft = cv2.GaussianBlur(parts, (0, 0), 0.5 * coarse)
    return 90 + 110 * cv2.resize(soft, (columns, rows), interpolation=cv2.INTER_AREA)[None]


def found_in(bands, tile=None):
    everywhere = np.ones(bands.shape[1:], bool)
    levels = level_adjustment_of(paint_brightness(bands).ravel())
    all_kept = MarkingSettings(cleaning=CleanSettings(min_confidence=0.0))
    markings = find_markings(bands, everywhere, None, PIXEL, levels, all_kept)
    return polygons_of(markings, tile)


def polygons_of(markings, tile=None):
    rows, columns = markings.mask.shape
    tile = tile or max(rows, columns)
    window = slice(0, rows), slice(0, columns)
    pieces = [tile_polygons(markings, window, slice(row, min(row + tile, rows)),
                             slice(col, min(col + tile, columns)), PLACE)
              for row in range(0, rows, tile) for col in range(0, columns, tile)]
    return merge_tile_polygons(pieces, PLACE, 1.0, 0.0, tempfile.gettempdir())


def turned_box(x, y, length, width, degrees):
    box = shapely.box(-length / 2, -width / 2, length / 2, width / 2)
    return shapely.affinity.translate(shapely.affinity.rotate(box, degrees, origin=(0, 0)), x, y)


@settings(max_examples=10, deadline=None)
@given(st.floats(-0.06, 0.06), st.floats(-0.06, 0.06), st.floats(0, 180), st.sampled_from([0.3, 0.45]))
def test_outlines_beat_the_pixel(dx, dy, degrees, width):
    truth = turned_box(109.6 + dx, 190.4 + dy, 5.0, width, degrees)
    found = found_in(drawn([truth]))
    assert len(found) == 1
    offset = shapely.get_coordinates(shapely.centroid(found.polygons[0]))[0] - [109.6 + dx, 190.4 + dy]
    turn = np.radians(degrees)
    assert abs(offset @ [np.cos(turn), np.sin(turn)]) < 0.3 * PIXEL  # along the dash
    assert abs(offset @ [-np.sin(turn), np.cos(turn)]) < 0.1 * PIXEL  # across it
    assert found.length[0] == pytest.approx(5.0, abs=0.2) and found.width[0] == pytest.approx(width, abs=0.06)


def test_parts_are_joined_across_seams():
    ring = shapely.Point(109.6, 190.4).buffer(4).difference(shapely.Point(109.6, 190.4).buffer(3.7))
    field = np.full((160, 160), -50, np.float32)
    rows, columns = np.mgrid[:160, :160]
    x, y = PLACE * (columns + 0.5, rows + 0.5)
    distance = np.hypot(x - 109.6, y - 190.4)
    field = (0.15 - np.abs(distance - 3.85)).astype(np.float32) * 100
    markings = Markings(field > 0, field, np.where(field > 0, 80, 0).astype(np.float32), field > 0,
                        np.where(field > 0, np.float32(0.7), 0))
    whole = polygons_of(markings)
    assert len(whole) == 1 and len(whole.polygons[0].interiors) == 1
    assert whole.area[0] == pytest.approx(ring.area, rel=0.02)
    assert whole.confidence[0] == pytest.approx(0.7)
    assert whole.contrast[0] == pytest.approx(80) and whole.colour[0] == "yellow"
    for tile in (7, 31, 64):
        cut = polygons_of(markings, tile)
        assert len(cut) == 1 and len(cut.polygons[0].interiors) == 1
        assert cut.area[0] == pytest.approx(whole.area[0], rel=1e-6) and cut.contrast[0] == pytest.approx(80)
        assert cut.polygons[0].symmetric_difference(whole.polygons[0]).area < 0.02 * ring.area


def test_a_marking_inside_one_tile_is_found_once():
    dashes = [turned_box(109.6, y, 3.0, 0.45, 0) for y in (197.0, 190.4, 183.5)]
    whole, cut = (found_in(drawn(dashes), tile) for tile in (None, 54))
    assert len(whole) == len(cut) == 3
    assert np.sort(cut.area) == pytest.approx(np.sort(whole.area), rel=1e-6)


def test_markings_at_the_images_edge_are_closed():
    field = np.full((20, 20), -1, np.float32)
    field[:3, :] = field[:, 17:] = 1
    markings = Markings(field > 0, field, field, np.zeros((20, 20), bool), field)
    found = polygons_of(markings)
    assert len(found) == 1 and found.polygons[0].is_valid and found.colour[0] == "white"


def test_heights_of_the_ground(tmp_path):
    truth = turned_box(109.6, 190.4, 5.0, 0.45, 30)
    found = found_in(drawn([truth]))
    grid = Grid(100.0, 200.0, 0.5, 40, 40)
    cx, cy = grid.centres()
    plane = (10 + 0.1 * (cx[None, :] - 100) + 0.05 * (cy[:, None] - 180)).astype(np.float32)
    write_raster(tmp_path / "g.tif", plane, grid, CRS.from_epsg(6677).to_wkt())
    with RasterSampler(tmp_path / "g.tif") as ground:
        raised, without = with_heights(found.polygons, ground)
        _, outside = with_heights(shapely.transform(found.polygons[:], lambda xy: xy + 1000), ground)
    assert without == 0 and outside == 1
    x, y, z = shapely.get_coordinates(raised[:], include_z=True).T
    assert np.allclose(z, 10 + 0.1 * (x - 100) + 0.05 * (y - 180), atol=1e-4)


def test_a_hole_belongs_to_the_ring_round_it_though_a_piece_lies_inside():
    row, column = np.mgrid[:60, :60]
    away = np.hypot(row - 30, column - 30)
    paint = ((away > 20) & (away < 26)) | (away < 12)  # the middle of the hole lies on the piece in it
    field = np.where(paint, 40, -40).astype(np.float32)
    markings = Markings(paint, field, field, ~paint, np.ones(field.shape, np.float32))
    found = polygons_of(markings)
    assert sorted(len(polygon.interiors) for polygon in found.polygons) == [0, 1]
    assert all(polygon.is_valid for polygon in found.polygons)
    assert found.area.sum() == pytest.approx(np.count_nonzero(paint) * abs(PLACE.a * PLACE.e), rel=0.03)


def test_what_has_the_most_area_in_doubt_comes_first():
    """0.5 x 0.5 x 1 and 0.4 x 0.6 x 2 and 0.3 x 0.7 x 0.5."""
    assert most_in_doubt(np.array([0.5, 0.4, 0.3]), np.array([1.0, 2.0, 0.5])).tolist() == [1, 0, 2]
