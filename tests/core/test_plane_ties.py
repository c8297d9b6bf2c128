"""Ties by planes between two made drives, and steps of a drive as its ties show them."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.mobile.adjustment.network import NONE, PLANE, TIE, NetworkObservations, plan_residuals
from urbanmap_qgis.mobile.adjustment.plane_observations import plane_observations
from urbanmap_qgis.mobile.adjustment.planes import DrivePlanes, plane_ties, planes_of
from urbanmap_qgis.mobile.adjustment.records import AdjustmentRun
from urbanmap_qgis.mobile.adjustment.steps import away_from_steps, observed_steps
from urbanmap_qgis.mobile.adjustment.ties import Drive
from urbanmap_qgis.mobile.boresight.plane_patches import PlanePatches
from urbanmap_qgis.mobile.registration.trajectory_stops import path_parameters_of, stilled
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import SILENT

LENGTH = 60.0


def drive(start, backwards=False):
    """A drive along x at 10 m/s, as it truly was."""
    time = start + np.linspace(0.0, LENGTH / 10, 121)
    x = np.linspace(0.0, LENGTH, 121)
    x, heading = (x[::-1], 270.0) if backwards else (x, 90.0)
    return Trajectory(time, np.column_stack([x, np.full(121, 2.0 if backwards else -2.0), np.full(121, 2.0)]),
                      np.tile([0.0, 0.0, heading], (121, 1)))


def street(rng, ends, n=400_000):
    """Points of a road, two facades along it and, where `ends`, of walls across."""
    x, y, z = rng.uniform(0, LENGTH, n), rng.uniform(-8, 8, n), rng.uniform(0, 6, n)
    kind = rng.integers(0, 4 if ends else 3, n)
    y = np.where(kind == 1, -8.0, np.where(kind == 2, 8.0, y))
    z = np.where(kind == 0, 0.0, z)
    x = np.where(kind == 3, np.round(x / 15) * 15 + 3.0, x)
    y = np.where(kind == 3, np.where(rng.random(n) < 0.5, -1, 1) * rng.uniform(6, 8, n), y)
    return np.column_stack([x, y, z]) + rng.normal(0, 0.005, (n, 3))


def survey(make_cloud, folder, name, true, shift, ends, seed):
    """A cloud placed by a trajectory that is off by a shift, and that trajectory."""
    rng = np.random.default_rng(seed)
    points = street(rng, ends)
    at = np.argsort(true.place[:, 0])
    time = np.interp(points[:, 0], true.place[at, 0], true.time[at])
    path = make_cloud(folder / f"{name}.laz", *(points + shift).T, gps_time=time)
    return path, Trajectory(true.time, true.place + shift, true.angles)


@pytest.mark.slow
@pytest.mark.parametrize("ends", [True, False])
def test_planes_say_how_far_drives_lie_apart(make_cloud, tmp_path, ends):
    shift = np.array([[0.05, 0.06, -0.04], [-0.06, -0.05, 0.05]])
    made = [survey(make_cloud, tmp_path, f"d{k}", drive(100.0 + 100 * k, bool(k)), shift[k], ends, k) for k in (0, 1)]
    paths, reported = zip(*made)
    found = plane_ties(planes_of([[path] for path in paths], reported), reported, reported, 0.1)
    assert len(found) >= 5 and (found.kind == PLANE).all() and set(found.drive.tolist()) == {0}
    wanted = shift[1] - shift[0]  # by so much the first must move more
    off = found.value[:, :3] - wanted
    assert np.abs(off[:, 1]).max() < 0.02 and np.abs(off[:, 2]).max() < 0.01 and np.isnan(found.value[:, 3]).all()
    sigma = np.sqrt(found.covariance[:, [0, 1, 2], [0, 1, 2]])
    assert sigma[:, 1].max() < 0.04 and sigma[:, 2].max() < 0.02
    if ends:
        assert np.median(np.abs(off[:, 0])) < 0.03 and np.median(sigma[:, 0]) < 0.05
    else:
        assert sigma[:, 0].min() > 0.2  # nothing is seen along a street of even walls
    residual = np.column_stack([np.full(len(found), 0.5), np.full(len(found), 0.01), *np.zeros((2, len(found)))])
    if not ends:
        assert plan_residuals(found, residual) == pytest.approx(np.full(len(found), 0.01), abs=0.02)


@pytest.mark.slow
def test_ties_that_are_adjusted_already_say_the_same(make_cloud, tmp_path):
    shift = np.array([[0.8, 0.5, 0.3], [-0.7, -0.6, -0.2]])
    true = [drive(100.0), drive(200.0, True)]
    made = [survey(make_cloud, tmp_path, f"d{k}", true[k], shift[k], True, k) for k in (0, 1)]
    paths, reported = zip(*made)
    planes = planes_of([[path] for path in paths], reported)
    found = plane_ties(planes, reported, true, 0.1)
    assert len(found) >= 5
    assert np.median(np.abs(found.value[:, :3] - (shift[1] - shift[0])), axis=0) == pytest.approx(np.zeros(3), abs=0.02)


@pytest.mark.slow
def test_drives_that_share_no_markings_are_brought_together_by_planes(make_cloud, tmp_path):
    """As reported they lie a metre and a half apart. Along the street one wall looks like the next: nothing is said."""
    shift = np.array([[0.9, 0.8, 0.3], [-0.6, -0.7, -0.2]])
    true = [drive(100.0), drive(200.0, True)]
    made = [survey(make_cloud, tmp_path, f"d{k}", true[k], shift[k], True, k) for k in (0, 1)]
    paths, reported = zip(*made)
    drives = [Drive(f"d{k}", trajectory, None) for k, trajectory in enumerate(reported)]
    found = plane_observations([[path] for path in paths], drives, NetworkObservations.none(), AdjustmentRun(), SILENT)
    off = found.value[:, :3] - (shift[1] - shift[0])
    assert len(found) >= 5
    assert np.abs(off[:, 1]).max() < 0.05 and np.abs(off[:, 2]).max() < 0.05
    sigma = np.sqrt(found.covariance[:, [0, 1, 2], [0, 1, 2]])
    assert sigma[:, 0].min() > 5.0 and sigma[:, 1].max() < 0.1 and sigma[:, 2].max() < 0.05


@pytest.mark.slow
def test_roads_tie_the_heights_of_drives_that_walls_have_placed(make_cloud, tmp_path):
    """Walls put both where they are in plan; in height they lie 0.8 m apart still."""
    shift = np.array([[0.9, 0.8, 0.5], [-0.6, -0.7, -0.3]])
    true = [drive(100.0), drive(200.0, True)]
    made = [survey(make_cloud, tmp_path, f"d{k}", true[k], shift[k], True, k) for k in (0, 1)]
    paths, reported = zip(*made)
    drives = [Drive(f"d{k}", trajectory, None) for k, trajectory in enumerate(reported)]
    placed = [Trajectory(one.time, one.place + np.array([0.0, 0.0, up]), one.angles)
              for one, up in zip(true, shift[:, 2])]
    found = plane_observations([[path] for path in paths], drives, NetworkObservations.none(), AdjustmentRun(), SILENT,
                               placed)
    off = found.value[:, :3] - (shift[1] - shift[0])
    assert len(found) >= 5
    assert np.abs(off[:, 1]).max() < 0.05 and np.abs(off[:, 2]).max() < 0.05
    assert np.median(np.abs(off[:, 0])) < 0.05  # placed already, the walls across the street count too


def ties(value, number=0, other=1):
    n = len(value)
    parameter, none = 10.0 * np.arange(n), np.zeros((n, 2))
    value = np.column_stack([value, np.zeros((n, 2))])
    return NetworkObservations(np.full(n, number), parameter, none, np.full(n, other), parameter[::-1], none, value,
                               np.tile(np.eye(4) * 1e-4, (n, 1, 1)), np.full(n, TIE))


def test_a_step_is_seen_where_it_is_and_drift_is_none():
    nodes = np.arange(0.0, 301.0, 5.0)
    parameter = 10.0 * np.arange(31)
    drift = np.column_stack([0.5 * np.sin(parameter / 80), 0.3 * np.cos(parameter / 90)])
    assert not observed_steps(ties(drift), 0, nodes).any()
    stepped = ties(drift + 2.0 * (parameter > 145)[:, None])
    found = observed_steps(stepped, 0, nodes)
    middle = 0.5 * (nodes[1:] + nodes[:-1])
    assert found.any() and (np.abs(middle[found > 0] - 145) < 25).all()
    assert observed_steps(stepped, 1, nodes).any() and not observed_steps(stepped, NONE, nodes).any()
    away = away_from_steps(stepped, stepped, 30.0)
    assert not away[14] and not away[15] and away[2] and away[-3]
    assert away_from_steps(ties(drift), ties(drift), 30.0).all()


def test_planes_seen_over_a_stop_say_less_where_the_vehicle_may_have_crept():
    """Two drives meet the same facades; the first one stands for 20 s among them, its trajectory wanders by 0.4 m."""
    rng = np.random.default_rng(1)
    time = np.linspace(0.0, 32.0, 641)
    x = np.interp(time, [0.0, 6.0, 26.0, 32.0], [0.0, 30.0, 30.0, 60.0])
    true = Trajectory(time, np.column_stack([x, 0 * x - 2.0, 0 * x + 2.0]), np.tile([0.0, 0.0, 90.0], (641, 1)))
    wander = np.interp(time, [6.0, 26.0], [0.0, 0.4])
    reported = Trajectory(time, true.place + np.outer(wander, [1.0, 1.0, 0.0]), true.angles)
    along = np.sort(rng.uniform(0, 60, 600))
    side = rng.choice([-8.0, 8.0], 600)
    seen = np.interp(along, [0.0, 29.0, 31.0, 60.0], [0.0, 5.9, 26.1, 32.0])
    place = np.column_stack([along, side, rng.uniform(1, 6, 600)])
    other = drive(100.0)
    groups = np.repeat([0, 1], 600)
    times = np.concatenate([seen, np.interp(along, other.place[:, 0], other.time)])
    first = place + np.outer(np.interp(seen, time, wander), [1.0, 1.0, 0.0])
    normal = np.tile([0.0, 1.0, 0.0], (1200, 1))
    patches = PlanePatches(groups, times, np.concatenate([first, place]), normal, np.full(1200, 0.003),
                           np.zeros((1200, 0)))
    both = [reported, other]
    found = plane_ties(DrivePlanes(patches, np.array([0, 1])), both, [stilled(item) for item in both], 1.0)
    sigma = np.sqrt(found.covariance[:, 1, 1])
    wanted = -np.interp(np.interp(found.parameter, path_parameters_of(reported, 1.0), time), time, wander)
    assert np.abs(found.value[:, 1] - wanted).max() < 0.02
    assert sigma.max() > 1.3 * sigma.min()
