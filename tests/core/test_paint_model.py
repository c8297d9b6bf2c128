"""The trained model of paint: trees worked out by hand, and the figures of drawn ground that it is given."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.markings.marking_confidence import GroundBeside
from urbanmap_qgis.aerial.markings.paint_model import FILE, KindOfLight, PaintModel, paint_model
from urbanmap_qgis.aerial.markings.road_model import RoadModel
from urbanmap_qgis.aerial.markings.surroundings import cells_of, figures_at, road_share, sums_over

PIXEL = 0.12


def two_trees():
    """Trees that ask for a > 1 and b > 0, and for b > 2 twice."""
    return PaintModel(("a", "b"), 0.5, np.array([[0, 1], [1, 1]]), np.float32([[1, 0], [2, 2]]),
                      np.float32([[1, 2, 3, 4], [10, 20, 30, 40]]), np.float32([0, 0.5]), np.float32([0.1, 0.9]))


def test_trees_by_hand():
    figures = {"a": np.array([0.0, 2.0, 2.0, 1.0]), "b": np.array([0.0, -1.0, 3.0, 3.0])}
    assert two_trees().score(figures, 4).tolist() == [0.5 + 1 + 10, 0.5 + 3 + 10, 0.5 + 4 + 40, 0.5 + 2 + 40]
    assert two_trees().score({"a": figures["a"]}, 4).tolist() == [11.5, 13.5, 13.5, 11.5]  # what is not told is 0


def test_evidence_is_the_mean_of_trees_and_rules():
    figures = {"a": np.array([0.0, 0.0]), "b": np.array([0.0, 0.0]), "rules": np.array([0.25, 0.0])}
    likely = 1 / (1 + np.exp(-11.5))
    assert two_trees().evidence_of(figures, 2) == pytest.approx(np.sqrt([0.25 * likely, 0.02 * likely]))
    assert two_trees().probability(np.array([0.0, 0.25, 0.5, 1.0])) == pytest.approx([0.1, 0.5, 0.9, 0.9])


def test_rules_count_less_and_paint_is_rarer_in_another_light():
    figures, light = {"a": np.zeros(2), "b": np.zeros(2), "rules": np.array([0.25, 0.0])}, KindOfLight(0.5, 0.25)
    likely = 1 / (1 + np.exp(-11.5))
    assert two_trees().evidence_of(figures, 2, light) == pytest.approx(np.sqrt([0.5 * likely, 0.02 ** 0.5 * likely]))
    # odds of 1 to 9, 1 to 1 and 9 to 1, a quarter each
    assert two_trees().probability(np.array([0.0, 0.25, 0.5]), light) == pytest.approx([1 / 37, 1 / 5, 9 / 13])


def test_a_stored_model_is_the_same(tmp_path):
    two_trees().write(tmp_path / "m.npz")
    read = PaintModel.read(tmp_path / "m.npz")
    figures = {"a": np.linspace(-1, 3, 9), "b": np.linspace(4, -4, 9)}
    assert np.array_equal(read.score(figures, 9), two_trees().score(figures, 9)) and read.names == ("a", "b")


def ground_with_stripe(dashed=False):
    """A vertical stripe on ground that is 90 on its left and 130 on its right: image, narrow pixels, ground."""
    image = np.full((420, 420), 90, np.float32)
    image[:, 211:] = 130
    image[:, 209:212] = 200
    if dashed:
        image[np.arange(420) % 50 >= 25, 209:212] = 90
    narrow = image == 200
    clear = np.ones(image.shape, np.uint8)
    clear[:, 207:214] = 0
    return image, narrow, GroundBeside(clear, clear, clear, np.where(clear, image, 100).astype(np.float32), None)


def figures(image, narrow, ground, row=70, column=70):
    bands = np.repeat(np.clip(image, 0, 255).astype(np.uint8)[None], 3, axis=0)
    cells = cells_of(bands, image, narrow, ground, PIXEL, 1.0)
    model = RoadModel(brightness=100.0)
    return {name: float(values[0]) for name, values in figures_at(
        np.array([row]), np.array([column]), cells, model, PIXEL, 10.0).items()}


def test_ground_that_differs_on_both_sides_is_told():
    told = figures(*ground_with_stripe())
    assert told["sided1.5"] == pytest.approx(4.0) and told["lighter1.5"] == pytest.approx(1.3)
    assert told["poorer1.5"] == 1.0 and told["ordered1.1"] > 0.99 and told["inline"] > 0.95
    assert told["inline_elsewhere"] < 0.1 and told["warm2.6"] == 0.0
    image, narrow, ground = ground_with_stripe()
    image[:, 211:][image[:, 211:] == 130] = 90
    assert figures(image, narrow, ground)["sided1.5"] == 0.0


def share_of_road(image, smooth, green, places, colour=True):
    clear = np.ones(image.shape, np.uint8)
    clear[78:87, 150:250] = 0  # a stroke and its rim tell nothing
    ground = GroundBeside(clear, clear, smooth, image, None)
    bands = np.stack([image, image + green, image] if colour else [image]).astype(np.uint8)
    return road_share(np.asarray(places), bands, image, ground, RoadModel(brightness=100.0), PIXEL, 1.0)


def test_what_can_be_a_road_is_smooth_as_bright_and_of_its_colour():
    image, smooth, middle = np.full((420, 420), 100, np.float32), np.ones((420, 420), np.uint8), [81 * 420 + 200]
    assert share_of_road(image, smooth, 0, middle) == 1
    assert share_of_road(image, 0 * smooth, 0, middle) == 0 and share_of_road(image, smooth, 30, middle) == 0
    assert share_of_road(image, smooth, 30, middle, colour=False) == 1
    for level in (40, 185):
        assert share_of_road(np.full_like(image, level), smooth, 0, middle) == 0
    smooth[:, :201] = 0
    assert share_of_road(image, smooth, 0, [200 * 420 + 201, 200 * 420 + 50]) == pytest.approx([0.5, 0], abs=0.03)


def test_the_share_of_road_in_a_part_is_the_same():
    rng = np.random.default_rng(5)
    image = rng.integers(30, 220, (420, 420)).astype(np.float32)
    smooth = np.kron(rng.integers(0, 2, (14, 14)), np.ones((30, 30))).astype(np.uint8)
    whole = share_of_road(image, smooth, 0, [210 * 420 + 210], colour=False)
    part = road_share(np.array([201 * 360 + 180]), image[None, 9:, 30:390].astype(np.uint8), image[9:, 30:390],
                      GroundBeside(np.ones((411, 360), np.uint8), None, smooth[9:, 30:390], None, None),
                      RoadModel(brightness=100.0), PIXEL, 1.0)
    assert part == whole and 0 < whole[0] < 1


def test_dashes_lie_in_line_but_not_all_along():
    whole, dashed = figures(*ground_with_stripe()), figures(*ground_with_stripe(dashed=True), row=67)
    assert 0.3 < dashed["inline"] < 0.8 < whole["inline"] and dashed["narrow2.6"] < whole["narrow2.6"]


def test_sums_over_cells_are_whole_and_those_of_a_part_the_same():
    values = np.random.default_rng(3).integers(0, 4000, (301, 203)).astype(np.float32)
    sums = sums_over(values, 3)
    assert sums[4, 7] == values[12:15, 21:24].sum()
    assert np.array_equal(sums[10:40, 5:50], sums_over(values[30:120, 15:150], 3))


def test_the_model_of_this_release():
    """It is small, its confidence rises with the trees' sum, and it asks for what is told and nothing else."""
    model = paint_model()
    assert FILE.stat().st_size < 500_000 and (np.diff(model.shares) > 0).all() and model.shares[0] >= 0
    image, narrow, ground = ground_with_stripe()
    told = figures(image, narrow, ground)
    own = {"relief", "rules", "paint", "pwarm", "pgreen", "warmer", "plen", "pwid", "pfill", "parea"}
    assert set(model.names) == set(told) | own
    assert model.shares[-1] <= 1
