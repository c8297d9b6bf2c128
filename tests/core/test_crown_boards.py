"""Signs that stand in the crowns of trees."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.settings.roadmap import ObjectSettings


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
