"""Walls across the street tell the pitch by standing upright."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.simulated_windows import simulate
from tests.core.test_second_witness import adjusted, street
from urbanmap_qgis.estimation.normal_equations import PLANE, SPACE
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.trajectory_stops import path_parameters_of
from urbanmap_qgis.mobile.registration.walls.facade_planes import facade_planes
from urbanmap_qgis.mobile.registration.walls.upright_walls import UprightWalls
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness
from urbanmap_qgis.mobile.trajectory import Trajectory, move_points, path_chainage

RISE = -2.2
"""m that the vehicle drives while the scan of a wall ahead rises by a metre: it looks 24 degrees upwards."""


def drive(pitch=0.0, drift=0.0):
    """True and reported trajectory to the east: nose up by `pitch` degrees, ahead by `drift` m each metre driven."""
    time = 1000.0 + np.arange(0.0, 30.0, 0.05)
    x = 10.0 * (time - 1000.0)
    true = np.column_stack([x, np.zeros(len(x)), np.full(len(x), 2.0)])
    angles = np.tile([0.0, 0.0, 90.0], (len(x), 1))
    return (Trajectory(time, true, angles),
            Trajectory(time, true + drift * np.column_stack([x, 0 * x, 0 * x]), angles + np.array([0.0, pitch, 0.0])))


def scanned(true, lean=0.0):
    """Points of walls across at every 40 m, degrees off plumb by `lean`, and the times at which a scanner meets them.
    """
    rng = np.random.default_rng(2)
    points = []
    for at in np.arange(40.3, 290.0, 40.0):
        y, z = (part.ravel() for part in np.meshgrid(np.arange(3.0, 9.0, 0.1), np.arange(2.0, 10.0, 0.1)))
        x = at + z * np.tan(np.radians(lean)) + rng.normal(0.0, 0.002, len(y))
        points.append(np.column_stack([x, y, z]))
    points = np.concatenate(points)
    time = np.interp(points[:, 0] - 2.0 + RISE * (points[:, 2] - 2.0), true.place[:, 0], true.time)
    order = np.argsort(time, kind="stable")
    return points[order], time[order]


@pytest.fixture
def seen(make_cloud, tmp_path):
    """Function that gives the facades of a drive as reported, and path parameters of it."""
    def look(true, reported, lean=0.0):
        points, time = scanned(true, lean)
        place = move_points(points, time, true, reported)
        cloud = open_cloud([make_cloud(tmp_path / "survey.laz", *place.T, gps_time=time)])
        return facade_planes(cloud, reported, reported.place[:, 0])
    return look


def found_pitch(planes, curve, active=SPACE):
    """Degrees, by the walls alone, roll as it is."""
    observations = UprightWalls.among(planes).about(curve, active)
    rate = observations.rate[:, list(active).index(4)]
    return float((rate * observations.target * observations.weight).sum() / (rate**2 * observations.weight).sum())


def unchanged(path_parameter):
    """No correction."""
    return np.zeros((len(path_parameter), 6))


@pytest.mark.parametrize("pitch", [0.0, 0.12, -0.3])
def test_a_wall_across_the_street_shows_the_pitch(seen, pitch):
    true, reported = drive(pitch)
    planes = seen(true, reported)
    assert np.median(planes.sweep) == pytest.approx(RISE, abs=0.05)
    assert found_pitch(planes, unchanged) == pytest.approx(-pitch, abs=0.02)


def test_what_the_trajectory_drifts_while_a_wall_is_scanned_is_no_pitch(seen):
    true, reported = drive(0.1, drift=0.003)
    planes = seen(true, reported)

    def known(path_parameter):
        change = np.zeros((len(path_parameter), 6))
        change[:, 0] = -0.003 / 1.003 * path_parameter
        return change

    assert abs(found_pitch(planes, unchanged) + 0.1) > 0.2  # 3 mm a metre over 2.2 m a metre of height
    assert found_pitch(planes, known) == pytest.approx(-0.1, abs=0.02)


def test_walls_off_plumb_count_by_how_they_differ(seen):
    """Of walls that lean all alike nobody can tell the pitch; of those that do not, each is one witness."""
    true, reported = drive()
    planes = seen(true, reported)
    upright = UprightWalls.among(planes)
    rng = np.random.default_rng(5)
    lean = np.radians(rng.normal(0.0, 0.4, upright.wall.max() + 1))[upright.wall]
    differing = replace(upright, planes=replace(upright.planes, tilt=upright.planes.tilt + lean))
    sure, unsure = (1 / np.sqrt((item.rate[:, 4] ** 2 * item.weight).sum())
                    for item in (each.about(unchanged, SPACE) for each in (upright, differing)))
    assert 0.02 < sure < 0.06 and unsure > 2 * sure
    count = np.bincount(upright.wall)
    assert unsure > 0.4 / np.sqrt(len(count)) / 2  # not by the square root of the planes' number


def test_walls_along_the_street_say_nothing_of_the_pitch(seen):
    true, reported = drive()
    planes = seen(true, reported)
    turned = replace(planes, normal=planes.normal[:, ::-1])
    assert UprightWalls.among(turned) is None
    assert UprightWalls.among(replace(planes, tilt=None, sweep=None)) is None  # kerbs do not stand upright
    assert UprightWalls.among(planes.select(np.zeros(len(planes), bool))) is None


def test_a_few_planes_are_no_wall(seen):
    true, reported = drive()
    planes = seen(true, reported)
    assert UprightWalls.among(planes.select(np.arange(5))) is None


def leaning_walls(made):
    """Walls across every 20 m of a drive, which lean as its pitch is off and by 0.2 degrees a plane."""
    planes, _ = street(made)
    across = planes.select(np.abs(planes.normal[:, 0]) > 0.9)
    way = path_chainage(made.reported)
    along = path_parameters_of(made.reported, CorrectionSettings().time_weight)
    at = (across.chainage[:, None] + np.arange(0.0, 80.0, 20.0)).ravel()
    more = across.select(np.repeat(np.arange(len(across)), 4))
    place = more.place + (at - more.chainage)[:, None] * np.array([1.0, 0.0, 0.0])
    more = replace(more, place=place, chainage=at, path_parameter=np.interp(at, way, along))
    planes = more.select(np.argsort(at, kind="stable")).select(np.sort(at) < way[-1])
    pitch = np.interp(planes.chainage, made.windows.chainage, made.error[:, 4])
    east, north = planes.normal.T
    rate = north * planes.back[:, 3, 4] - east * planes.back[:, 4, 4]
    noise = np.radians(0.2) * np.random.default_rng(8).normal(size=len(planes))
    return WallWitness(replace(planes, tilt=noise - rate * pitch, sweep=np.zeros(len(planes))))


def test_the_correction_takes_the_pitch_from_walls():
    made = simulate(7, length=400.0, turn=None, crossings=25.0, three_d=True)
    flat = replace(made.windows, information=without_pitch(made.windows.information),
                   gradient=made.windows.gradient * [1, 1, 1, 1, 0, 1])
    made = replace(made, windows=flat)
    before, after = adjusted(made), adjusted(made, leaning_walls(made))
    off = [np.abs(item.value[:, 4] - made.error[:, 4]) for item in (before, after)]
    assert off[1].mean() < 0.6 * off[0].mean()
    assert (off[1] < 2 * after.sigma()[:, 4]).mean() > 0.9
    assert np.median(after.sigma()[:, 4]) < 0.8 * np.median(before.sigma()[:, 4])
    assert np.hypot(*(after.value - made.error)[:, :2].T).mean() < 0.02


def without_pitch(information):
    """(n, 6, 6) that say nothing of the pitch."""
    kept = np.diag([1.0, 1.0, 1.0, 1.0, 0.0, 1.0])
    return kept @ information @ kept


def test_in_plan_the_pitch_stays():
    made = simulate(7, length=200.0, turn=None, crossings=25.0)
    assert not adjusted(made, leaning_walls(made)).value[:, 4].any()
    assert 4 not in PLANE
