"""How many walls an NDT rests on: drawn displacements against a search for the maximum, and where it settles."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from scipy.optimize import minimize_scalar

from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.evidence import effective_walls
from urbanmap_qgis.localisation.evidence.effective_walls import robust_excess
from urbanmap_qgis.localisation.evidence.information import Evidence, surface_rows
from urbanmap_qgis.localisation.evidence.settled_place import settled_places
from urbanmap_qgis.localisation.localisation_settings import VehicleScanner
from urbanmap_qgis.localisation.walls.wall_cells import space_cells, wall_plan_cells
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas
from urbanmap_qgis.localisation.walls.wall_scan import scan_walls
from urbanmap_qgis.mobile.registration.matching.ndt_match import Mixture, RigidMotion, match_points

PRIOR = np.diag([1e-6, 1e6, 1e6])
SIGMA = 0.3


def facing_east(shares, sharpness: float, draws: int, monkeypatch) -> np.ndarray:
    """What is added for walls that all face east, with so many points each."""
    monkeypatch.setattr(effective_walls, "DRAWS", draws)
    wall = np.repeat(np.arange(len(shares)), shares)
    row = surface_rows(np.tile([1.0, 0.0], (len(wall), 1)), np.zeros((len(wall), 2)))
    weight = np.full(len(wall), SIGMA ** -2.0)
    evidence = Evidence(np.zeros(len(wall), int), row, weight, np.full(len(wall), 0.01), ())
    return robust_excess(evidence, np.ones(len(wall)), wall, np.full(len(wall), SIGMA), [np.ones(len(wall))], 1,
                         PRIOR, sharpness)[0]


def test_two_walls_alike_are_two_walls(monkeypatch):
    # Two bumps so near each other have their one maximum in the middle: the linear mean.
    added = facing_east([20, 20], 0.05, 4000, monkeypatch)
    assert abs(added[0, 0]) < 0.02 * SIGMA ** 2 / 2 and np.abs(added[1:]).max() < 1e-9


def test_the_strongest_wall_is_followed_as_a_search_for_the_maximum_does(monkeypatch):
    shares, sharpness = np.array([30, 10, 10]), 0.5
    added = facing_east(shares, sharpness, 6000, monkeypatch)[0, 0]
    rng = np.random.default_rng(3)
    robust, linear = [], []
    for displaced in rng.normal(0.0, SIGMA, (4000, 3)):
        middle = (shares * displaced).sum() / shares.sum()

        def worth(x, displaced=displaced):
            return -(shares * np.exp(-0.5 * sharpness * (x - displaced) ** 2 / SIGMA ** 2)).sum()

        robust.append(minimize_scalar(worth, bracket=(middle - 0.01, middle + 0.01)).x)
        linear.append(middle)
    expected = np.mean(np.square(robust)) - np.mean(np.square(linear))
    assert expected > 0.05 * np.mean(np.square(linear))
    assert added == pytest.approx(expected, rel=0.2)


def test_a_scan_settles_where_the_registration_of_its_points_does():
    boxes = [(4.3 + 7 * k, 5.1 + (k % 3) * 0.8, 11.0 + 7 * k, 20) for k in range(6)]
    boxes += [(-30.2, -20.3, -3.1, -6.4), (20.3, -25.1, 45.2, -9.3)]
    shapes = np.array([shapely.box(*box) for box in boxes], object)
    pieces = building_walls(shapes, None, np.full(len(boxes), 15.0), np.zeros(len(boxes)))
    walls = WallMap.of(pieces, wall_sigmas(pieces, 0.2))
    sensor = np.array([[0.0, 1.0, 2.0], [-3.0, 0.5, 2.0]])
    scan, cells = scan_walls(walls, sensor, VehicleScanner(hidden=0.0)), wall_plan_cells(walls, 2.0, 2.0)
    mixture = Mixture.of(0.3, 2.0, 2)
    found = settled_places(scan, sensor, cells, mixture, np.eye(3) * 1e-9)
    for number, place in enumerate(sensor[:, :2]):
        points = scan.offset[scan.of == number]
        start = RigidMotion(np.zeros(2), place - cells.ndt.origin, np.eye(2))
        local = cells.ndt.__class__(**{**cells.ndt.__dict__, "origin": np.zeros(2)})
        pose = match_points(points, start, local, mixture).pose
        settled = pose.translation + cells.ndt.origin - place
        assert found[number, :2] == pytest.approx(settled, abs=5e-4)
        assert np.hypot(*settled) > 0.002
        assert found[number, 2] == pytest.approx(np.arctan2(pose.rotation[1, 0], pose.rotation[0, 0]), abs=5e-5)


def test_road_of_a_map_in_space_lies_outside_buildings():
    """A block of 20 m to the east of the place, over a level road."""
    walls = SimpleNamespace(start=np.array([[4.0, -10.0]]), end=np.array([[4.0, 10.0]]), low=np.array([[0.0, 0.0]]),
                            top=np.array([[9.0, 9.0]]), normal=np.array([[-1.0, 0.0]]), wall=np.array([0]))
    city = SimpleNamespace(walls=walls, sigma=np.array([0.05]),
                           obstacles=SimpleNamespace(inside=lambda places: places[:, 0] > 4.0))
    found = space_cells(city, 1.0, 20.0, 0.0, np.zeros(2), 10.0, 0.05)
    place = found.mean + found.origin
    road = place[place[:, 2] < 0.1]
    assert len(road) > 20 and road[:, 0].min() < -5.0 and road[:, 0].max() <= 4.6


def test_walls_in_space_stand_between_their_low_and_their_top():
    """A wall five metres to the east, from 3 to 7 m above the ground, over a level road."""
    walls = SimpleNamespace(start=np.array([[5.0, -3.0]]), end=np.array([[5.0, 3.0]]), low=np.array([[3.0, 3.0]]),
                            top=np.array([[7.0, 7.0]]), normal=np.array([[-1.0, 0.0]]), wall=np.array([0]))
    city = SimpleNamespace(walls=walls, sigma=np.array([0.05]),
                           obstacles=SimpleNamespace(inside=lambda places: np.zeros(len(places), bool)))
    found = space_cells(city, 1.0, 20.0, 0.0, np.zeros(2), 10.0, 0.05)
    z = (found.mean + found.origin)[:, 2]
    assert np.allclose(z[z < 1.0], 0.0) and 3.0 < z[z > 1.0].min() < 4.0 and 6.0 < z[z > 1.0].max() < 7.0
