"""Level roofs of a plan: exact cover, straight shared edges, true borders and heights."""

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate, translate

from urbanmap_qgis.buildings.model_status import LOST_ROOFS
from urbanmap_qgis.buildings.roof_polygons.level_roofs import level_roofs
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import RoofedBuilding
from urbanmap_qgis.settings.buildings import PolygonParameters

BOX = shapely.box
PLANS = {
    "two": [BOX(0, 0, 10, 12), BOX(10, 0, 20, 12)],
    "penthouse": [shapely.difference(BOX(0, 0, 30, 20), BOX(8, 6, 16, 14)), BOX(8, 6, 16, 14)],
    "ell": [BOX(0, 0, 20, 8), BOX(0, 8, 8, 18), BOX(20, 0, 26, 5)],
    "u": [BOX(0, 0, 30, 8), BOX(0, 8, 8, 24), BOX(22, 8, 30, 24)],
    "courtyard": [shapely.difference(BOX(0, 0, 30, 20), BOX(10, 6, 20, 14)) & BOX(0, 0, 15, 20),
                  shapely.difference(BOX(0, 0, 30, 20), BOX(10, 6, 20, 14)) & BOX(15, 0, 30, 20)],
    "six": [BOX(0, 0, 10, 10), BOX(10, 0, 20, 10), BOX(20, 0, 30, 10), BOX(0, 10, 10, 20),
            BOX(10, 10, 22, 20), BOX(22, 10, 30, 20)],
    "oblique": [shapely.Polygon([(0, 0), (18, 0), (10, 14), (0, 14)]),
                shapely.Polygon([(18, 0), (30, 0), (30, 14), (10, 14)])],
}


def building(roofs, density=8.0, step=3.0, seed=1):
    """A building with random points on true roofs 1, 2, ..., each `step` m higher than the one before."""
    outline = shapely.union_all(roofs, grid_size=1e-6)
    x0, y0, x1, y1 = outline.bounds
    rng = np.random.default_rng(seed)
    xy = rng.uniform([x0, y0], [x1, y1], (int(density * (x1 - x0) * (y1 - y0)), 2))
    number = np.zeros(len(xy), int)
    for i, roof in enumerate(roofs):
        number[shapely.contains_xy(roof, xy)] = i + 1
    xyz = np.column_stack([xy, 6.0 + step * number + rng.normal(0.0, 0.03, len(xy))])
    return RoofedBuilding(1, outline, xyz[number > 0], number[number > 0])


def of_roof(table, number):
    return shapely.union_all([p for p, n in zip(table.polygon, table.roof_id) if n == number])


def check_cover(table, outline):
    """Valid polygons that fill the outline to the rounding of the nodes, borders paired edge by edge."""
    assert all(p.is_valid and p.geom_type == "Polygon" for p in table.polygon)
    assert shapely.symmetric_difference(shapely.union_all(table.polygon), outline).area < 1e-3 * outline.length
    assert sum(p.area for p in table.polygon) == pytest.approx(outline.area, abs=1e-3 * outline.length)
    edges = {}
    for ring in shapely.get_rings(table.polygon):
        for a, b in zip(ring.coords[:-1], ring.coords[1:]):
            edges[min(a, b), max(a, b)] = edges.get((min(a, b), max(a, b)), 0) + 1
    assert max(edges.values()) <= 2
    for (a, b), times in edges.items():
        if times == 1:  # not shared, so it lies on the outline
            middle = shapely.Point((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            assert outline.boundary.distance(middle) < 0.03  # nodes nearer than this are one


@pytest.mark.parametrize("name", sorted(PLANS))
@pytest.mark.parametrize("angle", [0.0, 23.0, 77.0])
def test_true_roofs_come_back(name, angle):
    roofs = [translate(rotate(r, angle, origin=(10, 10)), 84000.0, 447000.0) for r in PLANS[name]]
    given = building(roofs)
    table = level_roofs(given, PolygonParameters())
    check_cover(table, given.outline)
    assert set(table.status) == {"ok"} and len(table.polygon) == len(roofs)
    for i, roof in enumerate(roofs):
        found = of_roof(table, i + 1)
        assert shapely.intersection(found, roof).area / shapely.union(found, roof).area > 0.95
        # a border is straight: true corners, junctions with other roofs, and a few where a border is stepped
        assert len(shapely.get_coordinates(found)) <= 2 * len(shapely.get_coordinates(roof)) + 2
        assert table.height[table.roof_id.index(i + 1)] == pytest.approx(9.0 + 3.0 * i, abs=0.05)


def test_one_roof_is_the_outline_itself():
    given = building([shapely.MultiPolygon([BOX(0, 0, 10, 10), BOX(20, 0, 25, 10)])])
    table = level_roofs(given, PolygonParameters())
    assert table.roof_id == [1, 1] and all(map(shapely.equals, table.polygon, given.outline.geoms))


def test_part_without_data_goes_to_the_nearest_roof_and_is_told():
    given = building(PLANS["two"])
    seen = given.xyz[:, 0] < 15
    table = level_roofs(RoofedBuilding(1, given.outline, given.xyz[seen], given.roof[seen]), PolygonParameters())
    check_cover(table, given.outline)
    assert of_roof(table, 2).area == pytest.approx(120.0, rel=0.03)
    assert table.coverage[table.roof_id.index(2)] < 0.6


def test_same_input_same_output():
    one, two = (level_roofs(building(PLANS["six"]), PolygonParameters()) for _ in range(2))
    assert [p.wkb for p in one.polygon] == [p.wkb for p in two.polygon]


@pytest.mark.parametrize("seed", [1, 2])
def test_many_small_roofs_are_all_kept(seed):
    rng = np.random.default_rng(seed)
    rooms = [BOX(x, y, x + 3, y + 3) for x, y in
             ((7 * i + rng.uniform(0.5, 3), 7 * j + rng.uniform(0.5, 3)) for i in range(9) for j in range(6))]
    given = building([shapely.difference(BOX(0, 0, 63, 42), shapely.union_all(rooms)), *rooms], step=0.5)
    table = level_roofs(given, PolygonParameters())
    assert not any(status.startswith(LOST_ROOFS) for status in table.status)
    assert set(table.roof_id) == set(range(1, 56))
    check_cover(table, given.outline)
    assert np.median([of_roof(table, 2 + i).intersection(room).area / of_roof(table, 2 + i).union(room).area
                      for i, room in enumerate(rooms)]) > 0.7
