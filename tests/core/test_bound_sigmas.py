"""Standard deviations along lines and bounds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from tests.core.laid_out_roads import avenue, drive
from urbanmap_qgis.roadmap.bound_sigmas import set_bound_sigmas
from urbanmap_qgis.roadmap.lines.line_work import RoadArea, line_work
from urbanmap_qgis.roadmap.map_records import Bound, MapLine, VectorMap, lines_of
from urbanmap_qgis.roadmap.map_tables import bound_columns
from urbanmap_qgis.roadmap.vector_map import build_vector_map


def straight(x0, x1, step=5.0, **more):
    at = np.arange(x0, x1 + 0.1, step)
    return MapLine(np.column_stack([at, np.zeros(len(at)), np.zeros(len(at))]), "solid", "white", **more)


def bound_of(xs, first=0):
    return [np.array([x, 0.0, 0.0]) for x in xs], Bound(list(range(first, first + len(xs))), "solid", sigma=0.02)


def test_sigma_grows_with_the_distance_to_a_line_and_across_bounds():
    places, bound = bound_of([0.0, 10.0, 20.0, 30.0])
    built = VectorMap([*places, np.array([50.0, 0.0, 0.0])], [bound, Bound([3, 4], "solid"), Bound([0, 3], "virtual")])
    set_bound_sigmas(built, [straight(0, 10, sigma=0.02)])
    assert bound.sigmas[:2] == pytest.approx([0.02, 0.02])
    assert bound.sigmas[2] == pytest.approx(np.hypot(0.02, 0.09)) and bound.sigmas[3] == pytest.approx(
        np.hypot(0.02, 0.19))
    assert built.bounds[1].sigmas == pytest.approx([np.hypot(0.02, 0.19), np.hypot(0.02, 0.39)])
    assert 0.02 < bound.sigma < bound.sigmas[3] and not built.bounds[2].sigmas


def test_sigma_between_two_lines_is_that_of_the_nearer_one():
    places, bound = bound_of([0.0, 14.0, 30.0])
    built = VectorMap(places, [bound])
    set_bound_sigmas(built, [straight(0, 5, sigma=0.02), straight(25, 30, sigma=0.03)])
    assert bound.sigmas[1] == pytest.approx(np.hypot(0.02, 0.08)) and bound.sigmas[2] == pytest.approx(0.03)


def test_vertices_of_a_line_tell_and_lines_without_sigma_leave_it_open():
    places, bound = bound_of([0.0, 10.0])
    built = VectorMap(places, [bound])
    set_bound_sigmas(built, [straight(0, 10, sigma=0.02)])
    line = straight(0, 10, sigma=0.02)
    set_bound_sigmas(built, [replace(line, sigmas=(0.01, 0.02, 0.05))])
    assert bound.sigmas == pytest.approx([0.01, 0.05])
    other = Bound([0, 1], "solid", sigma=np.nan)
    set_bound_sigmas(VectorMap(places, [other]), [straight(0, 10)])
    assert not other.sigmas and np.isnan(other.sigma)


def test_a_worn_line_tells_where_it_has_no_paint():
    paint = [shapely.box(a, -0.075, b, 0.075) for a, b in ((0, 20), (27, 50))]
    (line,) = [one for one in line_work(paint, ["white"] * 2).lines if one.kind == "solid"]
    assert len(line.sigmas) == len(line.points) and min(line.sigmas) >= 0.02
    told = bound_columns(VectorMap([], [Bound([], "solid", sigmas=[0.0214, 0.05])]))["sigmas"]
    assert told == ["0.021,0.050"]


def test_table_of_lines_keeps_the_sigmas_that_fit_its_vertices():
    shape = shapely.LineString([(0, 0), (10, 0), (20, 1)])
    columns = {"class": ["solid"] * 3, "sigma": [0.02] * 3, "sigmas": ["0.02,0.03,0.04", "0.02,0.03", "x"]}
    assert [line.sigmas for line in lines_of([shape] * 3, columns)] == [(0.02, 0.03, 0.04), (), ()]


def test_bounds_of_a_map_state_it_for_each_node():
    lines = [replace(line, sigma=0.02) for line in (*avenue(0, 60), *avenue(75, 120))]
    built = build_vector_map(lines, (), [drive((-10, 5.2), (130, 5.2)), drive((130, -5.2), (-10, -5.2))])
    painted = [bound for bound in built.bounds if bound.kind != "virtual"]
    assert painted and all(len(bound.sigmas) == len(bound.nodes) for bound in painted)
    assert min(min(bound.sigmas) for bound in painted) == pytest.approx(0.02)


def test_lines_of_a_layer_keep_their_chain_and_bound_and_official_edges_have_none():
    line = shapely.LineString([(0, 0, 1), (9, 0, 1)])
    columns = {"class": ["solid"], "chain": [7], "bound_id": [12]}
    (own,), (official,) = (lines_of([line], columns, field) for field in ("class", None))
    assert (own.kind, own.chain, own.identifier) == ("solid", 7, 12)
    assert (official.kind, official.chain, official.identifier) == ("road border", -1, -1)


def test_only_polygons_of_an_area_are_its_outline():
    parts = shapely.geometrycollections([shapely.box(0, 0, 1, 1), shapely.linestrings([(0, 0), (5, 5)]),
                                         shapely.box(3, 0, 4, 2)])
    area = RoadArea(parts, "unknown", np.full(2, np.nan), np.nan, "white")
    assert area.multipolygon.geom_type == "MultiPolygon" and area.multipolygon.area == 3.0
