"""Ids of bounds that were edited by hand."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core import laid_out_roads as roads
from urbanmap_qgis.roadmap.bound_ids import bound_ids
from urbanmap_qgis.roadmap.given_bounds import rejoined
from urbanmap_qgis.roadmap.map_records import Bound, MapLine, VectorMap, lines_of
from urbanmap_qgis.roadmap.map_tables import bound_columns
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings


def built_of(*courses):
    """A map of bounds along x from a to b at a y; kind after these."""
    built = VectorMap()
    for a, b, y, kind in courses:
        numbers = range(len(built.nodes), len(built.nodes) + 2)
        built.nodes += [np.array([x, y, 0.0]) for x in (a, b)]
        built.bounds.append(Bound(list(numbers), kind))
    return built


def line(a, b, y, identifier=-1):
    return MapLine(np.array([(a, y, 0.0), (b, y, 0.0)]), "solid", identifier=identifier)


def test_bounds_are_counted_where_no_line_has_an_id():
    assert bound_ids(built_of((0, 50, 0, "solid"), (0, 50, 3, "dashed")), [line(0, 50, 0)]) == [0, 1]


def test_each_id_goes_to_the_longest_bound_along_its_line_and_others_are_counted_on():
    built = built_of((0, 20, 0.05, "solid"), (20, 60, 0, "solid"), (0, 60, 3.0, "dashed"), (0, 60, 6.0, "virtual"),
                     (0, 60, 9.3, "solid"), (0, 60, 12.0, "solid"))
    lines = [line(0, 60, 0, 7), line(60, 0, 3.0, 12), line(0, 60, 6.0, 3), line(0, 60, 9.0, 5), line(0, 20, 12.0, 9)]
    # The virtual one is nobody's line, the next lies too far off, the last runs along its line for a third only.
    assert bound_ids(built, lines) == [13, 7, 12, 14, 15, 16]


def given_again(built, lines):
    """Bounds as the layer holds them, with the stop lines copied into it."""
    shapes = [shapely.LineString(built.bound_points(bound)) for bound in built.bounds]
    return lines_of(shapes, bound_columns(built)) + [one for one in lines if one.kind == "stop line"]


def lane_ends(built, without=()):
    """Begin and end (x, y) of each lane that has none of some bounds, rounded to centimetres."""
    return np.array(sorted(tuple(np.round(lane.centre[[0, -1], :2], 2).ravel()) for lane in built.lanes
                           if lane.kind == "lane" and not {lane.left, lane.right} & set(without)))


@pytest.fixture(scope="module")
def paint():
    """An avenue whose dashed lines are solid before its stop line, a part of a symbol that lines run past, and the same
    road behind a junction."""
    near = [line for y in (-7.0, -3.5, 3.5, 7.0) for line in (
        roads.line(y, 0, 60, "dashed" if abs(y) < 5 else "solid", chain=int(y * 2 + 20)),
        roads.line(y, 60, 90, "solid", chain=int(y * 2 + 20)))]
    lines = [*near, roads.line(0.0, 0, 90, "solid", double=True), *roads.avenue(120, 170)]
    stops = [roads.stop(90.3, 0.1, 6.9), roads.stop(30.0, 0.2, 3.2), roads.stop(119.7, -6.9, -0.1)]
    return [*lines, *stops], [roads.zebra(43, 46, 4.4, 6.2), roads.arrow(70, 1.7, "arrow straight right")]


@pytest.mark.parametrize("driven", [False, True])
def test_bounds_given_unmoved_give_the_same_lanes_and_ids_time_after_time(paint, driven):
    lines, areas = paint
    drives = [roads.drive((-10, 5.2), (180, 5.2)), roads.drive((180, -5.2), (-10, -5.2))] * driven
    settings = MapSettings(traffic="left")
    first = build_vector_map(lines, areas, drives, settings)
    assert len(lane_ends(first)) == 12
    again = first
    for _ in range(2):
        given = given_again(again, lines)
        again = build_vector_map(given, areas, drives, settings)
        assert lane_ends(again) == pytest.approx(lane_ends(first), abs=0.02)
        plain = [k for k, bound in enumerate(first.bounds) if bound.kind != "virtual"]
        assert set(plain) <= set(bound_ids(again, given))
        assert [first.bounds[k].double for k in plain].count(True) == sum(one.double for one in again.bounds)


def sharing_nodes(built, number):
    """Numbers of the bounds that have a node of one, itself among them: their ends go with it."""
    return [k for k, bound in enumerate(built.bounds) if set(bound.nodes) & set(built.bounds[number].nodes)]


def test_a_moved_bound_changes_the_lanes_at_its_nodes_alone_and_a_deleted_one_stays_so(paint):
    lines, areas = paint
    settings = MapSettings(traffic="left")
    first = build_vector_map(lines, areas, [], settings)
    moved = next(k for k, bound in enumerate(first.bounds) if bound.kind == "dashed")
    rest = [one for one in given_again(first, lines) if one.identifier != moved]
    without = build_vector_map(rest, areas, [], settings)
    assert lane_ends(without) == pytest.approx(lane_ends(first, [moved]), abs=0.02)
    others = lane_ends(first, sharing_nodes(first, moved))
    assert len(others) >= 6
    for node in first.bounds[moved].nodes:
        first.nodes[node] = first.nodes[node] + (roads.place([(0, 0.3)]) - roads.place([(0, 0)]))[0]
    given = given_again(first, lines)
    again = build_vector_map(given, areas, [], settings)
    ids = bound_ids(again, given)
    beside = [k for k, name in enumerate(ids) if name == moved]
    assert len(beside) == 1
    assert lane_ends(again, sharing_nodes(again, beside[0])) == pytest.approx(others, abs=0.02)
    assert len(lane_ends(again)) == len(lane_ends(first))


def test_bounds_in_a_row_are_one_line_of_each_class():
    parts = [line(0, 20, 0, 3), line(40, 20, 0.02, 4), line(40, 60, 0, 5), line(60, 60.1, 9, 6)]
    onward = MapLine(np.array([(60.0, 0, 0), (80.0, 0, 0)]), "dashed", identifier=7)
    made = rejoined([*parts, onward, line(0, 60, 3)])
    assert [(one.kind, len(one.joints), one.chain) for one in made] == [
        ("solid", 4, 0), ("dashed", 2, 0), ("solid", 2, 1), ("solid", 0, -1)]
    assert made[0].chain == made[1].chain
