"""The trained model of paint: trees worked out by hand, and the figures of drawn ground that it is given."""

from __future__ import annotations

import numpy as np
import pytest

from scripts.train_marking_pieces import calibrated, read_trees
from urbanmap_qgis.aerial.markings.marking_filter import likely_grid
from urbanmap_qgis.aerial.markings.marking_pieces import marking_pieces_of
from urbanmap_qgis.aerial.markings.paint_figures import (
    PaintImage,
    StrokeCells,
    company_figures,
    stroke_figures,
    sums_over,
)
from urbanmap_qgis.aerial.markings.paint_model import FILE, PaintModel, PaintTrees, paint_model
from urbanmap_qgis.aerial.markings.road_model import RoadModel

PIXEL = 0.12


def two_trees():
    """Trees that ask for a > 1 and b > 0, and for b > 2 twice."""
    return PaintTrees(("a", "b"), 0.5, np.array([[0, 1], [1, 1]]), np.float32([[1, 0], [2, 2]]),
                      np.float32([[1, 2, 3, 4], [10, 20, 30, 40]]))


def test_trees_by_hand():
    figures = {"a": np.array([0.0, 2.0, 2.0, 1.0]), "b": np.array([0.0, -1.0, 3.0, 3.0])}
    assert two_trees().score(figures, 4).tolist() == [0.5 + 1 + 10, 0.5 + 3 + 10, 0.5 + 4 + 40, 0.5 + 2 + 40]
    assert two_trees().score({"a": figures["a"]}, 4).tolist() == [11.5, 13.5, 13.5, 11.5]  # what is not known is 0


def test_trees_of_catboost_by_hand():
    """Its first question is the last digit; a tree with one question more."""
    told = {"scale_and_bias": [2.0, [0.5]], "oblivious_trees": [
        {"splits": [{"float_feature_index": 2, "border": 1.0}, {"float_feature_index": 0, "border": 5.0}],
         "leaf_values": [1, 2, 3, 4]},
        {"splits": [{"float_feature_index": 2, "border": 0.0}], "leaf_values": [10, 20]}]}
    trees = read_trees(told, ["a", "b", "c"], 2)
    assert trees.names == ("a", "c")
    figures = {"a": np.array([0.0, 6.0, 6.0, 0.0]), "c": np.array([2.0, 0.5, 2.0, -1.0])}
    assert trees.score(figures, 4).tolist() == [0.5 + 2 * (2 + 20), 0.5 + 2 * (3 + 20), 0.5 + 2 * (4 + 20),
                                                0.5 + 2 * (1 + 10)]


def test_a_stored_model_is_the_same(tmp_path):
    made = PaintModel(two_trees(), two_trees(), 0.25, np.float32([0, 0.5]), np.float32([0.1, 0.9]))
    made.write(tmp_path / "m.npz")
    read = PaintModel.read(tmp_path / "m.npz")
    figures = {"a": np.linspace(-1, 3, 9), "b": np.linspace(4, -4, 9)}
    assert np.array_equal(read.second.score(figures, 9), two_trees().score(figures, 9))
    assert read.first.names == ("a", "b") and read.least == 0.25
    assert read.probability(np.array([0.0, 0.25, 0.5, 1.0])) == pytest.approx([0.1, 0.5, 0.9, 0.9])


def test_calibration_is_the_share_of_paint_and_rises():
    rng = np.random.default_rng(1)
    score = rng.random(20_000)
    paint = (rng.random(20_000) < score ** 2).astype(float)
    evidence, shares = calibrated(score, paint, np.ones(20_000))
    assert (np.diff(shares) > 0).all() and np.interp(0.7, evidence, shares) == pytest.approx(0.49, abs=0.06)


def drawn(dashed=False, right=130.0):
    """A vertical stripe on ground that is 90 on its left and something else on its right."""
    image = np.full((420, 420), 90, np.float32)
    image[:, 211:] = right
    image[:, 209:212] = 200
    if dashed:
        image[np.arange(420) % 50 >= 25, 209:212] = 90
    narrow = (image == 200).astype(np.uint8)
    clear = np.ones(image.shape, np.uint8)
    clear[:, 207:214] = 0
    bands = np.repeat(np.clip(image, 0, 255).astype(np.uint8)[None], 3, axis=0)
    return PaintImage(bands, image, np.where(narrow, 90, image), narrow, narrow.copy(), clear,
                      RoadModel(brightness=100.0), 1.0, 10.0, PIXEL)


def figures_of(seen, row=70, likely=1.0):
    """All figures of the stripe's cell in a row of cells."""
    pieces = marking_pieces_of(seen.narrow, PIXEL, 0.0, 5.0)
    cells = StrokeCells.of(seen, pieces.inside)
    found = stroke_figures(seen, cells, pieces.inside, np.full(len(pieces.inside), 10.0), pieces)
    found |= company_figures(cells, likely_grid(cells, np.full(len(cells.rows), likely, np.float32)))
    number = int(np.flatnonzero(cells.rows == row)[0])
    return {name: float(values[number]) for name, values in found.items()}


def test_ground_that_differs_on_both_sides_shows():
    found = figures_of(drawn())
    assert found["sided"] == pytest.approx(4.0)
    assert found["ordered1.1"] > 0.99 and found["firm"] > 0.99 and found["pwarm"] == 0.0
    assert found["inline"] > 0.95 and found["inline_elsewhere"] < 0.1
    assert found["relief"] == pytest.approx(11.0) and found["plen"] == -1  # too long to have a shape
    assert figures_of(drawn(right=90.0))["sided"] == 0.0


def test_dashes_lie_in_line_and_have_a_shape():
    whole, dashed = figures_of(drawn()), figures_of(drawn(dashed=True), row=67)
    assert dashed["inline"] < 0.9 < whole["inline"] and dashed["narrow2.6"] < whole["narrow2.6"]
    assert dashed["plen"] == pytest.approx(3.0, abs=0.05) and dashed["pwid"] == pytest.approx(0.36, abs=0.05)
    assert dashed["pfill"] == pytest.approx(1.0, abs=0.05) and dashed["pspread"] == pytest.approx(0, abs=1e-3)


def test_company_is_what_the_first_round_took_for_paint():
    sure, none = figures_of(drawn()), figures_of(drawn(), likely=0.0)
    assert sure["aligned2.6"] > 0.99 and none["aligned2.6"] == none["linline"] == 0
    assert sure["linline"] > 0.9 and none["inline"] == sure["inline"]


def test_sums_over_cells_are_whole_and_those_of_a_part_the_same():
    values = np.random.default_rng(3).integers(0, 4000, (301, 203)).astype(np.float32)
    sums = sums_over(values, 3)
    assert sums[4, 7] == values[12:15, 21:24].sum()
    assert np.array_equal(sums[10:40, 5:50], sums_over(values[30:120, 15:150], 3))


def test_the_model_of_this_release():
    """It is small, its confidence rises with the evidence, and it asks for figures that there are."""
    model, known = paint_model(), set(figures_of(drawn()))
    assert FILE.stat().st_size < 500_000 and (np.diff(model.shares) > 0).all() and model.shares[0] >= 0
    assert set(model.first.names) | set(model.second.names) <= known
    assert not [name for name in model.first.names if name.startswith(("aligned", "inline", "linline"))]
