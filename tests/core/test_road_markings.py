"""Road markings by adaptive thresholding: drawn streets with known paint, tiles, depths, units and bad input."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from pyproj import CRS
from rasterio.enums import ColorInterp
from rasterio.transform import Affine
from scipy.ndimage import gaussian_filter

from urbanmap_qgis.aerial.markings.disc_opening import disc_opened
from urbanmap_qgis.aerial.markings.marching_squares import zero_lines
from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import (
    MarkingSettings,
    find_markings,
    ground_figures,
    level_adjustment_of,
    paint_brightness,
)
from urbanmap_qgis.aerial.markings.road_model import road_model_of
from urbanmap_qgis.aerial.markings.signs.lane_spacing import LaneSpacing, lane_spacing
from urbanmap_qgis.errors import Cancelled, InputError
from urbanmap_qgis.progress import Progress, notices_to

WKT = CRS.from_epsg(6677).to_wkt()
PIXEL = 0.12
PLAIN = MarkingSettings(cleaning=None)
KEEN = MarkingSettings(cleaning=CleanSettings(min_confidence=0.2))
"""Takes what is doubtful: a few dashes alone on bare ground are."""

X0, Y0 = -7000.0, -34000.0
NORTH_UP = Affine(PIXEL, 0, X0, 0, -PIXEL, Y0)


def street(rows=320, columns=420, seed=1):
    """RGB (3, rows, columns) of a street with noise, and where its white and yellow paint is.

    Below lies light paving with a kerb; a white vehicle stands on the street.
    """
    rng = np.random.default_rng(seed)
    image = np.full((rows, columns, 3), 90.0)
    image[rows - 60:] = 175.0
    white = np.zeros((rows, columns), dtype=np.uint8)
    yellow = np.zeros((rows, columns), dtype=np.uint8)
    for start in range(20, columns - 60, 80):
        cv2.line(white, (start, 40), (start + 40, 50), 1, 2)
    for start in range(60, 120, 8):
        white[120:145, start:start + 4] = 1
    cv2.line(yellow, (10, 200), (columns - 10, 180), 1, 2)
    image[white > 0], image[yellow > 0] = (205, 205, 205), (215, 165, 60)
    image[90:106, 250:290] = (225, 225, 225)
    image = cv2.GaussianBlur(image, (0, 0), 0.6) + rng.normal(0, 2.5, image.shape)
    return np.clip(np.moveaxis(image, 2, 0), 0, 255), white > 0, yellow > 0


def write(path, bands, transform=NORTH_UP, crs=WKT, dtype="uint8", **profile):
    crs = crs and rasterio.crs.CRS.from_user_input(crs)
    with rasterio.open(path, "w", driver="GTiff", width=bands.shape[2], height=bands.shape[1], count=len(bands),
                       dtype=dtype, transform=transform, crs=crs, **profile) as out:
        out.write(bands.astype(dtype))
    return path


def read_mask(path):
    with rasterio.open(path) as source:
        return source.read(1) > 0


def near(mask):
    return cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0


def scores(found, truth):
    """Precision and recall at one pixel tolerance."""
    return (found & near(truth)).sum() / max(found.sum(), 1), (truth & near(found)).sum() / truth.sum()


def search(bands, settings, roads=None):
    everywhere = np.ones(bands.shape[1:], dtype=bool)
    levels = level_adjustment_of(paint_brightness(bands).ravel())
    if settings.cleaning:
        levels = replace(levels, road=road_model_of([ground_figures(bands, everywhere, PIXEL, levels, settings)]))
    return find_markings(bands, everywhere, roads, PIXEL, levels, settings)


def test_paint_is_found_and_nothing_else():
    bands, white, yellow = street()
    precision, recall = scores(search(bands, KEEN).mask, white | yellow)
    assert precision > 0.98 and recall > 0.97


def test_a_vehicle_and_a_kerb_go():
    bands, _white, _yellow = street()
    plain = search(bands, PLAIN).mask
    vehicle, kerb = np.s_[80:116, 240:300], np.s_[255:270]
    assert plain[vehicle].sum() > 50 and plain[kerb].sum() > 300
    cleaned = search(bands, KEEN).mask
    assert not cleaned[vehicle].any() and not cleaned[kerb].any()


def test_yellow_is_told_from_white():
    bands, white, yellow = street()
    found = search(bands, KEEN)
    assert found.yellow[yellow & found.mask].mean() > 0.95 and found.yellow[white & found.mask].mean() < 0.02


def test_shade_keeps_markings():
    bands, white, yellow = street()
    bands[:, :, 200:] *= 0.4
    found = search(bands, KEEN).mask
    assert scores(found[:, 210:], (white | yellow)[:, 210:])[1] > 0.9


def replace_cleaning(**rules):
    return MarkingSettings(cleaning=CleanSettings(**rules))


def test_specks_go():
    bands = np.full((3, 120, 120), 90.0)
    bands[:, 60:62, 60:62] = 220.0
    assert search(bands, replace_cleaning(min_area=0.0, min_confidence=0.0)).mask.any()
    assert not search(bands, replace_cleaning(min_area=0.5, min_confidence=0.0)).mask.any()


@pytest.mark.slow
@pytest.mark.parametrize("tile", [96, 160, 420])
def test_result_does_not_depend_on_the_cut(tmp_path, tile):
    bands, _white, _yellow = street(400, 520)
    path, settings = write(tmp_path / "正射.tif", bands), replace_cleaning(min_confidence=0.2)
    whole = markings_from_orthophoto(path, tmp_path / "whole.tif", settings=settings, tile=4096)
    cut = markings_from_orthophoto(path, tmp_path / "cut.tif", settings=settings, tile=tile)
    assert np.array_equal(read_mask(tmp_path / "whole.tif"), read_mask(tmp_path / "cut.tif"))
    assert len(whole.polygons) == len(cut.polygons) > 10
    # An edge that lies on a seam may lose a thousandth of a pixel, and so change places in the order.
    for figure in ("area", "contrast", "confidence"):
        one, other = (np.sort(getattr(made.polygons, figure)) for made in (whole, cut))
        assert np.allclose(one, other, rtol=1e-6, atol=1e-3)
    assert sorted(whole.polygons.colour) == sorted(cut.polygons.colour)


def narrow_street(rows=320, columns=420):
    """RGB (3, rows, columns) of a crossing 4 m long between light paving, and where its bars are."""
    image = np.full((rows, columns, 3), 175.0)
    image[130:190] = 90.0
    bars = np.zeros((rows, columns), np.uint8)
    for row in range(134, 184, 8):
        bars[row:row + 4, 190:224] = 1
    image[bars > 0] = 205.0
    # Narrow shadows beside it leave no smooth ground.
    for beside in np.s_[130:190, 232:], np.s_[130:190, :182]:
        image[beside] = np.where(np.arange(image[beside].shape[1])[:, None] // 4 % 2, 50.0, 90.0)
    image = cv2.GaussianBlur(image, (0, 0), 0.6) + np.random.default_rng(3).normal(0, 2.5, image.shape)
    return np.clip(np.moveaxis(image, 2, 0), 0, 255), bars > 0


def test_a_crossing_of_a_narrow_street_is_found():
    bands, bars = narrow_street()
    assert search(bands, KEEN).mask[bars].mean() > 0.8


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_workers_make_the_same_file(tmp_path, kind):
    bands, _white, _yellow = street(500, 600)
    path = write(tmp_path / "正射.tif", bands)
    places = SearchArea(roads=[shapely.box(X0, Y0 - 40, X0 + 70, Y0)])
    alone = markings_from_orthophoto(path, tmp_path / "alone.tif", places, tile=160, settings=KEEN)
    pool = ThreadPoolExecutor(2) if kind == "threads" else ProcessPoolExecutor(
        2, mp_context=multiprocessing.get_context("spawn"))
    with pool as executor:
        together = markings_from_orthophoto(path, tmp_path / "together.tif", places, tile=160, executor=executor)
    assert (tmp_path / "alone.tif").read_bytes() == (tmp_path / "together.tif").read_bytes()
    assert len(alone.polygons) > 5
    assert shapely.equals_exact(alone.polygons.polygons[:], together.polygons.polygons[:]).all()
    assert np.array_equal(alone.polygons.contrast, together.polygons.contrast)


@pytest.mark.parametrize(("dtype", "scale"), [("uint16", 200), ("uint16", 8), ("int16", 100), ("float32", 1 / 255)])
def test_bit_depth_does_not_matter(tmp_path, dtype, scale):
    bands, _white, _yellow = street()
    bands = np.round(bands)
    markings_from_orthophoto(write(tmp_path / "8.tif", bands), tmp_path / "a.tif", settings=KEEN)
    markings_from_orthophoto(write(tmp_path / "16.tif", bands * scale, dtype=dtype), tmp_path / "b.tif", settings=KEEN)
    assert (read_mask(tmp_path / "a.tif") != read_mask(tmp_path / "b.tif")).mean() < 1e-4


def test_grey_rgba_and_infrared(tmp_path):
    bands, white, _yellow = street()
    shape = bands.shape[1:]
    grey = write(tmp_path / "grey.tif", bands.mean(axis=0)[None])
    markings_from_orthophoto(grey, tmp_path / "a.tif", settings=KEEN)
    assert scores(read_mask(tmp_path / "a.tif")[:160], white[:160])[1] > 0.9

    alpha = np.full((1, *shape), 255.0)
    alpha[0, :, :100] = 0
    path = write(tmp_path / "rgba.tif", np.concatenate([bands, alpha]), photometric="rgb", alpha="yes")
    with rasterio.open(path) as source:
        assert source.colorinterp[3] == ColorInterp.alpha
    markings_from_orthophoto(path, tmp_path / "b.tif", settings=KEEN)
    found = read_mask(tmp_path / "b.tif")
    assert not found[:, :100].any() and scores(found[:160, 110:], white[:160, 110:])[1] > 0.9


def test_no_data_is_not_looked_at(tmp_path):
    bands, white, _yellow = street()
    bands = np.maximum(np.round(bands), 1)
    bands[:, 30:150, 80:90] = 0
    found = markings_from_orthophoto(write(tmp_path / "a.tif", bands, nodata=0), tmp_path / "m.tif", settings=KEEN)
    assert found.searched_area == pytest.approx((bands[0].size - 1200) * PIXEL ** 2)
    mask = read_mask(tmp_path / "m.tif")
    assert not mask[30:150, 80:90].any() and scores(mask[:160], white[:160] & (bands[0, :160] > 0))[1] > 0.9


def test_saturated_paint_is_no_hole_where_no_data_is_white(tmp_path):
    """Paint of 255 in all bands under a no-data value of 255, in one image with a border that holds no image."""
    bands, white, _yellow = street()
    bands[:, white] = 255
    bands[:, :, :12] = 255
    plain = markings_from_orthophoto(write(tmp_path / "a.tif", bands), tmp_path / "a_mask.tif", settings=KEEN)
    told = []
    with notices_to(told.append):
        path = write(tmp_path / "b.tif", bands, nodata=255)
        found = markings_from_orthophoto(path, tmp_path / "b_mask.tif", tile=160, settings=KEEN)
    assert len(told) == 1 and "no-data value 255" in told[0]
    assert plain.searched_area - found.searched_area == pytest.approx(12 * bands.shape[1] * PIXEL ** 2)
    mask = read_mask(tmp_path / "b_mask.tif")
    assert not mask[:, :12].any() and scores(mask[:160, 16:], white[:160, 16:])[1] > 0.9


def test_limits_roads_buildings_and_mask(tmp_path):
    bands, white, yellow = street()
    path = write(tmp_path / "a.tif", bands)
    half = shapely.box(X0, Y0 - 160 * PIXEL, X0 + 420 * PIXEL, Y0)
    hidden = np.zeros((1, 80, 105))
    hidden[:, :, :25] = 255
    coarse = write(tmp_path / "hidden.tif", hidden, Affine(4 * PIXEL, 0, X0, 0, -4 * PIXEL, Y0))
    runs = {"roads": SearchArea(roads=[half]), "buildings": SearchArea(buildings=[half]),
            "mask": SearchArea(mask=coarse)}
    masks = {}
    for name, places in runs.items():
        markings_from_orthophoto(path, tmp_path / f"{name}.tif", places, settings=KEEN)
        masks[name] = read_mask(tmp_path / f"{name}.tif")
    assert not masks["roads"][160:].any() and scores(masks["roads"][:158], white[:158])[1] > 0.97
    assert not masks["buildings"][:160].any() and scores(masks["buildings"][165:], yellow[165:])[1] > 0.97
    assert not masks["mask"][:, :100].any() and scores(masks["mask"][:, 105:], (white | yellow)[:, 105:])[1] > 0.97


def test_feet_and_turned_images(tmp_path):
    bands, _white, _yellow = street()
    metres = markings_from_orthophoto(write(tmp_path / "m.tif", bands), tmp_path / "a.tif", settings=KEEN)
    foot = 0.3048
    feet = write(tmp_path / "f.tif", bands, Affine(PIXEL / foot, 0, 9e5, 0, -PIXEL / foot, 5e5), CRS.from_epsg(2225))
    in_feet = markings_from_orthophoto(feet, tmp_path / "b.tif", metres_per_unit=foot, settings=KEEN)
    turn = Affine.translation(X0, Y0) * Affine.rotation(30) * Affine.scale(PIXEL, -PIXEL)
    turned = markings_from_orthophoto(write(tmp_path / "t.tif", bands, turn), tmp_path / "c.tif", settings=KEEN)
    assert len(metres.polygons) == len(in_feet.polygons) == len(turned.polygons)
    for other in (in_feet, turned):
        assert np.allclose(np.sort(other.polygons.area), np.sort(metres.polygons.area), rtol=1e-6)
    with rasterio.open(tmp_path / "c.tif") as source:
        assert source.transform.almost_equals(turn)
    back = shapely.transform(turned.polygons.polygons[:], lambda xy: np.column_stack(~turn * xy.T))
    there = shapely.transform(metres.polygons.polygons[:], lambda xy: np.column_stack(~NORTH_UP * xy.T))
    assert shapely.union_all(back).symmetric_difference(shapely.union_all(there)).area < 0.5


def test_fine_pixels_are_taken_together(tmp_path):
    bands, white, yellow = street(200, 260)
    bands = np.repeat(np.repeat(bands, 6, axis=1), 6, axis=2)[:, :-1, :-2]
    fine = write(tmp_path / "fine.tif", bands, Affine(PIXEL / 6, 0, X0, 0, -PIXEL / 6, Y0))
    markings_from_orthophoto(fine, tmp_path / "m.tif", settings=KEEN)
    found = read_mask(tmp_path / "m.tif")
    assert found.shape == bands.shape[1:]
    assert scores(found[3::6, 3::6], (white | yellow)[:found[3::6].shape[0], :found[:, 3::6].shape[1]])[1] > 0.95


def test_nothing_to_find(tmp_path):
    path = write(tmp_path / "a.tif", np.full((3, 200, 200), 90.0))
    found = markings_from_orthophoto(path, tmp_path / "m.tif", settings=KEEN)
    assert not len(found.polygons) and found.marked_area == 0 and not read_mask(tmp_path / "m.tif").any()
    away = markings_from_orthophoto(path, tmp_path / "m.tif", SearchArea(roads=[shapely.box(0, 0, 1, 1)]))
    assert away.searched_area == 0 and not read_mask(tmp_path / "m.tif").any()


def test_bad_input(tmp_path):
    flat = np.full((3, 40, 40), 90.0)
    out = tmp_path / "m.tif"
    (tmp_path / "text.tif").write_text("no raster")
    other = write(tmp_path / "other.tif", flat[:1], Affine(PIXEL, 0, 0, 0, -PIXEL, 0))
    palette = write(tmp_path / "palette.tif", flat[:1], photometric="palette")
    for words, path, places in (
            ("cannot be read", tmp_path / "text.tif", None),
            ("colour table", palette, None),
            ("cannot be seen", write(tmp_path / "coarse.tif", flat, Affine(2, 0, X0, 0, -2, Y0)), None),
            ("not square", write(tmp_path / "long.tif", flat, Affine(0.1, 0, X0, 0, -0.2, Y0)), None),
            ("does not reach", write(tmp_path / "a.tif", flat), SearchArea(mask=other))):
        with pytest.raises(InputError, match=words):
            markings_from_orthophoto(path, out, places, settings=KEEN)
        assert not out.exists()


def test_a_mask_that_does_not_cover_is_told(tmp_path):
    warnings = []
    part = write(tmp_path / "part.tif", np.zeros((1, 20, 20)))
    markings_from_orthophoto(write(tmp_path / "a.tif", street()[0]), tmp_path / "m.tif", SearchArea(mask=part),
                             progress=Progress(warn=warnings.append))
    assert len(warnings) == 1 and "does not cover" in warnings[0]


def test_cancel_leaves_nothing(tmp_path):
    path = write(tmp_path / "a.tif", street()[0])
    with pytest.raises(Cancelled):
        markings_from_orthophoto(path, tmp_path / "m.tif", progress=Progress(cancelled=lambda: True), settings=KEEN)
    assert [file.name for file in tmp_path.iterdir()] == ["a.tif"]


# The opening by a disc is OpenCV's, to the bit


@pytest.mark.parametrize("side", [3, 7, 9, 11, 13, 17, 25, 31])
@pytest.mark.parametrize("shape", [(1, 40), (300, 270), (20, 300), (257, 5)])
def test_it_is_opencvs(side, shape):
    image = np.random.default_rng(side).normal(100.0, 30.0, shape).astype(np.float32)
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
    wanted = cv2.morphologyEx(image, cv2.MORPH_OPEN, disc, borderType=cv2.BORDER_REPLICATE)
    assert np.array_equal(disc_opened(image, disc), wanted)


def test_a_line_goes_and_a_field_stays():
    image = np.zeros((100, 100), np.float32)
    image[:, 20:28] = image[40:80, 50:90] = 7.0
    opened = disc_opened(image, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (11, 11)))
    assert not opened[:, 15:40].any()
    assert (opened[50:70, 60:80] == 7.0).all()


# Distance of neighbouring lane lines: lines in metres and in feet, crossings and single lines that tell nothing


def drawn(boxes, turn=0.0, unit=1.0):
    """Spacing of boxes (left, low, right, high) in m, turned by degrees, in a CRS of a unit in m."""
    made = np.array([shapely.box(*one) for one in boxes], object)
    sides = np.array([[right - left, high - low] for left, low, right, high in boxes]).reshape(-1, 2)
    moved = shapely.transform([shapely.affinity.rotate(one, turn, (0, 0)) for one in made], lambda p: p / unit + 5e5)
    return lane_spacing(moved, shapely.area(made), sides.max(axis=1), sides.min(axis=1))


def dashes(at, count=8, step=9.0, dash=4.0):
    return [(step * k, at - 0.075, step * k + dash, at + 0.075) for k in range(count)]


@pytest.mark.parametrize("turn", [0.0, 37.0, 90.0])
@pytest.mark.parametrize("unit", [1.0, 0.3048])
def test_neighbouring_lines(turn, unit):
    """Of four lines the nearest neighbours are 3.2, 3.2 and 3.4 m away, which share all 8 dashes of 4 m."""
    lines = [*dashes(0.0), *dashes(3.2), *dashes(6.4), *dashes(9.8)]
    made = drawn(lines, turn, unit)
    assert made.spacing == pytest.approx(3.2, abs=0.01)
    assert made.length == pytest.approx(6 * 8 * 4.0, rel=0.01)
    wider = drawn([*dashes(0.0), *dashes(3.4), *dashes(6.8)], turn, unit)
    assert wider.spacing == pytest.approx(3.4, abs=0.01)


def test_a_pixel_said_half_as_large_halves_it():
    lines = np.array([*dashes(0.0), *dashes(3.2)])
    assert drawn(lines / 2).spacing == pytest.approx(1.6, abs=0.01)


@pytest.mark.parametrize("boxes", [
    [], dashes(0.0), [(0.0, 0.9 * k, 3.0, 0.9 * k + 0.45) for k in range(10)],
    [(0.0, 2.5 * k, 5.0, 2.5 * k + 0.1) for k in range(10)]], ids=["none", "one line", "crossing", "one row of bays"])
def test_what_tells_nothing(boxes):
    assert drawn(boxes) == LaneSpacing(0.0, 0.0)


# Lines along which a field is zero


def framed(field):
    return np.pad(field.astype(np.float32), 1, constant_values=np.float32(-1e9))


@pytest.mark.parametrize("side, smooth", [(5, 0.0), (60, 0.0), (200, 0.7), (300, 3.0)])
def test_lines_are_those_of_scikit_image_to_the_last_bit(side, smooth):
    measure = pytest.importorskip("skimage.measure")
    noise = np.random.default_rng(side).normal(size=(side, side + 3))
    field = framed(gaussian_filter(noise, smooth) if smooth else noise)
    wanted = measure.find_contours(field, 0.0)
    points, counts = zero_lines(field)
    assert len(wanted) > 1
    assert counts.tolist() == [len(line) for line in wanted]
    assert np.array_equal(points, np.concatenate(wanted))


def test_one_high_value_has_four_crossings():
    field = -np.ones((3, 3))
    field[1, 1] = 3
    points, counts = zero_lines(field)
    assert counts.tolist() == [5]
    assert {tuple(point) for point in points.tolist()} == {(0.25, 1), (1.75, 1), (1, 0.25), (1, 1.75)}
    assert points[0].tolist() == points[-1].tolist()


def test_high_values_across_a_square_do_not_touch():
    field = -np.ones((4, 4))
    field[1, 1] = field[2, 2] = 1
    assert zero_lines(field)[1].tolist() == [5, 5]


def test_nothing_high_has_no_lines():
    points, counts = zero_lines(-np.ones((4, 5)))
    assert points.shape == (0, 2)
    assert len(counts) == 0


def test_a_field_high_at_its_edge_is_refused():
    with pytest.raises(ValueError, match="below zero along its edges"):
        zero_lines(np.ones((3, 3)))
