"""Edges of building models against laser points: displaced models give their displacement, within sigma."""

import csv

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.acceptance.criteria import FAILED, HEIGHT, NOT_CHECKED, PASSED, PLAN, outcome
from urbanmap_qgis.acceptance.edge_comparison import (
    ABSENT_EDGES,
    SAME_POINTS,
    compare_edges,
    edge_criteria,
    plan_figures,
    shared_shift,
)
from urbanmap_qgis.acceptance.edge_measurement import (
    ABSENT,
    FEW,
    OPEN,
    ROOFS,
    SHOWN,
    VAGUE,
    WALLS,
    PointsAboutEdge,
    roof_edge,
)
from urbanmap_qgis.acceptance.edge_points import EdgeFrame, ModelSurface
from urbanmap_qgis.acceptance.edge_sampling import draw_edges
from urbanmap_qgis.acceptance.edges_report import (
    compared_numbers,
    edges_verdict,
    write_compared_csv,
    write_edges_report,
)
from urbanmap_qgis.acceptance.error_figures import across_figures
from urbanmap_qgis.acceptance.job import Job
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS, Limits
from urbanmap_qgis.io.points.pointcloud import open_cloud


def house(x, y, width=12.0, depth=9.0, turn=0.4, eave=6.0, rise=2.5):
    """A house with a gabled roof, on the ground at height 0, as all of its faces."""
    along, across = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])

    def at(u, v, z):
        return (*(np.array([x, y]) + u * along + v * across), z)

    a, b, c, d = at(0, 0, eave), at(width, 0, eave), at(width, depth, eave), at(0, depth, eave)
    left, right = at(0, depth / 2, eave + rise), at(width, depth / 2, eave + rise)
    e, f, g, h = ((*p[:2], 0.0) for p in (a, b, c, d))
    faces = [[a, b, right, left], [c, d, left, right], [e, h, g, f], [e, f, b, a], [f, g, c, right, b], [g, h, d, c],
             [h, e, a, left, d]]
    return shapely.MultiPolygon([shapely.Polygon(face) for face in faces])


@pytest.fixture(scope="module")
def town():
    """24 houses of several shapes and directions."""
    shape = np.random.default_rng(5)
    return [house(30.0 * (k % 6), 30.0 * (k // 6), shape.uniform(9, 14), shape.uniform(8, 10), shape.uniform(0, 1.5),
                  shape.uniform(4, 8), shape.choice([0.01, 2.5])) for k in range(24)]


@pytest.fixture(scope="module")
def clouds(town, tmp_path_factory):
    """Airborne points of the town by their density per m2: 5 cm in plan and 3 cm in height."""
    surface, folder, made = ModelSurface(town), tmp_path_factory.mktemp("clouds"), {}
    for density in (2, 10):
        draw = np.random.default_rng(density)
        plan = draw.uniform((-15, -15), (185, 125), (density * 200 * 140, 2))
        height = np.nan_to_num(surface.heights(plan))
        made[density] = cloud(np.column_stack([plan + draw.normal(0, 0.05, plan.shape),
                                               height + draw.normal(0, 0.03, len(plan))]), folder / f"{density}.las")
    return made


def cloud(points, path):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [0.001] * 3
    data = laspy.LasData(header)
    data.x, data.y, data.z = points.T
    data.write(path)
    return open_cloud([path])


def moved(models, shift):
    return [shapely.transform(model, lambda xyz: xyz + np.array(shift), include_z=True) for model in models]


def compared(models, points, limits=MAP_LEVELS[500], shown_by=ROOFS, count=84):
    drawn = draw_edges(models, [str(k) for k in range(len(models))], ["u"] * len(models), count=count)
    return compare_edges(drawn, models, points, limits, shown_by)


def sigmas(edges):
    return np.array([one.sigma for one in edges.measured])[edges.shown]


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (0.2, -0.1, 0.15), (0.9, 0.5, -0.4), (-0.6, 0.3, 0.0)])
def test_displaced_models_give_their_displacement_within_sigma(town, clouds, shift):
    edges = compared(moved(town, shift), clouds[10])
    every = np.ones(len(edges), bool)
    assert np.count_nonzero(edges.shown) > 70
    off = (edges.across - edges.normal @ shift[:2])[edges.shown]
    assert np.mean((off / sigmas(edges)) ** 2) < 1.5 and np.mean(np.abs(off) < 3 * sigmas(edges)) > 0.97
    assert abs(off.mean()) < 0.03
    assert shared_shift(edges, every) == pytest.approx(shift, abs=0.06)
    assert plan_figures(edges, every).rmse == pytest.approx(np.hypot(*shift[:2]), abs=0.07)
    assert np.nanmedian(edges.up) == pytest.approx(shift[2], abs=0.03)


