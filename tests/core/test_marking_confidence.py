"""Confidence of markings: asphalt, grass, roofs and wide paint drawn with known places."""

from __future__ import annotations

from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings import marking_filter
from urbanmap_qgis.aerial.markings.marking_confidence import clear_of_paint, texture
from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_pieces import marking_pieces_of
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings
from urbanmap_qgis.aerial.markings.signs.crossing_bars import CONFIDENCE
from urbanmap_qgis.aerial.markings.signs.strokes import strokes_of
from urbanmap_qgis.aerial.markings.signs.strokes_in_company import IN_LINE, STROKES_REACH, vouched_confidence
from urbanmap_qgis.aerial.markings.signs.thick_paint import paint_around

PIXEL = 0.1


def scene(seed=2):
    """(rows, columns, 3): asphalt on the left, earth and grass on the right, all with lines of the same brightness."""
    rng = np.random.default_rng(seed)
    image = np.full((400, 600, 3), 95.0)
    image[:200, 300:] = (120, 112, 92)
    image[200:, 300:] = (95, 100, 80)
    image[200:, 300:] += cv2.GaussianBlur(rng.normal(0, 60, (200, 300)), (0, 0), 1.2)[..., None]
    for left in (60, 360):
        for top in (60, 260):
            image[top:top + 40, left:left + 2] = 215
    image = cv2.GaussianBlur(image, (0, 0), 0.6) + rng.normal(0, 1.5, image.shape)
    return np.clip(image, 0, 255).astype(np.uint8)


def found_in(tmp_path, image, area=None, **rules):
    path = tmp_path / "o.tif"
    with rasterio.open(path, "w", driver="GTiff", width=image.shape[1], height=image.shape[0], count=3, dtype="uint8",
                       crs="EPSG:6677", transform=Affine(PIXEL, 0, 0, 0, -PIXEL, 0)) as out:
        out.write(np.moveaxis(image, -1, 0))
    settings = MarkingSettings(cleaning=CleanSettings(**rules))
    made = markings_from_orthophoto(path, tmp_path / "m.tif", area, settings)
    with rasterio.open(tmp_path / "m.tif") as source:
        return made, source.read(1) > 0


def test_paint_on_asphalt_stays_and_stripes_on_grass_and_earth_go(tmp_path):
    image = scene()
    _, every = found_in(tmp_path, image, min_confidence=0.0)
    made, mask = found_in(tmp_path, image)
    assert every[60:100, 360:362].mean() > 0.8 and every[:, 310:].sum() > 500
    assert mask[60:100, 60:62].mean() > 0.9 and mask[260:300, 60:62].mean() > 0.9
    assert mask[:, 310:].sum() < 0.05 * every[:, 310:].sum()
    assert len(made.polygons) and (made.polygons.confidence > 0.2).all() and (made.polygons.confidence <= 1).all()


def test_the_trained_model_parts_the_same_scene(tmp_path):
    image = scene()
    _, every = found_in(tmp_path, image, min_confidence=0.0, trained=True)
    made, mask = found_in(tmp_path, image, trained=True)
    assert mask[60:100, 60:62].mean() > 0.9 and mask[260:300, 60:62].mean() > 0.9
    assert mask[200:, 310:].sum() < 0.05 * every[200:, 310:].sum()
    sure = made.polygons.confidence[[shape.centroid.x < 10 for shape in made.polygons.polygons]]
    assert len(sure) and (sure > 0.3).all()


def stroke_on_a_track(beside, half=17, brightness=215, seed=3):
    """(rows, columns, 3): a stroke of 1.5 m on a track of twice so many pixels through earth, and on asphalt lines of
    2.4 m2 far from it and, where given, beside."""
    rng = np.random.default_rng(seed)
    image = np.full((300, 500, 3), 95.0)
    image[:, 55:101 - half] = image[:, 101 + half:180] = (120, 112, 92)
    image[140:155, 100:102] = brightness
    for left in (400, *beside):
        image[100:180, left:left + 3] = 215
    image = cv2.GaussianBlur(image, (0, 0), 0.6) + rng.normal(0, 1.5, image.shape)
    return np.clip(image, 0, 255).astype(np.uint8)


