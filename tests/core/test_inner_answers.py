"""Steps inside stages, by known answers of their own: what later steps would make up for, or tolerances hide."""

from __future__ import annotations

from collections import Counter
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine
from scipy.spatial import cKDTree

from urbanmap_qgis.aerial.frames.occlusion import RaisedCells, _lift
from urbanmap_qgis.aerial.markings import marking_report
from urbanmap_qgis.aerial.markings.marking_confidence import GroundBeside
from urbanmap_qgis.aerial.markings.marking_pieces import MarkingPieces, PieceImage, piece_figures
from urbanmap_qgis.aerial.markings.road_model import RoadModel
from urbanmap_qgis.aerial.markings.surroundings import cells_of, figures_at
from urbanmap_qgis.aerial.orthophotos.orthorectification import OrthorectifiedFrame
from urbanmap_qgis.buildings.city_export import _level
from urbanmap_qgis.buildings.mesh25d.mesh_points import BUILDING_CLASS, _chosen
from urbanmap_qgis.buildings.model_status import NOT_MODELLED
from urbanmap_qgis.buildings.model_table import _verdict
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.gnss.rinex.observation_file import _numbers
from urbanmap_qgis.gnss.walls.offset_posterior import _rival
from urbanmap_qgis.io.conversion.geoid import _whole_seconds
from urbanmap_qgis.io.conversion.reprojection import resampled
from urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report
from urbanmap_qgis.io.points.point_buckets import PointBuckets
from urbanmap_qgis.mobile.adjustment import planes
from urbanmap_qgis.mobile.adjustment.network import _likelihood
from urbanmap_qgis.mobile.registration import report as registration_report
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.virtual_control import virtual_control
from urbanmap_qgis.roadmap.checks.lane_rules import _nearest_on
from urbanmap_qgis.roadmap.edges.edge_points import EdgeTile
from urbanmap_qgis.roadmap.edges.uprights import upright_candidates
from urbanmap_qgis.roadmap.lanes.right_of_way import LANES, STOP_LINE, WIDTH, _minor, _Road
from urbanmap_qgis.roadmap.lines.line_fit import fit_centre_line
from urbanmap_qgis.roadmap.lines.line_work import RoadArea
from urbanmap_qgis.roadmap.objects.object_records import POLE, TREE, Stem
from urbanmap_qgis.roadmap.objects.street_objects import _doubt
from urbanmap_qgis.roadspace.junctions import _skew
from urbanmap_qgis.roadspace.survey import road_areas
from urbanmap_qgis.terrain import cloud_tiles

PIXEL = 0.12


def test_a_rival_is_what_lies_beyond_the_valleys_on_both_sides():
    density = np.array([[0.0, 0.4, 0.2, 0.05, 0.2, 0.15], [0.1, 0.2, 0.05, 0.1, 0.4, 0.15],
                        [0.1, 0.2, 0.4, 0.2, 0.1, 0.0]])
    assert _rival(density) == pytest.approx([0.35, 0.3, 0.0])


def stripe(turned=False):
    """A stripe 0.36 m wide in the middle of even ground, upright or (`turned`) lying: image, narrow pixels, ground."""
    image = np.full((420, 420), 90, np.float32)
    image[:, 209:212] = 200
    clear = np.ones(image.shape, np.uint8)
    clear[:, 207:214] = 0
    image, clear = (np.ascontiguousarray(part.T if turned else part) for part in (image, clear))
    return image, image == 200, GroundBeside(clear, clear, clear, np.where(clear, image, 100).astype(np.float32), None)


def around(image, narrow, ground):
    bands = np.repeat(image.astype(np.uint8)[None], 3, axis=0)
    cells = cells_of(bands, image, narrow, ground, PIXEL, 1.0)
    return {name: float(value[0]) for name, value in figures_at(
        np.array([70]), np.array([70]), cells, RoadModel(brightness=100.0), PIXEL, 10.0).items()}


def test_surroundings_do_not_hang_on_the_way_a_stroke_runs():
    upright, lying = around(*stripe()), around(*stripe(turned=True))
    assert upright["firm"] == pytest.approx(1.0, abs=0.01) and upright["inline"] > 0.95 > 0.1 > upright["beside_both"]
    assert lying == pytest.approx(upright, abs=1e-6)


