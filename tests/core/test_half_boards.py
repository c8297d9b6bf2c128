"""Boards of which one half shows, or few points: their planes, middles and sizes."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.objects.crown_boards import face_in_crown, plane_beside_post
from urbanmap_qgis.roadmap.objects.hanging_parts import HangingParts, outlined_board
from urbanmap_qgis.roadmap.objects.object_records import StemAxis
from urbanmap_qgis.roadmap.objects.street_objects import _with_board

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
def test_the_post_does_not_turn_the_half_of_its_board(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, 0.1, 0.4, 30), post(rng, 30, 1.7)])
    normal = plane_beside_post(place, place[:, :2] - POST.middle[:2])[1]
    assert abs((azimuth(normal) + 90.0) % 180.0 - 90.0) < 3.0
    bare = np.linalg.eigh(np.cov(place.T))[1][:, 0]
    assert abs((azimuth(bare) + 90.0) % 180.0 - 90.0) > 5.0  # with its post


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
def test_a_board_of_few_points_among_leaves_is_found_whole(seed):
    rng = np.random.default_rng(seed)
    cells = np.stack(np.meshgrid(np.arange(5), np.arange(5)), axis=-1).reshape(-1, 2)
    flat = (cells + rng.uniform(0.35, 0.65, cells.shape)) / 5.0
    board = np.column_stack([0.8 * flat[:, 0] - 0.4, 0.006 * rng.standard_normal(25), 1.7 + 0.7 * flat[:, 1]])
    leaves = rng.uniform([-1.0, -1.0, 1.6], [1.0, 1.0, 3.0], (60, 3))
    place = np.concatenate([board, post(rng, 60), leaves])
    rows, normal = face_in_crown(place, POST)
    assert abs((azimuth(normal) + 90.0) % 180.0 - 90.0) < 4.0
    found = outlined_board(place[rows], normal, POST, np.array([1.0, -8.0]))
    assert np.linalg.norm(found.centre - [0.0, 0.0, 2.05]) < 0.1


@pytest.mark.parametrize("seed", range(10))
def test_leaves_alone_make_no_board(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([post(rng, 60), rng.uniform([-1.0, -1.0, 1.6], [1.0, 1.0, 3.0], (800, 3))])
    assert face_in_crown(place, POST) is None


@pytest.mark.parametrize("seed", range(5))
def test_a_post_that_goes_on_under_its_board_makes_it_no_taller(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, -0.35, 0.35, 120), post(rng, 60, 0.9)])
    found = outlined_board(place, np.array([0.0, 1.0, 0.0]), POST, np.array([1.0, -8.0]))
    assert abs(found.height - 0.7) < 0.1 and abs(found.centre[2] - 2.05) < 0.05  # not 1.5 m


@pytest.mark.parametrize(("reach", "kept"), [(0.4, True), (1.5, False)])
def test_what_goes_on_beyond_a_board_in_leaves_is_a_wall(reach, kept):
    rng = np.random.default_rng(1)
    board = outlined_board(face(rng, -0.4, 0.4, 60), np.array([0.0, 1.0, 0.0]), POST, np.array([1.0, -8.0]))
    around = HangingParts(4.0, 3.0, board, 0.0, np.nan, np.nan, (0.0, 0.0))
    leaves = rng.uniform([-1.0, -1.0, 1.6], [1.0, 1.0, 3.0], (100, 3))
    place = np.concatenate([face(rng, -reach, reach, int(150 * reach)), post(rng, 60), leaves])
    assert (_with_board(around, [], POST, False, place).board is not None) == kept
