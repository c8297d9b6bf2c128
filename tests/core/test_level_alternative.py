"""Level roofs in place of planes, where they are nearer to all points."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.planes.level_alternative import SUSPECT, has_lost_plane, roof_misfit
from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
from urbanmap_qgis.buildings.roof_polygons.building_polygons import roof_polygons_of
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import LEVELS_BETTER, RoofedBuilding
from urbanmap_qgis.settings.buildings import PLANES, PolygonParameters

PLAN = shapely.box(0, 0, 12, 8)


def points_of(height):
    xy = np.random.default_rng(5).uniform([0, 0], [12, 8], (768, 2))
    return np.column_stack([xy, height(*xy.T)])


def drawn(points, roof):
    return roof_polygons_of(RoofedBuilding(1, PLAN, points, roof), PolygonParameters(roofs=PLANES))


def test_four_terraces_taken_for_one_slope_become_four_levels():
    points = points_of(lambda x, y: 8.0 + 1.1 * np.floor(x / 3))
    one = np.ones(len(points), int)
    assert SUSPECT < roof_misfit(partition_planes(PLAN, points, one).polygons, points) < 0.6
    table = drawn(points, one)
    assert all(LEVELS_BETTER in str(words) for words in table.status)
    assert sorted(table.height) == pytest.approx([8.0, 9.1, 10.2, 11.3], abs=0.01)


def test_a_gable_stays_one():
    points = points_of(lambda x, y: 8.0 - 0.7 * np.abs(y - 4))
    table = drawn(points, np.where(points[:, 1] < 4, 1, 2))
    assert len(table.polygon) == 2 and not any(LEVELS_BETTER in str(words) for words in table.status)
    assert roof_misfit(table.polygon, points) < 0.05


def test_few_points_do_not_tilt_the_only_roof():
    """A level shed that a branch hangs over: a slope through some of its points misses the others more."""
    x = np.array([0.3, 0.9, 1.5, 2.1, 2.7, 3.3, 3.7, 0.5, 1.2, 2.4])
    z = 3.0 + np.array([0.0, 0.0, 0.02, 0.0, 0.25, 0.4, 0.02, 0.0, 0.01, 0.0])
    points = np.column_stack([x, np.linspace(0.2, 2.8, 10), z])
    shed = RoofedBuilding(1, shapely.box(0, 0, 4, 3), points, np.array([0, 1, 0, 1, 1, 1, 0, 0, 1, 0]))
    tilted = partition_planes(shed.outline, points, shed.roof)
    assert np.hypot(*tilted.planes[0, :2]) > 0.05 and roof_misfit(tilted.polygons, points) < SUSPECT
    table = roof_polygons_of(shed, PolygonParameters(roofs=PLANES))
    assert table.slope == [0.0] and table.height == pytest.approx([3.0], abs=0.05)


@pytest.mark.parametrize(("drawn", "lost"), [([1], True), ([1, 2], False)])
def test_a_plane_is_lost_that_has_points_and_no_polygon(drawn, lost):
    """Two level roofs of 36 m2, 2 m apart in height; polygons of the lower one cover both."""
    x, y = (values.ravel() for values in np.meshgrid(np.arange(0.25, 12.0, 0.5), np.arange(0.25, 6.0, 0.5)))
    roof = np.where(x < 6.0, 1, 2)
    points = np.column_stack([x, y, np.where(roof == 1, 8.0, 10.0)])
    polygons = [shapely.force_3d(shapely.box(0, 0, 12, 6), 8.0)] * len(drawn)
    assert has_lost_plane(polygons, drawn, points, roof, 4.0, 10.0) is lost