@pytest.mark.slow
def test_right_models_keep_level_500_and_displaced_ones_do_not(town, clouds):
    right = compared(town, clouds[10])
    found = edge_criteria(right, MAP_LEVELS[500], independent=True)
    assert [(item.component, item.outcome) for item in found] == [(PLAN, PASSED), (HEIGHT, PASSED)]
    assert "Accepted for map level 500" in edges_verdict(right, found, 500)[1]
    off = edge_criteria(compared(moved(town, (0.5, 0.2, 0.5)), clouds[10]), MAP_LEVELS[500], independent=True)
    assert [item.outcome for item in off] == [FAILED, FAILED]


@pytest.mark.slow
def test_sparse_points_say_sigma_and_judge_no_sharp_level(town, clouds):
    wide, sharp = compared(town, clouds[2], MAP_LEVELS[1000]), compared(town, clouds[2])
    off = wide.across[wide.shown]
    assert np.median(sigmas(wide)) > 2 * np.median(sigmas(compared(town, clouds[10])))
    assert 0.3 < np.mean((off / sigmas(wide)) ** 2) < 1.5
    assert sharp.count(VAGUE, np.ones(len(sharp), bool)) > len(sharp) / 2
    assert (sigmas(sharp) <= 0.25 / np.sqrt(8)).all()


def test_points_that_the_models_were_made_of_judge_nothing(town, clouds):
    edges = compared(town, clouds[10])
    found = edge_criteria(edges, MAP_LEVELS[500], independent=False)
    assert {item.barred for item in found} == {SAME_POINTS} and outcome(found) == NOT_CHECKED
    assert "Not judged" in edges_verdict(edges, found, 500)[1]


def test_too_few_edges_judge_nothing(town, clouds):
    edges = compared(town[:4], clouds[10])
    assert 0 < np.count_nonzero(edges.shown) < 21
    found = edge_criteria(edges, MAP_LEVELS[500], independent=True)
    assert outcome(found) == NOT_CHECKED and "21 are needed" in edges_verdict(edges, found, 500)[1]


def test_models_where_nothing_stands_speak_against_the_delivery(town, clouds, tmp_path):
    lost = [house(30.0 * k + 14, 18.0, 8, 6, 0.0, 5.0) for k in range(5)]  # between the houses
    edges = compared([*town, *lost], clouds[10], count=200)
    phantom = np.array([int(name) >= len(town) for name in edges.drawn.building])
    assert edges.count(ABSENT, phantom) > 0.5 * phantom.sum() and edges.count(SHOWN, phantom) < 0.2 * phantom.sum()
    found = edge_criteria(edges, MAP_LEVELS[2500], independent=True)
    assert outcome(found) == NOT_CHECKED and {item.barred for item in found} == {ABSENT_EDGES}
    assert "there are points, but no edge" in edges_verdict(edges, found, 2500)[1]


def test_edges_without_points_and_party_walls_are_left_out(clouds):
    away = compared([house(5000.0, 0.0)], clouds[10])
    assert {one.reason for one in away.measured} == {FEW} and np.isnan(compared_numbers(away)["RMSE_PLAN"])
    row = [house(0, 0, 10, 9, 0.0), house(10, 0, 10, 9, 0.0)]
    drawn = draw_edges(row, "ab", ["u"] * 2, count=84)
    edges = compare_edges(drawn, row, clouds[10], MAP_LEVELS[500], ROOFS)
    shared = (np.abs(drawn.ends[:, :, 0] - 10.0) < 1e-6).all(axis=1)
    assert shared.sum() == 2 and all(edges.measured[k].reason == OPEN for k in np.flatnonzero(shared))