STROKE = np.s_[140:155, 100:102]


def test_what_is_doubtful_stays_where_sure_paint_is_near(tmp_path):
    made, every = found_in(tmp_path, stroke_on_a_track(()), min_confidence=0.0)
    assert every[STROKE].mean() > 0.8 and (made.polygons.confidence == 0).any()
    _, alone = found_in(tmp_path, stroke_on_a_track(()))
    _, beside = found_in(tmp_path, stroke_on_a_track((20,)))
    assert not alone[STROKE].any() and beside[STROKE].mean() > 0.8
    assert alone[100:180, 400:403].mean() > 0.9 and beside[100:180, 400:403].mean() > 0.9


def test_worn_paint_on_a_road_may_be_alone(tmp_path):
    made, mask = found_in(tmp_path, stroke_on_a_track((), half=60, brightness=115))
    assert mask[STROKE].mean() > 0.8 and made.polygons.confidence.min() < 0.6


def test_roads_answer_for_what_is_doubtful(tmp_path):
    area = SearchArea(roads=[shapely.box(0, -30, 50, 0)])
    _, mask = found_in(tmp_path, stroke_on_a_track(()), area)
    assert mask[STROKE].mean() > 0.8


def hard(image, seed=4):
    """A scene with ground as rough as in hard light."""
    rough = image + np.random.default_rng(seed).normal(0, 6, image.shape[:2])[..., None]
    return np.clip(rough, 0, 255).astype(np.uint8)


def test_the_trained_model_is_taken_in_hard_light_alone(tmp_path):
    soft, rough = ([found_in(tmp_path, image, trained=trained) for trained in (False, True)]
                   for image in (scene(), hard(scene())))
    assert not np.array_equal(soft[0][0].polygons.confidence, soft[1][0].polygons.confidence)
    assert np.array_equal(rough[0][0].polygons.confidence, rough[1][0].polygons.confidence)
    assert np.array_equal(rough[0][1], rough[1][1]) and rough[0][1][60:100, 60:62].mean() > 0.8
    assert CleanSettings().confidence.hard_light(rough[0][0].road)
    assert not CleanSettings().confidence.hard_light(soft[0][0].road)


def test_known_roads_need_no_model_in_hard_light(tmp_path):
    """With roads the confidence asks for the contrast alone: 0.5 at least."""
    made, _ = found_in(tmp_path, hard(scene()), SearchArea(roads=[shapely.box(0, -40, 30, 0)]))
    assert len(made.polygons) and (made.polygons.confidence >= 0.5).all()


def in_blue_shade(image):
    """The left 300 columns of a scene (rows, columns, 3) in the light of the sky alone, which has little red."""
    shaded = image.astype(float)
    shaded[:, :300] *= (0.15, 0.26, 0.5)
    return np.clip(shaded + np.array((0, 0, 6)), 0, 255).astype(np.uint8)


def test_lines_in_the_blue_shade_stay_and_the_sun_through_leaves_goes(tmp_path):
    image = scene()
    image[:, 300:] = scene()[:, :300]  # asphalt in the sun, by which the image's own road is told
    shaded = in_blue_shade(image)
    rng = np.random.default_rng(4)
    dapples = np.zeros(image.shape[:2], np.uint8)
    for column, row in rng.integers((110, 20), (290, 380), (120, 2)):
        cv2.ellipse(dapples, (int(column), int(row)), (4, 2), int(rng.integers(180)), 0, 360, 1, -1)
    shaded[dapples > 0] = image[dapples > 0]
    _, every = found_in(tmp_path, shaded, min_confidence=0.0)
    _, mask = found_in(tmp_path, shaded)
    assert mask[60:100, 60:62].mean() > 0.9 and mask[260:300, 60:62].mean() > 0.9
    assert mask[60:100, 360:362].mean() > 0.9
    assert every[dapples > 0].sum() > 300 and mask[dapples > 0].sum() < 0.1 * every[dapples > 0].sum()


