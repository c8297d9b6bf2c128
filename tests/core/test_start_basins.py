"""Where searches end that start beside the true place, on hills drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.localisation.map_aliases import STEP
from urbanmap_qgis.localisation.simulation.prediction_check import area_under_roc
from urbanmap_qgis.localisation.start_basins import share_elsewhere

MOST = 20


def hills(*tops):
    """Cones (2 MOST + 1 square) with tops at (east, north), m, of given heights, falling 1 a metre."""
    east, north = np.meshgrid(*[np.arange(-MOST, MOST + 1) * STEP] * 2)
    return np.max([height - np.hypot(east - x, north - y) for x, y, height in tops], axis=0)


def test_single_hill_draws_every_start():
    assert share_elsewhere(hills((0, 0, 9)), 1.0) == 0.0
    assert share_elsewhere(hills((0.5, -0.5, 9)), 1.0) == 0.0  # a map that is a little off


def test_second_hill_draws_the_starts_on_its_side_of_the_valley():
    """The valley runs along east = 1.75 m, as high tops as these are: starts beyond it are drawn away."""
    from scipy.stats import norm

    found = share_elsewhere(hills((0, 0, 9), (3.5, 0, 9)), 1.0)
    assert found == pytest.approx(norm.sf(1.75), abs=0.005)
    assert share_elsewhere(hills((0, 0, 9), (3.5, 0, 9)), 2.0) > 4 * found
    # A lower hill draws fewer, one beyond all starts none.
    assert share_elsewhere(hills((0, 0, 9), (3.5, 0, 7.5)), 1.0) < found / 2
    assert share_elsewhere(hills((0, 0, 9), (9.0, 0, 9)), 1.0) < 1e-3


def test_place_that_is_on_the_slope_of_another_is_left_by_all():
    assert share_elsewhere(hills((3.0, 0, 9)), 0.5) == pytest.approx(1.0)


def test_what_tells_nothing_has_no_share():
    assert np.isnan(share_elsewhere(np.zeros((41, 41)), 1.0))
    assert np.isnan(share_elsewhere(hills((0, 0, 9))[18:23, 18:23], 2.0))


def test_area_under_the_curve_is_the_share_of_pairs_in_order():
    score, event = np.array([0.1, 0.4, 0.4, 0.8]), np.array([False, True, False, True])
    assert area_under_roc(score, event) == pytest.approx((1 + 0.5 + 2) / 4)
    assert np.isnan(area_under_roc(score, np.zeros(4, bool))) and np.isnan(area_under_roc(score, np.ones(4, bool)))
