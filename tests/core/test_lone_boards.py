"""Boards of signs whose posts do not show: found by their faces, and what is no board is left out."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.roadmap.objects.lone_boards import lone_boards
from urbanmap_qgis.roadmap.objects.object_city import furniture_objects
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.roadmap.objects.sweep_index import SweepIndex
from urbanmap_qgis.settings.roadmap import ObjectSettings

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