def test_the_colour_of_a_piece_is_told_against_the_road():
    """Red 120, green 100, blue 80: a fifth of 100 warmer on each side, and no green."""
    image, narrow, ground = stripe()
    bands = np.stack([np.full(image.shape, value, np.uint8) for value in (120, 100, 80)])
    places = np.flatnonzero(narrow)
    none = np.zeros(len(places))
    pieces = MarkingPieces(places, none.astype(int), np.array([len(places)]), np.array([50.0]), np.array([True]))
    seen = PieceImage(bands, image, narrow, ground, RoadModel(brightness=100.0, warmth=0.1, green=0.02), 1.0, 10.0)
    values = piece_figures(seen, places, none + 3.0, none + 0.5, pieces, none.astype(int), PIXEL).values
    assert values["pwarm"] == pytest.approx(0.3, abs=1e-3) and values["pgreen"] == pytest.approx(-0.02, abs=1e-3)
    assert values["warmer"] == pytest.approx(0.0, abs=1e-3) and values["paint"] == pytest.approx(2.0)
    assert values["relief"] == pytest.approx(3.0) and values["rules"] == pytest.approx(0.5)


@pytest.mark.parametrize(("one", "other", "waits", "goes"), [
    (_Road(1, 3.0, 2, 0), _Road(2, 6.0, 2, 0), LANES, ""), (_Road(1, 3.0, 2, 0), _Road(1, 6.0, 2, 0), WIDTH, ""),
    (_Road(2, 6.0, 2, 2), _Road(1, 3.0, 2, 0), STOP_LINE, ""), (_Road(1, 3.0, 2, 0), _Road(1, 3.0, 2, 0), "", ""),
    (_Road(1, 3.0, 2, 1), _Road(1, 3.0, 2, 0), "", "")])
def test_the_minor_road_is_told_by_stop_lines_then_lanes_then_width(one, other, waits, goes):
    assert (_minor(one, other), _minor(other, one)) == (waits, goes)


@pytest.mark.parametrize(("kind", "filled", "crowd", "wall", "word"), [
    (POLE, 0.9, 0.0, 0, ""), (POLE, 0.5, 0.0, 0, "its stem is seen in parts"), (TREE, 0.5, 0.0, 0, ""),
    (TREE, 0.9, 0.0, 0, ""), (POLE, 0.9, 1.5, 0, "other things stand close beside it"), (TREE, 0.9, 1.5, 0, ""),
    (POLE, 0.9, 0.0, 40, "it may be a part of a wall")])
def test_why_a_stem_is_doubtful(kind, filled, crowd, wall, word):
    assert _doubt(Stem(np.arange(100), 0.3, 4.0, filled), kind, crowd, wall) == word


def test_a_part_of_an_image_is_drawn_smaller_by_the_factor(tmp_path):
    with rasterio.open(tmp_path / "a.tif", "w", driver="GTiff", width=200, height=120, count=3, dtype="uint8",
                       transform=Affine(0.1, 0, 0, 0, -0.1, 12)) as target:
        target.write(np.full((3, 120, 200), 100, np.uint8))
    found = SimpleNamespace(polygons=SimpleNamespace(polygons=np.array([shapely.box(5, 5, 7, 6)], object)))
    with rasterio.open(tmp_path / "a.tif") as source:
        picture = marking_report._drawn(source, tmp_path / "a.tif", (20, 0, 160, 80), 4.0, found)
    assert cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_COLOR).shape == (20, 40, 3)


@pytest.mark.parametrize(("step", "whole"), [(0.016667, 60.0), (0.0166, 59.76), (0.02500001, 90.0), (1e-7, 3.6e-4)])
def test_a_step_with_cut_decimals_is_the_whole_second_beside_it(step, whole):
    """A hundredth of a second away it is a step of its own, and a step is never 0."""
    assert _whole_seconds(step) * 3600 == pytest.approx(whole, rel=1e-6)


def test_records_that_come_in_order_are_not_copied():
    records = np.zeros(6, [("x", "<f8")])
    with PointBuckets(records.dtype) as buckets:
        assert buckets.add(np.array([1, 1, 4, 4, 4, 9]), records) == {1: 2, 4: 3, 9: 1}
        assert all(np.shares_memory(piece, records) for pieces in buckets._pieces.values() for piece in pieces)
        assert buckets.add(np.array([4, 1]), records[:2]) == {1: 1, 4: 1} and len(buckets.read(4)) == 4


@pytest.mark.parametrize(("status", "seen", "grade", "words"), [
    (["ok", "ok"], True, GOOD, ()), (["ok", "ok"], False, LOOK, ("no points were given",)),
    (["ok", "odd", NOT_MODELLED, NOT_MODELLED], True, LOOK, ("With a remark: 1;", "Without a model: 2;")),
    ([NOT_MODELLED, NOT_MODELLED], True, BAD, ("Without a model: 2;",))])
