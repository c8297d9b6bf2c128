"""Predicted accuracy of localisation against what can be worked out by hand and by chance."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.accuracy_map import accuracy_map
from urbanmap_qgis.localisation.accuracy_records import LocalisationMap
from urbanmap_qgis.localisation.ellipses import along_and_across, plan_ellipses
from urbanmap_qgis.localisation.evidence.information import Evidence, SharedError, covariance, fused, surface_rows
from urbanmap_qgis.localisation.evidence.marking_map import marking_evidence, marking_map
from urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner
from urbanmap_qgis.localisation.places.place_status import (
    BELOW,
    GOOD,
    HEIGHTS_DIFFER,
    INSIDE,
    MARKING_HEIGHTS_DIFFER,
    NO_HEIGHT,
    NONE,
    OUTSIDE,
    POOR,
    TUNNEL,
)
from urbanmap_qgis.localisation.places.road_places import places_on_drive, places_on_grid, places_on_roads, tunnels
from urbanmap_qgis.localisation.report import localisation_pictures
from urbanmap_qgis.localisation.walls.measured_walls import sigmas_of_moved
from urbanmap_qgis.localisation.walls.wall_map import WallMap, building_sigmas, wall_sigmas, walls_with_heights

PRIOR = np.diag([1e-6, 1e-6, 1e-6])


def city(boxes, sigma=0.2, top=20.0, low=0.0):
    shapes = np.array([shapely.box(*box) for box in boxes], object)
    walls = building_walls(shapes, None, np.full(len(boxes), top), np.full(len(boxes), low))
    return WallMap.of(walls, wall_sigmas(walls, sigma))


def canyon(sigma=0.2):
    """Two rows of smooth walls along x, 600 m long, 20 m apart."""
    return city([(-300, 10, 300, 25), (-300, -25, 300, -10)], sigma)


def place(x, y, z=0.0, heading=(1.0, 0.0)):
    a, b = heading
    return places_on_roads([shapely.LineString([(x - a, y - b, z), (x + a, y + b, z)])], 5.0)


def predicted(walls, places, settings=None, **others):
    return accuracy_map(LocalisationMap(walls, **others), places, settings or LocalisationSettings())


@pytest.mark.paper("J 6.2, localisation")
def test_covariance_is_that_of_drawn_displacements():
    rng = np.random.default_rng(3)
    angle = rng.uniform(0, 2 * np.pi, 60)
    normal = np.column_stack([np.cos(angle), np.sin(angle)])
    offset = rng.uniform(-30, 30, (60, 2))
    row, wall = surface_rows(normal, offset), np.arange(60) // 10
    weight, noise, sigma = rng.uniform(5, 20, 60), np.full(60, 0.05), np.full(60, 0.3)
    made = covariance(Evidence(np.zeros(60, int), row, weight, noise, (SharedError(wall, np.ones(60), sigma),)), 1,
                      PRIOR)[0]
    error = rng.normal(0, 0.3, (6, 40000))[wall] + rng.normal(0, 0.05, (60, 40000))
    solved = np.linalg.solve((row.T * weight) @ row, (row.T * weight) @ error)
    assert np.cov(solved) == pytest.approx(made, rel=0.06, abs=0.02 * made.max())


def test_more_points_do_not_make_a_displaced_wall_better():
    walls = canyon(0.3)
    coarse, fine = (predicted(walls, place(0, 0), LocalisationSettings(
        "ICP", scanner=VehicleScanner(resolution=step, hidden=0.0))) for step in (2.0, 0.1))
    # Two walls: the mean of both displacements.
    assert coarse.sigma["walls"][0, 1] == pytest.approx(0.3 / np.sqrt(2), rel=0.03)
    assert fine.sigma["walls"][0, 1] == pytest.approx(coarse.sigma["walls"][0, 1], rel=0.02)
    # The mixture of an NDT lets it grow, and hidden walls do.
    mixture, hidden = (predicted(walls, place(0, 0), LocalisationSettings(scanner=VehicleScanner(hidden=share)))
                       .sigma["walls"][0, 1] for share in (0.0, 0.5))
    assert mixture == pytest.approx(0.3 / np.sqrt(2) * np.sqrt(1.055), rel=0.02) and hidden > 1.02 * mixture


def test_smooth_street_slides_along():
    settings = LocalisationSettings(start_sigma=2.0)
    made = predicted(canyon(), place(0, 0), settings)
    assert made.sigma["walls"][0, 0] == pytest.approx(2.0, rel=0.02) and made.sigma["walls"][0, 1] < 0.2
    assert made.status[0] == "slides along the street" and made.kind[0] == POOR
    assert abs(made.ellipse.bearing[0] - 90) < 1 and made.walls[0] == 2 and made.alias_share[0] == 0


def test_crossing_is_fixed_in_all_directions():
    walls = city([(10, 10, 60, 60), (-60, 10, -10, 60), (-60, -60, -10, -10), (10, -60, 60, -10)])
    made = predicted(walls, place(0, 0))
    assert made.status[0] == "ok" and made.kind[0] == GOOD and made.ellipse.major[0] < 0.2
    # Four walls to either side, each with 0.2 m.
    assert made.sigma["walls"][0, :2] == pytest.approx(0.1, rel=0.15)


def test_houses_at_equal_distances_repeat():
    houses = [(x, y, x + 8, y + 10) for x in range(-120, 121, 12) for y in (8, -18)]
    made = predicted(city(houses, 0.1), place(2, 0))
    assert made.alias_share[0] > 0.1 and "repeats every 12 m" in made.status[0] and made.kind[0] == POOR
    assert np.abs(made.alias_shift[0]) == pytest.approx([12.0, 0.0], abs=0.6)
    rng = np.random.default_rng(2)
    odd = [(x, y, x + rng.uniform(4, 10), y + rng.uniform(6, 14)) for x in range(-120, 121, 12) for y in (8, -18)]
    assert predicted(city(odd, 0.1), place(2, 0)).alias_share[0] < 0.05


def test_walls_with_measured_sigma_take_it():
    walls = canyon(0.3).walls
    line = shapely.LineString([(-200, 10.4), (200, 10.4)])
    sigma = wall_sigmas(walls, 0.3, None, [line, shapely.LineString([(0, 0), (0, 60)])], np.array([0.05, 0.01]))
    assert np.sum(sigma == 0.05) == 1 and np.sum(sigma == 0.3) == len(sigma) - 1
    assert building_sigmas(np.array([0, 0, 1]), np.array([0.1, 0.4, np.nan])) == pytest.approx([0.4, np.nan],
                                                                                            nan_ok=True)


def test_walls_that_were_left_where_they_were_keep_their_sigma():
    # What `adjustwalls` and `mergebuildingmodels` write: only walls that stand on their measurements take these' sigma.
    moved = ["adjusted", "likely", "moved", "fits", "ok", None]
    left = ["not observable", "held", "not seen", "too far", "neighbour", "does not fit"]
    sigma = sigmas_of_moved(np.full(12, 0.4), moved + left)
    assert (sigma[:6] == 0.4).all() and np.isnan(sigma[6:]).all()
    assert (sigmas_of_moved(np.array([0.1, 0.2]), None) == [0.1, 0.2]).all()
    walls = canyon(0.3).walls
    line = [shapely.LineString([(-200, 10.4), (200, 10.4)])]
    placed, kept = (wall_sigmas(walls, 0.3, None, line, sigmas_of_moved(np.array([0.8]), [status]))
                    for status in ("likely", "not observable"))
    assert np.sum(placed == 0.8) == 1 and (kept == 0.3).all()


def test_markings_tell_across_by_edges_and_along_by_ends():
    line = shapely.LineString([(-100, 2), (100, 2)])
    settings = LocalisationSettings(start_sigma=2.0, marking_common=0.0, marking_noise=0.01)
    made = predicted(None, place(0, 0), settings, markings=marking_map([line], np.array([0.05])))
    assert made.sigma["markings"][0, 1] == pytest.approx(0.05, rel=0.1)
    assert made.sigma["markings"][0, 0] == pytest.approx(2.0, rel=0.02)
    stop = shapely.box(5, -3, 5.4, 0)
    both = predicted(None, place(0, 0), settings, markings=marking_map([line, stop], np.array([0.05, 0.05])))
    assert both.sigma["markings"][0, 0] == pytest.approx(0.05, rel=0.1)
    # Two lines of one colour end where the map is cut: no end of paint.
    halves = [shapely.LineString([(-6, 2), (0, 2)]), shapely.LineString([(0, 2), (9, 2)])]
    assert len(marking_map(halves, np.full(2, 0.05)).xy) < len(marking_map([halves[0], shapely.LineString(
        [(1, 2), (10, 2)])], np.full(2, 0.05)).xy)


def test_markings_behind_walls_are_not_seen():
    hidden = marking_map([shapely.box(-1, 30, 1, 30.5)], np.array([0.05]))
    settings = LocalisationSettings(marking_range=60.0)
    assert np.isnan(predicted(canyon(), place(0, 0), settings, markings=hidden).sigma["markings"]).all()
    assert np.isfinite(predicted(None, place(0, 0), settings, markings=hidden).sigma["markings"]).all()


def test_sources_together_are_better_than_each():
    rng = np.random.default_rng(1)
    some = rng.normal(size=(2, 5, 3, 3))
    one, other = (np.einsum("nij,nkj->nik", each, each) + 0.05 * np.eye(3) for each in some)
    one, other = (np.linalg.inv(np.linalg.inv(each) + PRIOR) for each in (one, other))
    both = fused([one, other], PRIOR)
    assert np.linalg.inv(both) == pytest.approx(np.linalg.inv(one) + np.linalg.inv(other) - PRIOR, rel=1e-6)


def test_ellipse_and_its_parts_along_a_heading():
    covariance_ = np.array([np.diag([4.0, 1.0])])
    ellipse = plan_ellipses(covariance_)
    assert (ellipse.major[0], ellipse.minor[0], ellipse.bearing[0]) == pytest.approx((2, 1, 90))
    along, across = along_and_across(covariance_, np.radians([90.0]))
    assert (along[0], across[0]) == pytest.approx((2, 1))
    assert along_and_across(covariance_, np.radians([45.0]))[0] == pytest.approx(np.sqrt(2.5))


@pytest.mark.parametrize("where, words", [
    (place(0, 15), INSIDE), (place(3000, 0), OUTSIDE), (place(0, 0, 60.0), HEIGHTS_DIFFER)])
def test_places_of_which_nothing_can_be_said(where, words):
    made = predicted(canyon(), where)
    assert made.status[0] == words and made.kind[0] == NONE
    assert np.isnan(made.sigma["together"]).all() and np.isnan(made.ellipse.major[0])


def test_tunnel_and_road_below_the_ground():
    road = shapely.LineString([(-5, 0, 0), (5, 0, 0)])
    made = predicted(canyon(), places_on_roads([road], 5.0, tunnels({"TUNNEL": ["yes"]}, 1)))
    assert set(made.status) == {TUNNEL} and np.isnan(made.ellipse.major).all()
    below = place(0, 0, -8.0)
    below = type(below)(**{**vars(below), "ground": np.zeros(1)})
    assert predicted(canyon(), below).status[0] == BELOW
    assert not tunnels({"name": ["x"]}, 1).any() and not tunnels({"tunnel": ["no", None, 0]}, 3).any()


def test_empty_plain_has_no_sigma():
    far = city([(0, 0, 10, 10), (1000, 0, 1010, 10)])
    made = predicted(far, place(500, 5))
    assert made.status[0] in ("no walls within range", NO_HEIGHT) and made.kind[0] == NONE
    assert np.isnan(made.sigma["together"]).all()
    made = predicted(far, place(150, 5, 0.0))
    assert made.status[0] == "no walls within range" and np.isnan(made.sigma["walls"]).all()


def test_few_points_are_no_small_sigma():
    post = city([(50, -0.3, 50.6, 0.3)], 0.02)
    made = predicted(post, place(0, 0))
    assert made.status[0] == "few points on walls" and np.isnan(made.ellipse.major[0]) and made.alias_share[0] == 0


def test_buildings_without_heights_are_left_out_and_told():
    boxes = [(-300, 10, 300, 25), (-300, -25, 300, -10)]
    shapes = np.array([shapely.box(*box) for box in boxes], object)
    pieces, without = walls_with_heights(shapes, np.arange(2), np.array([20.0, np.nan]), np.zeros(2))
    walls = WallMap.of(pieces, wall_sigmas(pieces, 0.2))
    near = LocalisationMap(walls, without_height=np.array([[0.0, -17.0]]))
    made = accuracy_map(near, place(0, 0), LocalisationSettings())
    assert made.walls[0] == 1 and "1 buildings without heights left out" in made.status[0]
    pieces, without = walls_with_heights(shapes, np.arange(2), None, None)
    assert pieces is None and len(without) == 2
    nothing = accuracy_map(LocalisationMap(None, without_height=without), place(0, 17), LocalisationSettings())
    assert nothing.kind[0] == NONE and "without heights" in nothing.status[0]


def test_markings_of_another_height_system_are_not_used():
    line = shapely.LineString([(-10, 2, 37), (10, 2, 37)])
    made = predicted(canyon(), place(0, 0), None, markings=marking_map([line], np.array([0.05])))
    assert MARKING_HEIGHTS_DIFFER in made.status[0] and np.isnan(made.sigma["markings"]).all()


def test_ground_beside_a_tower_is_the_foot_of_its_podium():
    """Most walls near the road are a tower's, which begin 24 m above it."""
    podium, tower = shapely.box(-40, 10, 40, 60), shapely.box(-6, 11, 6, 23)
    walls = building_walls(np.array([podium, tower], object), np.array([7, 7]), np.array([36.0, 60.0]),
                           np.array([12.0, 36.0]))
    found = WallMap.of(walls, wall_sigmas(walls, 0.3)).feet(np.array([[0.0, 5.0], [0.0, -500.0]]), 60.0)
    assert found[0] == 12.0 and np.isnan(found[1])


