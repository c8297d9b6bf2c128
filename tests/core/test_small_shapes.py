"""Small known answers in the plane: corners, holes, faces and what stands behind them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
import shapely.affinity
from pyproj import CRS
from rasterio import Affine

from tests.core.test_cityjson import houses
from tests.solid_files import read_solids, write_solids
from urbanmap_qgis.aerial.markings.marking_report import _draw
from urbanmap_qgis.buildings.merging.plan_edges import _corners
from urbanmap_qgis.buildings.mesh25d.mesh_quality import wall_boxes
from urbanmap_qgis.buildings.mesh25d.tin import Tin
from urbanmap_qgis.buildings.solids.manifold import _Corner, _fill_dips
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.geometry.sampling import sample
from urbanmap_qgis.geometry.solid import OUTER_WALL, Solid
from urbanmap_qgis.gnss.walls.moved_buildings import _Follower
from urbanmap_qgis.gnss.walls.offset_observations import _pass_observations
from urbanmap_qgis.gnss.walls.signal_strength import expected_cn0
from urbanmap_qgis.io.pages.svg_profile import Series, profile
from urbanmap_qgis.job.agreement import extent_in_degrees
from urbanmap_qgis.job.file_facts import GSI_DEM, GSI_OTHER, GSI_OUTLINES, POINTS, FileFacts
from urbanmap_qgis.job.recognition.xml_facts import _gsi_kind
from urbanmap_qgis.localisation.evidence.marking_map import marking_evidence
from urbanmap_qgis.localisation.report.localisation_pictures import _markings
from urbanmap_qgis.localisation.walls.wall_cells import space_cells
from urbanmap_qgis.mobile.boresight.adjustment import _pairs as _plane_pairs
from urbanmap_qgis.mobile.registration import report
from urbanmap_qgis.mobile.registration.matching.ndt_map import build_ndt
from urbanmap_qgis.mobile.registration.matching.windows import choose_windows
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.roadmap.edges.uprights import Uprights, _directions, _measure
from urbanmap_qgis.roadmap.lanes.intersections import add_intersections
from urbanmap_qgis.roadmap.lines.dash_consensus import _usual
from urbanmap_qgis.roadmap.lines.line_fit import fit_centre_line
from urbanmap_qgis.roadmap.lines.symbol_patterns import CELL, raster
from urbanmap_qgis.roadmap.map_records import Bound, MapLane, VectorMap
from urbanmap_qgis.roadmap.vector_map import _refer
from urbanmap_qgis.samplecity.gnss.rays import _plan_crossing
from urbanmap_qgis.samplecity.laser.raycast import _slab


@pytest.mark.parametrize("turn", [0.0, 30.0, 45.0, 110.0])
def test_nodes_on_a_straight_edge_are_no_corners_in_any_direction(turn):
    ring = shapely.Polygon([(0, 0), (10, 0), (10, 6), (0, 6)]).segmentize(2.5)
    turned = shapely.affinity.rotate(ring, turn, origin=(0, 0))
    xy = shapely.get_coordinates(turned)[:-1]
    found = {tuple(place) for place in xy[_corners(xy)].round(6)}
    wanted = shapely.get_coordinates(shapely.affinity.rotate(shapely.box(0, 0, 10, 6), turn, origin=(0, 0))).round(6)
    assert found == {tuple(place) for place in wanted}


def test_a_ring_of_paint_keeps_its_hole_and_what_lies_beside_it():
    ring = shapely.box(-1.0, -1.0, 1.0, 1.0).difference(shapely.box(-0.5, -0.5, 0.5, 0.5))
    bar = shapely.box(2.0, -1.0, 2.5, 1.0)
    for shapes in ([ring], [bar, ring], [ring, bar]):
        assert raster(shapes).sum() * CELL**2 == pytest.approx(sum(one.area for one in shapes), rel=0.1)


@pytest.mark.parametrize("high, backed", [((1.2, 2.0), True), ((2.5, 6.0), False), ((0.3, 0.8), False)])
def test_a_rail_is_backed_by_what_is_as_high_as_a_vehicle(high, backed):
    """A cabin behind the side of a lorry, not a tree or a facade over it, nor what is no higher than the rail."""
    rng = np.random.default_rng(1)
    across = np.concatenate([rng.normal(0.0, 0.005, 60), rng.uniform(0.3, 1.0, 40)])
    up = np.concatenate([np.linspace(0.05, 0.8, 60), np.linspace(*high, 40)])
    points = np.zeros(100, [("z", "f8"), ("drive", "i4")])
    points["z"] = 20.0 + up
    one = np.zeros(1)
    stations = Uprights(one.astype(int), np.zeros((1, 2)), np.array([[1.0, 0.0]]), *[one + np.nan for _ in range(5)],
                        one.astype(np.int64), one.astype(np.int64), one.astype(bool), one.astype(bool))
    _measure(stations, 0, across, up, points)
    assert stations.height[0] == pytest.approx(0.8, abs=0.02) and stations.ground[0] == pytest.approx(20.0)
    assert stations.backed[0] == backed


def test_a_refined_surface_has_no_point_in_a_triangles_circle():
    rng = np.random.default_rng(4)
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
    surface = Tin(corners, np.zeros(4), [[0, 1, 2, 3]])
    xy = rng.uniform(0.5, 9.5, (60, 2))
    surface.refine(xy, rng.uniform(0.0, 5.0, 60), 0.01, 40)
    places = np.array(surface.xy)
    assert len(places) == 44
    for triangle in surface.triangles.values():
        a, b, c = places[list(triangle)]
        centre = np.linalg.solve(2 * np.array([b - a, c - a]), [b @ b - a @ a, c @ c - a @ a])
        assert np.hypot(*(places - centre).T).min() > np.hypot(*(a - centre)) * (1 - 1e-4)


def test_the_box_of_a_slanting_wall_has_the_mean_of_its_two_ends():
    lower, upper = [(80, 40, 2), (90, 40, 4), (90, 40, 9), (80, 40, 5)], [(80, 40, 5), (90, 40, 9), (90, 40, 11)]
    faces = (((0, 1, 2, 3),), ((4, 5, 6),))
    mesh = Solid(np.array([*lower, *upper], float), faces, (OUTER_WALL, OUTER_WALL), (0, 0))
    assert wall_boxes(mesh).tolist() == [[80.0, 40.0, 90.0, 40.0, 3.0, 8.0]]


def test_a_window_counts_the_cells_that_hold_enough_points():
    """Patches of 3, 1, 2 and 0 points in one cell each; windows of two."""
    patch = np.array([0, 0, 0, 1, 2, 2])
    x = np.where(patch == 0, 0.5, np.where(patch == 1, 5.5, 9.5))
    settings = RegistrationSettings(window_patches=2, feature_count=1, feature_points=2, feature_grid=1.0,
                                    max_window_patches=2, extend_at_end=True)
    found = choose_windows(x, np.zeros(6), patch, 4, settings)
    assert (found.first.tolist(), found.last.tolist()) == ([0, 0, 1, 2], [0, 1, 2, 3])
    assert found.features.tolist() == [1, 1, 1, 1]


def test_the_band_of_a_chart_lies_a_sigma_to_either_side_of_its_curve():
    x, values = np.linspace(0.0, 9.0, 10), np.linspace(1.0, 3.0, 10)
    page = profile(x, [Series("a", values)], "s", "m", (values, np.full(10, 0.5)))
    band = np.array([pair.split(",") for pair in re.search(r'<polygon points="([^"]*)"', page)[1].split()], float)
    upper, lower = band[:10], band[10:][::-1]
    slope = (upper[0, 1] - upper[-1, 1]) / 2.0  # of the picture, for a metre
    assert slope > 0 and lower[:, 1] - upper[:, 1] == pytest.approx(slope * 1.0, abs=0.2)


def test_values_fill_the_height_of_a_chart():
    """From 0 at the foot to the largest, above which a twentieth of the height is left; 12 px above, 40 px below."""
    page = profile(np.array([0.0, 1.0]), [Series("a", np.array([0.0, 2.0]), dots=True)], "s", "m", height=240)
    foot, top = (float(place) for place in re.findall(r'<circle cx="[^"]*" cy="([^"]*)"', page))
    assert foot == pytest.approx(200.0, abs=0.1) and top == pytest.approx(200.0 - 188.0 / 1.05, abs=0.1)


def test_a_sequence_may_have_buildings_in_its_first_line(tmp_path):
    write_solids(tmp_path / "a.city.json", houses())
    text = (tmp_path / "a.city.json").read_text(encoding="utf-8").replace("\n", "")
    (tmp_path / "a.city.jsonl").write_text(text + "\n", encoding="utf-8")
    assert [house.id for house in read_solids(tmp_path / "a.city.jsonl")] == ["家 1", "b2", "b3"]


def test_outlines_are_drawn_where_the_markings_lie():
    """A square of 10 pixels from column 20, row 30 of the image, drawn two to one in the part that begins at 10, 10."""
    image = np.zeros((40, 40, 3), np.uint8)
    ring = shapely.box(100.0 + 20 * 0.1, 500.0 - 40 * 0.1, 100.0 + 30 * 0.1, 500.0 - 30 * 0.1)
    _draw(image, np.array([ring], object), ~Affine(0.1, 0, 100.0, 0, -0.1, 500.0), (10, 10, 80, 80), 2.0)
    rows, columns = np.nonzero(image.any(axis=2))
    assert (columns.min(), columns.max()) == (pytest.approx(4.5, abs=1.5), pytest.approx(9.5, abs=1.5))
    assert (rows.min(), rows.max()) == (pytest.approx(9.5, abs=1.5), pytest.approx(14.5, abs=1.5))
    assert image[11:13, 6:8].max() < 30


def lane_map(*lanes):
    """A map of lanes, each of its kind and its left and right bounds as places in plan."""
    built = VectorMap(left_hand=True)
    for kind, *sides in lanes:
        for side in sides:
            built.nodes += [np.array([*place, 0.0]) for place in side]
            built.bounds.append(Bound(list(range(len(built.nodes) - len(side), len(built.nodes))), "virtual"))
        centre = np.column_stack([np.mean([sides[0][k] for k in (0, -1)], axis=0),
                                  np.mean([sides[0][-1], sides[1][-1]], axis=0)]).T
        built.lanes.append(MapLane(len(built.bounds) - 2, len(built.bounds) - 1, True, True,
                                   np.column_stack([centre, np.zeros(2)]), 3.0, 3.0, kind, "", "straight"))
    return built


BULGING = ("virtual", [(0, 3), (5, 7), (10, 3)], [(0, 0), (5, 4), (10, 0)])
BESIDE = [("lane", [(-40, 9), (0, 9)], [(-40, 6), (0, 6)]), ("lane", [(10, 9), (50, 9)], [(10, 6), (50, 6)])]


@pytest.mark.parametrize("more, corners", [
    (BESIDE, {(0, 0), (10, 0), (10, 3), (10, 6), (10, 9), (0, 9), (0, 6), (0, 3)}),  # as wide as the roads beside
    ([*BESIDE, ("lane", [(2, 9), (8, 9)], [(2, 7), (8, 7)])], None),  # but for a lane that would lie in it
    ([], None)])
def test_the_area_of_a_way_that_bulges_takes_the_roads_beside_in(more, corners):
    built = lane_map(BULGING, *more)
    add_intersections(built)
    found = [({tuple(built.nodes[node][:2]) for node in one.ring}, one.lanes) for one in built.intersections]
    assert found == ([(corners, [0])] if corners else [])


def test_a_way_past_a_lane_stays_out_of_the_area():
    """Else the area would lie about the lane, which is no way through it."""
    short, long = ("virtual", [(0, 3), (10, 3)], [(0, 0), (10, 0)]), ("virtual", [(0, 6), (70, 6)], [(0, 3), (70, 3)])
    beside = ("lane", [(20, 2.5), (30, 2.5)], [(20, 1.5), (30, 1.5)])
    built = lane_map(short, long, beside)
    add_intersections(built)
    assert [one.lanes for one in built.intersections] == [[0]]
    alone = lane_map(short, long)
    add_intersections(alone)
    assert [one.lanes for one in alone.intersections] == [[0, 1]]


def test_a_level_ray_is_in_a_slab_all_along_or_never():
    origin, direction = np.array([[0.0, 0.5, 5.0]]), np.array([[1.0, 0.0, 0.0]])
    enter, leave = _slab(origin, direction, np.array([2.0, 0.0, 0.0]), np.array([3.0, 1.0, 1.0]))
    assert enter.tolist() == [[2.0, -np.inf, np.inf]] and leave.tolist() == [[3.0, np.inf, -np.inf]]


@pytest.mark.parametrize("extent, known", [((139.0, 35.0, 140.0, 36.0), True), ((-10.0, -90.0, 360.0, 90.0), True),
                                           ((0.0, 0.0, 9.0, 91.0), False), ((0.0, 0.0, 361.0, 9.0), False)])
def test_degrees_off_the_earth_are_no_extent(extent, known):
    facts = FileFacts(Path("a.csv"), POINTS, crs_wkt=CRS.from_epsg(4326).to_wkt(), extent=extent)
    assert extent_in_degrees(facts) == (extent if known else None)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_points_beyond_a_map_fall_on_its_outermost_empty_cells(dimensions):
    found = build_ndt(np.random.default_rng(2).uniform(0.0, 6.0, (400, dimensions)), 2.0)
    middle = np.array(found.shape) * found.cell / 2
    for axis in range(dimensions):
        for side, at in ((-1, 0), (1, found.shape[axis] - 1)):
            place = middle.copy()
            place[axis] += side * 100.0
            cell = np.unravel_index(found.cells_of(place[None]), found.shape)
            assert cell[axis] == at and found.number[found.cells_of(place[None])] == -1


def test_a_line_of_sight_crosses_an_edge_at_its_distance_in_plan():
    a, b = np.array([[6.0, -2.0], [6.0, 1.0], [-3.0, 2.0]]), np.array([[2.0, 6.0], [6.0, 9.0], [4.0, 2.0]])
    start, direction = np.zeros((3, 2)), np.array([[3.0, 3.0], [2.0, 0.0], [0.0, 5.0]])
    distance, crosses = _plan_crossing(a, b, start, direction)
    assert distance == pytest.approx([np.hypot(10 / 3, 10 / 3), 6.0, 2.0]) and crosses.tolist() == [True, False, True]


@dataclass
class StrengthTable:
    """What of the table of signals tells their strength."""

    system: np.ndarray
    cn0: np.ndarray
    elevation: np.ndarray

    def __len__(self):
        return len(self.system)


def test_usual_strength_is_that_of_free_signals_of_the_same_system():
    """GPS: 40 free ones at 45 dB-Hz, as many blocked at 20; Galileo: 40 free ones at 35, few of GLONASS."""
    system = np.repeat(["G", "E", "R"], [80, 50, 9])
    strength = np.repeat([45.0, 20.0, 35.0, 50.0, 40.0], [40, 40, 40, 10, 9])
    free = np.repeat([True, False, True, False, True], [40, 40, 40, 10, 9])
    usual = expected_cn0(StrengthTable(system, strength, np.full(139, 55.0)), free)
    assert (usual[:130] == np.where(system[:130] == "G", 45.0, 35.0)).all() and np.isnan(usual[130:]).all()


def test_a_corner_on_an_edge_moves_with_its_share_of_the_ends():
    walls = SimpleNamespace(start=np.array([[0.0, 0.0], [8.0, 0.0]]), end=np.array([[8.0, 0.0], [8.0, 8.0]]))
    net = SimpleNamespace(node=np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 8.0]]), start=np.array([0, 1]),
                          end=np.array([1, 2]))
    follow = _Follower(walls, net, np.array([[1.0, 2.0], [3.0, -2.0], [3.0, 4.0]]), np.array([0, 1, 2]))
    places = np.array([[0.0, 0.0, 5.0], [2.0, 0.0, 6.0], [8.0, 6.0, 7.0], [3.0, 3.0, 8.0]])
    assert follow(places).tolist() == [[1.0, 2.0, 5.0], [3.5, 1.0, 6.0], [11.0, 8.5, 7.0], [3.0, 3.0, 8.0]]


def test_markings_are_drawn_along_their_course_as_long_as_they_are():
    """Of two pieces within the picture, half a metre of one to the east and all of a short one to the north."""
    city = SimpleNamespace(markings=SimpleNamespace(
        xy=np.array([[5.0, 5.0], [8.0, 2.0], [50.0, 5.0]]), normal=np.array([[0.0, 1.0], [1.0, 0.0], [0.0, 1.0]]),
        length=np.array([2.0, 0.25, 2.0])))
    drawn = _markings(city, lambda xy: 100.0 * xy, np.zeros(2), np.full(2, 10.0))
    ends = [sorted([float(number) for number in pair.split()] for pair in re.split("[ML]", line)[1:3]) for line in
            re.findall(r"M[^M\"]+", drawn)]
    assert ends == [[[475.0, 500.0], [525.0, 500.0]], [[800.0, 187.5], [800.0, 212.5]]]


def test_a_lane_refers_to_the_stop_line_right_at_its_end_alone():
    """Of two oblique lines that come near its end, one crosses the lane there and one seven metres before."""
    built = lane_map(("lane", [(0, 1.5), (20, 1.5)], [(0, -1.5), (20, -1.5)]))
    built.lanes[0].centre = np.array([[0.0, 0, 0], [5.0, 0, 0], [20.0, 0, 0]])
    crossing, before = np.array([[19.0, -2.0, 0], [20.5, 2.0, 0]]), np.array([[12.0, -0.5, 0], [20.0, 3.5, 0]])
    _refer(built, [crossing, before], [])
    assert built.lanes[0].stop_lines == [0] and [one.kind for one in built.findings] == ["stop line without lane"]


def test_places_on_a_line_are_a_thin_line_and_a_heap_is_none():
    rng = np.random.default_rng(5)
    along = np.column_stack([np.linspace(0.0, 4.0, 60), np.linspace(0.0, 3.0, 60)]) + rng.normal(0.0, 0.01, (60, 2))
    normal, thin = _directions(along)
    assert thin[5:-5].all() and np.abs(normal[5:-5] @ [0.6, -0.8]).min() > 0.99
    assert not _directions(rng.uniform(0.0, 1.0, (200, 2)))[1][10:].any()


@pytest.mark.parametrize("angle, alike", [(11.0, True), (14.0, False), (75.0, False)])
def test_planes_that_face_alike_are_pairs(angle, alike):
    turned = np.radians(angle)
    normal = np.array([[1.0, 0, 0], [np.cos(turned), np.sin(turned), 0]])
    patches = SimpleNamespace(group=np.array([0, 1]), normal=normal)
    first, second = _plane_pairs(patches, np.array([[0.0, 0, 0], [0.1, 0, 0]]), 0.5)
    assert (len(first), len(second)) == (alike, alike)


def test_walls_in_space_stand_between_their_low_and_their_top():
    """A wall five metres to the east, from 3 to 7 m above the ground, over a level road."""
    walls = SimpleNamespace(start=np.array([[5.0, -3.0]]), end=np.array([[5.0, 3.0]]), low=np.array([[3.0, 3.0]]),
                            top=np.array([[7.0, 7.0]]), normal=np.array([[-1.0, 0.0]]), wall=np.array([0]))
    city = SimpleNamespace(walls=walls, sigma=np.array([0.05]),
                           obstacles=SimpleNamespace(inside=lambda places: np.zeros(len(places), bool)))
    found = space_cells(city, 1.0, 20.0, 0.0, np.zeros(2), 10.0, 0.05)
    z = (found.mean + found.origin)[:, 2]
    assert np.allclose(z[z < 1.0], 0.0) and 3.0 < z[z > 1.0].min() < 4.0 and 6.0 < z[z > 1.0].max() < 7.0


@pytest.mark.parametrize("empty", range(4))
def test_heights_beside_an_empty_cell_are_weighted_among_the_others(empty):
    grid = Grid(0.0, 2.0, 1.0, 2, 2)
    raster, weight = np.array([1.0, 2.0, 3.0, 7.0]), np.array([0.75 * 0.4, 0.25 * 0.4, 0.75 * 0.6, 0.25 * 0.6])
    left = np.arange(4) != empty
    wanted = weight[left] @ raster[left] / weight[left].sum()
    raster[empty] = np.nan
    assert sample(grid, raster.reshape(2, 2), np.array([0.75]), np.array([0.9])) == pytest.approx([wanted])


def test_a_marking_informs_by_its_length_and_by_the_square_of_its_noise():
    markings = SimpleNamespace(xy=np.array([[5.0, 0.0], [5.0, 0.0], [0.0, 20.0]]), sigma=np.full(3, 0.03),
                               normal=np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), length=np.array([0.5, 0.25, 0.5]),
                               marking=np.arange(3))
    settings = SimpleNamespace(marking_noise=0.04, detection=0.6, marking_common=0.02)
    told = marking_evidence(markings, np.zeros(3, int), np.arange(3), np.zeros((1, 3)), settings)
    assert told.weight == pytest.approx([0.6 / 0.05**2 * 1.0, 0.6 / 0.05**2 * 0.5, 0.6 / (0.03**2 + 0.08**2)])


def test_the_gap_of_a_line_is_known_worse_than_its_paint():
    paint = shapely.STRtree([shapely.box(0.0, -0.075, 15.0, 0.075), shapely.box(27.0, -0.075, 42.0, 0.075)])
    found = fit_centre_line(np.array([[0.0, 0.0], [42.0, 0.0]]), 0.15, paint)
    gap = (found.chainage > 20.0) & (found.chainage < 22.0)
    assert not found.covered[gap].any() and found.sigma[gap].min() > 0.03
    assert found.sigma[(found.chainage > 3.0) & (found.chainage < 12.0)].max() < 0.02


@pytest.mark.parametrize("head, kind", [
    (b"<BldA gml:id='a'>", ("outlines", "BldA")), (b"<Dataset><BldL>", ("outlines", "BldL")),
    (b"<DEM>", ("dem", "DEM")), (b"<RdEdg gml:id='K1'>", ("other", "RdEdg"))])
def test_gsi_files_are_known_by_their_features(head, kind):
    names = {GSI_OUTLINES: "outlines", GSI_DEM: "dem", GSI_OTHER: "other"}
    found, detail = _gsi_kind(head)
    assert (names[found], detail) == kind


def test_the_usual_dash_is_the_median_of_those_near_the_pattern():
    dashes = np.cumsum(np.array([[0.0, 5.0], [5.0, 5.2], [5.0, 5.4], [5.0, 9.5], [5.0, 1.0]]).ravel()).reshape(-1, 2)
    assert _usual(SimpleNamespace(dashes=dashes, dash=5.0)) == pytest.approx(5.2)


def test_the_corners_beside_a_dip_say_how_narrow_it_is():
    corners = [_Corner(k, k + 1, k, height, angle) for k, (height, angle) in
               enumerate([(5, 2.0), (2, 1.8), (4, 0.3), (0, 2.1)])]
    (dip,) = [repair for repair in _fill_dips(corners, 1) if len(repair.corners) == 1 and repair.corners[0].height == 2]
    assert dip.target == 2 and dip.narrowest == 0.3


def test_few_signals_of_a_satellite_are_no_observation():
    """Three signals of one satellite in a block and one of another, 20 m from the wall, 0.5 m longer than predicted."""
    walls, signals = SimpleNamespace(wall=np.array([4])), SimpleNamespace(
        satellite=np.array(["G01", "G01", "G01", "G02"]), time=np.array([0.0, 1.0, 2.0, 0.0]), sigma=np.full(4, 1.0))
    reflections = SimpleNamespace(select=lambda rows: SimpleNamespace(
        piece=np.zeros(len(rows), int), distance=np.full(len(rows), 20.0), cosine=np.full(len(rows), 0.8)))
    clock = SimpleNamespace(rows=np.arange(4), corrected=np.array([32.4, 32.5, 32.6, 40.0]), unit_weight=1.0,
                            white=np.zeros(4), share=np.ones((4, 2)))
    paths = SimpleNamespace(reflections=reflections, reflection=np.arange(4))
    found, shares = _pass_observations(walls, signals, paths, np.ones(4, bool), clock, np.zeros(5), 30.0, 2)
    assert len(found) == 1 and found[0] == pytest.approx([4.0, 0.0, 0.0, 0.5, 0.8, 20.0, 1.57 / 3, 3.0])
    assert shares.shape == (1, 2)


def test_pictures_of_windows_show_points_before_and_after_where_they_lie(monkeypatch):
    """One point three metres east and two north of the window's middle, moved by a metre to the west."""
    size = round(report._SIDE / report._PIXEL)
    monkeypatch.setattr(report, "_background", lambda *_: np.zeros((size, size, 3), np.uint8))
    survey = SimpleNamespace(
        correction=SimpleNamespace(value=np.zeros((1, 6)), time=np.array([0.0, 1.0])),
        windows=SimpleNamespace(place=np.array([[50.0, 60.0, 5.0]]), window_first=np.array([0]),
                                window_last=np.array([1])),
        markings=SimpleNamespace(x=np.array([53.01, 53.0]), y=np.array([62.01, 62.0]), z=np.zeros(2),
                                 time=np.array([0.5, 9.0])))
    moved = SimpleNamespace(translations=lambda points, time: np.tile([-1.0, 0.0, 0.0], (len(points), 1)))
    picture = report._picture(survey, 0, moved, None, None)
    rows, columns = np.nonzero(picture.any(axis=2) & ~(picture == 255).all(axis=2))
    east = ((columns % (size + 6)) + 0.5) * report._PIXEL - report._SIDE / 2
    north = report._SIDE / 2 - (rows + 0.5) * report._PIXEL
    assert east == pytest.approx([3.0, 2.0], abs=0.05) and north == pytest.approx([2.0, 2.0], abs=0.05)
