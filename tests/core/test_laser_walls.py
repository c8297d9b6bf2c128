"""Walls in airborne laser points: a known building scanned from above, also in lines, and facades that a survey saw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.registration.walls.facade_planes import FacadePlanes
from urbanmap_qgis.mobile.registration.walls.laser_walls import laser_walls, step_across
from urbanmap_qgis.mobile.registration.walls.stretches import WallReadings, shifted_stretches
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness

NOISE = 0.1  # m, of a point in plan
WALL = 5.0  # m: the front of the building, which faces south
REPORTED = np.array([0.3, 0.8])  # m, by which the survey is off


def airborne(seed, lines=None, canopy=0.0):
    """Points (n, 3), 7 a m2, of a building 12 m high north of WALL, x from 0 to 30, and the ground before it.

    `lines` : m between scan lines along the wall; `canopy` : m that one 3 m high stands out.
    """
    rng = np.random.default_rng(seed)
    true = rng.uniform([-20.0, -10.0], [50.0, 20.0], (7 * 70 * 30, 2))
    if lines:
        true[:, 1] = lines * np.round(true[:, 1] / lines)
    inside = (true[:, 0] > 0.0) & (true[:, 0] < 30.0)
    z = np.where(inside & (true[:, 1] > WALL), 12.0, np.where(inside & (true[:, 1] > WALL - canopy), 3.0, 0.0))
    return np.column_stack([true + rng.normal(0.0, NOISE, true.shape), z])


def facade(step=0.8):
    """Planes that a survey saw of the front, reported REPORTED off, up to 8 m over the ground."""
    x, z = (part.ravel() for part in np.meshgrid(np.arange(1.0, 29.5, step), np.arange(0.4, 8.0, step)))
    place = np.column_stack([x + REPORTED[0], np.full(len(x), WALL + REPORTED[1]), z])
    normal = np.tile([0.0, -1.0], (len(x), 1))
    return FacadePlanes(x, x, place, np.tile([0.0, 9.0, 2.0], (len(x), 1)), normal, np.tile(np.eye(6), (len(x), 1, 1)))


@pytest.fixture
def cloud(make_cloud, tmp_path):
    """Function that makes a cloud of points (n, 3)."""
    return lambda points: open_cloud([make_cloud(tmp_path / "als.laz", *points.T)])


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("canopy", "lines"), [(0.0, None), (2.0, None), (0.0, 0.5)])
def test_the_wall_is_where_it_is_however_far_off_the_survey_was(cloud, seed, canopy, lines):
    """A canopy before it changes nothing, as it is lower; of lines half a metre apart sigma says so."""
    found = laser_walls(facade(), cloud(airborne(seed, lines, canopy)))
    assert len(found) == 2  # pieces of 16 m at most
    off = found.ends[:, :, 1] - WALL
    assert np.abs(off).max() < (0.5 * lines + 0.1 if lines else 0.08)
    assert (np.abs(off).max(axis=1) < 3.0 * np.hypot(found.sigma, 0.02)).all()
    assert (found.sigma > 0.1).all() if lines else (found.sigma < 0.08).all()
    assert found.outward == pytest.approx(np.tile([0.0, -1.0], (2, 1)))
    assert len(set(found.building)) == 1  # all that face alike share what the strip is off by


def test_a_step_that_is_none_is_not_clear():
    """An even roof, an alley between two roofs a metre apart, and points that lie anyhow."""
    rng = np.random.default_rng(1)
    roof = rng.uniform(-3.0, 3.0, 300)
    assert not step_across(roof, np.zeros(0)).clear
    assert not step_across(roof, rng.uniform(-3.0, 3.0, 300)).clear
    assert step_across(roof[roof < 0.4], rng.uniform(0.4, 3.0, 150)).place == pytest.approx(0.4, abs=0.08)


def test_without_any_wall_it_is_said(cloud):
    level = airborne(1)
    level[:, 2] = 0.0
    with pytest.raises(InsufficientDataError, match="no wall where the survey saw facades"):
        laser_walls(facade(), cloud(level))


def test_walls_of_a_strip_that_is_off_do_not_contradict_markings(cloud):
    """0.25 m are within what a strip may be off by; outlines that are off by as much do contradict."""
    points = airborne(2)
    edges = laser_walls(facade(), cloud(points))
    assert edges.shared == pytest.approx(0.1)
    readings = _readings(0.25, edges.shared), _readings(0.25, 0.04)
    assert [len(shifted_stretches(one, (0.0, 0.1))) for one in readings] == [0, 1]
    assert WallWitness(facade(), edges).matched(lambda at: np.zeros((len(at), 6))).outside == pytest.approx(
        -REPORTED[1], abs=0.1)


def test_a_wall_that_two_surveys_saw_is_one(cloud):
    points, planes = cloud(airborne(1)), facade()
    first = laser_walls(planes, points)
    again = laser_walls(replace(planes, place=planes.place - np.array([0.0, 0.6, 0.0])), points)
    assert again.on(first).all() and not len(again.select(~again.on(first)))
    other = replace(first, ends=first.ends + np.array([0.0, 3.0]))
    assert not other.on(first).any() and not replace(again, outward=-again.outward).on(first).any()


def _readings(off, shared):
    """Walls of both sides of a street and across it, all `off` m east of where the markings have them."""
    chainage = np.arange(0.0, 200.0, 4.0)
    outward = np.array([[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]])[np.arange(len(chainage)) % 4]
    return WallReadings(chainage, outward, off * outward[:, 0], np.full(len(chainage), 0.05), shared)
