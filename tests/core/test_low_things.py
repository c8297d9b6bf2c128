"""Bollards and boxes of a made-up street: where they stand, and what is none of them."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.roadmap.objects.object_records import BOLLARD, DOUBTFUL, MEASURED, OTHER
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.settings.roadmap import ObjectSettings


def found_of(tmp_path, *makers, angle=0.0):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=30.0), angle, 1,
                             more=lambda rng: np.concatenate([make(rng) for make in makers]))
    return street_objects([tmp_path / "drive.las"], trajectory, ObjectSettings(survey_sigma=0.0)).objects


def bollard(along, across, top=0.9, lean=(0.0, 0.0)):
    return lambda rng: scene.post(rng, along, across, top, 0.14, lean=lean)


@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_bollards_stand_where_they_are(tmp_path, angle):
    true = np.array([[8.0, 5.0], [9.5, 5.0], [20.0, -6.0]])
    things = found_of(tmp_path, *(bollard(*place) for place in true), angle=angle)
    things = sorted(things, key=lambda thing: to_local(thing.foot[None], angle)[0, 0])
    assert [(thing.kind, thing.status) for thing in things] == [(BOLLARD, MEASURED)] * 3
    feet = np.array([to_local(thing.foot[None], angle)[0] for thing in things])
    assert np.abs(feet[:, :2] - true).max() < 0.04
    assert [thing.height for thing in things] == pytest.approx([0.9] * 3, abs=0.1)
    assert [thing.diameter for thing in things] == pytest.approx([0.14] * 3, abs=0.04)


def test_a_bollard_under_a_crown_is_no_trunk(tmp_path):
    things = found_of(tmp_path, bollard(15.0, 5.0), lambda rng: scene.tree(rng, 16.2, 5.0, trunk=2.4, radius=1.8))
    assert sorted(thing.kind for thing in things) == [BOLLARD, "tree"]
    found, = (one for one in things if one.kind == BOLLARD)
    assert to_local(found.foot[None], 0.0)[0, 0] == pytest.approx(15.0, abs=0.05)


def test_close_things_make_a_bollard_doubtful_unless_it_stands_in_a_row(tmp_path):
    def beside(rng):
        return scene.wall(rng, 11.0, 5.5, 1.2, 1.0)

    alone, = (one for one in found_of(tmp_path, bollard(12.0, 5.0), beside) if one.kind == BOLLARD)
    assert alone.status == DOUBTFUL and "close beside" in alone.reason
    row = [one for one in found_of(tmp_path, bollard(12.0, 5.0), bollard(13.8, 5.0), beside) if one.kind == BOLLARD]
    assert [one.status for one in row] == [MEASURED] * 2
    other = [one for one in found_of(tmp_path, bollard(12.0, 5.0), bollard(13.8, 5.0, 1.2), beside)
             if one.kind == BOLLARD]
    assert sorted(one.status for one in other) == [DOUBTFUL, MEASURED]


@pytest.mark.parametrize("make", [
    lambda rng: scene.post(rng, 15.0, 5.0, 3.0),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.45),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.9, lean=(0.5, 0.0)),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.9, 0.5),
    lambda rng: np.concatenate([scene.post(rng, 15.0, 5.0, 1.3), scene.post(rng, 15.0, 5.0, 3.0, low=1.45)])],
    ids=["post", "stone", "leaning", "thick", "hidden in the middle"])
def test_what_is_no_bollard(tmp_path, make):
    assert not any(thing.kind == BOLLARD for thing in found_of(tmp_path, make))


@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_a_cabinet_is_a_box(tmp_path, angle):
    cabinet, = found_of(tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)), angle=angle)
    assert (cabinet.kind, cabinet.status, cabinet.board) == (OTHER, MEASURED, None)
    assert np.abs(to_local(cabinet.foot[None], angle)[0][:2] - [15.0, 5.5]).max() < 0.05
    assert cabinet.height == pytest.approx(1.3, abs=0.1) and cabinet.diameter == pytest.approx(0.9, abs=0.06)
    # Its longer side runs along the street.
    assert abs((cabinet.azimuth + angle + 90.0) % 180.0 - 90.0) < 4.0


def test_a_box_among_other_things_is_doubtful(tmp_path):
    """Parts of a thinly measured vehicle look like boxes."""
    boxes = [one for one in found_of(
        tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)),
        lambda rng: scene.box(rng, 16.1, 5.5, 0.65, (0.9, 0.4, 1.3))) if one.kind == OTHER]
    assert boxes and {one.status for one in boxes} == {DOUBTFUL}


def test_a_bollard_before_a_cabinet_does_not_hide_it(tmp_path):
    things = found_of(tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)), bollard(15.2, 5.15, 0.8))
    assert any(thing.kind == OTHER and abs(to_local(thing.foot[None], 0.0)[0, 0] - 15.0) < 0.05 for thing in things)


@pytest.mark.parametrize("make", [
    lambda rng: scene.wall(rng, 14.0, 5.0, 1.5, 1.2),
    lambda rng: scene.box(rng, 15.0, 5.5, 0.8, (4.2, 1.7, 1.5)),
    lambda rng: scene.leaves(rng, 15.0, 5.0, 0.7, 0.6, 900.0)], ids=["wall", "car", "bush"])
def test_what_is_no_box(tmp_path, make):
    assert not any(thing.kind == OTHER for thing in found_of(tmp_path, make))
