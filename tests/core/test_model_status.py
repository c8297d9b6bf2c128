"""What a model says of itself: statuses, reasons, quality, and the points that it is measured against."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.building_model import FROM_NEIGHBOURS, FitPoints, RoofInput, model_building
from urbanmap_qgis.buildings.fit_points import candidate_points
from urbanmap_qgis.buildings.model_stage import bases_with_neighbours, build_models
from urbanmap_qgis.buildings.model_status import (
    FEW_POINTS,
    GROUND_UNKNOWN,
    LOST_ROOFS,
    LOW,
    NOT_MODELLED,
    OK,
    PARTLY_MODELLED,
    POOR_FIT,
    SMALL,
    STATUSES,
    UNSEEN,
    ModelFacts,
    counts,
    judge,
    quality,
)
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints, has_curved_walls
from urbanmap_qgis.progress import notices_to


def grid_points(x0, y0, x1, y1, height, step=0.4):
    """Points (n, 3) of a level roof on a regular raster."""
    x, y = [a.ravel() for a in np.meshgrid(np.arange(x0 + step / 2, x1, step), np.arange(y0 + step / 2, y1, step))]
    return np.column_stack([x, y, np.full(len(x), float(height))])


def roofs_of(*rows, status="ok"):
    polygons = np.empty(len(rows), dtype=object)
    polygons[:] = [row[0] for row in rows]
    return RoofInput(polygons, np.ones(len(rows), int), np.arange(1, len(rows) + 1),
                     np.array([row[1] for row in rows], float), np.full(len(rows), status, object))


def made(outline, roofs, base=0.0, points=None, **more):
    fit = None if points is None else FitPoints(points, np.ones(len(points), int))
    return model_building(1, outline, "", roofs, base, fit, **more)


BOX = shapely.box(0, 0, 20, 10)


def test_a_model_near_all_of_its_points_is_ok():
    model = made(BOX, roofs_of((BOX, 8.0)), points=grid_points(0, 0, 20, 10, 8.02))
    assert (model.status, model.reason) == (OK, "")
    assert model.quality > 0.95 and model.fit.not_explained == 0


def test_a_tower_left_out_is_not_explained():
    points = np.concatenate([grid_points(0, 0, 20, 10, 8.0), grid_points(5, 0, 15, 10, 40.0)])
    model = made(BOX, roofs_of((BOX, 8.0)), points=points)
    assert model.status == POOR_FIT and "33 %" in model.reason
    assert model.quality < 0.1


@pytest.mark.parametrize(("sloped", "status"), [(True, POOR_FIT), (False, OK)])
def test_roofs_that_may_slope_are_held_to_half_a_metre(sloped, status):
    points = grid_points(0, 0, 20, 10, 8.0)
    inner = (np.abs(points[:, 0] - 10) < 4) & (np.abs(points[:, 1] - 5) < 2.5)  # a fifth of the plan
    points[inner, 2] += 1.6
    assert made(BOX, roofs_of((BOX, 8.0)), points=points, sloped=sloped).status == status


def test_parapets_are_explained():
    inside = grid_points(1, 1, 19, 9, 8.0)
    ring = grid_points(0, 0, 20, 10, 9.0)
    ring = ring[~((ring[:, 0] > 0.8) & (ring[:, 0] < 19.2) & (ring[:, 1] > 0.8) & (ring[:, 1] < 9.2))]
    model = made(BOX, roofs_of((BOX, 8.0)), points=np.concatenate([inside, ring]))
    assert model.status == OK and model.fit.not_explained == 0


def test_lost_roofs_reach_the_model():
    assert made(BOX, roofs_of((BOX, 8.0), status="lost roofs; outline from points, regular")).status == LOST_ROOFS


@pytest.mark.parametrize(("height", "status"), [(9.2, LOST_ROOFS), (8.3, OK)])
def test_a_roof_without_a_polygon_is_lost_where_no_other_explains_it(height, status):
    points = np.concatenate([grid_points(0, 0, 20, 10, 8.0), grid_points(8, 3, 12, 7, height)])
    fit = FitPoints(points, np.repeat([1, 2], [1250, 100]))
    assert model_building(1, BOX, "", roofs_of((BOX, 8.0)), 0.0, fit).status == status


def test_twelve_centimetres_are_no_sound_building():
    model = made(BOX, roofs_of((BOX, 3.12)), base=3.0)
    assert model.status == LOW and "0.12 m" in model.reason


def test_an_outline_modelled_in_part_says_how_much():
    model = made(BOX, roofs_of((shapely.box(0, 0, 10, 10), 8.0)))
    assert model.status == PARTLY_MODELLED and "50 %" in model.reason


def test_small_and_sparse_buildings_have_their_own_words():
    shed = shapely.box(0, 0, 2, 2)
    assert made(shed, roofs_of((shed, 3.0))).status == SMALL
    assert made(BOX, roofs_of((BOX, 8.0)), points=grid_points(0, 0, 20, 10, 8.0, step=4.0)).status == FEW_POINTS
    half = grid_points(0, 0, 8, 10, 8.0)
    assert made(BOX, roofs_of((BOX, 8.0)), points=half).status == UNSEEN


def test_towers_and_curved_walls_are_noted_and_stay_ok():
    circle = shapely.Point(0, 0).buffer(8.0)
    assert has_curved_walls(circle) and not has_curved_walls(BOX)
    model = made(circle, roofs_of((circle, 60.0)))
    assert model.status == OK and "tower, 60 m" in model.reason and "curved" in model.reason


def test_the_gravest_status_comes_first_and_all_reasons_stay():
    facts = ModelFacts(height=0.3, area=4.0, outline_area=4.0, points=9.0, not_explained=0.6, unseen=0.7, rmse_z95=0.4,
                       lost_roofs=True)
    status, reason = judge(GROUND_UNKNOWN, "its ground is not known", facts)
    assert status == POOR_FIT
    for text in ("60 %", "no polygon", "0.30 m", "ground is not known", "70 %", "only 9 points", "4.0 m2"):
        assert text in reason
    assert (*STATUSES,)[::len(STATUSES) - 1] == (NOT_MODELLED, OK)


def test_every_status_is_counted():
    found = counts([OK, OK, LOW])
    assert set(found) == set(STATUSES) and found[OK] == 2 and found[LOW] == 1 and sum(found.values()) == 3


@pytest.mark.parametrize("worse", [{"rmse_z95": 0.4}, {"rmse_z": 0.9}, {"not_explained": 0.2}, {"unseen": 0.3}])
def test_quality_falls_with_each_flaw(worse):
    good = {"rmse_z": 0.2, "rmse_z95": 0.1, "not_explained": 0.05, "unseen": 0.05}
    assert 0 < quality(OK, **{**good, **worse}) < quality(OK, **good) < 1
    assert quality(NOT_MODELLED, **good) == 0 and np.isnan(quality(OK, np.nan, np.nan, 0.0, 0.0))


def test_unknown_ground_is_taken_from_near_neighbours_only():
    boxes = [shapely.box(x, 0, x + 10, 10) for x in (0, 20, 40, 500)]
    footprints = clean_footprints(np.array(boxes, object))
    base, source = bases_with_neighbours(footprints, np.array([5.0, np.nan, 7.0, np.nan]))
    assert base[:3] == pytest.approx([5.0, 6.0, 7.0]) and np.isnan(base[3])
    assert source[1] == FROM_NEIGHBOURS and source[0] == source[2] == ""
    roofs = RoofInput(np.array(boxes, object), footprints.ids, np.ones(4, int), np.full(4, 12.0),
                      np.full(4, "ok", object))
    models = build_models(footprints, roofs, np.array([5.0, np.nan, 7.0, np.nan]))
    assert [model.status for model in models] == [OK, GROUND_UNKNOWN, OK, GROUND_UNKNOWN]
    assert [model.base for model in models] == pytest.approx([5.0, 6.0, 7.0, 9.5])
    assert "neighbours" in models[1].reason and "assumed 2.5 m" in models[3].reason


@pytest.mark.parametrize("unit", [1.0, 100.0])
def test_heights_in_centimetres_are_told(unit):
    boxes, told = [shapely.box(30.0 * k, 0.0, 30.0 * k + 10.0, 10.0) for k in range(3)], []
    footprints = clean_footprints(np.array(boxes, object))
    roofs = RoofInput(np.array(boxes, object), footprints.ids, np.ones(3, int), unit * np.array([9.0, 12.0, 15.0]),
                      np.full(3, "ok", object))
    with notices_to(told.append):
        build_models(footprints, roofs, unit * np.full(3, 4.0))
    assert len(told) == (unit != 1.0) and all("centimetres" in line for line in told)


def test_smooth_surfaces_that_no_roof_took_are_candidates_and_trees_are_not():
    rng = np.random.default_rng(1)
    roof, upper = grid_points(0, 0, 20, 10, 8.0), grid_points(2, 2, 8, 8, 20.0)
    tree = np.column_stack([rng.uniform(12, 18, 300), rng.uniform(2, 8, 300), rng.uniform(9, 16, 300)])
    low = grid_points(0, 0, 20, 10, 0.5)
    points = np.concatenate([roof, upper, tree, low])
    on_roof = np.arange(len(points)) < len(roof)
    under = (points[:, 0] > 12) & (points[:, 0] < 18) & (points[:, 1] > 2) & (points[:, 1] < 8)
    seen = ~(((points[:, 0] > 2) & (points[:, 0] < 8) & (points[:, 1] > 2) & (points[:, 1] < 8) | under)
             & (points[:, 2] == 8.0))
    use = candidate_points(*points[seen].T, on_roof[seen], np.zeros(seen.sum(), bool), BOX, 0.0)
    everything = candidate_points(*points[seen].T, on_roof[seen], np.ones(seen.sum(), bool), BOX, 0.0)
    assert (everything == (points[seen][:, 2] >= 2.0)).all()
    kept = points[seen][use]
    assert (kept[:, 2] == 20.0).sum() > 0.8 * len(upper)
    assert ((kept[:, 2] > 9) & (kept[:, 2] < 16.1)).sum() < 0.1 * len(tree)
    assert not (kept[:, 2] < 1).any()
