"""The building chain on real clouds, against the figures that it is to reach."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("osgeo.ogr", reason="GDAL's Python module, which reads the outlines, is not installed")

from scripts.bench import DATA, DELFT, Delft, chain
from scripts.layers import read_layer
from urbanmap_qgis.buildings.model_status import NOT_MODELLED
from urbanmap_qgis.buildings.solids.validity import check_solid

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="the real test data are not beside the checkout")


@pytest.fixture(scope="module")
def delft():
    return Delft.read()


def figures(delft, cloud, outlines="outlines"):
    run = chain(DELFT / f"{cloud}.laz", read_layer(DELFT / f"{outlines}.gpkg")[0])
    return run, dict(zip(("modelled", "ok", "roofs", "rmse_z95", "rmse_3d", "flat", "iou"), delft.figures(run)))


@pytest.mark.parametrize("cloud, rmse_z95, flat", [("points", 0.50, 0.14), ("points_unclassified", 0.54, 0.14),
                                                   ("points_2_per_m2", 0.65, 0.14), ("points_1_per_m2", 0.78, 0.16)])
def test_delft_is_modelled_whole_and_valid(delft, cloud, rmse_z95, flat):
    run, reached = figures(delft, cloud)
    assert reached["modelled"] == "92/92"
    assert [problem for model in run.models for solid in model.solids for problem in check_solid(solid)] == []
    assert reached["rmse_z95"] <= rmse_z95
    assert reached["flat"] <= flat
    assert reached["iou"] >= 0.98
    assert reached["roofs"] <= 350


@pytest.mark.parametrize("cloud", ["points", "points_unclassified"])
@pytest.mark.parametrize("outlines, iou", [("outlines_shifted_1m", 0.85), ("outlines_shifted_2m", 0.80)])
def test_displaced_outlines_are_brought_back(delft, cloud, outlines, iou):
    _, reached = figures(delft, cloud, outlines)
    # A model of a displaced outline may say that it does not explain the points beside it.
    assert reached["iou"] >= iou and reached["modelled"] == "92/92" and reached["ok"] >= 76


def test_a_cell_of_delft_without_ground_points():
    outlines, (base,) = read_layer(DATA / "delft_cells" / "outlines_83000_446500.gpkg", "z_base")
    run = chain(DATA / "delft_cells" / "points_83000_446500.laz", outlines, np.array(base, float))
    assert sum(bool(model.solids) for model in run.models) >= 652
    # All points that can be roof count, also those of which no roof was made: a few buildings are far off.
    error = [model.fit.rmse_z95 for model in run.models if model.fit]
    assert np.nanmedian(error) < 0.25 and np.nanmean(error) < 0.40


@pytest.mark.parametrize("cloud, outlines, field, least", [
    ("ign/870000_6618000.laz", "ign/870000_6618000_buildings.gpkg", "building_id", 6),
    ("amsterdam/ahn_2386_9702.laz", "amsterdam/outlines_bgt.gpkg", "building_id", 8)])
def test_other_clouds_lose_no_row(cloud, outlines, field, least):
    polygons, _ = read_layer(DATA / outlines, field)
    models = chain(DATA / cloud, polygons).models
    assert len(models) == len(polygons)
    assert sum(bool(model.solids) for model in models) >= least
    assert all(model.reason for model in models if model.status == NOT_MODELLED)
