"""Edges of building models against real laser points: what the models are displaced by comes back."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

pytest.importorskip("osgeo.ogr", reason="GDAL's Python module, which reads the outlines, is not installed")

from scripts.bench import DATA, DELFT, chain
from scripts.layers import read_layer
from urbanmap_qgis.acceptance.criteria import NOT_CHECKED, outcome
from urbanmap_qgis.acceptance.edge_comparison import compare_edges, edge_criteria
from urbanmap_qgis.acceptance.edge_measurement import ROOFS
from urbanmap_qgis.acceptance.edge_sampling import draw_edges
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS
from urbanmap_qgis.io.points.pointcloud import open_cloud

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="the real test data are not beside the checkout")


@pytest.fixture(scope="module")
def models():
    """Own models of Delft west, as all their faces."""
    run = chain(DELFT / "points.laz", read_layer(DELFT / "outlines.gpkg")[0])
    return [shapely.MultiPolygon([shapely.Polygon(*_rings(solid, rings))
                                  for solid in model.solids for rings in solid.faces]) for model in run.models]


def _rings(solid, rings):
    return solid.vertices[list(rings[0])], [solid.vertices[list(hole)] for hole in rings[1:]]


def compared(models, level):
    drawn = draw_edges(models, range(len(models)), [""] * len(models), count=300)
    return compare_edges(drawn, models, open_cloud([DELFT / "points.laz"]), MAP_LEVELS[level], ROOFS)


@pytest.mark.parametrize("level, least", [(500, 30), (1000, 120)])
def test_displaced_models_of_delft_give_their_displacement(models, level, least):
    shift = np.array([0.5, 0.3, 0.2])
    moved = [shapely.transform(model, lambda xyz: xyz + shift, include_z=True) for model in models]
    before, after = compared(models, level), compared(moved, level)
    assert np.count_nonzero(before.shown) >= least
    both = before.shown & after.shown
    moved_across = (after.across - before.across)[both] - before.normal[both] @ shift[:2]
    assert both.sum() >= 0.7 * before.shown.sum() and abs(np.median(moved_across)) < 0.05
    assert np.mean(np.abs(moved_across) < 0.15) > 0.8
    assert np.nanmedian((after.up - before.up)[both]) == pytest.approx(shift[2], abs=0.06)
    assert abs(np.nanmedian(before.up)) < 0.05
    # The outlines are those of walls; roofs stand out over them.
    assert -0.4 < np.median(before.across[before.shown]) < 0.0
    assert outcome(edge_criteria(before, MAP_LEVELS[level], independent=False)) == NOT_CHECKED
