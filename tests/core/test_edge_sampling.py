"""Edges of building models drawn for a survey, and what a unit needs of them."""

import csv

import numpy as np
import pytest
import shapely

from urbanmap_qgis.acceptance.acceptance_report import verdict, write_acceptance_report, write_sampling_report
from urbanmap_qgis.acceptance.check_points import check_points_from_columns
from urbanmap_qgis.acceptance.criteria import NOT_CHECKED, PASSED, criteria, outcome
from urbanmap_qgis.acceptance.edge_sampling import (
    EDGES_OF_UNIT,
    draw_edges,
    measured_edges,
    outer_edges,
    quarter_meshes,
    write_edges_csv,
)
from urbanmap_qgis.acceptance.job import Job
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS
from urbanmap_qgis.errors import InputError


def house(x, y, height=12.0, foot=3.0):
    """A box of 10 by 6 m as all of its faces."""
    corners = [(x, y), (x + 10, y), (x + 10, y + 6), (x, y + 6)]
    walls = [[(*a, foot), (*b, foot), (*b, height), (*a, height)] for a, b in zip(corners, corners[1:] + corners[:1])]
    faces = [[(*c, height) for c in corners], [(*c, foot) for c in corners[::-1]], *walls]
    return shapely.MultiPolygon([shapely.Polygon(face) for face in faces])


def test_edges_are_those_of_the_contour_at_the_height_of_the_roof():
    edges = outer_edges(house(100, 200))
    assert edges.shape == (4, 2, 3) and (edges[:, :, 2] == 12.0).all()
    assert {tuple(point) for point in edges.reshape(-1, 3)} == {
        (100.0, 200.0, 12.0), (110.0, 200.0, 12.0), (110.0, 206.0, 12.0), (100.0, 206.0, 12.0)}
    assert len(outer_edges(shapely.force_2d(house(0, 0)))) == 0 and len(outer_edges(None)) == 0


def test_a_vertex_on_a_straight_side_is_no_corner():
    corners = [(0, 0), (4, 0), (10, 0), (10, 6), (9, 6), (9, 7), (0, 7)]
    roof = shapely.MultiPolygon([shapely.Polygon([(*c, 5.0) for c in corners])])
    lengths = sorted(np.hypot(*(edge[1] - edge[0])[:2]) for edge in outer_edges(roof))
    assert lengths == pytest.approx([6, 7, 9, 10])  # the two sides of 1 m are too short


def test_a_unit_gets_one_edge_of_each_building_before_a_second():
    models = [house(20 * k, 0) for k in range(30)]
    drawn = draw_edges(models, range(30), ["a"] * 30)
    assert len(drawn) == EDGES_OF_UNIT and len(set(drawn.building)) == EDGES_OF_UNIT
    assert drawn.available == {"a": 120}
    again = draw_edges(models, range(30), ["a"] * 30)
    assert (again.ends == drawn.ends).all()
    assert (draw_edges(models, range(30), ["a"] * 30, seed=2).ends != drawn.ends).any()


def test_a_unit_with_few_edges_gives_all_and_says_so(tmp_path):
    drawn = draw_edges([house(0, 0), house(500, 0), house(520, 0)], "pqr", ["a", "b", "b"])
    assert drawn.available == {"a": 4, "b": 8} and len(drawn) == 12
    write_sampling_report(tmp_path / "a.html", drawn, Job(job="第3工区"))
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "Nothing was checked" in page and "cannot be judged by themselves" in page and "Accepted" not in page


def test_outlines_without_heights_are_refused():
    with pytest.raises(InputError, match="give models, not outlines"):
        draw_edges([shapely.box(0, 0, 10, 10)], ["a"], [""])


def test_units_are_quarter_meshes_in_japan_only():
    # Just north-east of the origin of zone IX, 36 N 139 50' E. First mesh 54 39; of 50' eighths of a degree are 6.67,
    # tenths of the rest 6.67: second 0 6, third 0 6; two thirds of its side: south-east half 2, south-west of that 1.
    assert quarter_meshes([house(50, 50)], "EPSG:6677") == ["5439060621"]
    assert quarter_meshes([house(85000, 447000)], "EPSG:28992") == [""]


def fill(path, offset):
    """The table of edges as a survey gives it back: each point truly lies `offset` away from the product."""
    with path.open(encoding="utf-8-sig", newline="") as stream:
        rows = list(csv.DictReader(stream))
    for row in rows:
        for axis, off in zip("xyz", offset):
            row[axis] = f"{float(row[f'{axis}_product']) - off:.3f}"
    return {name: [row[name] for row in rows] for name in rows[0]}


@pytest.fixture
def measured(tmp_path):
    """21 edges with both ends, 10 cm off in plan and 5 cm in height."""
    drawn = draw_edges([house(20 * k, 0) for k in range(21)], range(21), ["m"] * 21)
    write_edges_csv(tmp_path / "edges.csv", drawn)
    return fill(tmp_path / "edges.csv", (0.06, 0.08, 0.05))


def judged(columns):
    points = check_points_from_columns(columns, unit_field="unit")
    return points, criteria(points, MAP_LEVELS[500], 42, EDGES_OF_UNIT)


def test_a_filled_table_is_judged(measured, tmp_path):
    points, found = judged(measured)
    assert len(points) == 42 and outcome(found) == PASSED
    assert [item.figures.rmse for item in found] == pytest.approx([0.1, 0.05], abs=1e-3)
    write_acceptance_report(tmp_path / "r.html", points, found, MAP_LEVELS[500], Job(), 500)
    assert "Sampled edges of buildings" in (tmp_path / "r.html").read_text(encoding="utf-8")


def test_an_edge_with_one_end_is_none(measured):
    measured["x"][0] = ""
    points, found = judged(measured)
    assert measured_edges(points.edge, points.unit) == {"m": 20}
    assert outcome(found) == NOT_CHECKED
    assert verdict(points, found, 500)[1] == (
        "Not judged for map level 500: 20 edges with both ends measured (m), and 21 are needed.")


def test_a_table_that_nobody_filled_is_no_check(measured):
    for axis in "xyz":
        measured[axis] = [""] * 42
    with pytest.raises(InputError, match="no check point"):
        judged(measured)
