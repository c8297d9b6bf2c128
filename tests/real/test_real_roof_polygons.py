"""Roof polygons on real points of Delft, and against the true roofs of a simulated city block."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.polygons.outline_from_points import outline_from_points
from urbanmap_qgis.buildings.polygons.roof_polygon import paper_roof_polygons
from urbanmap_qgis.buildings.roof_polygons.level_roofs import level_roofs
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import RoofedBuilding
from urbanmap_qgis.settings.buildings import PolygonParameters

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data"
DELFT, CITY = DATA / "als" / "delft_west", DATA / "city"

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="the folder shared/data beside the checkout is absent")
laspy = pytest.importorskip("laspy", reason="laspy reads the points")
ogr = pytest.importorskip("osgeo.ogr", reason="GDAL's Python package reads the outlines")
ogr.UseExceptions()


def read_layer(path, name=None):
    """Polygons without z and their attributes."""
    source = ogr.Open(str(path))
    layer = source.GetLayerByName(name) if name else source.GetLayer(0)
    return [(shapely.force_2d(shapely.from_wkb(bytes(f.GetGeometryRef().ExportToWkb()))), f.items()) for f in layer]


def by_building(path, plans):
    """x, y, z of the building points inside each plan."""
    las = laspy.read(path)
    building = np.asarray(las.classification) == 6
    xyz = np.column_stack([las.x, las.y, las.z])[building]
    point, plan = shapely.STRtree(plans).query(shapely.points(xyz[:, :2]), predicate="within")
    return [xyz[point[plan == i]].T for i in range(len(plans))]


def single(polygon):
    return polygon.geoms[0] if polygon.geom_type == "MultiPolygon" and len(polygon.geoms) == 1 else polygon


@pytest.fixture(scope="module")
def delft():
    plans = [single(polygon) for polygon, _ in read_layer(DELFT / "outlines.gpkg")]
    return list(zip(plans, by_building(DELFT / "points.laz", plans)))


def storeys(z):
    """A plain labelling for these tests: heights in steps of 2 m."""
    return np.floor((z - z.min()) / 2.0).astype(int) + 1


def divide(outline, x, y, z, roof):
    """Polygons of the level roofs of a plan."""
    return level_roofs(RoofedBuilding(1, outline, np.column_stack([x, y, z]), roof), PolygonParameters()).polygon


def test_plans_of_delft_are_filled_exactly(delft):
    divided = 0
    for outline, (x, y, z) in delft:
        if len(x) < 20:
            continue
        polygons = divide(outline, x, y, z, storeys(z))
        divided += len(polygons) > 1
        assert all(polygon.is_valid for polygon in polygons)
        union = shapely.union_all(polygons)
        assert shapely.symmetric_difference(union, outline).area < 2e-3 * outline.length
        assert sum(polygon.area for polygon in polygons) == pytest.approx(outline.area, abs=1e-3 * outline.length)
        corners = shapely.get_num_coordinates(outline)
        assert sum(map(shapely.get_num_coordinates, polygons)) < 2 * corners + 12 * len(polygons)
    assert divided > 60


def test_paper_polygons_of_delft(delft):
    drawn = area = points = 0
    for outline, (x, y, _) in delft[::4]:
        if len(x) < 50:
            continue
        (roof,) = paper_roof_polygons(x, y, np.ones(len(x), int), len(x) / outline.area)
        assert roof.polygon.is_valid
        drawn += 1
        area += shapely.intersection(roof.polygon, outline).area
        points += outline.area
    assert drawn > 15
    assert 0.8 < area / points < 1.0


def test_outlines_from_points_match_the_official_ones(delft):
    overlaps = []
    for outline, (x, y, _) in delft[::4]:
        if len(x) < 100:
            continue
        found = outline_from_points(x, y, len(x) / outline.area).outline
        assert found.is_valid
        overlaps.append(shapely.intersection(found, outline).area / shapely.union(found, outline).area)
    assert np.median(overlaps) > 0.85


def test_borders_lie_on_the_true_roofs_of_the_simulated_block():
    buildings = {}
    for polygon, row in read_layer(CITY / "truth" / "roofs.gpkg", "roofs"):
        buildings.setdefault(row["building"], []).append((row["z_roof"], shapely.make_valid(polygon)))
    plans, truth = [], []
    for key in sorted(buildings)[::6]:
        highest_first = sorted(buildings[key], key=lambda item: -item[0])
        plan = shapely.union_all([polygon for _, polygon in highest_first])
        plan = plan.buffer(0.3, join_style="mitre").buffer(-0.3, join_style="mitre")
        if plan.geom_type == "Polygon":
            plans.append(plan)
            truth.append(highest_first)
    deviation = []
    for plan, roofs, (x, y, z) in zip(plans, truth, by_building(CITY / "als" / "als_classified.laz", plans)):
        number = np.zeros(len(x), int)
        for i in range(len(roofs) - 1, -1, -1):  # the highest is written last
            number[shapely.contains_xy(roofs[i][1], x, y) & (z > roofs[i][0] - 1.0)] = i + 1
        borders = shapely.union_all(shapely.boundary(divide(plan, x, y, z, number)))
        places = shapely.get_coordinates(shapely.segmentize(shapely.boundary(roofs[0][1]), 0.5))
        inner = shapely.points(places[shapely.distance(plan.boundary, shapely.points(places)) > 0.7])
        deviation += shapely.distance(borders, inner).tolist()
    assert len(deviation) > 200
    assert np.median(deviation) < 0.05
    assert np.percentile(deviation, 90) < 0.25