def test_walls_that_reach_down_without_end_tell_no_foot():
    walls = building_walls(np.array([shapely.box(0, 0, 9, 9)], object), None, np.array([20.0]), np.array([np.nan]))
    assert np.isnan(WallMap.of(walls, wall_sigmas(walls, 0.3)).feet(np.zeros((1, 2)), 60.0)).all()


def test_places_along_lines_and_drives():
    made = places_on_roads([None, shapely.LineString([(0, 0), (20, 0), (20, 10)])], 5.0)
    assert len(made) == 6 and made.street.tolist() == [1] * 6 and made.step.sum() == pytest.approx(30)
    assert np.degrees(made.heading[[0, -1]]) == pytest.approx([90, 0])
    path = np.array([[0, 0, 1], [10, 0, 2], [10, 0, 2], [30, 0, 4.0]])
    drive = places_on_drive(path, np.array([0.0, 1.0, 5.0, 6.0]), 10.0)
    assert drive.place[:, 0] == pytest.approx([5, 15, 25]) and drive.place[:, 2] == pytest.approx([1.5, 2.5, 3.5])
    assert drive.time[0] == pytest.approx(0.5) and 5.0 < drive.time[1] < 5.5
    from urbanmap_qgis.geometry.grid import Grid
    assert len(places_on_grid(Grid(0, 100, 5.0, 4, 3))) == 12


