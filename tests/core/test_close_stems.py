"""Posts that stand so close to a trunk that both pass for one stem."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.roadmap.objects.close_stems import close_stems
from urbanmap_qgis.roadmap.objects.object_records import Stem
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.settings.roadmap import ObjectSettings


def corner_seen(rng, x, y, side, number, low=0.4, high=2.2, noise=0.006):
    """Places (n, 3), m, on the two sides of a square post that a survey from the south east sees."""
    along, up = rng.uniform(-side / 2, side / 2, number), rng.uniform(low, high, number)
    south = rng.random(number) < 0.5
    plan = np.where(south[:, None], np.column_stack([along, np.full(number, -side / 2)]),
                    np.column_stack([np.full(number, side / 2), along]))
    return np.column_stack([plan + [x, y] + noise * rng.standard_normal((number, 2)), up])


def parted(*things):
    place = np.concatenate(things)
    stem = Stem(np.arange(len(place)), float(place[:, 2].min()), float(place[:, 2].max()), 1.0)
    return close_stems(stem, place)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("away", [0.24, 0.3, 0.4])
def test_a_post_beside_a_trunk_is_told_apart(seed, away):
    rng = np.random.default_rng(seed)
    trunk, post = corner_seen(rng, -away, 0.02, 0.25, 300), corner_seen(rng, 0.0, 0.0, 0.08, 80)
    first, second = parted(trunk, post)
    assert (first.beside, second.beside) == (False, True)
    assert np.mean(first.rows < 300) == np.mean(second.rows >= 300) == 1.0
    assert len(second.rows) > 70


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("aside", [0.28, 0.32])
def test_a_sign_close_to_a_trunk_is_found_beside_its_tree(tmp_path, aside, seed):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=34.0), seed=seed,
                             more=lambda rng: np.concatenate(
                                 [scene.post(rng, 16.0, 5.0, 2.7, 0.12),
                                  scene.board(rng, 15.93, 5.0, 2.4, 0.8, 0.6, 0.0),
                                  scene.leafy(rng, 16.0 + aside, 5.1, 60.0, trunk=2.6)]))
    found = street_objects([tmp_path / "drive.las"], trajectory, ObjectSettings(survey_sigma=0.0)).objects
    foot = np.array([to_local(thing.foot[None], 0.0)[0, :2] for thing in found]).reshape(-1, 2)
    # Clusters of leaves may pass for trunks of few points, doubtful: they do so without the sign too.
    sure = [k for k, thing in enumerate(found) if thing.kind != "tree" or thing.status == "measured"]
    at = {found[k].kind: foot[k] for k in sure}
    assert len(sure) == 2 and set(at) == {"sign", "tree"}
    assert np.hypot(*(at["sign"] - [16.0, 5.0])) < 0.05
    assert np.hypot(*(at["tree"] - [16.0 + aside, 5.1])) < 0.1
    board = next(thing.board for thing in found if thing.board is not None)
    assert np.linalg.norm(to_local(board.centre[None], 0.0)[0, :2] - [15.93, 5.0]) < 0.1


@pytest.mark.parametrize("seed", range(5))
def test_stray_points_between_them_do_not_join_them(seed):
    rng = np.random.default_rng(seed)
    twigs = np.column_stack([rng.uniform(-0.2, 0.0, 6), rng.uniform(-0.1, 0.1, 6), rng.uniform(0.4, 2.2, 6)])
    assert len(parted(corner_seen(rng, -0.3, 0.0, 0.25, 300), corner_seen(rng, 0.0, 0.0, 0.08, 80), twigs)) == 2


@pytest.mark.parametrize("seed", range(5))
def test_one_thing_stays_one(seed):
    rng = np.random.default_rng(seed)
    alone = corner_seen(rng, 0.0, 0.0, 0.3, 400)
    assert len(parted(alone)) == 1
    assert len(parted(alone[rng.random(400) < 0.15])) == 1  # seen by few points
    # Its two sides with a gap between them: each is one face alone.
    assert len(parted(alone[np.abs(alone[:, 0] + alone[:, 1]) > 0.04])) == 1
    low = corner_seen(rng, 0.35, 0.0, 0.12, 100, 0.4, 0.9)
    assert len(parted(alone, low)) == 1  # a bollard is no post
    thin = corner_seen(rng, 0.35, 0.0, 0.12, 12)
    assert len(parted(alone, thin)) == 1
