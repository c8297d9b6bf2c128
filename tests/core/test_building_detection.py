"""Buildings found in points without outlines: a made street with roofs, a crown, a lorry and a bridge."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.laser_blocks import block_cloud
from urbanmap_qgis.buildings.detection.detected_outline import DECK, MOVABLE, OK
from urbanmap_qgis.buildings.detection.detection_stage import detect_buildings
from urbanmap_qgis.buildings.detection.roof_regions import ROW, regions_of_cells
from urbanmap_qgis.buildings.detection.roof_surfaces import roof_odds
from urbanmap_qgis.errors import InsufficientDataError

HOUSE, BARN = shapely.box(20, 20, 32, 29), shapely.box(50, 20, 70, 32)


@pytest.mark.parametrize("density", [16.0, 2.0])
def test_houses_are_outlined_and_a_crown_is_not(tmp_path, density):
    cloud = block_cloud(tmp_path, density, roofs=[(HOUSE, 6.0, 0.5), (BARN, 9.0, 0.0)], crowns=[(25, 60, 7.0)])
    found = detect_buildings(cloud)
    assert [building.status for building in found.buildings] == [OK, OK]
    for building, truth in zip(sorted(found.buildings, key=lambda each: each.area), (HOUSE, BARN)):
        overlap = shapely.intersection(building.outline, truth).area / shapely.union(building.outline, truth).area
        assert overlap > (0.88 if density > 4 else 0.75)
        assert 0.05 < building.sigma < 0.8
        assert building.confidence > 0.9


def test_a_lorry_and_a_bridge_say_what_they_are(tmp_path):
    lorry = shapely.box(20, 20, 32, 22.4)
    cloud = block_cloud(tmp_path, 12.0, roofs=[(lorry, 3.6, 0.0), (BARN, 9.0, 0.0)], bridges=[(10, 50, 90, 60, 5.0)])
    found = {building.status: building for building in detect_buildings(cloud).buildings}
    assert found.keys() == {OK, MOVABLE, DECK}
    assert "vehicle or a container" in found[MOVABLE].reason
    assert found[MOVABLE].outline.intersects(lorry)


def test_the_result_does_not_depend_on_the_tiles(tmp_path, monkeypatch):
    from urbanmap_qgis.buildings.detection import labelled_cloud

    cloud = block_cloud(tmp_path, 12.0, roofs=[(HOUSE, 6.0, 0.5), (BARN, 9.0, 0.0)])
    whole = detect_buildings(cloud).buildings
    monkeypatch.setattr(labelled_cloud, "TILE_SIDE", (26.0, 26.0))
    cut = detect_buildings(cloud).buildings
    assert len(cut) == len(whole)
    assert all(shapely.hausdorff_distance(one.outline, other.outline) < 0.3 for one, other in zip(whole, cut))


def test_bare_ground_is_refused_in_words(tmp_path):
    with pytest.raises(InsufficientDataError, match="lies on a roof"):
        detect_buildings(block_cloud(tmp_path, 4.0))


def test_cells_that_touch_at_a_corner_are_one_region():
    cells = np.array([ROW + 1, 2 * ROW + 2, 2 * ROW + 9, 3 * ROW + 8])
    assert regions_of_cells(cells).tolist() == [0, 0, 1, 1]


@pytest.mark.parametrize("echoes", [True, False])
def test_a_crown_over_a_roofs_corner_is_no_roof(echoes):
    rng = np.random.default_rng(3)
    crown = rng.uniform(-1, 1, (2000, 3))
    crown = crown[(crown**2).sum(axis=1) < 1] * [4, 4, 3] + [18, 18, 12]
    roof = np.column_stack([rng.uniform(0, 20, (3600, 2)), rng.normal(6.0, 0.02, 3600)])
    last = np.r_[np.ones(len(roof), bool), np.full(len(crown), not echoes)]
    odds = roof_odds(np.vstack([roof, crown]), last, echoes, 9.0)
    assert (odds[:len(roof)] > 0).mean() > 0.98
    assert (odds[len(roof):] < 0).mean() > 0.95