def test_walls_from_the_street_give_their_faces(town, tmp_path):
    draw, points = np.random.default_rng(2), []
    for model in town:
        for ends in draw_edges([model], ["a"], ["u"], count=9).ends:
            frame, count = EdgeFrame.of(ends), 1500
            plan = frame.world(draw.uniform(0, frame.length, count), draw.normal(0.0, 0.02, count))
            points += [np.column_stack([plan, draw.uniform(0, 4.0, count)]),
                       np.column_stack([frame.world(draw.uniform(0, frame.length, 300), draw.uniform(0.1, 2, 300)),
                                        np.zeros(300)])]
    edges = compared(moved(town, (0.3, -0.2, 0.0)), cloud(np.concatenate(points), tmp_path / "mms.las"), shown_by=WALLS)
    assert np.count_nonzero(edges.shown) > 60
    off = (edges.across - edges.normal @ (0.3, -0.2))[edges.shown]
    assert np.abs(off).max() < 0.06 and np.isnan(edges.up).all()
    found = edge_criteria(edges, MAP_LEVELS[500], independent=True)
    assert [item.outcome for item in found] == [FAILED, NOT_CHECKED]  # walls show no heights


def test_the_figure_in_plan_does_not_depend_on_how_many_edges_run_which_way():
    shift, rng = np.array([0.4, 0.0]), np.random.default_rng(0)
    for turn, east in ((0.0, 30), (0.0, 9), (0.7, 25)):
        angle = np.where(np.arange(40) < east, turn, turn + np.pi / 2)
        normals = np.column_stack([np.cos(angle), np.sin(angle)])
        assert across_figures(normals, normals @ shift).rmse == pytest.approx(0.4, abs=1e-9)
        noise = across_figures(normals, rng.normal(0, 0.1, 40)).rmse
        assert noise == pytest.approx(0.1 * np.sqrt(2), rel=0.35)
    one_way = across_figures(np.tile([1.0, 0.0], (30, 1)), np.full(30, 0.01))
    assert np.isnan(one_way.rmse) and one_way.count == 30


def test_report_and_table_tell_every_edge_and_what_they_rest_on(town, clouds, tmp_path):
    edges = compared(town, clouds[10])
    for independent, words in ((False, "a check of the modelling, not of accuracy"), (True, "nor their names prove")):
        found = edge_criteria(edges, MAP_LEVELS[500], independent)
        write_edges_report(tmp_path / "a.html", edges, found, MAP_LEVELS[500], Job(job="第3工区"), 500, independent)
        page = (tmp_path / "a.html").read_text(encoding="utf-8")
        assert words in page and "第3工区" in page and ("Accepted" in page) == independent
    write_compared_csv(tmp_path / "a.csv", edges)
    with (tmp_path / "a.csv").open(encoding="utf-8-sig", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(edges)
    assert float(rows[0]["across"]) == pytest.approx(edges.across[0], abs=1e-4)
    assert all((row["across"] == "") == (row["left_out"] != "") for row in rows)


def window(outward_to, lower_at):
    """A flat roof 6 m high whose points go on to so far outward of the model's edge, and points on the ground."""
    steps = np.arange(0.05, 8.0, 0.1)
    along, outward = (values.ravel() for values in np.meshgrid(steps, np.arange(-3.0, outward_to, 0.1)))
    low = np.array([[x, place] for x in steps for place in lower_at])
    above = np.concatenate([np.zeros(len(along)), np.full(len(low), -6.0)])
    return PointsAboutEdge(np.concatenate([along, low[:, 0]]), np.concatenate([outward, low[:, 1]]), 6.0 + above, above,
                           reach=1.0, length=8.0, roof=6.0)


@pytest.mark.parametrize("lower_at, reason", [((1.5, 1.6, 1.7), ABSENT), ((0.2, 0.3, 0.4, 0.5), OPEN)])
def test_roofs_that_go_on_beyond_the_window_speak_against_the_model_only_where_they_end(lower_at, reason):
    """Beyond the window lower points show that the roof ends there; lower points only before its end do not."""
    assert roof_edge(window(1.45 if reason == ABSENT else 3.0, lower_at)).reason == reason


def test_without_limits_nothing_is_judged(town, clouds):
    edges = compared(town, clouds[10], Limits(None, None))
    found = edge_criteria(edges, Limits(None, None), independent=True)
    assert found == [] and "Nothing was judged" in edges_verdict(edges, found, None)[1]
