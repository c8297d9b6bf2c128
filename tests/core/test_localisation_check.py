"""Simulated scans and their registration, and what is made of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.gnss.rays.tracing import WallObstacles
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.accuracy_map import accuracy_map
from urbanmap_qgis.localisation.accuracy_records import LocalisationMap
from urbanmap_qgis.localisation.evidence.marking_map import marking_map
from urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner
from urbanmap_qgis.localisation.places.road_places import places_on_grid, places_on_roads
from urbanmap_qgis.localisation.prepared_map import field_of_walls
from urbanmap_qgis.localisation.report.localisation_report import stretches, write_localisation_report
from urbanmap_qgis.localisation.simulation.line_matches import lines_of_walls
from urbanmap_qgis.localisation.simulation.marking_check import check_marking_prediction
from urbanmap_qgis.localisation.simulation.prediction_check import (
    check_prediction,
    compared,
    ends_at_place,
    rank_agreement,
)
from urbanmap_qgis.localisation.simulation.simulated_matches import match_error, plan_matching_map, space_matching_map
from urbanmap_qgis.localisation.simulation.simulated_scans import displaced, ray_directions, simulated_scans
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas

BOXES = [(10, 10, 40, 40), (-35, 12, -10, 40), (-40, -40, -9, -10), (11, -40, 40, -12), (-6, 45, 5, 60)]


@pytest.fixture(scope="module")
def walls():
    shapes = np.array([shapely.box(*box) for box in BOXES], object)
    pieces = building_walls(shapes, None, np.full(len(BOXES), 15.0), np.zeros(len(BOXES)))
    return WallMap.of(pieces, wall_sigmas(pieces, 0.2))


@pytest.fixture(scope="module")
def places():
    return places_on_roads([shapely.LineString([(-20, 1, 0), (20, 1, 0)])], 10.0)


def settings(**scanner):
    return LocalisationSettings(scanner=VehicleScanner(**({"hidden": 0.0, "noise": 0.01} | scanner)))


def test_displaced_walls_stand_where_they_should(walls):
    moved = displaced(walls.walls, walls.sigma, np.random.default_rng(1))
    along = np.column_stack([-moved.normal[:, 1], moved.normal[:, 0]])
    shift = moved.start - walls.walls.start
    assert np.einsum("ij,ij->i", shift, along) == pytest.approx(0, abs=1e-9)
    assert np.einsum("ij,ij->i", moved.start, moved.normal) == pytest.approx(moved.offset)
    drawn = np.concatenate([displaced(walls.walls, walls.sigma, np.random.default_rng(k)).offset - walls.walls.offset
                            for k in range(200)])
    assert np.std(drawn) == pytest.approx(0.2, rel=0.05) and abs(np.mean(drawn)) < 0.01


def test_scans_lie_on_walls_and_on_the_road(walls):
    scanner = VehicleScanner("multi-layer", hidden=0.0, noise=1e-6)
    sensor = np.array([[0.0, 0.0, 2.0]])
    scan, = simulated_scans(walls.obstacles, sensor, np.zeros(1), scanner, 120, np.random.default_rng(1))
    points = scan.offset + sensor
    low = points[:, 2] < 1e-3
    lines = shapely.union_all([shapely.box(*box).exterior for box in BOXES])
    assert low.any() and (~low).any() and points[:, 2].min() > -1e-3
    assert shapely.distance(lines, shapely.points(points[~low, :2])).max() < 1e-3
    assert len(ray_directions(scanner, 120)) == 16 * 120 and scan.hidden == 0


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.1, 0.3])
def test_vehicles_and_trees_hide_about_what_is_asked_for(walls, share):
    sensor = np.tile([[0.0, 1.0, 2.0]], (300, 1))
    scans = simulated_scans(walls.obstacles, sensor, np.full(300, np.pi / 2), VehicleScanner(hidden=share), 60,
                            np.random.default_rng(1))
    assert np.mean([scan.hidden for scan in scans]) == pytest.approx(share, rel=0.5)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["2D", "multi-layer"])
def test_registration_in_the_city_as_mapped_is_exact(walls, places, kind):
    """Without displacement, noise and vehicles the matcher must find the place from a metre away."""
    own = settings(kind=kind, max_range=40.0)
    field = field_of_walls(walls, places, own)
    place = np.array([2.0, 1.0, 2.0])
    scan, = simulated_scans(walls.obstacles, place[None], np.zeros(1), own.scanner, 120, np.random.default_rng(1))
    city = (plan_matching_map(walls, field, own) if kind == "2D"
            else space_matching_map(walls, field, own, place[:2], 0.0))
    for seed in range(2):
        error = match_error(scan.offset, place, city, own, np.random.default_rng(seed))
        assert np.hypot(*error[:2]) < 0.06 and abs(np.degrees(error[2])) < 0.2


@pytest.mark.slow
def test_prediction_holds_what_is_simulated(walls, places):
    made = accuracy_map(LocalisationMap(walls), places, settings())
    check = check_prediction(walls, made, settings(), 3, 25, 3)
    assert check.rows.tolist() == [0, 3] and check.errors.shape == (2, 25, 3)
    assert np.median(check.observed / check.predicted) == pytest.approx(1.0, abs=0.3)
    assert check.inside > 0.8 and check.elsewhere.max() < 0.2
    some, again = (check_prediction(walls, made, settings(), 2, 2, 3) for _ in range(2))
    assert np.array_equal(some.errors, again.errors)


@pytest.mark.slow
def test_scans_that_end_in_the_next_gap_of_a_row_of_houses_do_not_converge():
    """Started 3 m off in a row that repeats every 6 m; where walls stand on one side alone, along it nothing counts."""
    shapes = np.array([shapely.box(x, y, x + 3, y + 5) for x in range(-72, 73, 6) for y in (5, -10)], object)
    pieces = building_walls(shapes, None, np.full(len(shapes), 12.0), np.zeros(len(shapes)))
    row = WallMap.of(pieces, wall_sigmas(pieces, 0.05))
    wide = LocalisationSettings(scanner=VehicleScanner(hidden=0.0, noise=0.01), start_sigma=3.0)
    narrow = LocalisationSettings(scanner=VehicleScanner(hidden=0.0, noise=0.01), start_sigma=0.3)
    where = places_on_roads([shapely.LineString([(-9, 0, 0), (9, 0, 0)])], 3.0)
    far, near = (accuracy_map(LocalisationMap(row), where, one) for one in (wide, narrow))
    assert (far.undetermined == 0).all() and (near.undetermined == 0).all()
    assert np.nanmedian(far.elsewhere) > 0.2 and np.nanmedian(near.elsewhere) < 0.02
    lost, kept = (check_prediction(row, made, one, 2, 4, 3) for made, one in ((far, wide), (near, narrow)))
    assert (~lost.converged).mean() > 0.2 and kept.converged.all() and kept.determined.all()
    assert np.isnan(kept.failures_ranked) and kept.inside_converged == pytest.approx(kept.inside)


def test_direction_along_a_smooth_wall_is_not_determined_and_has_no_share():
    shapes = np.array([shapely.box(-300, 10, 300, 25)], object)
    pieces = building_walls(shapes, None, np.full(1, 12.0), np.zeros(1))
    wall = WallMap.of(pieces, wall_sigmas(pieces, 0.1))
    made = accuracy_map(LocalisationMap(wall), places_on_roads([shapely.LineString([(-9, 0, 0), (9, 0, 0)])], 3.0),
                        settings())
    assert (made.undetermined == 1).all() and np.isnan(made.elsewhere).all()
    check = check_prediction(wall, made, settings(), 2, 2, 3)
    assert not check.determined.any() and np.isnan([check.rank_converged, check.inside_converged]).all()


def test_true_city_is_scanned_where_one_is_given(walls, places):
    """All of the true city a metre to the east: the scans say so."""
    from dataclasses import replace

    shift = np.array([0.6, 0.0])
    pieces = walls.walls
    truth = replace(pieces, start=pieces.start + shift, end=pieces.end + shift,
                    offset=pieces.offset + pieces.normal @ shift)
    made = accuracy_map(LocalisationMap(walls), places, settings())
    check = check_prediction(walls, made, settings(), 2, 3, 3, truth)
    assert np.median(check.errors[:, :, 0]) == pytest.approx(-0.6, abs=0.1)
    assert isinstance(WallObstacles.of(truth), WallObstacles)


def test_shares_and_ranks(walls, places):
    made = accuracy_map(LocalisationMap(walls), places, settings())
    rng = np.random.default_rng(1)
    rows = np.arange(len(places))
    drawn = np.stack([rng.multivariate_normal(np.zeros(3), made.by_source["walls"][row], 2000) for row in rows])
    check = compared(rows, drawn, np.zeros(len(rows)), np.zeros(len(rows)), made)
    assert check.inside == pytest.approx(0.95, abs=0.01)
    assert check.observed == pytest.approx(check.predicted, rel=0.05)
    assert check.observed_parts == pytest.approx(check.predicted_parts, rel=0.06)
    assert rank_agreement(np.arange(5.0), np.arange(5.0) ** 3) == pytest.approx(1.0)
    assert rank_agreement(np.arange(5.0), -np.arange(5.0)) == pytest.approx(-1.0)
    assert np.isnan(rank_agreement(np.arange(2.0), np.arange(2.0))) and np.isnan(rank_agreement(np.ones(5), rows[:5]))


def test_report_has_classes_worst_stretches_and_what_was_simulated(walls, places, tmp_path):
    made = accuracy_map(LocalisationMap(walls), places, settings())
    check = check_prediction(walls, made, settings(), 2, 2, 3)
    write_localisation_report(tmp_path / "r.html", LocalisationMap(walls), made, check)
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    for words in ("Worst stretches", "Predicted against observed", "<ellipse", "good", "Spearman",
                  "Scans that end elsewhere", "Places with a direction not determined"):
        assert words in text
    assert sorted(np.concatenate(stretches(made)).tolist()) == list(range(len(places)))


def test_an_area_without_roads_is_ranked_by_squares_with_their_places(walls, tmp_path):
    made = accuracy_map(LocalisationMap(walls), places_on_grid(Grid(-100, 100, 25.0, 8, 8), np.zeros((8, 8))),
                        LocalisationSettings())
    squares = stretches(made)
    assert len(squares) == 16 and {len(rows) for rows in squares} == {4}
    for rows in squares:
        assert np.ptp(made.places.place[rows, :2], axis=0).max() <= 25.0
    write_localisation_report(tmp_path / "r.html", LocalisationMap(walls), made, None)
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "Worst squares of 50 m" in page and "Worst stretches" not in page and "about east" in page
    # 64 places of a grid of 25 m stand for 200 m x 200 m, not for a length of road.
    assert "Area, m²" in page and "40,000" in page and "Length of road" not in page and "area, m²" in page


def test_a_worst_stretch_has_the_status_of_the_places_that_are_ranked(walls, tmp_path):
    made = accuracy_map(LocalisationMap(walls), places_on_grid(Grid(-100, 100, 25.0, 8, 8), np.zeros((8, 8))),
                        LocalisationSettings())
    # Three of the four places of each square say nothing.
    silent = np.arange(64).reshape(8, 8) % 2 + np.arange(8)[:, None] % 2 > 0
    major = np.where(silent.ravel(), np.nan, 0.4)
    status = np.where(silent.ravel(), "inside a building", "ok").astype(object)
    mixed = replace(made, ellipse=replace(made.ellipse, major=major), status=status)
    write_localisation_report(tmp_path / "r.html", LocalisationMap(walls), mixed, None)
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    worst = page[page.index("Worst squares"):page.index("Median sigma of the weakest direction, m")]
    assert "Scans that end elsewhere" in worst and "inside a building" not in worst


@pytest.mark.slow
def test_scans_are_registered_by_icp_where_that_is_how_vehicles_match(walls, places):
    exact = WallMap.of(walls.walls, np.full(walls.walls.count, 0.01))
    by_icp = replace(settings(), matcher="ICP", start_sigma=0.3)
    lines = lines_of_walls(exact, field_of_walls(exact, places, by_icp), by_icp)
    rng = np.random.default_rng(5)
    sensor = np.array([2.0, 1.0, 2.0])
    scan, = simulated_scans(exact.obstacles, sensor[None], np.zeros(1), by_icp.scanner, 360, rng)
    errors = np.array([match_error(scan.offset, sensor, lines, by_icp, rng) for _ in range(10)])
    assert np.abs(errors[:, :2]).max() < 0.01 and np.abs(errors[:, 2]).max() < 0.001
    made = accuracy_map(LocalisationMap(walls), places, by_icp)
    check = check_prediction(walls, made, by_icp, 2, 60, 3)
    assert check.observed == pytest.approx(check.predicted, rel=0.35)
    assert check.inside_converged > 0.88 and check.converged.mean() > 0.95


@pytest.mark.slow
def test_markings_are_measured_and_registered():
    # A street with dashes, edge lines and a stop line, and one across it.
    paint = [shapely.box(x, y - 0.07, x + 5, y + 0.07) for x in range(-60, 60, 12) for y in (-3.1, 0.2)]
    paint += [shapely.box(14.9, -3.0, 15.3, 0.1), shapely.box(-18.2, -3.0, -17.8, 0.1)]
    markings = marking_map(np.array(paint, object), np.full(len(paint), 0.05))
    by_paint = replace(settings(), start_sigma=0.4)
    road = places_on_roads([shapely.LineString([(-20, -1.4, 0), (20, -1.4, 0)])], 8.0)
    made = accuracy_map(LocalisationMap(None, markings), road, by_paint)
    check = check_marking_prediction(markings, made, by_paint, 1, 60, 2)
    assert check.converged.mean() > 0.9
    assert check.observed_parts[:, :2] == pytest.approx(check.predicted_parts[:, :2], rel=0.6)
    assert check.inside_converged > 0.8
    sure = marking_map(np.array(paint, object), np.full(len(paint), 0.005))
    still = replace(by_paint, marking_common=0.0, marking_noise=0.001, start_sigma=0.1)
    exact = check_marking_prediction(sure, accuracy_map(LocalisationMap(None, sure), road, still), still, 1, 10, 2)
    assert exact.observed.max() < 0.02


def test_a_scan_ends_at_its_place_within_two_cells_or_three_sigmas():
    expected = np.stack([np.diag([0.1, 0.1, 0.01]) ** 2, np.diag([0.1, 0.5, 0.01]) ** 2])
    beside = np.array([0.0, 0.99, 1.01, 1.49, 1.51])
    errors = np.zeros((2, 5, 3))
    errors[:, :, 0] = beside
    assert ends_at_place(errors, expected).tolist() == [[True, True, False, False, False],
                                                        [True, True, True, True, False]]


def test_a_city_moves_by_buildings_only_where_it_may():
    walls = _walls()
    still = displaced(walls, np.zeros(2), np.random.default_rng(1))
    assert (still.start == walls.start).all() and (still.offset == walls.offset).all()
    moved = displaced(walls, np.zeros(2), np.random.default_rng(1), common=1.0)
    shift = moved.start - walls.start
    assert (np.abs(shift) > 1e-6).all() and not np.allclose(shift[0], shift[1])
    assert moved.end - walls.end == pytest.approx(shift)


def _walls():
    from urbanmap_qgis.gnss.rays.wall_faces import building_walls

    shapes = np.array([shapely.box(0, 0, 8, 8), shapely.box(30, 0, 38, 8)], object)
    walls = building_walls(shapes, None, np.full(2, 9.0), np.zeros(2))
    first = [np.flatnonzero(walls.building == number)[0] for number in (0, 1)]
    rows = {name: getattr(walls, name)[first] for name in
            ("start", "end", "offset", "normal", "low", "top", "building") if hasattr(walls, name)}
    return replace(walls, **rows, wall=np.arange(2))
