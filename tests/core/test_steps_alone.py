"""Steps inside a stage, each alone with a known answer: in a whole stage the steps around them make up for a fault."""

from __future__ import annotations

import datetime
import multiprocessing
import re
import time
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.markings.orthophoto_reader import _in_blocks
from urbanmap_qgis.buildings.planes.plane_segmentation import _seen_inside, _spread, _without_strips
from urbanmap_qgis.buildings.planes.step_lines import _longest
from urbanmap_qgis.buildings.segmentation import BUFFER, _ground_part
from urbanmap_qgis.citymodel.checks.feature_walk import _coordinates
from urbanmap_qgis.citymodel.citygml.value_reader import generic_value
from urbanmap_qgis.citymodel.model import Measure
from urbanmap_qgis.citymodel.tables.table_store import TableStore
from urbanmap_qgis.execution import end_workers_but
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.gnss.walls.adjustment import ADJUSTED, HELD, LIKELY, NOT_OBSERVABLE, WallResult
from urbanmap_qgis.gnss.walls.offset_posterior import ErrorModel, _derivatives, _learnt
from urbanmap_qgis.localisation.places.place_status import GOOD, NONE, POOR
from urbanmap_qgis.localisation.report import localisation_pictures
from urbanmap_qgis.mobile.adjustment.planes import _Pair
from urbanmap_qgis.mobile.adjustment.reference_steps import LIMITS as STEP_LIMITS
from urbanmap_qgis.mobile.adjustment.reference_steps import MIN_CHANGE, _Course, _of_reference
from urbanmap_qgis.mobile.lines.course_heights import _fitted, _inverse_bands, _most_likely, _solve
from urbanmap_qgis.mobile.lines.rectification import BETWEEN
from urbanmap_qgis.mobile.lines.rectification_report import course_map
from urbanmap_qgis.mobile.survey_tiles import _meet, _within
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.roadmap.comparison.map_elements import _crosswalk, elements_of_lines
from urbanmap_qgis.roadmap.edges.assembly import LIMITS as EDGE_LIMITS
from urbanmap_qgis.roadmap.edges.assembly import _carry_low
from urbanmap_qgis.roadmap.lanes import beyond_junctions
from urbanmap_qgis.roadmap.lanes.section_preparation import STOP_REACH, _belongs
from urbanmap_qgis.roadmap.lines.line_chains import StrokeChain
from urbanmap_qgis.roadmap.lines.stop_lines import _at_end
from urbanmap_qgis.roadmap.map_records import lines_of
from urbanmap_qgis.roadmap.objects import street_objects
from urbanmap_qgis.roadspace.road_surface import GRID, _crosses
from urbanmap_qgis.samplecity.scene.markings import _bays
from urbanmap_qgis.samplecity.scene.paint import value_noise
from urbanmap_qgis.sources import sources_mark


def test_running_core_has_the_mark_of_its_sources():
    assert re.fullmatch(r"[0-9a-f]{16}", sources_mark())


def test_only_workers_started_since_are_ended():
    context = multiprocessing.get_context("fork")
    before, after = (context.Process(target=time.sleep, args=(60,), daemon=True) for _ in range(2))
    before.start()
    others = set(multiprocessing.active_children())
    after.start()
    try:
        end_workers_but(others)
        after.join(10)
        assert after.exitcode is not None and before.exitcode is None
    finally:
        before.kill()


# GNSS


def test_walls_that_are_adjusted_or_likely_are_moved():
    walls = SimpleNamespace(status=np.array([ADJUSTED, LIKELY, NOT_OBSERVABLE, HELD]))
    assert WallResult.is_moved.fget(walls).tolist() == [True, True, False, False]


@pytest.mark.parametrize("count", [0, 7, 300])
def test_learnt_shares_hold_the_prior_of_twenty_observations(count):
    share = np.zeros((3, count))
    share[0] = 1.0
    model = _learnt(ErrorModel(), share, np.zeros(count), np.zeros(count), np.zeros(count))
    assert model.nlos_share == pytest.approx(0.2 * 20 / (count + 20))
    assert model.outlier_share == pytest.approx(0.1 * 20 / (count + 20))
    assert model.nlos_mean_delay == pytest.approx(4.0)