def test_street_that_slides_is_not_usable_however_well_it_was_known_before():
    settings = LocalisationSettings(start_sigma=0.5, usable=1.0)
    assert predicted(canyon(), place(0, 0), settings).kind[0] == POOR


def test_a_plan_of_accuracy_shows_each_place_where_it_lies(monkeypatch):
    for name in ("_markings", "_walls"):
        monkeypatch.setattr(localisation_pictures, name, lambda *given: "")
    place = np.array([[1000.0, 5000.0], [1100.0, 5000.0], [1100.0, 5030.0]])
    none = np.full(3, np.nan)
    accuracy = SimpleNamespace(places=SimpleNamespace(place=place), kind=np.array([GOOD, POOR, NONE]),
                               ellipse=SimpleNamespace(major=none, minor=none, bearing=none))
    svg = localisation_pictures.accuracy_plan(None, accuracy, np.arange(3), 10.0, width=280, around=20.0)
    assert re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)"', svg) == [("40.0", "100.0"), ("240.0", "100.0"),
                                                                       ("240.0", "40.0")]


def test_a_marking_informs_by_its_length_and_by_the_square_of_its_noise():
    markings = SimpleNamespace(xy=np.array([[5.0, 0.0], [5.0, 0.0], [0.0, 20.0]]), sigma=np.full(3, 0.03),
                               normal=np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), length=np.array([0.5, 0.25, 0.5]),
                               marking=np.arange(3))
    settings = SimpleNamespace(marking_noise=0.04, detection=0.6, marking_common=0.02)
    told = marking_evidence(markings, np.zeros(3, int), np.arange(3), np.zeros((1, 3)), settings)
    assert told.weight == pytest.approx([0.6 / 0.05**2 * 1.0, 0.6 / 0.05**2 * 0.5, 0.6 / (0.03**2 + 0.08**2)])
