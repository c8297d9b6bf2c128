"""Sloped roofs on the part of Delft beside the checkout, with all their points and thinned."""

import numpy as np
import pytest

from scripts.bench import DELFT, Delft, chain, score
from scripts.bench_sloped import shares
from scripts.layers import read_layer
from scripts.scoring import points_inside, summary
from urbanmap_qgis.buildings.solids.validity import check_solid

pytestmark = pytest.mark.skipif(not DELFT.is_dir(), reason="the laser points of Delft are not beside the checkout")


@pytest.fixture(scope="module")
def delft():
    pytest.importorskip("osgeo")
    return Delft.read()


@pytest.mark.parametrize(("cloud", "error", "near"), [("points", 0.23, 0.88), ("points_unclassified", 0.23, 0.87),
                                                      ("points_2_per_m2", 0.35, 0.82), ("points_1_per_m2", 0.60, 0.70)])
def test_sloped_roofs_lie_on_their_points(delft, cloud, error, near):
    outlines, _ = read_layer(DELFT / "outlines.gpkg", "lokaalid")
    run = chain(DELFT / f"{cloud}.laz", outlines, sloped=True)
    assert all(model.solids for model in run.models)
    simplified = [model for model in run.models if model.lod != "2.2"]
    assert len(simplified) <= (cloud == "points_2_per_m2") and all(model.status == "simplified" for model in simplified)
    assert [problem for model in run.models for solid in model.solids for problem in check_solid(solid)] == []
    assert summary(score(run, delft.truth, delft.points))["rmse_z95"] < error
    assert shares(run.models, points_inside(delft.points, delft.truth))[1] > near
    tops = [max(solid.vertices[:, 2].max() for solid in model.solids) for model in run.models]
    seen = [points[:, 2].max() for points in points_inside(delft.points, delft.truth)]
    assert np.percentile(np.array(tops) - seen, 90) < 0.5
