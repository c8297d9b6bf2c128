"""Maps of worn or scattered lines: what lies beside, over or round other lanes is told or left out."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.core.laid_out_roads import drive, line, path_line, place
from tests.core.test_right_of_way import arms, drives, stops
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.formats.lanelet_map import lanelet_elements
from urbanmap_qgis.roadmap.lanes.junctions import about_curve, goes_past_lanes
from urbanmap_qgis.roadmap.lanes.lane_assembly import without_turning_back
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

ALL = MapSettings(traffic="left")

SPLIT = 30
"""Points of a worn line."""


def path_points(one):
    """Points (SPLIT, 3) at equal distances along a line."""
    plan = shapely.LineString(one.points)
    return shapely.get_coordinates(shapely.line_interpolate_point(plan, np.linspace(0.0, 1.0, SPLIT), normalized=True),
                                   include_z=True)


@pytest.mark.parametrize(("across", "x0", "x1", "past"), [
    (-1.75, -5, 65, True), (-1.75, -5, 40, False), (-5.0, -5, 65, False)])
def test_a_path_goes_past_a_lane_that_it_keeps_beside_from_end_to_end(across, x0, x1, past):
    built = build_vector_map([line(3.5, 0, 60), line(0.0, 0, 60)], (), [drive((0, 1.75), (60, 1.75))], ALL)
    assert len(built.lanes) == 1
    path = place([(x, across) for x in range(x0, x1)])
    assert goes_past_lanes(built, path) is past


def test_a_drive_beside_a_lane_makes_no_way_there_and_is_told():
    """The street has lanes both ways west of x = 20 and east of 70; between, lines show that of the west alone."""
    lines = [line(y, x0, x1) for x0, x1 in ((0, 20), (70, 90)) for y in (3.5, 0.0, -3.5)]
    lines += [line(y, 30, 60) for y in (0.0, -3.5)]
    built = build_vector_map(lines, (), [drive((0, 1.75), (90, 1.75)), drive((90, -1.75), (0, -1.75))], ALL)
    ways = [shapely.LineString(lane.centre[:, :2]).length for lane in built.lanes if lane.kind == "virtual"]
    assert len(ways) == 2 and max(ways) < 15.0
    assert [one.kind for one in built.findings if "runs" in one.text] == ["driven without lane"]


@pytest.mark.parametrize("seed", range(5))
def test_two_scattered_drawings_of_one_line_are_one_bound(seed):
    scatter = np.random.default_rng(seed).normal(0.0, 0.06, (2, 31))
    twice = [path_line(list(enumerate(across))) for across in scatter]
    lines = [line(3.5, 0, 30), line(-3.5, 0, 30), *twice]
    built = build_vector_map(lines, (), [drive((0, 1.7), (30, 1.7)), drive((30, -1.7), (0, -1.7))], ALL)
    assert len(built.lanes) == 2 and len({lane.right for lane in built.lanes}) == 1


def test_points_at_which_a_bound_turns_back_are_left_out():
    path = np.array([[0, 0, 0], [5, 0.1, 0], [4.7, 0.05, 0], [9, 0, 0], [12, 3, 0.0]])
    left = without_turning_back(path)
    steps = np.diff(left[:, :2], axis=0)
    assert (steps[:, 0] > 0.0).all() and np.array_equal(left[[0, -1]], path[[0, -1]]) and len(left) == 4
    assert np.array_equal(without_turning_back(left), left)


@pytest.mark.parametrize("seed", range(12))
def test_no_map_of_worn_or_scattered_lines_has_an_error(seed):
    """A third of the lines of a crossing is lost, the others are cut or scatter; some drives are missing."""
    rng = np.random.default_rng(seed)
    worn = []
    for one in [*arms(), *stops()]:
        if rng.random() < 0.3:
            continue
        points = path_points(one) + np.column_stack([rng.normal(0.0, 0.05 * (seed % 2), (SPLIT, 2)), np.zeros(SPLIT)])
        gap = int(rng.integers(3, SPLIT - 6)) if seed % 3 == 0 else SPLIT
        worn += [replace(one, points=part) for part in (points[:gap], points[gap + 3:]) if len(part) > 1]
    built = build_vector_map(worn, (), [path for path in drives() if rng.random() < 0.7], ALL)
    for dialect in ("lanelet2", "autoware"):
        elements, _ = lanelet_elements(built, CRS.from_epsg(6677).to_wkt(), speed_limit=40, dialect=dialect)
        assert [fault.rule for fault in check_map(elements) if fault.severity == "error"] == []


def test_a_turn_leaves_and_enters_in_the_lanes_directions():
    """Lanes that were bent before, but end and begin along one line: the way between them is that line."""
    before = np.array([[-20.0, 9.0, 1], [-12.0, 4.0, 1], [-6.0, 1.0, 1], [-3.0, 0.0, 1], [0.0, 0.0, 1.0]])
    after = np.array([[20.0, 0.0, 1], [23.0, 0.0, 1], [30.0, 6.0, 1.0]])
    sides = {"left": 1.5, "right": -1.5}
    built = SimpleNamespace(
        lanes=[SimpleNamespace(centre=before), SimpleNamespace(centre=after)],
        coordinates=lambda lane, side: (before, after)[lane] + np.array([0.0, sides[side], 0.0]))
    for points, aside in zip(about_curve(built, 0, 1), (1.5, -1.5)):
        assert points[:, 1] == pytest.approx(aside) and (np.diff(points[:, 0]) > 0).all()
        assert 0.0 < points[0, 0] < points[-1, 0] < 20.0
