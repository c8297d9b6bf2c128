"""Road markings in labelled photographs; the labels are here, the photographs are not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from scripts.score_markings import (
    HELD_BACK,
    LABELS,
    PHOTOGRAPHS,
    SUNLIT,
    Labels,
    lanes_above_chance,
    read_labels,
    score,
    score_of,
    total,
)

AERIAL = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "aerial"
here = pytest.mark.skipif(not AERIAL.is_dir(), reason="../shared/data/aerial is not there")


@pytest.mark.parametrize("name", [*PHOTOGRAPHS, *SUNLIT, *HELD_BACK])
def test_labels_lie_where_all_is_labelled(name):
    labels = read_labels(LABELS / f"{name}.geojson")
    markings = np.array(labels.markings)
    assert len(markings) > 10 and shapely.is_valid(labels.area)
    inside = shapely.area(shapely.intersection(markings, shapely.buffer(shapely.convex_hull(labels.area), 1)))
    assert inside.sum() > 0.98 * shapely.area(markings).sum()


def test_score_of_drawn_paint():
    """A line of 20 m2 of which half is found, finds 0.1 to 0.3 m beside it and one far off, at two confidences."""
    labels = Labels("", 0.1, shapely.box(-1, -1, 400, 400), [shapely.box(-0.5, 99.5, 399.5, 104.5)])
    mask, confidence = np.zeros((400, 400), bool), np.full((400, 400), 0.9)
    mask[100:105, :200] = True
    mask[97:100, :100] = True
    mask[300:310, :100] = True
    confidence[300:] = 0.3
    made = score_of(mask, confidence, labels)
    assert made.found == pytest.approx(23) and made.right == pytest.approx(13) and made.painted == pytest.approx(20)
    assert made.recall == pytest.approx(0.5, abs=0.01) and made.precision == pytest.approx(13 / 23)
    assert made.classes[:, 0].tolist() == pytest.approx([0, 10, 0, 0, 13])
    assert total([made, made]).found == pytest.approx(46) and total([made, made]).recall == made.recall


def test_lanes_with_a_find_are_compared_with_chance():
    """Half of a lane has a line beside it, which is near to 2.7 % of the image; then there are lines all over it."""
    lanes, mask = np.zeros((1000, 1000), bool), np.zeros((1000, 1000), bool)
    lanes[500] = mask[510, :500] = True
    assert lanes_above_chance(mask, lanes, 0.1) == pytest.approx((0.52 - 0.027) / (1 - 0.027), abs=0.02)
    mask[510], mask[:, ::104] = False, True
    assert lanes_above_chance(mask, lanes, 0.1) == pytest.approx(0, abs=0.01)  # half of any line is near


@here
@pytest.mark.parametrize(("name", "roads", "least"), [
    ("drift_c", False, 0.95), ("uav_markings_1", False, 0.97), ("sind", False, 0.82),
    ("drift_c", True, 0.93), ("sind", True, 0.86)])
def test_real_photograph(name, roads, least, tmp_path):
    assert score(read_labels(LABELS / f"{name}.geojson"), AERIAL, roads, tmp_path).f1 > least


@here
@pytest.mark.parametrize(("name", "precision", "recall"), [("us_0", 0.81, 0.6), ("us_12", 0.71, 0.45)])
def test_sunlit_tile(name, precision, recall, tmp_path):
    made = score(read_labels(LABELS / f"{name}.geojson"), AERIAL, False, tmp_path)
    assert made.precision > precision and made.recall > recall
