"""Boards of which one half shows: their middles and sizes."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.objects.hanging_parts import outlined_board
from urbanmap_qgis.roadmap.objects.object_records import StemAxis

POST = StemAxis(np.array([0.0, 0.05, 2.0]), np.zeros(2), 0.08, np.zeros(2))


def face(rng, left, right, number, low=1.7, high=2.4):
    """Points on a board that faces south, m."""
    return np.column_stack([rng.uniform(left, right, number), 0.006 * rng.standard_normal(number),
                            rng.uniform(low, high, number)])


def post(rng, number, low=0.4, high=2.4):
    """Points on the side of the post that a survey from the south east sees, m."""
    return np.column_stack([rng.uniform(0.0, 0.04, number), rng.uniform(0.01, 0.09, number),
                            rng.uniform(low, high, number)])


def azimuth(normal):
    return np.degrees(np.arctan2(normal[0], normal[1])) % 180.0


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("few", "whole"), [(4, False), (40, True)])
def test_the_half_that_one_drive_sees_is_a_half_though_another_saw_some_of_the_rest(seed, few, whole):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, 0.1, 0.4, 80), face(rng, -0.25, -0.1, few)])
    board = outlined_board(place, np.array([0.0, 1.0, 0.0]), POST, np.array([8.0, 2.0]))
    assert board.whole == whole
    assert abs(board.centre[0]) < 0.03 if not whole else board.centre[0] > 0.05
    # Not from where the post hides nothing.
    assert outlined_board(place, np.array([0.0, 1.0, 0.0]), POST, np.array([1.0, -8.0])).whole


@pytest.mark.parametrize("seed", range(5))
def test_a_post_that_goes_on_under_its_board_makes_it_no_taller(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, -0.35, 0.35, 120), post(rng, 60, 0.9)])
    found = outlined_board(place, np.array([0.0, 1.0, 0.0]), POST, np.array([1.0, -8.0]))
    assert abs(found.height - 0.7) < 0.1 and abs(found.centre[2] - 2.05) < 0.05  # not 1.5 m
