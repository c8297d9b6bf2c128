"""Roofs of a model are not cut into slivers where planes nearly meet or would reach under the ground."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.building_model import ASSUMED, STOREY, RoofInput, model_building
from urbanmap_qgis.buildings.planes.plan_nodes import meeting_polygons
from urbanmap_qgis.buildings.planes.plane_moments import moments
from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
from urbanmap_qgis.buildings.planes.plane_regularisation import LIMITS, regular_planes
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


@pytest.mark.parametrize("step, heights", [(0.03, 1), (0.3, 2)])
def test_parts_of_one_slope_are_on_one_plane(step, heights):
    points, part = house_with_dormer(step, 3)
    planes = regular_planes(moments(points, part - 1, 4), AXES)
    southern = planes[2:]
    assert southern[0, :2] == pytest.approx(southern[1, :2], abs=0.03)
    at = southern @ [9.0, 2.0, 1.0]
    assert len(np.unique(np.round(at, 6))) == heights
    assert abs(at[1] - at[0] - step) < (step if heights == 1 else 0.05) + 1e-6


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_house_with_a_dormer_has_no_face_cut_into_triangles(seed):
    points, part = house_with_dormer(0.03, seed)
    outline = shapely.box(0, 0, 12, 8)
    plan = partition_planes(outline, points, part)
    (solid,), problems = checked_sloped_solids(outline, np.array(plan.polygons, object), plan.roof_numbers, 0.0)
    assert problems == []
    assert len(roofs_of(solid)) == len(plan.polygons) and min(roofs_of(solid)) > 0.25


def test_many_level_roofs_keep_their_steps_and_lie_apart():
    rng = np.random.default_rng(5)
    height = rng.uniform(10.0, 11.0, 60)
    points = np.concatenate([np.column_stack([rng.uniform(0, 4, (30, 2)) + np.array([5 * row, 0]), np.full(30, z)])
                             for row, z in enumerate(height)])
    planes = regular_planes(moments(points, np.repeat(np.arange(60), 30), 60), AXES)
    different = np.unique(np.round(planes[:, 2], 9))
    assert np.diff(different).min() >= LIMITS.one_height - 1e-9
    assert np.abs(planes[:, 2] - height).max() < 2 * LIMITS.one_height


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


def test_planes_that_one_plane_fits_as_well_are_one():
    """Slopes of a plane that differ as the noise makes them; the steeper one beside them stays what it is."""
    rng = np.random.default_rng(11)
    xy = rng.uniform(0, 4, (3, 150, 2)) + np.array([[0, 0], [6, 0], [12, 0]])[:, None]
    slope = np.array([0.50, 0.51, 0.60])
    z = 5.0 + slope[:, None] * xy[..., 1] + rng.normal(0, 0.02, xy.shape[:2])
    points = np.concatenate([xy, z[..., None]], axis=2).reshape(-1, 3)
    planes = regular_planes(moments(points, np.repeat(np.arange(3), 150), 3), np.zeros((0, 2)))
    assert (planes[0] == planes[1]).all()
    assert np.hypot(*(planes[2, :2] - planes[0, :2])) > 0.06
    for plane, heights, own in zip(planes, z, xy):
        assert np.sqrt(np.mean((own @ plane[:2] + plane[2] - heights) ** 2)) < 0.02 + 0.03
