"""Predicted accuracy of localisation against what can be worked out by hand and by chance."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from scipy.optimize import minimize_scalar

from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.accuracy_map import accuracy_map
from urbanmap_qgis.localisation.accuracy_records import LocalisationMap
from urbanmap_qgis.localisation.ellipses import along_and_across, plan_ellipses
from urbanmap_qgis.localisation.evidence import effective_walls
from urbanmap_qgis.localisation.evidence.effective_walls import robust_excess
from urbanmap_qgis.localisation.evidence.information import (
    Evidence,
    SharedError,
    covariance,
    covariances_of_parts,
    fused,
    surface_rows,
)
from urbanmap_qgis.localisation.evidence.marking_map import marking_evidence, marking_map
from urbanmap_qgis.localisation.evidence.settled_place import settled_places
from urbanmap_qgis.localisation.evidence.symmetric_systems import solved
from urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner
from urbanmap_qgis.localisation.map_aliases import STEP, ScoreField, alias_modes
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
from urbanmap_qgis.localisation.simulation.prediction_check import area_under_roc
from urbanmap_qgis.localisation.start_basins import share_elsewhere
from urbanmap_qgis.localisation.walls.measured_walls import sigmas_of_moved
from urbanmap_qgis.localisation.walls.wall_cells import space_cells, wall_plan_cells
from urbanmap_qgis.localisation.walls.wall_map import WallMap, building_sigmas, wall_sigmas, walls_with_heights
from urbanmap_qgis.localisation.walls.wall_scan import scan_walls
from urbanmap_qgis.mobile.registration.matching.ndt_match import Mixture, RigidMotion, match_points

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


# Where searches end that start beside the true place, on hills drawn by hand


MOST = 20


def hills(*tops):
    """Cones (2 MOST + 1 square) with tops at (east, north), m, of given heights, falling 1 a metre."""
    east, north = np.meshgrid(*[np.arange(-MOST, MOST + 1) * STEP] * 2)
    return np.max([height - np.hypot(east - x, north - y) for x, y, height in tops], axis=0)


def test_single_hill_draws_every_start():
    assert share_elsewhere(hills((0, 0, 9)), 1.0) == 0.0
    assert share_elsewhere(hills((0.5, -0.5, 9)), 1.0) == 0.0  # a map that is a little off


def test_second_hill_draws_the_starts_on_its_side_of_the_valley():
    """The valley runs along east = 1.75 m, as high tops as these are: starts beyond it are drawn away."""
    from scipy.stats import norm

    found = share_elsewhere(hills((0, 0, 9), (3.5, 0, 9)), 1.0)
    assert found == pytest.approx(norm.sf(1.75), abs=0.005)
    assert share_elsewhere(hills((0, 0, 9), (3.5, 0, 9)), 2.0) > 4 * found
    # A lower hill draws fewer, one beyond all starts none.
    assert share_elsewhere(hills((0, 0, 9), (3.5, 0, 7.5)), 1.0) < found / 2
    assert share_elsewhere(hills((0, 0, 9), (9.0, 0, 9)), 1.0) < 1e-3


def test_place_that_is_on_the_slope_of_another_is_left_by_all():
    assert share_elsewhere(hills((3.0, 0, 9)), 0.5) == pytest.approx(1.0)


def test_what_tells_nothing_has_no_share():
    assert np.isnan(share_elsewhere(np.zeros((41, 41)), 1.0))
    assert np.isnan(share_elsewhere(hills((0, 0, 9))[18:23, 18:23], 2.0))


def test_area_under_the_curve_is_the_share_of_pairs_in_order():
    score, event = np.array([0.1, 0.4, 0.4, 0.8]), np.array([False, True, False, True])
    assert area_under_roc(score, event) == pytest.approx((1 + 0.5 + 2) / 4)
    assert np.isnan(area_under_roc(score, np.zeros(4, bool))) and np.isnan(area_under_roc(score, np.ones(4, bool)))


# Other places where what is seen fits: modes of odds over shifts that were drawn by hand


SIZE = 41
MIDDLE = SIZE // 2


def surface(*hills, between=1e-6):
    """Log odds with cells (rows north, columns east of the middle) of given odds, all others at `between`."""
    odds = np.full((SIZE, SIZE), between)
    odds[MIDDLE, MIDDLE] = 1.0
    for row, column, height in hills:
        odds[MIDDLE + row, MIDDLE + column] = height
    return np.log(odds)


def test_shift_and_share_of_other_modes():
    found = alias_modes(surface((0, 12, 0.5), (-10, -6, 0.25)), 2.0)
    assert found.shift == pytest.approx(np.array([[12.0, 0.0], [-6.0, -10.0]]) * STEP)
    assert found.share == pytest.approx([0.5 / 1.75, 0.25 / 1.75], abs=0.002)


@pytest.mark.parametrize(("valley", "count"), [(0.2, 1), (0.35, 0)])
def test_only_what_a_valley_parts_is_another_mode(valley, count):
    """Along a street without features the odds are a ridge: six tenths of the lower hill part the two."""
    assert len(alias_modes(surface((0, 12, 0.5), between=valley), 2.0).shift) == count


@pytest.mark.parametrize(("away", "count"), [(4, 0), (5, 1)])
def test_what_is_near_is_the_same_place(away, count):
    assert len(alias_modes(surface((away, 0, 0.5)), 2.0).shift) == count


def test_hills_near_a_likelier_one_are_one_with_it():
    found = alias_modes(surface((0, 12, 0.5), (0, 15, 0.3)), 2.0)
    assert found.shift == pytest.approx(np.array([[12.0, 0.0]]) * STEP)
    assert found.share == pytest.approx([0.8 / 1.8], abs=0.002)


def test_score_is_highest_where_the_map_was_moved_from():
    """Points seen 1.5 m west and 1 m south of the corner of two walls that the map has."""
    wall = np.concatenate([np.column_stack([np.arange(0.25, 20, 0.5), np.full(40, 10.25)]),
                           np.column_stack([np.full(20, 10.25), np.arange(0.25, 10, 0.5)])])
    field = ScoreField.of(wall, (-10.0, -10.0, 30.0, 30.0), 0.3)
    score = field.shifted(wall[::2] - [1.5, 1.0], 6)
    assert np.unravel_index(score.argmax(), score.shape) == (6 + 2, 6 + 3)
    assert score.max() == pytest.approx(30 * np.log1p(1 / 0.05), rel=0.02)


# Covariances of some of the evidence are, to the last digit, those of that evidence alone


PLACES = 23


def evidence(rows):
    """Rows of 23 places in no order, with walls that several of them share."""
    rng = np.random.default_rng(11)
    of, row = rng.integers(0, PLACES, 900), rng.normal(size=(900, 3)) * [1.0, 1.0, 20.0]
    weight, noise = rng.uniform(1.0, 900.0, 900), rng.uniform(0.01, 0.3, 900)
    group, factor = rng.integers(-1, 40, 900), rng.uniform(-1, 1, 900)
    shared = [SharedError(group[rows], factor[rows], np.full(len(group[rows]), 0.2))]
    return Evidence(of[rows], row[rows], weight[rows], noise[rows], shared)


def by_hand(given, place, prior):
    """H^-1 (sum u^2 s^2 a a^T + sum_g s_g^2 b_g b_g^T + P) H^-1 of one place."""
    mine = given.of == place
    a, u, s = given.row[mine], given.weight[mine], given.noise[mine]
    h, middle = prior + (a.T * u) @ a, prior + (a.T * (u * s) ** 2) @ a
    error = given.shared[0]
    for number in np.unique(error.group[mine & (error.group >= 0)]):
        of_group = mine & (error.group == number)
        b = (given.weight * error.factor)[of_group] @ given.row[of_group]
        middle = middle + 0.2**2 * np.outer(b, b)
    return np.linalg.inv(h) @ middle @ np.linalg.inv(h)


@pytest.mark.parametrize("share", [0.0, 0.2, 0.7, 1.0])
def test_a_part_is_what_its_rows_alone_give(share):
    whole, prior = evidence(slice(None)), np.diag([1.0, 1.0, 0.1])
    mask = np.random.default_rng(3).random(900) < share
    part, = covariances_of_parts(whole, [mask.astype(float)], PLACES, prior)
    alone = evidence(mask)
    assert np.array_equal(part, covariance(alone, PLACES, prior))
    for place in range(PLACES):
        assert part[place] == pytest.approx(by_hand(alone, place, prior), rel=1e-9, abs=1e-15)


def test_a_share_of_a_row_is_a_row_of_fewer_measurements():
    whole, prior = evidence(slice(None)), np.diag([1.0, 1.0, 0.1])
    share = np.random.default_rng(4).uniform(0.1, 1.0, 900)
    part, = covariances_of_parts(whole, [share], PLACES, prior)
    fewer = Evidence(whole.of, whole.row, whole.weight * share, whole.noise / np.sqrt(share), whole.shared)
    assert part == pytest.approx(covariance(fewer, PLACES, prior), rel=1e-9, abs=1e-15)


def test_small_systems_are_solved_as_the_library_does():
    rng = np.random.default_rng(5)
    root = rng.normal(size=(400, 3, 3)) * [1.0, 30.0, 900.0]
    matrix, right = root @ np.swapaxes(root, 1, 2) + np.diag([1.0, 1.0, 800.0]), rng.normal(size=(400, 3))
    upper = np.stack([matrix[:, i, j] for i in range(3) for j in range(i, 3)])
    expected = np.linalg.solve(matrix, right[..., None])[..., 0]
    assert np.allclose(solved(upper, right.T).T, expected, rtol=1e-6, atol=1e-9)


# How many walls an NDT rests on: drawn displacements against a search for the maximum, and where it settles


PRIOR_WALLS = np.diag([1e-6, 1e6, 1e6])
SIGMA = 0.3


def facing_east(shares, sharpness: float, draws: int, monkeypatch) -> np.ndarray:
    """What is added for walls that all face east, with so many points each."""
    monkeypatch.setattr(effective_walls, "DRAWS", draws)
    wall = np.repeat(np.arange(len(shares)), shares)
    row = surface_rows(np.tile([1.0, 0.0], (len(wall), 1)), np.zeros((len(wall), 2)))
    weight = np.full(len(wall), SIGMA ** -2.0)
    evidence = Evidence(np.zeros(len(wall), int), row, weight, np.full(len(wall), 0.01), ())
    return robust_excess(evidence, np.ones(len(wall)), wall, np.full(len(wall), SIGMA), [np.ones(len(wall))], 1,
                         PRIOR_WALLS, sharpness)[0]


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