def test_known_roads_need_no_proof(tmp_path):
    import shapely

    _, mask = found_in(tmp_path, scene(), SearchArea(roads=[shapely.box(30.5, -20.0, 60.0, 0.0)]))
    assert mask[60:100, 360:362].mean() > 0.8


def test_texture_is_the_noise_of_plain_ground():
    rng = np.random.default_rng(0)
    image = rng.normal(100, 3, (200, 200)).astype(np.float32)
    clear = clear_of_paint(np.zeros(image.shape, bool), np.ones(image.shape, bool), PIXEL)
    assert np.median(texture(image, clear, PIXEL, 0.2)) == pytest.approx(3.0, rel=0.05)
    assert np.isinf(texture(image, np.zeros_like(image), PIXEL, 0.2)).all()


# Letters in shade where a road is thickly painted, and flecks of sun where it is not


PIXEL_PAINT = 0.12
LETTER = np.s_[90:98, 100:108]


def lost(bars, confidence=1.0, *, far=False):
    """Share of a block in shade that goes as a speck beside so many bars of 0.48 by 4.8 m in the sun."""
    mask = np.zeros((200, 400), bool)
    for number in range(bars):
        left = 20 + 8 * number + (200 if far else 0)
        mask[40:80, left:left + 4] = True
    mask[LETTER] = True
    pieces = marking_pieces_of(mask, mask.view(np.uint8), PIXEL_PAINT, 12.0)
    letter = np.zeros(mask.shape, bool)
    letter[LETTER] = True
    shaded = letter.take(pieces.inside)
    judged = SimpleNamespace(pieces=pieces, mask=mask, narrow=mask, near=(slice(0, 200), slice(0, 400)),
                             by_rules=np.where(shaded, confidence, 1.0).astype(np.float32),
                             ground=SimpleNamespace(in_shade=lambda inside, pixel: letter.take(inside)))
    specks = marking_filter._specks(judged, SimpleNamespace(roads=None), PIXEL_PAINT, CleanSettings())
    assert not specks[~shaded].any()
    return specks[shaded].mean()


def test_a_sure_letter_among_much_paint_stays():
    assert lost(12) == 0.0


@pytest.mark.parametrize(("bars", "confidence", "far"), [
    (4, 1.0, False),  # little paint
    (12, 0.5, False),  # not sure by its own ground
    (12, 1.0, True),  # too far off
])
def test_flecks_go(bars, confidence, far):
    assert lost(bars, confidence, far=far) == 1.0


def test_paint_is_counted_by_rows_and_columns():
    rng = np.random.default_rng(4)
    inside = np.sort(rng.choice(60 * 80, 500, replace=False))
    sure = rng.random(500) < 0.4
    rows, columns = np.divmod(inside, 80)
    near = (np.abs(rows[:, None] - rows) <= 10) & (np.abs(columns[:, None] - columns) <= 10)
    assert np.array_equal(paint_around(sure, inside, (60, 80), 0.1, 1.0), (near & sure).sum(axis=1))


# Strokes that others vouch for: before the bars of a crossing, and in line with sure ones


PIXEL_COMPANY = 0.12
COMB = [(0.9 * k, 0.0, 0.45, 4.0) for k in range(-2, 3)]


