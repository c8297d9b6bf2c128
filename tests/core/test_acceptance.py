"""Errors at check points against the limits of a map level."""

import csv
import re

import numpy as np
import pytest

from urbanmap_qgis.acceptance.acceptance_report import error_map, verdict, write_acceptance_report, write_points_csv
from urbanmap_qgis.acceptance.check_points import check_points_from_columns
from urbanmap_qgis.acceptance.criteria import FAILED, HEIGHT, NOT_CHECKED, PASSED, PLAN, criteria, outcome
from urbanmap_qgis.acceptance.error_figures import across_figures, point_figures, signed_figures
from urbanmap_qgis.acceptance.job import Job
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS, Limits
from urbanmap_qgis.acceptance.pdf_content import metres
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.pages.report import Fixed
from urbanmap_qgis.io.pages.svg_vectors import vector_map, vector_map_shape


def table(errors, **more):
    """A table of coordinates whose product is off by `errors` (n, 3)."""
    errors = np.asarray(errors, float)
    true = np.column_stack([100.0 * np.arange(len(errors)), 50.0 * np.arange(len(errors)), np.full(len(errors), 7.0)])
    product = true + errors
    return {"id": [f"P{k}" for k in range(len(errors))],
            **{name: list(true[:, k]) for k, name in enumerate("xyz")},
            **{f"{name}_product": list(product[:, k]) for k, name in enumerate("xyz")}, **more}


def test_errors_are_product_less_truth():
    points = check_points_from_columns(table([(0.03, -0.04, 0.02)]))
    assert points.errors == pytest.approx(np.array([[0.03, -0.04, 0.02]]), abs=1e-9)
    assert points.state == ""


def test_figures_of_a_known_example():
    figures = point_figures(np.array([[0.03, 0.04, 0.1], [-0.03, -0.04, -0.1], [0.06, 0.08, np.nan]]))
    assert figures.plan.count == 3 and figures.height.count == 2
    assert figures.plan.mean == pytest.approx((0.05 + 0.05 + 0.1) / 3)
    assert figures.plan.rmse == pytest.approx(np.sqrt((0.0025 + 0.0025 + 0.01) / 3))
    assert figures.plan.maximum == pytest.approx(0.1)
    assert figures.height.rmse == pytest.approx(0.1)
    assert figures.height.std == pytest.approx(0.1 * np.sqrt(2))
    assert figures.height.mean == pytest.approx(0.0)


def test_the_bound_holds_in_95_of_100_samples():
    draws = np.random.default_rng(3).normal(0.0, 0.2, (4000, 8))
    held = np.mean([signed_figures(row).bound >= 0.2 for row in draws])
    assert held == pytest.approx(0.95, abs=0.012)


@pytest.mark.parametrize(("across", "turned", "shared"), [
    (1.0, 0.0, 0.0), (0.5, 0.6, 0.0), (0.1, 0.6, 0.0), (0.1, 0.0, 0.5)])
def test_the_bound_in_plan_holds_however_errors_lie(across, turned, shared):
    """With 2 n degrees of freedom it would hold in 86 to 88 % of samples where errors lie along one line."""
    draws = np.random.default_rng(4).normal(0.0, 1.0, (4000, 10, 2)) * [0.2, 0.2 * across] + [0.2 * shared, 0.0]
    turn = np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]])
    all_places = 0.2 * np.sqrt(1.0 + across ** 2 + shared ** 2)
    held = np.mean([point_figures(np.column_stack([row @ turn, row[:, 0]])).plan.bound >= all_places for row in draws])
    assert 0.93 <= held <= 0.975


def test_the_bound_in_plan_is_that_of_chi_square_with_the_components_that_vary():
    from scipy.stats import chi2

    along = np.array([0.1, -0.3, 0.2, -0.1, 0.25, 0.3])
    line = point_figures(np.column_stack([along, 2.0 * along, along])).plan
    assert line.bound == pytest.approx(line.rmse * np.sqrt(6.0 / chi2.ppf(0.05, 6)))
    cross = np.vstack([np.column_stack([along, 0.0 * along]), np.column_stack([0.0 * along, along])])
    both = point_figures(np.column_stack([cross, cross[:, 0]])).plan
    assert both.bound == pytest.approx(both.rmse * np.sqrt(24.0 / chi2.ppf(0.05, 24)))
    none = point_figures(np.zeros((4, 3))).plan
    assert (none.rmse, none.bound) == (0.0, 0.0)