def test_slope_and_curvature_of_an_errors_density_are_those_of_its_parts():
    model, variance, step = ErrorModel(), np.full(60, 0.04), 1e-4
    error = np.linspace(-3.0, 12.0, 60)
    logs = np.stack([model.log_parts(error + k * step, variance) for k in (-1, 0, 1)])
    share = model.shares(error, variance)
    slope, curvature = _derivatives(model, error, variance)
    assert slope == pytest.approx(-(share * (logs[2] - logs[0])).sum(axis=0) / (2 * step), abs=1e-5)
    bent = -(logs[2] - 2 * logs[1] + logs[0]) / step**2
    assert curvature == pytest.approx((share * np.maximum(bent, 0.0)).sum(axis=0), abs=1e-4)


# Orthophotos


@pytest.mark.parametrize("shape", [(6, 9), (7, 10), (5, 4)])
def test_blocks_are_means_of_three_by_three_pixels_and_the_last_ones_go_over_the_edge(shape):
    rng = np.random.default_rng(3)
    band, seen = rng.integers(0, 255, shape).astype(np.uint8), rng.random(shape) < 0.9
    (mean,), whole = _in_blocks(band[None], seen, 3)
    assert mean.shape == whole.shape == (-(-shape[0] // 3), -(-shape[1] // 3))
    padding = [(0, -size % 3) for size in shape]
    wide, wide_seen = np.pad(band.astype(float), padding, "edge"), np.pad(seen, padding, "edge")
    for row, column in np.ndindex(*mean.shape):
        block = np.s_[3 * row:3 * row + 3, 3 * column:3 * column + 3]
        assert mean[row, column] == pytest.approx(wide[block].mean(), abs=1e-3)
        assert whole[row, column] == wide_seen[block].all()


# Roofs


def squares(*places):
    """Points of level squares of 4 m at places, and of a strip 0.3 m wide, with their labels."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0, 4, 0.3), np.arange(0, 4, 0.3)))
    points = [np.column_stack([x + east, y, np.full(len(x), height)]) for east, height in places]
    strip = np.column_stack([np.full(14, 20.0), np.arange(14) * 0.3, np.full(14, 9.0)])
    points.insert(1, strip)
    return np.vstack(points), np.repeat(np.arange(len(points)), [len(part) for part in points])


def test_planes_left_without_strips_are_numbered_on():
    points, label = squares((0.0, 5.0), (30.0, 7.0))
    left = _without_strips(points, label, 0.4)
    assert np.array_equal(left, np.select([label == 0, label == 2], [0, 1], -1))


def test_planes_left_without_neighbours_are_numbered_on():
    label = np.repeat([0, 1, 2, -1], [10, 10, 10, 2])
    inside = np.repeat([True, False, True, True], [10, 10, 10, 2])
    assert np.array_equal(_seen_inside(label, inside), np.repeat([0, -1, 1, -1], [10, 10, 10, 2]))


@pytest.mark.parametrize("slope", [(0.0, 0.0), (0.4, -0.2), (1.6, 0.3), (-2.5, 0.0)])
def test_points_join_the_plane_that_they_lie_on_square_to_it(slope):
    rng = np.random.default_rng(5)
    xy = rng.uniform(0.0, 5.0, (200, 2))
    chosen = np.column_stack([xy, xy @ slope + 3.0])
    lean = np.hypot(1.0, np.hypot(*slope))
    near, off = chosen.copy(), chosen.copy()
    near[:, 2] += 0.15 * lean
    off[:, 2] += 0.25 * lean
    label = np.zeros(len(xy), int)
    assert (_spread(near, chosen, label, 0.2) == 0).all() and (_spread(off, chosen, label, 0.2) == -1).all()


def test_ground_of_a_tile_reaches_beyond_its_outlines_to_all_sides():
    grid, heights = Grid(0.0, 500.0, 5.0, 100, 100), np.arange(10000.0).reshape(100, 100)
    part, below = _ground_part((grid, heights), np.array([shapely.box(240, 250, 260, 255)]))
    assert part.x_min <= 240 - BUFFER < part.x_min + 7.5 and part.y_max - 7.5 < 255 + BUFFER <= part.y_max
    assert 5 * part.columns >= 20 + 2 * BUFFER and 5 * part.rows >= 5 + 2 * BUFFER
    assert below.shape == (part.rows, part.columns)
    assert below[0, 0] == (500 - part.y_max) / 5 * 100 + part.x_min / 5
    assert _ground_part((grid, heights), np.array([shapely.box(900, 50, 910, 60)])) is None


def test_longest_line_of_cracks_takes_none_of_a_line_beside_it():
    long, short = (np.column_stack([at, np.full(len(at), y)]) for at, y in ((np.arange(0, 10, 0.25), 2.0),
                                                                            (np.arange(0, 4, 0.25), 6.0)))
    xy = np.vstack([long, short])
    angle = np.radians(np.arange(0, 180, 15))
    normals = np.column_stack([np.cos(angle), np.sin(angle)])
    line, chosen, length = _longest(xy, normals, np.ones(len(normals)), 0.25)
    assert np.array_equal(chosen, np.arange(len(xy)) < len(long))
    assert line == pytest.approx((0.0, 1.0, 2.0), abs=1e-9) and length == pytest.approx(9.75, abs=0.5)


# Surveys


@pytest.mark.parametrize(("box", "kept"), [((-9, -9, 9, 9), [0, 1, 2]), ((0, -9, 9, 9), [1, 2]),
                                           ((-9, -9, 0, 9), [0, 1]), ((-9, 0, 9, 9), [1, 2]), ((-9, -9, 9, 0), [0, 1]),
                                           ((-1, -1, 1, 1), [1])])
def test_points_within_a_box_are_those_between_its_edges(box, kept):
    at = np.array([-5.0, 0.0, 5.0])
    found = _within({"x": at, "y": at, "z": np.arange(3.0)}, (-5.0, -5.0, 5.0, 5.0), box)
    assert found["z"].tolist() == [float(row) for row in kept]


@pytest.mark.parametrize(("box", "meets"), [((5, 0, 9, 5), True), ((6, 0, 9, 5), False), ((-9, 0, 0, 5), True),
                                            ((-9, 0, -1, 5), False), ((0, 6, 5, 9), False), ((0, -9, 5, -1), False),
                                            ((1, 1, 2, 2), True)])
def test_boxes_meet_where_they_have_a_place_in_common(box, meets):
    assert _meet((0, 0, 5, 5), box) is meets and _meet(box, (0, 0, 5, 5)) is meets


def test_variance_of_a_walk_grows_by_what_neighbours_share_of_their_deviations():
    time_, rough = np.arange(400.0), np.random.default_rng(2).normal(0.0, 0.05, 401)
    error = (rough[1:] + rough[:-1]) / np.sqrt(2.0)
    walk, used = _fitted(time_, error)
    left = error[used] - walk.value
    shared = (left[1:] @ left[:-1]) / (left @ left)
    alone = _inverse_bands(_solve(time_[used], error[used], *_most_likely(time_[used], error[used]))[1])[0]
    assert shared > 0.3
    assert walk.variance == pytest.approx(alone * (1.0 + shared) / (1.0 - shared), rel=1e-9)


@pytest.mark.parametrize("extent", [(300.0, 20.0), (10.0, 200.0), (0.2, 0.1)])
def test_a_course_fills_its_plan_and_the_scale_bar_is_as_long_as_it_says(extent):
    count = 50
    drive = Trajectory(np.arange(count, dtype=float), np.column_stack([np.linspace(0.0, size, count) for size in (
        *extent, 1.0)]), np.zeros((count, 3)))
    svg = course_map(drive, SimpleNamespace(trajectory=drive, status=np.full(count, BETWEEN), sets=()))
    width, height = (int(value) for value in re.search(r'width="(\d+)" height="(\d+)"', svg).groups())
    places = np.array(re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", svg.partition("#333")[0]), float)[:2 * count]
    size = np.ptp(places, axis=0)
    assert (places >= 19.9).all() and (places <= [width - 19.9, height - 19.9]).all()
    begin, end, length = re.search(r'd="M([\d.]+) \d+H(\d+)".*>([\d.e-]+) m<', svg).groups()
    metres = (float(end) - float(begin)) / float(length)  # pixels a metre
    assert size == pytest.approx(np.array(extent) * metres, rel=0.02, abs=0.2)
    assert max(size[0] / (width - 40), 1.3 * size[1] / (width - 40)) == pytest.approx(
        1.0 if max(extent) > 1.0 else 0.2 / 1.3, rel=0.02)


@pytest.mark.parametrize(("gap", "turn", "tied"), [(0.1, 0.0, True), (-0.2, 5.0, True), (0.3, 0.0, False),
                                                   (0.1, 12.0, False)])
@pytest.mark.parametrize("level", [None, ()])  # facades are compared of drives that disagree in height, too
def test_planes_of_two_passes_are_one_where_they_lie_near_and_parallel(gap, turn, tied, level):
    angle = np.radians(turn)
    moved = np.array([[5.0, 0.0, 1.0], [5.0 + gap, 0.1, 1.0]])
    patches = SimpleNamespace(group=np.array([0, 1]), time=np.array([0.5, 7.5]),
                              normal=np.array([[1.0, 0.0, 0.0], [-np.cos(angle), -np.sin(angle), 0.0]]))
    drive = SimpleNamespace(time=np.array([0.0, 10.0]))
    pair = _Pair(SimpleNamespace(patches=patches, drive=np.array([0, 1])), moved, 0, 1, [drive, drive], [drive, drive],
                 [np.array([0.0, 100.0])] * 2, level)
    assert len(pair.gap) == tied
    if tied:
        half = angle / 2  # its normal lies between both
        assert pair.gap == pytest.approx(gap * np.cos(half) + 0.1 * np.sin(half))
        assert pair.along.tolist() == [5.0] and [time_.tolist() for time_ in pair.time] == [[0.5], [7.5]]


def course(step):
    """Values along 200 m that step by (2,) m in their middle."""
    chainage = np.arange(0.0, 200.0, 2.0)
    return _Course(chainage, np.where(chainage[:, None] > 100.0, step, 0.0) * np.ones(2))


@pytest.mark.parametrize(("change", "tied", "other", "is_reference"), [
    (2.0, 0.0, None, True), (2.0, 2.0, None, False), (0.5 * MIN_CHANGE, 0.0, None, False),
    (2.0, 0.0, 2.0, True), (2.0, 0.0, 0.0, False), (2.0, 0.0, -2.0, False)])
def test_a_step_is_the_references_when_a_tied_drive_has_none_of_its_own(change, tied, other, is_reference):
    steps = np.array([change, 0.0])
    way = _Course(course(0.0).chainage, course(0.0).chainage[:, None])
    seen = None if other is None else course(np.array([other, 0.0]))
    difference = course(np.array([tied, 0.0]))
    assert STEP_LIMITS.fewest < 20
    assert _of_reference(100.5, steps, (1, difference, way), seen) is is_reference


# Roads


def section(*offsets):
    """Tracks of 100 m beside an axis along x."""
    tracks = [SimpleNamespace(start=0.0, end=100.0, chainage=np.array([0.0, 100.0]), offset=np.array([offset, offset]))
              for offset in offsets]
    return SimpleNamespace(tracks=tracks, axis=SimpleNamespace(local=lambda xy: (xy[:, 0], xy[:, 1])))


@pytest.mark.parametrize(("stop", "belongs"), [
    (((50.0, -3.0), (50.0, 0.0)), True), (((50.0, 3.5), (50.0, 6.0)), True), (((50.0, 4.5), (50.0, 6.0)), False),
    (((50.0, -6.0), (50.0, -3.5)), True), (((50.0, -6.0), (50.0, -4.5)), False),
    (((100.0 + 0.9 * STOP_REACH, -3.0), (100.0 + 0.9 * STOP_REACH, 0.0)), True),
    (((101.0 + STOP_REACH, -3.0), (101.0 + STOP_REACH, 0.0)), False), (((50.0, -1.0), (53.0, 0.0)), False)])
def test_a_stop_line_belongs_to_the_section_that_it_lies_across(stop, belongs):
    assert _belongs(section(-3.0, 0.0, 3.0), np.array([(*place, 0.0) for place in stop])) is belongs


@pytest.mark.parametrize(("segment", "crosses"), [
    ([(0, 0), (0, 4)], True), ([(0, 2), (0, 6)], False), ([(-5, 2), (5, 2)], True), ([(0, 3), (0, 6)], False),
    ([(-12, 2), (-10, 2)], False), ([(9, 2), (9.5, 2)], True)])
def test_a_closing_line_crosses_an_edge_but_may_end_on_it(segment, crosses):
    net = shapely.LineString([(-10, 2), (10, 2)])
    ends = np.array(segment, float)
    assert _crosses(shapely.LineString(ends), net, ends) is crosses
    assert 0 < GRID < 0.01


def road_end(offsets, strips, double, outward, x):
    """The end of a road at x with lines at offsets in y, some of them double."""
    tracks = [SimpleNamespace(double=number in double, colour="white") for number in range(len(offsets))]
    return SimpleNamespace(
        section=SimpleNamespace(tracks=tracks), outward=np.array([outward, 0.0]),
        strips=[SimpleNamespace(right=right, left=left) for right, left in strips],
        track_end=lambda track: np.array([x, offsets[track]]))


@pytest.mark.parametrize(("double", "straight_across"), [((), True), ((0,), True), ((3,), True), ((2,), False),
                                                         ((1,), True)])
def test_the_line_between_directions_leads_to_the_double_line_within_the_road(monkeypatch, double, straight_across):
    monkeypatch.setattr(beyond_junctions, "colour_of", lambda track: track.colour)
    known = road_end((-3.0, 0.0, 3.0), [(0, 1), (1, 2)], (1,), 1.0, 0.0)
    end = road_end((-3.1, 0.1, 3.1, 6.1), [(0, 1), (1, 2), (2, 3)], double, -1.0, 20.0)
    assert beyond_junctions._opposite(known, end, 1) is straight_across


def bar_and_line(begin, turned):
    """A bar of 3 m along y at x = 0 and a line from `begin` that leads away from it by 40 m along x, then turns."""
    axis = np.column_stack([begin + np.arange(0.0, 40.0), np.zeros(40)])
    axis[31:, 1] = np.arange(9.0) * 4.0  # beyond what is looked at
    chain = StrokeChain(np.array([[0.0, -1.5], [0.0, 1.5]]), [0], 3.0, 0.45)
    line = StrokeChain(axis[[0, -1]], [1], 40.0, 0.15)
    return chain, [(line, SimpleNamespace(width=0.15, axis=axis[::-1] if turned else axis))]


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("begin", "found"), [(0.3, (True, False)), (30.0, (False, False)), (-20.0, (False, True))])
def test_a_line_ends_at_a_bar_or_goes_through_it(begin, turned, found):
    assert _at_end(*bar_and_line(begin, turned)) == found


def test_the_course_of_a_line_is_that_of_its_end_at_the_bar():
    chain, ((line, fit),) = bar_and_line(0.3, False)
    along_bar = np.vstack([[[0.3, 0.0]], np.column_stack([np.full(60, 0.3), 0.02 * np.arange(60)])])
    away = np.column_stack([np.linspace(0.4, 60.0, 200), np.full(200, 1.2)])
    for axis in (np.vstack([along_bar, away]), np.vstack([along_bar, away])[::-1]):
        assert _at_end(chain, [(line, SimpleNamespace(width=fit.width, axis=axis))]) == (False, False)


def test_a_low_step_lies_where_the_kerb_on_both_its_sides_leads():
    count = 12
    high, low = 2 * EDGE_LIMITS.low, 0.5 * EDGE_LIMITS.low
    place = np.column_stack([0.5 * np.arange(count), np.zeros(count)])
    true = 0.01 * np.arange(count)  # across, m
    stations = SimpleNamespace(
        place=place, normal=np.tile([0.0, 1.0], (count, 1)), foot=true.copy(), top=true.copy(),
        height=np.full(count, high), sigma=np.full(count, 0.005))
    stations.height[6] = low
    stations.foot[6] = stations.top[6] = 0.4
    _carry_low(stations, np.arange(count))
    assert stations.foot == pytest.approx(true, abs=1e-9) and np.array_equal(stations.foot, stations.top)
    assert stations.sigma[6] == EDGE_LIMITS.carried
    stations.foot[:6] = stations.top[:6] = 0.0  # it lies between a kerb further right and one further left
    stations.foot[7:] = stations.top[7:] = 0.1
    _carry_low(stations, np.arange(count))
    assert stations.foot[6] == pytest.approx(0.05, abs=1e-9) and stations.sigma[6] > EDGE_LIMITS.carried / 2
    stations.height[:4], stations.foot[1] = low, 0.3  # nothing before it
    _carry_low(stations, np.arange(count))
    assert stations.foot[1] == 0.3 and stations.sigma[1] == 2 * EDGE_LIMITS.unsure


def test_sigma_of_an_object_holds_what_its_stem_may_lean(monkeypatch):
    monkeypatch.setattr(street_objects, "kind_of", lambda around, diameter: ("pole", 0.9, None))
    monkeypatch.setattr(street_objects, "_doubt", lambda *given: "")
    axis = SimpleNamespace(diameter=0.2, middle=np.array([1.0, 2.0, 6.0]), lean=np.array([0.3, 0.4]),
                           sigma=np.array([0.01, 0.02]))
    around = SimpleNamespace(wall=0, crown=0.0, arm=0.0, top=8.0)
    stem = SimpleNamespace(rows=np.arange(40), beside=False)
    found = street_objects._object(stem, axis, np.array([1.0, 2.0, 1.0]), around, 0.0, 2,
                                   np.array([100.0, 200.0, 0.0]), SimpleNamespace(survey_sigma=0.03))
    lean = street_objects.LIMITS.lean * 5.0
    assert found.sigma == pytest.approx(np.sqrt((0.01**2 + 0.02**2) / 2 + lean**2 + 0.03**2))
    assert found.foot.tolist() == [101.0, 202.0, 1.0] and found.lean == pytest.approx(np.degrees(np.arctan(0.5)))


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


def test_lines_of_a_layer_keep_their_chain_and_bound_and_official_edges_have_none():
    line = shapely.LineString([(0, 0, 1), (9, 0, 1)])
    columns = {"class": ["solid"], "chain": [7], "bound_id": [12]}
    (own,), (official,) = (lines_of([line], columns, field) for field in ("class", None))
    assert (own.kind, own.chain, own.identifier) == ("solid", 7, 12)
    assert (official.kind, official.chain, official.identifier) == ("road border", -1, -1)


@pytest.mark.parametrize(("columns", "name"), [({}, "2"), ({"id": [None, "a"]}, "a"), ({"bound_id": [1, None]}, "2"),
                                               ({"line_id": [1, 4], "id": ["x", "y"]}, "4")])
def test_lines_of_a_layer_are_named_by_their_ids_or_rows(columns, name):
    line = shapely.LineString([(0, 0), (9, 0)])
    (found,) = elements_of_lines([None, line], {"class": ["solid", "dashed"], "colour": ["", "yellow"], **columns})
    assert (found.identifier, found.kind, found.colour, found.double) == (name, "dashed", "yellow", None)
    assert np.isnan(found.sigma) and found.points.tolist() == [[0.0, 0.0], [9.0, 0.0]]


@pytest.mark.parametrize("turned", [False, True])
def test_a_crosswalk_is_the_area_between_its_bounds_and_leads_across_them(turned):
    left, right = np.array([[0.0, 4.0], [5.0, 4.5], [10.0, 4.0]]), np.array([[0.0, 0.0], [6.0, -0.5], [10.0, 0.0]])
    relation = SimpleNamespace(identifier=7, members=[("way", 1, "left"), ("way", 2, "right")])
    found = _crosswalk(relation, {1: left, 2: right[::-1] if turned else right})
    ring = shapely.Polygon(found.points)
    assert ring.is_valid and ring.area == pytest.approx(40.0 + 2.5 + 2.5) and found.heading.tolist() == [0.0, 1.0]
    assert _crosswalk(relation, {1: left}) is None


# Tables and the sample city


@pytest.mark.parametrize("ring", ["<r><posList>1 2 3 4 5 6</posList></r>", "<r><pos>1 2 3</pos><pos>4 5 6</pos></r>",
                                  "<r><pos>1 2 3</pos><x><pos>4 5 6</pos></x></r>"])
def test_coordinates_of_a_ring_stand_in_one_list_or_point_by_point(ring):
    assert _coordinates(ElementTree.fromstring(ring)) == "1 2 3 4 5 6"


@pytest.mark.parametrize(("text", "value"), [
    ("<g:stringAttribute name='a'><g:value> 1.50 </g:value></g:stringAttribute>", "1.50"),
    ("<g:intAttribute name='a'><g:value>12</g:value></g:intAttribute>", 12),
    ("<g:doubleAttribute name='a'><g:value>1.50</g:value></g:doubleAttribute>", 1.5),
    ("<g:doubleAttribute name='a'><g:value>many</g:value></g:doubleAttribute>", "many"),
    ("<g:dateAttribute name='a'><g:value>2026-04-01</g:value></g:dateAttribute>", datetime.date(2026, 4, 1)),
    ("<g:measureAttribute name='a'><g:value uom='m'>2.5</g:value></g:measureAttribute>", Measure(2.5, "m")),
    ("<g:stringAttribute name='a'/>", ""), ("<g:intAttribute name='a'/>", "")])
def test_generic_attributes_have_values_of_their_kinds(text, value):
    space = "xmlns:g='http://www.opengis.net/citygml/generics/2.0'"
    element = ElementTree.fromstring(text.replace(" name", f" {space} name", 1))
    found = generic_value(element, lambda name, code: "")
    assert found == value and type(found) is type(value)


def test_columns_of_mixed_values_become_text_and_others_stay():
    with TableStore(False, False) as store:
        store.columns = {"mixed": [1, "a", None], "whole": [1, 2, None],
                         "FID": [1.5, None, 2.0], "yes": [True, None, False]}
        assert store.more_fields(["whole_"]) == [("mixed", "text"), ("whole", "int"), ("FID_", "real"), ("yes", "bool")]
        assert store.columns == {"mixed": ["1", "a", None], "whole": [1, 2, None], "FID_": [1.5, None, 2.0],
                                 "yes": [True, None, False]}


def test_noise_of_paint_has_no_steps_at_the_borders_of_its_cells():
    at = np.arange(-3.0, 4.0)
    for along in (lambda step: (at + step, np.full(7, 0.37)), lambda step: (np.full(7, 0.37), at + step)):
        before, after = (value_noise(*along(step), 1.0) for step in (-1e-6, 1e-6))
        assert before == pytest.approx(after, abs=1e-5) and np.ptp(before) > 0.1


def test_bays_are_ten_centimetres_of_paint_every_two_and_a_half_metres():
    ground = SimpleNamespace(to_local=lambda x, y: (x, y))
    bays = _bays(ground, shapely.box(0, 0, 12.2, 20.0))
    assert [bay.plan.area for bay in bays] == pytest.approx([0.1 * 5.0] * 5)
    assert [bay.plan.centroid.x for bay in bays] == pytest.approx([0.6, 3.1, 5.6, 8.1, 10.6])