def found(strokes, *, bars=0, sure=(), turn=0.0, side=400):
    """Confidence by number of strokes, each (m across, m along, m wide, m long), that others vouch for; the first so
    many are bars, and those numbered are sure."""
    flags = np.zeros((side, side), np.uint8)
    along = np.array([np.cos(np.deg2rad(turn)), np.sin(np.deg2rad(turn))])
    across = np.array([-along[1], along[0]])
    middles = [side * PIXEL_COMPANY / 2 + across * place + along * shift for place, shift, *_shape in strokes]
    for middle, (*_place, width, length) in zip(middles, strokes):
        sides = (np.outer((-1, 1, 1, -1), along) * length + np.outer((-1, -1, 1, 1), across) * width) / 2
        cv2.fillPoly(flags, [np.rint((middle + sides) / PIXEL_COMPANY).astype(np.int32)], 1)
    pieces = marking_pieces_of(flags > 0, flags, PIXEL_COMPANY, 12.0)
    labels = np.zeros(flags.shape, int)
    labels.ravel()[pieces.inside] = pieces.labels
    piece = [labels[round(middle[1] / PIXEL_COMPANY), round(middle[0] / PIXEL_COMPANY)] for middle in middles]
    vouching, rules = np.zeros(len(pieces.size), bool), np.zeros(len(pieces.size), np.float32)
    vouching[piece[:bars]] = True
    rules[[piece[number] for number in sure]] = 1.0
    accepted = pieces.size > 0
    accepted[0] = False
    strokes = strokes_of(pieces, accepted, side, PIXEL_COMPANY)
    made = vouched_confidence(strokes, vouching, pieces.labels, rules[pieces.labels])
    assert (made[vouching] == np.float32(CONFIDENCE)).all()
    return {number: made[label] for number, label in enumerate(piece) if made[label] and number >= bars}


@pytest.mark.parametrize("turn", [0.0, 17.0, 45.0, 90.0, 131.0])
def test_a_stop_line_before_bars(turn):
    assert found([*COMB, (0.9, 4.0, 4.0, 0.45)], bars=5, turn=turn) == {5: CONFIDENCE}


@pytest.mark.parametrize("turn", [0.0, 17.0, 90.0])
def test_dashes_in_line_with_a_sure_one(turn):
    dashes = [(0.0, shift, 0.2, 3.0) for shift in (-12.0, 0.0, 12.0)]
    assert found(dashes, sure=[1], turn=turn) == {0: IN_LINE, 2: IN_LINE}


@pytest.mark.parametrize(("stroke", "bars"), [
    ((0.9, 4.0, 4.0, 0.45), 2),  # two bars say little
    ((0.9, 7.0, 4.0, 0.45), 5),  # too far off
    ((6.0, 4.0, 4.0, 0.45), 5),  # beside, not before them
    ((0.9, 4.0, 1.2, 0.3), 5),  # a block
    ((0.9, 4.0, 3.0, 1.2), 5),  # too wide
    ((3.0, 0.0, 0.45, 4.0), 5),  # along them
])
def test_what_is_no_stop_line(stroke, bars):
    assert found([*COMB[:bars], stroke], bars=bars) == {}


@pytest.mark.parametrize("stroke", [
    (0.6, 6.0, 0.2, 3.0),  # beside its axis
    (0.0, 16.0, 0.2, 3.0),  # too far off
    (0.0, 6.0, 0.6, 3.0),  # too wide
    (0.0, 6.0, 0.2, 1.2),  # too short
    (0.0, 6.0, 3.0, 0.2),  # across
])
def test_what_is_not_in_line(stroke):
    assert found([(0.0, 0.0, 0.2, 3.0), stroke], sure=[0]) == {}


def test_sure_ones_vouch_for_each_other_and_doubtful_ones_for_none():
    far, *two = (-15.0, 0.0, 0.2, 3.0), (0.0, 0.0, 0.2, 3.0), (0.0, 6.0, 0.2, 3.0)
    assert [list(found([far, *two], sure=sure)) for sure in ([0], [0, 1], [0, 1, 2], [])] == [[], [2], [1, 2], []]


def test_the_reach_holds_all_that_vouches():
    assert CleanSettings().piece_reach >= STROKES_REACH