@pytest.mark.parametrize(("many", "few"), [(10, 10), (27, 3)])
def test_the_bound_across_edges_holds_where_few_run_the_other_way(many, few):
    """Three edges decide as much as 27 of the other direction; counted as 30 the bound would hold in 84 %."""
    normals = np.vstack([np.tile([1.0, 0.0], (many, 1)), np.tile([0.0, 1.0], (few, 1))])
    draws = np.random.default_rng(5).normal(0.0, 0.2, (4000, many + few))
    found = [across_figures(normals, row) for row in draws]
    held = np.mean([figures.bound >= 0.2 * np.sqrt(2.0) for figures in found])
    assert held >= 0.94
    assert np.mean([figures.rmse ** 2 for figures in found]) == pytest.approx(0.08, rel=0.03)


def test_one_error_alone_has_no_deviation_about_its_mean():
    figures = signed_figures(np.array([0.1]))
    assert figures.rmse == pytest.approx(0.1) and np.isnan(figures.std)


def test_limits_decide_each_component_by_itself():
    points = check_points_from_columns(table([(0.2, 0.0, 0.3), (-0.2, 0.0, -0.3)]))
    plan, height = criteria(points, MAP_LEVELS[500])
    assert (plan.component, plan.outcome) == (PLAN, PASSED)
    assert (height.component, height.outcome) == (HEIGHT, FAILED)
    assert outcome([plan, height]) == FAILED
    assert outcome(criteria(points, MAP_LEVELS[1000])) == PASSED


def test_a_shared_shift_fails_although_its_spread_is_small():
    points = check_points_from_columns(table([(0.3, 0.0, 0.0)] * 9))
    assert criteria(points, Limits(0.25, None))[0].outcome == FAILED


def test_nothing_passes_without_points_or_with_too_few():
    errors = [(0.01, 0.0, np.nan)] * 5
    plan, height = criteria(check_points_from_columns(table(errors)), MAP_LEVELS[250])
    assert plan.outcome == PASSED
    assert height.outcome == NOT_CHECKED
    assert outcome([plan, height]) == NOT_CHECKED
    assert criteria(check_points_from_columns(table(errors)), MAP_LEVELS[250], needed=6)[0].outcome == NOT_CHECKED
    assert outcome([]) == NOT_CHECKED


def test_each_unit_is_judged_by_itself():
    points = check_points_from_columns(table([(0.01, 0, 0), (0.02, 0, 0), (0.9, 0, 0)], mesh=["a", "a", "b"]),
                                       unit_field="mesh")
    found = criteria(points, Limits(0.25, None))
    assert [(item.unit, item.outcome) for item in found] == [("a", PASSED), ("b", FAILED)]


def test_points_that_were_adjusted_to_are_no_check():
    points = check_points_from_columns(table([(0.1, 0, 0), (0.0, 0, 0), (0.0, 0, 0)],
                                             role=["検証点", "調整点", "adjusted"]))
    assert points.id == ("P0",) and points.adjusted == 2
    with pytest.raises(InputError, match="no check point"):
        check_points_from_columns(table([(0.0, 0, 0)], role=["adjusted"]))
    with pytest.raises(InputError, match="role “spare”"):
        check_points_from_columns(table([(0.0, 0, 0)], role=["spare"]))


def test_residuals_after_the_correction_are_taken_before_those_as_reported():
    columns = {"id": ["a"], **{f"{axis}_before": [1.0] for axis in ("east", "north", "up")},
               **{f"{axis}_after": [0.1] for axis in ("east", "north", "up")}}
    assert check_points_from_columns(columns).state == "after"
    columns.update({f"{axis}_after": [None] for axis in ("east", "north", "up")})
    points = check_points_from_columns(columns)
    assert points.state == "before" and points.errors[0, 0] == 1.0


@pytest.mark.parametrize(("columns", "said"), [
    ({"a": [1]}, "no column x, y, x_product, y_product"),
    ({**table([(0, 0, 0)]), "x_product": ["far"]}, "“far” in row 1 of the column x_product is no number"),
    ({**table([(0, 0, 0)]), "x_product": [None]}, "no check point"),
])
def test_wrong_tables_are_told_in_a_sentence(columns, said):
    with pytest.raises(InputError, match=said):
        check_points_from_columns(columns, name="checks")


def test_a_unit_that_is_no_field_is_told():
    with pytest.raises(InputError, match="no field mesh"):
        check_points_from_columns(table([(0, 0, 0)]), unit_field="mesh")