def test_what_a_report_of_models_says_first(status, seen, grade, words):
    said = []
    _verdict(SimpleNamespace(verdict=lambda *args: said.append(args)), np.array(status, object), seen)
    assert said[0][0] == grade and all(word in str(said[0][1]) for word in words)
    assert ("remark" in str(said[0][1])) == ("odd" in status)


@pytest.mark.parametrize(("kind", "rise", "level"), [("roof", 0.0, "1.3"), ("roof", 1.0, "2.2"),
                                                     ("wall", 1.0, "1.3")])
def test_a_sloped_roof_makes_level_two(kind, rise, level):
    solid = SimpleNamespace(vertices=np.array([[0, 0, 5], [4, 0, 5], [4, 3, 5 + rise]], float), faces=[((0, 1, 2),)],
                            surface_type=(kind,))
    assert _level(SimpleNamespace(solids=[solid])) == level


def test_only_polygons_of_an_area_are_its_outline():
    parts = shapely.geometrycollections([shapely.box(0, 0, 1, 1), shapely.linestrings([(0, 0), (5, 5)]),
                                         shapely.box(3, 0, 4, 2)])
    area = RoadArea(parts, "unknown", np.full(2, np.nan), np.nan, "white")
    assert area.multipolygon.geom_type == "MultiPolygon" and area.multipolygon.area == 3.0


@pytest.mark.parametrize(("points", "cells"), [(3, 14), (2, 0)])
def test_a_cell_with_few_points_is_no_upright(points, cells):
    """A rail along y at x = 5.05, so many points in each cell from 0.3 to 0.9 m; its ends tell no direction."""
    along, up = np.meshgrid(2.05 + 0.1 * np.arange(16), np.linspace(0.3, 0.9, points), indexing="ij")
    record = np.zeros(along.size, [("x", "<f8"), ("y", "<f8"), ("z", "<f8")])
    record["x"], record["y"] = 5.05, along.ravel()
    found = upright_candidates(EdgeTile(np.zeros(2), record), up.ravel(), cKDTree([[0.0, 3.0]]))
    assert len(found.place) == cells and (found.normal[:, 0] > 0.99).all()


def test_planes_of_three_ways_tie_two_passes_in_place(monkeypatch):
    """The shift is theirs, and its variance that of so many planes of their scatter, with the floor of a tie."""
    shift, rng = np.array([0.2, -0.1, 0.05]), np.random.default_rng(5)
    pair = planes._Pair.__new__(planes._Pair)
    pair.normal = np.repeat(np.eye(3), 100, axis=0)
    pair.apart = False
    pair.gap = pair.normal @ shift + rng.normal(0, 0.002, 300)
    pair.time, pair.reported = (np.zeros(300),) * 2, (SimpleNamespace(time=np.array([0.0, 1.0])),) * 2
    pair._standing = [np.zeros(2)] * 2  # neither vehicle stands
    monkeypatch.setattr(planes._Pair, "_observation", lambda self, some, shift, covariance: (shift, covariance))
    found, covariance = pair.tie(np.arange(300))
    scatter = planes.LIMITS.sigma  # theirs is less
    assert found == pytest.approx(shift, abs=0.001) and pair.tie(np.arange(11)) is None
    assert np.sqrt(np.diag(covariance)[:3]) == pytest.approx(np.hypot(scatter / 10, planes.LIMITS.floor), rel=0.02)


class _Correction(SimpleNamespace):
    def __len__(self):
        return len(self.value)


