"""Boards of few points at thin posts among leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.test_half_boards import POST, azimuth, face, post
from urbanmap_qgis.roadmap.objects.crown_boards import face_in_crown
from urbanmap_qgis.roadmap.objects.hanging_parts import HangingParts, outlined_board
from urbanmap_qgis.roadmap.objects.street_objects import _with_board
from urbanmap_qgis.roadmap.objects.thin_boards import face_of_few

SEEN_FROM = np.array([1.0, -8.0])


def leaves(rng, number):
    return rng.uniform([-1.0, -1.0, 1.6], [1.0, 1.0, 3.0], (number, 3))


@pytest.mark.parametrize("seed", range(10))
def test_a_board_of_few_points_anywhere_on_it_is_found_among_leaves(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, -0.4, 0.4, 40), post(rng, 60), leaves(rng, 150)])
    rows, normal = face_of_few(place, POST, SEEN_FROM)
    assert abs((azimuth(normal) + 90.0) % 180.0 - 90.0) < 4.0
    found = outlined_board(place[rows], normal, POST, SEEN_FROM)
    assert np.linalg.norm(found.centre - [0.0, 0.0, 2.05]) < 0.15
    assert abs(found.width - 0.8) < 0.3 and abs(found.height - 0.7) < 0.3


def test_fewer_points_tell_it_than_full_cells_do():
    few, full = 0, 0
    for seed in range(20):
        rng = np.random.default_rng(seed)
        place = np.concatenate([face(rng, -0.4, 0.4, 24), post(rng, 60), leaves(rng, 150)])
        few += face_of_few(place, POST, SEEN_FROM) is not None
        full += face_in_crown(place, POST) is not None
    assert few >= 15 > full


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("number", [100, 800, 5000])
def test_leaves_alone_make_no_board(seed, number):
    rng = np.random.default_rng(seed)
    assert face_of_few(np.concatenate([post(rng, 60), leaves(rng, number)]), POST, SEEN_FROM) is None


@pytest.mark.parametrize("seed", range(5))
def test_a_wall_a_trunk_and_a_plane_of_the_scanner_are_no_boards(seed):
    rng = np.random.default_rng(seed)
    board, about = face(rng, -0.4, 0.4, 40), [post(rng, 60), leaves(rng, 150)]
    assert face_of_few(np.concatenate([face(rng, -1.0, 1.0, 200, 1.0, 3.0), *about]), POST, SEEN_FROM) is None
    assert face_of_few(np.concatenate([board, *about]), replace(POST, diameter=0.2), SEEN_FROM) is None
    assert face_of_few(np.concatenate([board, *about]), POST, np.array([8.0, 0.1])) is None


@pytest.mark.parametrize("seed", range(5))
def test_a_post_that_goes_on_under_its_board_makes_it_no_taller(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([face(rng, -0.35, 0.35, 120), post(rng, 60, 0.9)])
    found = outlined_board(place, np.array([0.0, 1.0, 0.0]), POST, SEEN_FROM)
    assert abs(found.height - 0.7) < 0.1 and abs(found.centre[2] - 2.05) < 0.05  # not 1.5 m


@pytest.mark.parametrize(("reach", "kept"), [(0.4, True), (1.5, False)])
def test_what_goes_on_beyond_a_board_in_leaves_is_a_wall(reach, kept):
    rng = np.random.default_rng(1)
    board = outlined_board(face(rng, -0.4, 0.4, 60), np.array([0.0, 1.0, 0.0]), POST, SEEN_FROM)
    around = HangingParts(4.0, 3.0, board, 0.0, np.nan, np.nan, (0.0, 0.0))
    place = np.concatenate([face(rng, -reach, reach, int(150 * reach)), post(rng, 60), leaves(rng, 100)])
    assert (_with_board(around, [], POST, False, place).board is not None) == kept
