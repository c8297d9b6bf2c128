"""Roofs of a model are not cut into slivers where planes nearly meet or would reach under the ground."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.building_model import ASSUMED, STOREY, RoofInput, model_building
from urbanmap_qgis.buildings.planes.plan_nodes import meeting_polygons
from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
from urbanmap_qgis.buildings.planes.plane_solids import checked_sloped_solids
from urbanmap_qgis.buildings.solids.sloped_solid import SlopedCell, sloped_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.geometry.solid import ROOF

AXES = np.array([[1.0, 0.0], [0.0, 1.0]])


def roofs_of(solid):
    """Areas in plan (m2) of the roof faces of a solid."""
    return [shapely.Polygon(solid.vertices[list(face[0]), :2]).area
            for face, kind in zip(solid.faces, solid.surface_type) if kind == ROOF]


def house_with_dormer(step, seed):
    """A gable whose southern slope a level dormer divides; the slope's eastern part is `step` m higher."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform((0, 0), (12, 8), (1200, 2))
    x, y = xy.T
    z = 9.0 - 0.8 * np.abs(y - 4.0) + np.where((y < 4) & (x > 7), step, 0.0)
    dormer = (np.abs(x - 6) < 1.5) & (y < 4)
    z[dormer] = 8.6
    part = np.select([dormer, y >= 4, x < 6], [1, 2, 3], 4)
    return np.column_stack([xy, z + rng.normal(0, 0.02, len(z))]), part


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_house_with_a_dormer_has_no_face_cut_into_triangles(seed):
    points, part = house_with_dormer(0.03, seed)
    outline = shapely.box(0, 0, 12, 8)
    plan = partition_planes(outline, points, part)
    (solid,), problems = checked_sloped_solids(outline, np.array(plan.polygons, object), plan.roof_numbers, 0.0)
    assert problems == []
    assert len(roofs_of(solid)) == len(plan.polygons) and min(roofs_of(solid)) > 0.25


def test_a_roof_that_reaches_under_the_ground_ends_above_it():
    cells = [SlopedCell(shapely.box(0, 0, 6, 4), 1, (0.0, 0.3, -0.05)),
             SlopedCell(shapely.box(6, 0, 12, 4), 2, (0.0, 0.0, 5.0)),
             SlopedCell(shapely.box(12, 0, 15, 4), 3, (0.0, 2.0, -7.5))]
    solid, = sloped_solids(cells, 0.0)
    assert check_solid(solid) == () and solid.raised_roofs == 2
    assert sum(roofs_of(solid)) == pytest.approx(60)
    assert min(solid.vertices[list(face[0]), 2].min() for face, kind in zip(solid.faces, solid.surface_type)
               if kind == ROOF) == pytest.approx(0.1)


def test_assumed_ground_lies_under_the_lowest_corner_of_a_slope():
    plane = np.array([0.0, 1.0, 5.0])
    xy = np.array([[0, 0], [10, 0], [10, 8], [0, 8]])
    polygon = shapely.Polygon(np.column_stack([xy, xy @ plane[:2] + plane[2]]))
    roofs = RoofInput(np.array([polygon], object), np.array([1]), np.array([1]), np.array([9.0]),
                      np.array(["ok"], object))
    model = model_building(1, shapely.box(0, 0, 10, 8), "", roofs, np.nan, sloped=True)
    assert model.base_source == ASSUMED and model.base == pytest.approx(5.0 - STOREY)
    assert roofs_of(model.solids[0]) == pytest.approx([80.0])


def test_nodes_that_move_onto_each_other_are_one():
    """Two short borders whose planes meet in one place: no edge under a millimetre is left."""
    planes = np.array([[0.0, -1.0, 5.0], [0.0, 1.0, 1.0], [1.0, 0.0, -1.0]])
    polygons = [shapely.Polygon([(0, 2), (4, 2), (4.06, 2), (8, 2), (8, 4), (0, 4)]),
                shapely.Polygon([(0, 0), (4, 0), (4, 2), (0, 2)]),
                shapely.Polygon([(4, 0), (8, 0), (8, 2), (4.06, 2), (4, 2)])]
    edges = {tuple(sorted(pair)) for polygon in meeting_polygons(polygons, planes)
             for ring in (shapely.get_coordinates(polygon).round(6).tolist(),)
             for pair in zip(map(tuple, ring), map(tuple, ring[1:]))}
    assert min(np.hypot(*np.subtract(*pair)) for pair in edges) > 0.001
