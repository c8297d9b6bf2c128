"""The paper's threshold of the survey's intensities, held against OpenCV's own on an image made plainly."""

import cv2
import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold, plain_marking_points


@pytest.fixture(scope="module")
def road():
    """Points (n, 2) on a road, their brightness (asphalt: 1) and which lie on paint."""
    rng = np.random.default_rng(5)
    at = rng.uniform([-7000.0, -34000.0], [-6980.0, -33988.0], (40_000, 2))
    paint = (np.abs(at[:, 1] + 33994.0) < 0.1) | ((np.abs(at[:, 0] + 6990.0) < 0.25) & (at[:, 1] < -33995))
    return at, np.where(paint, 3.5, 1.0) * rng.lognormal(0, 0.1, len(at)), paint


@pytest.mark.paper("J 3.2.3.3")
def test_the_threshold_is_opencvs_of_21_pixels_and_c_17(road):
    at, brightness, paint = road
    answer = plain_marking_points(*at.T, brightness, 4.0)
    column, row = (np.floor(at / 0.12).astype(int) - np.floor(at.min(axis=0) / 0.12).astype(int) + 30).T
    size = row.max() + 31, column.max() + 31
    image = np.full(size, round(255 / 4.0), np.uint8)
    for r, c in set(zip(row, column)):
        here = (row == r) & (column == c)
        image[r, c] = round(min(brightness[here].mean() * 255 / 4.0, 255))
    plain = cv2.adaptiveThreshold(image, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, 21, -17)
    assert np.mean(answer.paint == (plain[row, column] > 0)) > 0.9999
    assert answer.paint[paint].mean() > 0.8 and answer.paint[~paint].mean() < 0.05
    assert (answer.weight == answer.paint).all() and np.isfinite(answer.contrast[answer.paint]).all()


def test_a_cut_of_the_road_changes_nothing_inside(road):
    at, brightness, _ = road
    settings = PlainThreshold()
    whole = plain_marking_points(*at.T, brightness, 4.0, settings).paint
    near = at[:, 0] < -6990 + settings.reach
    assert (plain_marking_points(*at[near].T, brightness[near], 4.0, settings).paint[at[near, 0] < -6990]
            == whole[at[:, 0] < -6990]).all()


@pytest.mark.paper("J 3.3.3, Table 3-2")
def test_the_block_is_21_pixels_and_nonsense_is_refused():
    assert PlainThreshold().block_pixels == 21 and PlainThreshold(1.2).block_pixels % 2 == 1
    for bad in ({"block_size": 0.1}, {"c": 0.0}):
        with pytest.raises(InputError):
            PlainThreshold(**bad)
    assert not len(plain_marking_points(*np.zeros((3, 0)), 4.0).paint)
