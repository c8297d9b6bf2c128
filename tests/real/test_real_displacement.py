"""Displaced outlines of Delft put back by the laser points, against the outlines as published."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines.displacement import estimate_displacements, shifted_outlines
from urbanmap_qgis.buildings.outlines.evidence import EvidenceAccumulator, evidence_cell
from urbanmap_qgis.geometry.grid import Grid

laspy = pytest.importorskip("laspy")
ogr = pytest.importorskip("osgeo.ogr")

DELFT = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "als" / "delft_west"
pytestmark = pytest.mark.skipif(not DELFT.is_dir(), reason=f"real data not found: {DELFT}")
GROUND = -0.3  # m NAP: the quarter is flat
CLOUDS = ("points", "points_unclassified", "points_2_per_m2", "points_1_per_m2")


def outlines(name):
    source = ogr.Open(str(DELFT / name))
    rows = sorted((f.GetField("lokaalid"), bytes(f.GetGeometryRef().ExportToWkb())) for f in source.GetLayer(0))
    return shapely.force_2d(shapely.from_wkb([wkb for _, wkb in rows]))


@pytest.fixture(scope="module", params=CLOUDS)
def scene(request):
    """Name of the cloud, grid, evidence and highest z."""
    points = laspy.read(DELFT / f"{request.param}.laz")
    x_min, y_min, x_max, y_max = shapely.total_bounds(outlines("outlines.gpkg"))
    area = (x_max - x_min) * (y_max - y_min)
    x, y = np.asarray(points.x), np.asarray(points.y)
    density = np.count_nonzero((x > x_min) & (x < x_max) & (y > y_min) & (y < y_max)) / area
    grid = Grid.covering(x_min - 8, y_min - 8, x_max + 8, y_max + 8, evidence_cell(density))
    accumulator = EvidenceAccumulator(grid)
    for part in np.array_split(np.arange(len(x)), 5):
        accumulator.add(x[part], y[part], np.asarray(points.z)[part], np.asarray(points.classification)[part],
                        np.asarray(points.return_number)[part], np.asarray(points.number_of_returns)[part])
    return request.param, grid, accumulator.evidence(np.full(grid.shape, GROUND)), accumulator.surface


def overlap(polygons, scene, truth):
    _, grid, evidence, surface = scene
    there = shifted_outlines(polygons, estimate_displacements(polygons, evidence, grid, surface))
    return np.mean(shapely.area(shapely.intersection(there, truth)) / shapely.area(shapely.union(there, truth)))


def test_outlines_off_by_one_metre_come_back(scene):
    least = 0.82 if scene[0] == "points_1_per_m2" else 0.85
    assert overlap(outlines("outlines_shifted_1m.gpkg"), scene, outlines("outlines.gpkg")) >= least


def test_outlines_off_by_two_metres_come_back(scene):
    assert overlap(outlines("outlines_shifted_2m.gpkg"), scene, outlines("outlines.gpkg")) >= 0.80


def test_a_sheet_off_as_a_whole_comes_back(scene):
    truth = outlines("outlines.gpkg")
    sheet = shapely.transform(truth, lambda points: points + np.array([1.1, -0.7]))
    assert overlap(sheet, scene, truth) >= 0.88


def test_true_outlines_are_left_alone(scene):
    truth = outlines("outlines.gpkg")
    assert overlap(truth, scene, truth) >= 0.98