def test_the_verdict_never_accepts_what_was_not_checked():
    few = check_points_from_columns(table([(0.01, 0.0, np.nan)]))
    assert verdict(few, criteria(few, MAP_LEVELS[500]), 500)[1].startswith("Not judged")
    bad = check_points_from_columns(table([(0.5, 0.0, 0.0)]))
    assert verdict(bad, criteria(bad, MAP_LEVELS[500]), 500)[1] == (
        "Not accepted for map level 500: position in plan 0.500 m, limit 0.250 m.")
    sure = check_points_from_columns(table([(0.01, 0.0, 0.01)] * 40))
    assert "also with a confidence" in verdict(sure, criteria(sure, MAP_LEVELS[500]), 500)[1]
    close = check_points_from_columns(table([(0.24, 0.0, 0.01)] * 4))
    assert "too few" in verdict(close, criteria(close, MAP_LEVELS[500]), 500)[1]


def test_report_and_table_hold_every_point(tmp_path):
    points = check_points_from_columns(table(np.random.default_rng(1).normal(0, 0.02, (12, 3))))
    found = criteria(points, MAP_LEVELS[500])
    write_acceptance_report(tmp_path / "a.html", points, found, MAP_LEVELS[500], Job(job="第3工区 <1>"), 500,
                            {"Correction in plan (m)": np.array([0.9, 1.1])})
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "第3工区 &lt;1&gt;" in page and page.count("<circle") == 12
    assert "1.000" in page and "1.100" in page  # of the registration
    write_points_csv(tmp_path / "a.csv", points)
    with (tmp_path / "a.csv").open(encoding="utf-8-sig", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["id"] for row in rows] == list(points.id)
    assert float(rows[3]["plan"]) == pytest.approx(np.hypot(*points.errors[3, :2]), abs=1e-4)


def test_points_without_a_place_have_no_map():
    columns = {"id": ["a"], **{f"{axis}_after": [0.1] for axis in ("east", "north", "up")}}
    assert error_map(check_points_from_columns(columns), Limits(0.2, None)) is None


def test_lengths_of_the_pdf_have_no_negative_zero():
    assert [metres(value) for value in (-0.0004, 0.0, -0.0006, float("nan"))] == ["0.000", "0.000", "-0.001", "–"]


def test_a_map_has_the_shape_of_its_points():
    wide, tall = np.array([[0.0, 0.0], [300.0, 60.0]]), np.array([[0.0, 0.0], [100.0, 300.0]])
    assert vector_map_shape(wide) < 0.5 < 2.0 < vector_map_shape(tall)
    assert vector_map_shape(np.full((2, 2), np.nan)) == 0.75
    for places in (wide, tall):
        height = round(720 * vector_map_shape(places))
        drawing = vector_map(places, np.zeros((2, 2)), ["a", "b"], width=720, height=height)
        found = np.array(re.findall(r'<circle cx="(\S+)" cy="(\S+)"', drawing), float)
        # The points reach from one margin to the other both ways.
        assert np.allclose(np.ptp(found, axis=0), [720 - 148, height - 148 - 30], atol=2.0)


def test_names_on_the_map_stay_on_it_and_clear_of_each_other():
    places = np.array([(0.0, 0.0), (500.0, 200.0), (495.0, 199.0), (250.0, 0.0), (260.0, 1.0), (400.0, 100.0)])
    names = [f"検-{k:03d} 交差点北西角" for k in range(5)] + ["名" * 90]
    drawing = vector_map(places, np.zeros((6, 2)), names, width=720, height=400)
    points = np.array(re.findall(r'<circle cx="(\S+)" cy="(\S+)"', drawing), float)
    texts = re.findall(r'<text x="(\S+)" y="(\S+)" fill="#444">(.*?)<', drawing)
    shown = {name: (float(x), float(y)) for x, y, name in texts}
    # Wide letters are as wide as high, 11 pixels; the name that is longer than the map is left out.
    spans = {name: (x, x + 7 * 11 + 6 * 6) for name, (x, _) in shown.items()}
    assert names[0] in shown and names[1] in shown and names[5] not in shown
    assert all(begin >= 0 and end <= 720 for begin, end in spans.values())
    assert shown[names[0]][0] > points[0, 0] and spans[names[1]][1] < points[1, 0]
    for one in shown:
        for other in shown:
            if one < other and abs(shown[one][1] - shown[other][1]) < 11:
                assert spans[one][1] <= spans[other][0] or spans[other][1] <= spans[one][0]


@pytest.mark.parametrize(("value", "text"), [
    (-0.0004, "0.000"), (-0.0, "0.000"), (-0.0005001, "-0.001"), (10.0, "10.000"), (np.nan, "–")])
def test_no_figure_is_minus_nothing(value, text):
    assert Fixed.of(value, 3) == text
