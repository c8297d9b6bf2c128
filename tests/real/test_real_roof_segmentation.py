"""Roofs of real buildings: Delft (AHN3), classified, unclassified and thinned, against what roofer 1.1 reaches."""

import csv
from pathlib import Path

import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree

from urbanmap_qgis.buildings.detection.roof_surfaces import roof_odds
from urbanmap_qgis.buildings.roofs.roof_segmentation import NO_POINTS, segment_roofs

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "als" / "delft_west"

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason=f"real data not there: {DATA}")

ROOFER_ROOFS = 256
"""Roofs of roofer's flat models with a step of 0.5 m, at a best-95 % RMSE of 0.623 m."""


def read_outlines():
    ogr = pytest.importorskip("osgeo.ogr")
    dataset = ogr.Open(str(DATA / "outlines.gpkg"))
    return {feature.GetField("lokaalid"): shapely.from_wkb(bytes(feature.GetGeometryRef().ExportToWkb()))
            for feature in dataset.GetLayer(0)}


def read_points(name):
    """x, y, z, class and last echoes of a file, sorted by x."""
    laspy = pytest.importorskip("laspy")
    las = laspy.read(DATA / name)
    order = np.argsort(las.x, kind="stable")
    last = np.array(las.return_number) >= np.array(las.number_of_returns)
    return [np.array(a)[order] for a in (las.x, las.y, las.z, las.classification, last)]


def within(points, polygon, mask):
    """Rows of the points inside a polygon."""
    left, bottom, right, top = polygon.bounds
    first, last = np.searchsorted(points[0], [left, right])
    rows = np.arange(first, last)
    rows = rows[mask[rows] & (points[1][rows] >= bottom) & (points[1][rows] <= top)]
    shapely.prepare(polygon)
    return rows[shapely.contains_xy(polygon, points[0][rows], points[1][rows])]


@pytest.fixture(scope="module")
def area():
    """Outlines, the full cloud and the ground height at each building."""
    outlines, points = read_outlines(), read_points("points.laz")
    ground = {}
    for name, outline in outlines.items():
        for reach in (3, 10, 30):
            rows = within(points, shapely.box(*outline.buffer(reach).bounds), points[3] == 2)
            if len(rows) >= 10:
                break
        ground[name] = float(np.median(points[2][rows]))
    return outlines, points, ground


def on_roofs(points, ground, density):
    """Mask of the points whose surfaces are roofs."""
    high = np.flatnonzero(points[2] > ground + 2.0)
    mask = np.zeros(len(points[2]), bool)
    place = np.column_stack([a[high] - a[high].min() for a in points[:3]])
    mask[high] = roof_odds(place, points[4][high], True, density) > 0
    return mask


def segment_all(area, file, density, classified):
    """Each building's segmentation, and its RMSE of the best 95 % and of all scored points (n, 2), m."""
    outlines, truth, ground = area
    points = read_points(file)
    roof = points[3] == 6 if classified else on_roofs(points, min(ground.values()), density)
    results, errors = [], []
    for name, outline in outlines.items():
        x, y, z = (a[within(points, outline.buffer(1.0), roof & (points[2] > ground[name] + 2.0))] for a in points[:3])
        result = segment_roofs(x, y, z, outline, ground[name], density)
        own = np.column_stack([x, y])
        results.append(result)
        x, y, z = (a[within(truth, outline.buffer(-0.3), truth[3] == 6)] for a in truth[:3])
        known = result.roof_of_point > 0
        near = cKDTree(own[known]).query(np.column_stack([x, y]))[1]
        squares = np.sort((z - result.roofs.height[result.roof_of_point[known][near] - 1]) ** 2)
        errors.append([np.sqrt(squares[:np.ceil(0.95 * len(squares)).astype(int)].mean()),
                       np.sqrt(squares.mean())])
    return results, np.array(errors)


@pytest.mark.parametrize("file, density, classified, limit", [
    ("points.laz", 8.5, True, 0.50),
    ("points_unclassified.laz", 8.5, False, 0.50),
    ("points_2_per_m2.laz", 2.0, True, 0.60),
    ("points_1_per_m2.laz", 1.0, True, 0.70),
])
def test_all_buildings_have_roofs_that_fit(area, file, density, classified, limit):
    results, errors = segment_all(area, file, density, classified)
    assert len(results) == 92
    assert all(result.status != NO_POINTS and len(result.roofs) for result in results)
    assert errors[:, 0].mean() <= limit
    assert sum(len(result.roofs) for result in results) <= 1.2 * ROOFER_ROOFS
    for result in results:
        assert (np.diff(result.roofs.height) >= 0).all()
        assert (result.roofs.height_max >= result.roofs.height).all()


def test_flat_roofed_buildings(area):
    _, errors = segment_all(area, "points.laz", 8.5, True)
    with open(DATA / "peers.csv", newline="") as file:
        flat = {row["lokaalid"] for row in csv.DictReader(file)
                if row["lod12_rmse_3d"] and float(row["lod12_rmse_3d"]) < 0.2}
    chosen = [name in flat for name in area[0]]
    assert sum(chosen) >= 5
    assert errors[chosen, 1].mean() <= 0.14
