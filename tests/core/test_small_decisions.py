"""Small decisions with known answers, each on what lies on either side of it."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from pyproj import CRS

from urbanmap_qgis.buildings.outlines.displacement_search import shift_lattice
from urbanmap_qgis.buildings.planes.level_alternative import has_lost_plane
from urbanmap_qgis.buildings.planes.plan_faces import _PlaneBorders
from urbanmap_qgis.buildings.solids.plan_partition import _cleaned
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.imagery.overlays.overlay_pictures import PointColours
from urbanmap_qgis.io.conversion.geoid import Geoid
from urbanmap_qgis.io.conversion.height_conversion import height_conversion
from urbanmap_qgis.io.official.gsi_dem import _SECONDS, PRODUCTS, _product
from urbanmap_qgis.io.reference.height_systems import HeightSystem
from urbanmap_qgis.job.recognition.layer_kind import AREAS, OUTLINES, _by_size
from urbanmap_qgis.localisation.simulation.prediction_check import EVIDENCE_OF_CELL, STEP, _fits_elsewhere
from urbanmap_qgis.localisation.simulation.simulated_scans import displaced
from urbanmap_qgis.localisation.walls.wall_cells import space_cells
from urbanmap_qgis.mobile.lines.tie_point_proposals import _cell_sums
from urbanmap_qgis.mobile.markings.intensity_calibration import _fit, _model
from urbanmap_qgis.mobile.registration.correction.disagreements import NodeStep, either_side
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.roadmap.checks.light_rules import _cosine
from urbanmap_qgis.roadmap.edges.assembly import kerb_lines
from urbanmap_qgis.roadmap.edges.courses import _turns_off
from urbanmap_qgis.roadmap.edges.profile import most_likely_change
from urbanmap_qgis.roadmap.edges.stations import Stations
from urbanmap_qgis.roadmap.lanes.movements import _offer
from urbanmap_qgis.roadspace.road_pictures import plan_picture
from urbanmap_qgis.roadspace.road_records import RoadFinding
from urbanmap_qgis.samplecity.drive.motion import LIMITS as MOTION
from urbanmap_qgis.samplecity.drive.motion import _on_wheels
from urbanmap_qgis.samplecity.gnss.signals import _beside_line_of_sight
from urbanmap_qgis.samplecity.scene.faces import FaceKind, building_faces
from urbanmap_qgis.samplecity.scene.markings import _bays
from urbanmap_qgis.samplecity.scene.model import Building, RoofPart
from urbanmap_qgis.settings.roadmap import EdgeSettings


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


@pytest.mark.parametrize(("reverse", "change"), [(False, 0.4), (True, -0.4)])
def test_corrections_between_foreign_heights_go_as_they_are_told(reverse, change):
    grid = Geoid("0.4", np.array([[0.4]]))
    systems = HeightSystem("other", 5709, "NAP height"), HeightSystem("other", 7837, "DHHN2016 height")
    found = height_conversion(CRS.from_epsg(25832).to_wkt(), *systems, grid, reverse)
    assert found.heights([500_000.0], [5_600_000.0]) == pytest.approx([change])


def test_corrections_between_japanese_heights_go_by_their_age():
    grid, older, newer = Geoid("0.4", np.array([[0.4]])), HeightSystem("JGD2011"), HeightSystem("JGD2024")
    wkt = CRS.from_epsg(6677).to_wkt()
    assert height_conversion(wkt, older, newer, grid).heights([0.0], [0.0]) == pytest.approx([0.4])
    assert height_conversion(wkt, newer, older, grid).heights([0.0], [0.0]) == pytest.approx([-0.4])
    with pytest.raises(InputError, match="Against the grid"):
        height_conversion(wkt, older, newer, grid, reverse=True)


@pytest.mark.parametrize("size", [(12.0, 6.0), (6.0, 12.0)])
def test_ridge_of_a_gable_runs_along_the_longer_side(size):
    part = RoofPart(shapely.box(100.0, 100.0, 100.0 + size[0], 100.0 + size[1]), 5.0, z_ridge=8.0)
    faces = building_faces([Building(1, "gable", 0.0, (part,), (200, 200, 200), (90, 90, 90))])
    ridge = np.unique(faces.corners[faces.kind == FaceKind.ROOF].reshape(-1, 3), axis=0)
    ridge = ridge[ridge[:, 2] > 7.9]
    assert len(ridge) == 2 and np.ptp(ridge[:, :2], axis=0).tolist() == pytest.approx(
        [12.0, 0.0] if size[0] > size[1] else [0.0, 12.0])


def test_cosine_of_directions():
    assert _cosine(np.array([3.0, 0.0]), np.array([1.0, 1.0])) == pytest.approx(0.5**0.5)
    assert _cosine(np.array([0.0, 2.0]), np.array([0.0, -5.0])) == pytest.approx(-1.0)


def test_findings_are_drawn_at_their_places():
    findings = [RoadFinding("a", "", 110.0, 240.0), RoadFinding("b", "", 900.0, 240.0)]
    drawn = plan_picture((100.0, 200.0, 140.0, 260.0), 400, [], [], findings)
    assert drawn.count("<circle") == 1 and '<circle cx="100.0" cy="200.0"' in drawn and ">1</text>" in drawn


def test_colours_of_points_run_from_low_to_high():
    values = np.array([0.0, 0.25, 0.5, 1.0])
    assert (PointColours("height", 10.0, 30.0).of(10.0 + 20.0 * values) == PointColours("height").of(values)).all()
    below, above = PointColours("height", 10.0, 30.0).of(np.array([-50.0, 90.0]))
    ends = PointColours("height").of(np.array([0.0, 1.0]))
    assert (below == ends[0]).all() and (above == ends[1]).all()


def test_a_place_is_off_by_all_steps_up_to_the_right_stretch():
    """With one step half of its square, of two any of the three stretches may be the right one."""
    nodes, known = np.arange(0.0, 110.0, 10.0), 1e-12 * np.eye(2)
    steps = [NodeStep(2, np.array([1.0, 0.0]), known, 9.0), NodeStep(7, np.array([0.0, 2.0]), known, 9.0)]
    at = np.array([5.0, 50.0, 95.0])
    first, second, both = (np.outer(change, change) for change in (steps[0].change, steps[1].change, [1.0, 2.0]))
    beside, variance = either_side(steps, nodes, at)
    assert beside.all()
    assert variance == pytest.approx(np.array([first + both, first + second, second + both]) / 3, abs=1e-9)
    assert either_side(steps[:1], nodes, at)[1] == pytest.approx(np.array([first] * 3) / 2, abs=1e-9)
    assert not either_side([], nodes, at)[0].any()
    unsure = either_side([replace(steps[0], covariance=4.0 * np.eye(2))], nodes, at)[1]
    assert unsure[0] == pytest.approx(first / 2 + 0.4 * np.eye(2))  # no more unsure than it is large


def test_lowered_and_full_kerb_share_the_station_where_they_meet():
    count = 40
    height = np.where(np.arange(count) < 20, 0.15, 0.02)
    zeros, ones = np.zeros(count), np.ones(count)
    stations = Stations(
        course=np.zeros(count, int), place=np.column_stack([0.5 * np.arange(count), zeros]),
        normal=np.column_stack([zeros, ones]), seen=np.ones(count, bool), foot=zeros.copy(), top=zeros.copy(),
        z_foot=zeros.copy(), z_top=height, sigma=0.01 * ones, sigma_z=0.01 * ones, points=np.full(count, 20),
        passes=np.ones(count, int))
    full, low = kerb_lines(stations, EdgeSettings(), np.zeros(3))
    assert full.foot[-1] == pytest.approx(low.foot[0]) and full.gap == pytest.approx(0.0)
    assert low.foot[-1, 0] == pytest.approx(0.5 * (count - 1))


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


def test_the_plainest_curve_of_intensity_is_taken_where_it_serves():
    ranges = np.linspace(3.0, 40.0, 40)
    noise = np.random.default_rng(3).normal(0.0, 0.02, len(ranges))
    level = np.log(_model(ranges, 0.0, 900.0, 0.8, 0.0)) + noise
    floor, gain, fall, near = _fit(ranges, level, np.full(len(ranges), 500.0))
    assert floor < 1e-3 * np.exp(level).min() and near == 0.0
    assert (gain, fall) == (pytest.approx(900.0, rel=0.05), pytest.approx(0.8, abs=0.02))


@pytest.mark.parametrize(("there", "offered"), [((5,), 0), ((6,), 1), ((), 1)])
def test_a_way_is_offered_unless_it_is_there(there, offered):
    lane = {number: SimpleNamespace(successors=[], centre=np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]]))
            for number in range(8)}
    lane[1].successors, lane[7].successors = [7], list(there)
    built = SimpleNamespace(lanes=lane, findings=[])
    _offer(built, 1, 5, "left", 0.4)
    assert [(one.kind, one.x, one.y) for one in built.findings] == [("way possible", 3.0, 4.0)] * offered


def test_border_between_planes_costs_by_their_step():
    """Planes that part by 0.1 m a metre northwards, along a border that runs north from 0 to 4 m: 0.2 m on average."""
    borders = _PlaneBorders(np.array([[0, 1]]), np.array([[[7.0, 0.0], [7.0, 4.0]]]), np.array([10.0]),
                            np.array([[0.0, 0.1, 5.0], [0.0, 0.0, 5.0]]))
    apart = borders.cost(slice(None), np.array([0]), np.array([1]))
    level = replace(borders, planes=np.array([[0.0, 0.0, 5.2], [0.0, 0.0, 5.0]])).cost(
        slice(None), np.array([0]), np.array([1]))
    assert apart == pytest.approx(level) and 0.0 < apart[0] < 10.0
    assert borders.cost(slice(None), np.array([1]), np.array([1])) == 0.0


def test_polygons_that_cross_themselves_are_repaired_and_others_stay():
    crossed = shapely.Polygon([(10, 10), (12, 12), (12, 10), (10, 12)])
    sound = shapely.box(20, 20, 22, 22)
    repaired, same = _cleaned(np.array([crossed, sound], object), (10.0, 10.0))
    assert repaired.is_valid and repaired.area == pytest.approx(2.0) and same.equals(shapely.box(10, 10, 12, 12))


def test_error_beside_a_free_line_of_sight_fades_with_the_detour():
    error = np.abs(_beside_line_of_sight(np.linspace(0.0, 300.0, 3000)))
    assert error.max() < 0.12 * 20.0 / np.e + 1e-9 and error[-300:].max() < 1e-3


def test_lattice_of_shifts_holds_what_lies_at_the_very_reach():
    lattice = shift_lattice(0.1, 0.3)  # three steps of 0.1 are a little more than 0.3 in floating point
    assert {(3, 0), (-3, 0), (0, 3), (0, -3)} <= set(map(tuple, lattice.tolist())) and np.abs(lattice).max() == 3


@pytest.mark.parametrize(("aside", "turns"), [(0.0, False), (0.05, False), (0.6, True), (-0.6, True)])
@pytest.mark.parametrize("way", [(1.0, 0.0), (0.0, 1.0), (0.6, 0.8)])
def test_a_stray_station_at_the_end_turns_off(way, aside, turns):
    way = np.array(way)
    places = [k * 0.5 * way for k in range(20)]
    places[-1] = places[-1] + aside * np.array([-way[1], way[0]])
    assert bool(_turns_off([(place, True) for place in places])) is turns


@pytest.mark.parametrize(("latitude", "kind"), [(0.0, "buildings"), (60.0, "areas")])
def test_polygons_in_degrees_are_as_large_as_their_latitude_makes_them(latitude, kind):
    """Squares of 5e-5 degrees: 31 m2 at the equator, half as much at 60 degrees north."""
    shapes = [shapely.box(k, latitude, k + 5e-5, latitude + 5e-5) for k in range(3)]
    found = {"buildings": OUTLINES, "areas": AREAS}[kind]
    assert _by_size(shapes, True)[0] == found


def test_deviation_of_a_change_grows_with_the_gap_that_it_lies_in():
    """Two descriptions that part sharply between -0.1 and 0.1 m: any place in the gap is as likely."""
    places = np.array([-0.4, -0.3, -0.2, -0.1, 0.1, 0.2, 0.3, 0.4])
    before, after = np.where(places < 0, 0.0, 100.0), np.where(places < 0, 100.0, 0.0)
    edge, sigma = most_likely_change(places, before, after, 0.5)
    assert edge == pytest.approx(0.0, abs=1e-6) and sigma == pytest.approx(0.2 / 12**0.5, rel=1e-3)


@pytest.mark.parametrize(("drawn", "lost"), [([1], True), ([1, 2], False)])
def test_a_plane_is_lost_that_has_points_and_no_polygon(drawn, lost):
    """Two level roofs of 36 m2, 2 m apart in height; polygons of the lower one cover both."""
    x, y = (values.ravel() for values in np.meshgrid(np.arange(0.25, 12.0, 0.5), np.arange(0.25, 6.0, 0.5)))
    roof = np.where(x < 6.0, 1, 2)
    points = np.column_stack([x, y, np.where(roof == 1, 8.0, 10.0)])
    polygons = [shapely.force_3d(shapely.box(0, 0, 12, 6), 8.0)] * len(drawn)
    assert has_lost_plane(polygons, drawn, points, roof, 4.0, 10.0) is lost


@pytest.mark.parametrize(("peak", "elsewhere"), [((20, 20), False), ((5, 30), True)])
def test_a_scan_fits_elsewhere_by_its_points_above_the_road(peak, elsewhere):
    asked = []

    def shifted(places, most):
        asked.append((places, most))
        surface = np.zeros((2 * most + 1, 2 * most + 1))
        surface[peak] = 50.0 / EVIDENCE_OF_CELL
        return surface

    settings = SimpleNamespace(search=20 * STEP, scanner=SimpleNamespace(height=2.0))
    scan = np.array([[4.0, 1.0, -1.95], [6.0, 0.0, -1.0], [6.0, 2.0, 3.0]])  # the first is of the road
    found = _fits_elsewhere(SimpleNamespace(field=SimpleNamespace(shifted=shifted)), scan, np.array([10.0, 20.0, 2.0]),
                            settings)
    assert found is elsewhere
    (places, most), = asked
    assert places.tolist() == [[16.0, 20.0], [16.0, 22.0]] and most == 20


def test_fractions_of_a_part_run_within_the_whole():
    told = []
    part = Progress(told.append).part(0.5, 1.0).part(0.25, 0.75)
    for fraction in (0.0, 0.5, 1.0):
        part.step(fraction)
    assert told == pytest.approx([0.625, 0.75, 0.875])


def test_bays_of_a_parking_lot_are_five_metres_long_or_as_long_as_it_is_wide():
    ground = SimpleNamespace(to_local=lambda x, y: (x, y))
    for width, length in ((20.0, 5.0), (4.0, 2.8)):
        lines = [marking.plan.bounds for marking in _bays(ground, shapely.box(100.0, 50.0, 130.0, 50.0 + width))]
        assert len(lines) == 12 and all(top - bottom == pytest.approx(length) for _, bottom, _, top in lines)
        assert {bottom for _, bottom, _, _ in lines} == {50.6}


@pytest.mark.parametrize("first", [0, 1, 7])
def test_points_are_summed_up_by_cells(first):
    key = np.array([first + 3, first, first + 3, first])
    values = np.array([[1.0, 10.0, 5.0], [2.0, 20.0, 6.0], [3.0, 30.0, 7.0], [4.0, 40.0, 8.0]])
    found, sums, lowest, highest = _cell_sums(key, values, np.array([1.5, 9.0, 4.5, 2.0]))
    assert found.tolist() == [first, first + 3]
    assert sums.tolist() == [[6.0, 60.0, 14.0, 2.0], [4.0, 40.0, 12.0, 2.0]]
    assert lowest.tolist() == [2.0, 1.5] and highest.tolist() == [9.0, 4.5]


@pytest.mark.parametrize(("product", "metres"), PRODUCTS.items())
def test_a_product_of_the_gsi_is_known_by_its_cells(product, metres):
    source = SimpleNamespace(name="x.xml")
    assert PRODUCTS[_product(None, _SECONDS[metres] / 3600, source)] == metres
    with pytest.raises(InputError, match=r"cells of 3\.000 seconds"):
        _product(None, 3.0 / 3600, source)


def test_a_vehicle_s_springs_soften_a_step_of_the_road():
    """A step of 10 cm all across, over which the vehicle drives at 10 m/s."""
    x = np.zeros(400)
    y = np.arange(400) * 10.0 / MOTION.rate
    height, roll, pitch = _on_wheels(lambda east, north: np.where(north > y[200], 0.1, 0.0), x, y, np.zeros(400))
    assert height[0] == pytest.approx(0.0, abs=1e-6) and height[-1] == pytest.approx(0.1, abs=1e-6)
    assert np.abs(roll).max() < 1e-9 and pitch.max() > 0.1 and pitch.min() > -1e-9
    rise = np.diff(height)
    assert 0.0 < rise.max() < 0.1 / (0.15 * MOTION.rate)