def test_the_summary_of_a_registration_tells_the_whole_path():
    facts = {}
    report = SimpleNamespace(facts=facts.update, paragraph=lambda text: None)
    correction = _Correction(value=np.array([[3.0, 4.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]), three_d=False,
                             unseen=None, chainage=np.array([0.0, 40.0, 90.0]), drift_factor=np.nan)
    registration_report._summary(report, SimpleNamespace(
        correction=correction, markings=range(7), share=lambda state: 0.25,
        plan_accuracy=lambda: (0.02, 0.05)))
    assert facts["Path length (m)"] == 90.0 and facts["Patches"] == 3 and facts["Marking points"] == 7
    assert facts["Correction in plan, mean and maximum (m)"] == "2.000, 5.000" and facts["Bridged (%)"] == 25.0


def test_sides_that_are_not_seen_tell_nothing():
    image, narrow, ground = stripe()
    ground.clear[:, 212:] = 0
    values = around(image, narrow, ground)
    assert all(values[name + far] == -1 for name in ("sided", "poorer", "rougher", "lighter") for far in ("1.5", "2.6"))
    assert values["hidden1.5"] == 0.0


def test_points_of_a_building_for_a_mesh():
    """Thirty each: of the building's class on and off its outline, of no class on it; ground beside it at 2 m."""
    record = np.zeros(120, [("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("class", "u1")])
    record["x"] = np.repeat([5.0, 25.0, 6.0, 26.0], 30)
    record["y"], record["z"] = 5.0, np.repeat([9.0, 9.0, 7.0, 2.0], 30)
    record["class"] = np.repeat([BUILDING_CLASS, BUILDING_CLASS, 1, 2], 30)
    points, ground = _chosen(record, shapely.box(0, 0, 10, 10), False)
    assert set(points[:, 0]) == {5.0} and len(points) == 30 and ground == 2.0
    assert set(_chosen(record, shapely.box(0, 0, 10, 10), True)[0][:, 0]) == {5.0, 6.0}
    assert set(_chosen(record[60:], shapely.box(0, 0, 10, 10), False)[0][:, 0]) == {6.0}


def test_cells_in_another_system_are_as_large_as_at_the_middle_of_the_box():
    """North there is y^2 + x y: a cell of 0.1 at x = 15, y = 5 is 2.51 high."""
    def curved(x, y, inverse=False):
        return (x, 0.5 * (np.sqrt(x * x + 4 * y) - x)) if inverse else (x, y * y + x * y)

    source = SimpleNamespace(grid=SimpleNamespace(cell=0.1), sample=lambda x, y: 10 * x + y)
    grid, heights = resampled(source, curved, (10.0, 90.0, 20.0, 110.0))
    columns, rows = grid.centres()
    assert grid.cell == pytest.approx(2.51)
    assert heights[3, 2] == pytest.approx(10 * columns[2] + curved(columns[2], rows[3], inverse=True)[1])


def test_half_a_stroke_covers_a_line_and_does_not_draw_it():
    """20 m of paint 0.15 m wide along y = 0, of which the upper half is left for 4 m: its middle lies 4 cm up."""
    paint = [shapely.box(0, -0.075, 8, 0.075), shapely.box(8, 0.005, 12, 0.075), shapely.box(12, -0.075, 20, 0.075)]
    line = fit_centre_line(np.array([[0.0, 0.0], [20.0, 0.0]]), 0.15, shapely.STRtree(paint))
    assert line.covered.all() and np.abs(line.axis[:, 1]).max() < 0.005 and line.width == pytest.approx(0.15, abs=0.001)


def test_the_evidence_for_a_size_of_drift():
    """Half of what the prior's determinant has more than the normal matrix', less half the square and the loss."""
    prior = SimpleNamespace(determinant=3.0, square=lambda solution: 1.0)
    factors = SimpleNamespace(U=SimpleNamespace(diagonal=lambda: np.array([np.e, -np.e])))
    value = _likelihood(np.zeros(2), prior, factors, np.array([0.0, 4.0]), 1.0,
                        SimpleNamespace(value=np.array([[1.0, 1.0, np.nan, np.nan]] * 2)), SimpleNamespace(gross=2.0))
    assert value == pytest.approx(0.5 * (3.0 - 2.0) - 0.5 - 4.0 * np.log(2.0))


@pytest.mark.parametrize(("left", "right", "skew"), [((10, 4), (10, -4), 0.0), ((14, 4), (6, -4), 45.0),
                                                     ((7.69, 4), (12.31, -4), 30.0), ((110, 4), (110, -4), 0.0)])
def test_by_how_much_a_cut_leaves_the_cross_direction(left, right, skew):
    """Of an arm that runs east; its cuts lie where they lie, wherever the coordinates begin."""
    place = (left[0] + right[0]) / 2
    branch = SimpleNamespace(points=np.array([[0.0, 0.0], [200.0, 0.0]]), clearance=np.array([4.0, 4.0]))
    cut = SimpleNamespace(left=np.array(left, float), right=np.array(right, float), place=place)
    assert _skew(SimpleNamespace(branch=branch), cut) == pytest.approx(skew, abs=0.1)


def test_a_strange_place_among_points_is_named():
    """Most points lie in square (500, 500), one a thousand squares west and a million north of it."""
    size = cloud_tiles.LIMITS.place
    squares = Counter({complex(500, 500): 90, complex(501, 500): 40, complex(-500, 10**6 - 500): 1})
    away = f"{np.hypot(1000, 10**6 - 1000) * size / 1000:.0f} km"
    place = f"{-499.5 * size:.0f}, {(10**6 - 499.5) * size:.0f}"
    with pytest.raises(InputError, match=f"near {place}, {away} from the others"):
        cloud_tiles._require_filled(squares)
    cloud_tiles._require_filled(Counter({complex(500, 500): 90, complex(501, 500): 40}))


def test_numbers_of_observations_are_read_in_their_columns_and_elsewhere():
    texts = ["  20000000.123", "12345678901234", "      -1.250  ", " " * 14, "    1234.5 78 "]
    values, unread = _numbers(np.frombuffer("".join(texts).encode(), np.uint8).reshape(-1, 14))
    assert values == pytest.approx([20000000.123, 12345678901234.0, -1.25, np.nan, np.nan], nan_ok=True) and unread == 1


def test_a_note_of_settings_is_a_table_and_another_a_paragraph(tmp_path):
    for text, table in (("cell: 0.5 m; method: planes", True), ("looked at: by hand", False), ("a; b", False)):
        report = Report("Title")
        report.note(text)
        report.write(tmp_path / "a.html")
        assert ("<td" in (tmp_path / "a.html").read_text(encoding="utf-8")) == table


def test_the_background_grows_with_the_odds_of_outliers():
    one, other = (RegistrationSettings(outlier_share=share).background for share in (0.5, 0.2))
    assert 0.0 < one <= 1.0 and other == pytest.approx(one / 4)


@pytest.mark.parametrize(("seen", "known"), [(0, 3), (3, 0)])
def test_without_corners_there_is_no_virtual_control(seen, known):
    survey = SimpleNamespace(time=np.zeros(seen), place=np.zeros((seen, 3)))
    with pytest.raises(InsufficientDataError, match="no bar among the markings"):
        virtual_control(survey, np.zeros((known, 3)), None)


def test_the_ground_beyond_the_lines_of_sight_is_seen_as_its_edge():
    """Twenty columns are all seen; bits that fill up the last byte are no ground."""
    frame = OrthorectifiedFrame.__new__(OrthorectifiedFrame)
    frame._seen = Grid(0.0, 4.0, 1.0, 4, 20), np.packbits(np.ones((4, 20), bool), axis=1)
    seen = frame._sees(np.array([[12.5, 15.0, 19.5, 20.0, 20.4]]), np.array([[1.5]]))
    assert seen.all()
    frame._seen[1][:, 0] = 0b11110111
    assert frame._sees(np.array([[2.5, 3.7, 4.5, 6.5]]), np.array([[2.5]])).tolist() == [[True, False, False, True]]


def test_slivers_go_to_the_neighbour_with_the_longest_border():
    areas = [(shapely.box(0, 0, 10, 10), "carriageway", 0), (shapely.box(10, 0, 20, 10), "footway", 1),
             (shapely.box(0, 10, 10, 10.05), "carriageway", 2), (shapely.box(50, 0, 50.05, 9), "footway", 3)]
    found = road_areas._without_slivers(areas)
    assert [(kind, road, round(polygon.area, 6)) for polygon, kind, road in found] == [
        ("carriageway", 0, 100.5), ("footway", 1, 100.0)]


def test_raised_cells_are_put_into_the_window_that_they_lie_in():
    raised = RaisedCells(np.array([2, 5, 5, 6]), np.array([3, 11, 30, 12]), np.array([1.0, 7.0, 8.0, 9.0]))
    z, high = np.zeros((3, 4)), np.zeros((3, 4), bool)
    _lift(z, high, raised, slice(4, 7), slice(10, 14))
    assert z.tolist() == [[0, 0, 0, 0], [0, 7, 0, 0], [0, 0, 9, 0]] and np.array_equal(high, z > 0)


def test_the_nearest_point_of_a_path_has_the_height_there():
    path = np.array([[0.0, 0.0, 1.0], [10.0, 0.0, 3.0], [10.0, 0.0, 3.0], [10.0, 8.0, 7.0]])
    assert _nearest_on(path, np.array([4.0, -2.0])).tolist() == [4.0, 0.0, 1.8]
    assert _nearest_on(path, np.array([11.0, 6.0])).tolist() == [10.0, 6.0, 6.0]
    assert _nearest_on(path, np.array([-5.0, 0.0])).tolist() == [0.0, 0.0, 1.0]
