"""Boards of which one half shows: their middles and sizes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.roadmap.objects.boards import outlined_board
from urbanmap_qgis.roadmap.objects.lone_boards import lone_boards
from urbanmap_qgis.roadmap.objects.object_city import furniture_objects
from urbanmap_qgis.roadmap.objects.object_records import StemAxis
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.roadmap.objects.sweep_index import SweepIndex
from urbanmap_qgis.settings.roadmap import ObjectSettings

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


# Boards of signs whose posts do not show: found by their faces, and what is no board is left out


VIEW = np.array([0.0, 0.0])


def boards_of(place):
    return lone_boards(place, place[:, 2], SweepIndex(place[:, :2]), np.broadcast_to(VIEW, (len(place), 2)),
                       np.ones(len(place), bool))


@pytest.mark.parametrize("turned", [0.0, 35.0, -60.0])
def test_a_board_without_its_post_is_a_doubtful_sign(tmp_path, turned):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=30.0),
                             more=lambda rng: scene.board(rng, 15.0, 5.0, 2.4, 0.8, 0.6, turned))
    sign, = street_objects([tmp_path / "drive.las"], trajectory, ObjectSettings(survey_sigma=0.0)).objects
    assert (sign.kind, sign.status, sign.reason) == ("sign", "doubtful", "its post is not seen")
    assert sign.diameter is None and sign.lean is None and sign.confidence < 0.5
    assert np.abs(to_local(sign.board.centre[None], 0.0)[0] - [15.0, 5.0, 2.4]).max() < 0.05
    behind = sign.foot[:2] - sign.board.centre[:2]
    azimuth = np.radians(sign.azimuth)
    assert behind == pytest.approx([-0.04 * np.sin(azimuth), -0.04 * np.cos(azimuth)])
    assert (sign.board.width, sign.board.height) == pytest.approx((0.8, 0.6), abs=0.08)
    # The post stands somewhere behind the board: that is what its sigma says, not the accuracy of the board.
    assert 0.15 < sign.sigma < 0.3
    city, = furniture_objects([sign])
    board, = [shape for shape in city.shapes if shape.lod == "2"]
    assert sum(map(len, board.shells)) == 2  # both faces, and no post that nobody saw


def test_a_board_between_leaves_is_found():
    rng = np.random.default_rng(4)
    place = np.concatenate([scene.leaves(rng, 6.0, 5.0, 3.0, 1.6, 120.0),
                            scene.board(rng, 6.2, 5.1, 2.6, 0.8, 0.6, 0.0)])
    found = boards_of(place)
    assert len(found) == 1 and np.linalg.norm(found[0].centre - [6.2, 5.1, 2.6]) < 0.12


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_walls_trunks_leaves_and_vehicles_are_no_boards(seed):
    rng = np.random.default_rng(seed)
    place = np.concatenate([
        scene.wall(rng, 0.0, 9.0, 25.0), scene.leafy(rng, 4.0, 5.0, 120.0), scene.post(rng, 9.0, 5.0, 5.0, 0.5),
        scene.box(rng, 16.0, 4.0, 1.6, (6.0, 2.2, 3.2))])
    assert not boards_of(place[place[:, 2] > 0.3])


# Signs that stand in the crowns of trees


def found_of(tmp_path, *makers, seed=1):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=34.0), seed=seed,
                             more=lambda rng: np.concatenate([make(rng) for make in makers]))
    found = street_objects([tmp_path / "drive.las"], trajectory, ObjectSettings(survey_sigma=0.0)).objects
    return [(thing, to_local(thing.foot[None], 0.0)[0]) for thing in found]


@pytest.mark.parametrize("turned, width, aside, density", [(0.0, 0.8, 1.2, 60.0), (20.0, 0.8, 0.8, 200.0),
                                                           (-30.0, 0.6, 1.5, 200.0), (10.0, 0.9, -0.9, 120.0)])
def test_a_sign_in_a_crown_is_a_sign_and_marked(tmp_path, turned, width, aside, density):
    found = found_of(tmp_path, lambda rng: scene.sign(rng, 16.0, 5.0, width, 0.6, turned),
                     lambda rng: scene.leafy(rng, 16.0 + aside, 5.4, density))
    (sign, foot), = [(thing, foot) for thing, foot in found if thing.kind == "sign"]
    assert np.abs(foot[:2] - [16.0, 5.0]).max() < 0.03 and sign.crown is None
    assert sign.height == pytest.approx(2.7, abs=0.15)  # not the tree's
    assert np.abs(to_local(sign.board.centre[None], 0.0)[0] - [15.95, 5.0, 2.4]).max() < 0.08
    assert sign.board.width == pytest.approx(width, abs=0.12)
    assert abs((sign.azimuth - (90.0 - turned) + 90.0) % 180.0 - 90.0) < 5.0
    assert (sign.status, sign.reason) == ("doubtful", "it stands in the crown of a tree")
    assert any(thing.kind == "tree" and np.hypot(*(foot[:2] - [16.0 + aside, 5.4])) < 0.1 for thing, foot in found)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_leaves_trunks_and_posts_in_crowns_are_no_signs(tmp_path, seed):
    found = found_of(tmp_path, lambda rng: scene.leafy(rng, 6.0, 5.0, 60.0),
                     lambda rng: scene.leafy(rng, 14.0, 5.5, 250.0),
                     lambda rng: scene.leafy(rng, 22.0, -5.5, 120.0, 2.0, 1.4),
                     lambda rng: scene.leafy(rng, 29.2, 5.3, 120.0), lambda rng: scene.post(rng, 28.0, 5.0, 8.0, 0.16),
                     seed=seed)
    assert "sign" not in {thing.kind for thing, _ in found}
    assert sum(thing.kind == "tree" and thing.status == "measured" for thing, _ in found) >= 4
