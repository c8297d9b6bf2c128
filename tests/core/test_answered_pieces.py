"""What answers about doubtful markings teach: by hand, and in a drawn image in which colour tells what rules do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings.answered_markings import (
    MarkingAnswers,
    doubtful_markings,
    learned_from_orthophoto,
)
from urbanmap_qgis.aerial.markings.learning.answered_pieces import (
    AnsweredCells,
    LearnedAnswers,
    learned_from,
    read_learned,
)
from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings
from urbanmap_qgis.errors import InputError

PIXEL = 0.12
SETTINGS = MarkingSettings()


def cells(count=20, told=2.0, seed=1):
    """Answers of one cell each, all of confidence a half, of which the first of three figures tells."""
    rng = np.random.default_rng(seed)
    paint = np.arange(count) % 2 == 0
    figures = rng.normal(0, 1, (count, 3))
    figures[:, 0] = np.where(paint, told, -told)
    return AnsweredCells(("a", "b", "c"), figures, np.full(count, 0.5), np.arange(count), paint, np.ones(count),
                         np.array([[0.0, 0, 0], [1, 1, 1]]))


def test_the_figure_that_tells_is_learned_and_the_others_are_not():
    learned = learned_from(cells(), "profile")
    assert learned.weights[0] > 5 * max(abs(learned.weights[1]), abs(learned.weights[2]))
    found = learned.corrected(np.full(2, 0.5), {"a": np.array([2.0, -2.0])})
    assert found[0] > 0.6 and found[1] < 0.4 and (learned.yes, learned.no) == (10, 10)


def test_answers_that_agree_with_the_confidence_leave_it_nearly_as_it_is():
    given = replace(cells(told=0.0), confidence=np.where(np.arange(20) % 2 == 0, 0.9, 0.1))
    learned = learned_from(given, "profile")
    before = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
    assert learned.corrected(before, {}) == pytest.approx(before, abs=0.06)


def test_the_coefficients_are_the_most_likely():
    """At the maximum of the posterior its slope is zero: worked out anew, with the prior of the module."""
    from urbanmap_qgis.aerial.markings.learning.answered_pieces import LIMITS, log_odds

    given = cells(told=0.7)
    learned = learned_from(given, "trained")
    likely = learned.corrected(given.confidence, dict(zip(given.names, given.figures.T))).astype(float)
    pull = given.figures.T @ (given.paint - likely)
    assert pull == pytest.approx(LIMITS.figures_prior * np.array(learned.weights), abs=1e-4)
    assert np.sum(given.paint - likely) == pytest.approx(LIMITS.offset_prior * learned.offset, abs=1e-4)
    assert log_odds(given.confidence) @ (given.paint - likely) == pytest.approx(
        LIMITS.slope_prior * (learned.slope - 1), abs=1e-4)


def test_an_answer_counts_once_however_many_cells_it_covers():
    one = cells()
    twice = AnsweredCells(one.names, *(np.concatenate([values, values[:1]]) for values in (
        one.figures, one.confidence, one.answer)), one.paint, np.ones(21), one.spread_of)
    assert learned_from(twice, "profile").weights == pytest.approx(learned_from(one, "profile").weights)


def test_few_answers_are_refused():
    given = cells()
    with pytest.raises(InputError, match="20 yes and 0 no"):
        learned_from(replace(given, paint=np.ones(20, bool)), "profile")


def test_what_has_the_most_area_in_doubt_is_asked_first():
    """0.5 x 0.5 x 1 and 0.4 x 0.6 x 2 and 0.3 x 0.7 x 0.5; what is surer is not asked at all."""
    confidence, area = np.array([0.5, 0.71, 0.4, 0.3, 0.29]), np.array([1.0, 9.0, 2.0, 0.5, 9.0])
    assert doubtful_markings(confidence, area).tolist() == [2, 0, 3]


def test_what_is_stored_is_the_same_and_other_files_are_refused(tmp_path):
    learned = learned_from(cells(), "trained")
    learned.write(tmp_path / "w.json")
    assert read_learned(tmp_path / "w.json") == learned
    for text in ("[]", "{}", '{"kind": "answers to road markings"}'):
        (tmp_path / "x.json").write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match="no weights"):
            read_learned(tmp_path / "x.json")
    broken = replace(learned, spread=(0.0, 1.0, 1.0))
    broken.write(tmp_path / "x.json")
    with pytest.raises(InputError):
        read_learned(tmp_path / "x.json")


@pytest.fixture(scope="module")
def street(tmp_path_factory):
    """A grey yard with 24 white lines and 24 as bright and narrow but cold ones; their places, and which are white."""
    rng = np.random.default_rng(2)
    image = np.repeat(90 + rng.normal(0, 2, (900, 900, 1)), 3, axis=2)
    boxes, white = [], []
    for number in range(48):
        row, column = 60 + 130 * (number // 8) + rng.integers(0, 20), 40 + 105 * (number % 8)
        # Both are as bright in what is levelled: red, or the mean of the colours.
        image[row:row + 2, column:column + 30] = (128, 128, 128) if number % 2 else (126, 130, 128)
        top, left = -(row - 1) * PIXEL, (column - 1) * PIXEL
        boxes.append(shapely.box(left, top - 4 * PIXEL, left + 32 * PIXEL, top))
        white.append(bool(number % 2))
    path = tmp_path_factory.mktemp("street") / "ortho.tif"
    with rasterio.open(path, "w", driver="GTiff", width=900, height=900, count=3, dtype="uint8", crs="EPSG:6677",
                       transform=Affine(PIXEL, 0, 0, 0, -PIXEL, 0)) as target:
        target.write(np.moveaxis(np.clip(np.rint(image), 0, 255).astype(np.uint8), -1, 0))
    return path, np.array(boxes, object), np.array(white)


def confidences(found, boxes):
    """Mean confidence of what was found in each box; 0 where nothing was."""
    polygons = np.array(list(found.polygons.polygons), object)
    box, which = shapely.STRtree(polygons).query(boxes, predicate="intersects")
    total, count = np.bincount(box, found.polygons.confidence[which], minlength=len(boxes)), np.bincount(
        box, minlength=len(boxes))
    return total / np.maximum(count, 1)


@pytest.mark.slow
def test_the_rest_of_an_image_is_judged_by_what_was_answered(street, tmp_path):
    path, boxes, white = street
    every = replace(SETTINGS, cleaning=CleanSettings(min_confidence=0.0))
    before = confidences(markings_from_orthophoto(path, tmp_path / "m.tif", settings=every), boxes)
    asked = np.arange(48) < 24
    assert (before > 0).all() and abs(before[white].mean() - before[~white].mean()) < 0.15
    learned = learned_from_orthophoto(path, MarkingAnswers(boxes[asked], white[asked]), settings=every)
    taught = replace(every, cleaning=replace(every.cleaning, learned=learned))
    after = confidences(markings_from_orthophoto(path, tmp_path / "m.tif", settings=taught), boxes)
    assert (learned.yes, learned.no) == (12, 12)
    assert after[~asked & white].min() > after[~asked & ~white].max() + 0.1
    # A tile's result does not depend on how the image is cut.
    cut = markings_from_orthophoto(path, tmp_path / "c.tif", settings=taught, tile=512)
    with rasterio.open(tmp_path / "m.tif") as whole, rasterio.open(tmp_path / "c.tif") as parts:
        assert np.array_equal(whole.read(1), parts.read(1))
    assert len(cut.polygons)


def test_answers_do_not_go_with_roads_nor_without_cleaning(street):
    path, boxes, white = street
    answers = MarkingAnswers(boxes, white)
    with pytest.raises(InputError, match="roads"):
        learned_from_orthophoto(path, answers, SearchArea(roads=[shapely.box(0, -100, 100, 0)]))
    with pytest.raises(InputError, match="clean"):
        learned_from_orthophoto(path, answers, settings=MarkingSettings(cleaning=None))
    elsewhere = MarkingAnswers(np.array([shapely.box(5e3, 5e3, 5001, 5001)] * 20), np.arange(20) % 2 == 0)
    with pytest.raises(InputError, match="0 yes and 0 no"):
        learned_from_orthophoto(path, elsewhere)


def test_a_figure_that_an_image_does_not_have_counts_as_usual():
    learned = LearnedAnswers("profile", ("warm2.6",), (0.0,), (1.0,), (3.0,), 1.0, 0.0, 9, 9)
    assert learned.corrected(np.array([0.3]), {}) == pytest.approx([0.3])
