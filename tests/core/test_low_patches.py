"""Roofs that are not drawn on over lower places: patches, costs of corners, small pieces that are plainly seen."""

import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree

from urbanmap_qgis.buildings.planes.low_patches import low_patches
from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
from urbanmap_qgis.buildings.planes.plane_solids import checked_sloped_solids

ROOF, LOW = 8.0, 3.0
HOUSE = shapely.box(0, 0, 10, 8)
ANNEX = shapely.box(-4, 0, 0, 8)


def house(seed, low, lost=0):
    """Points (n, 3) of a level roof with a lower place, and the roof of each: `lost` is the low place's number."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform((0, 0), (10, 8), (800, 2))
    within = shapely.contains_xy(low, *xy.T)
    z = np.where(within, LOW, ROOF) + rng.normal(0, 0.02, len(xy))
    return np.column_stack([xy, z]), np.where(within, lost, 1)


def heights_over(points, polygons):
    """Greatest height of a corner over the highest point within 1 m of it, m."""
    corners = shapely.get_coordinates(polygons, include_z=True)
    near = cKDTree(points[:, :2]).query_ball_point(corners[:, :2], 1.0)
    return max(corner[2] - points[rows, 2].max() for corner, rows in zip(corners, near) if rows)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("low", [shapely.box(8, 0, 10, 2), shapely.box(0, 6.2, 10, 8), shapely.box(3.5, 2.5, 6.5, 5.5)])
def test_no_roof_is_drawn_over_a_low_place_of_points_without_a_plane(seed, low):
    points, roof = house(seed, low)
    annex, _ = house(seed + 100, shapely.Polygon())
    annex[:, 0], annex[:, 2] = annex[:, 0] * 0.4 - 4.0, annex[:, 2] - ROOF + LOW - 0.3
    whole = shapely.union_all([HOUSE, ANNEX])
    points, roof = np.concatenate([points, annex]), np.concatenate([roof, np.full(len(annex), 2)])
    made = partition_planes(whole, points, roof)
    assert heights_over(points, list(made.polygons)) < 0.5
    lowest = [polygon for polygon in made.polygons if polygon.representative_point().x > 0
              and shapely.get_coordinates(polygon, include_z=True)[0, 2] < 4]
    assert shapely.area(lowest).sum() == pytest.approx(low.area, rel=0.35)
    assert shapely.union_all(lowest).intersection(low).area > 0.7 * low.area
    assert shapely.area(made.polygons).sum() == pytest.approx(whole.area)
    assert set(made.roof_numbers.tolist()) == {1, 2}
    solids, problems = checked_sloped_solids(whole, np.array(made.polygons, object), made.roof_numbers, 0.0)
    assert solids and not problems


def test_a_house_without_a_low_place_has_no_patch():
    points, roof = house(3, shapely.Polygon())
    made = partition_planes(HOUSE, points, roof)
    assert len(made.polygons) == 1 and made.status == "one plane"
    assert made.polygons[0].equals(HOUSE)


def test_points_below_all_roofs_and_small_steps_make_no_patch():
    points, roof = house(4, shapely.box(8, 0, 10, 2))
    assert len(partition_planes(HOUSE, points, roof).polygons) == 1
    points[roof == 0, 2] = ROOF - 0.3
    assert len(partition_planes(HOUSE, points, roof).polygons) == 1


def test_patches_need_points_near():
    from urbanmap_qgis.buildings.planes.label_raster import label_raster

    points, roof = house(5, shapely.box(8, 0, 10, 2))
    roofs = points[roof == 1]
    raster = label_raster(roofs, np.zeros(len(roofs), int), HOUSE, 10.0)
    planes, whole = np.array([[0, 0, ROOF]]), np.array([HOUSE], object)
    assert low_patches(raster, planes, roofs, np.zeros(len(roofs), int), whole, np.array([0]), 1) is None


def test_lines_are_drawn_on_less_far_where_they_would_cut_very_many_faces(monkeypatch):
    from urbanmap_qgis.buildings.planes import candidate_segments as module
    from urbanmap_qgis.buildings.planes.label_raster import label_raster

    rng = np.random.default_rng(7)
    xy = rng.uniform(0, 40, (8000, 2))
    label = ((xy[:, 0] // 10) * 4 + xy[:, 1] // 10).astype(int)
    points = np.column_stack([xy, 5.0 + label % 7])
    outline, planes = shapely.box(0, 0, 40, 40), np.column_stack([np.zeros((16, 2)), 5.0 + np.arange(16) % 7])
    raster = label_raster(points, label, outline, 5.0)
    usual = module.candidate_segments(raster, planes, outline, points, label)
    monkeypatch.setattr(module, "MANY_FACES", 20.0)
    short = module.candidate_segments(raster, planes, outline, points, label)
    assert len(short) == len(usual)
    length = np.hypot(*(usual[:, 1] - usual[:, 0]).T) - np.hypot(*(short[:, 1] - short[:, 0]).T)
    assert length == pytest.approx(np.full(len(usual), 9.0))


def slope_with(stands, seed=6):
    """Points (n, 3), planes and outline of a slope of 12 by 8 m on which points stand at places and heights."""
    xy = np.random.default_rng(seed).uniform((0, 0), (12, 8), (960, 2))
    slope = 6.0 + 0.3 * xy[:, 1]
    on = (np.abs(xy[:, 0] - 6.0) < 1.0) & (np.abs(xy[:, 1] - 4.0) < 1.0)
    z = np.where(on, stands(xy, slope), slope)
    return np.column_stack([xy, z]), np.where(on, 0, 1), shapely.box(0, 0, 12, 8)


def test_a_dormer_that_is_no_plane_of_its_own_becomes_a_level_patch():
    points, roof, outline = slope_with(lambda xy, _: np.full(len(xy), 8.4))
    made = partition_planes(outline, points, roof)
    tops = [(polygon, plane) for polygon, plane in zip(made.polygons, made.planes) if np.allclose(plane[:2], 0)]
    assert len(tops) == 1
    assert tops[0][0].area == pytest.approx(4.0, abs=1.0)
    assert tops[0][1][2] == pytest.approx(8.4, abs=0.02)


def test_what_has_no_one_height_is_no_patch():
    """A crown over the slope: its points lie at all heights."""
    rng = np.random.default_rng(8)
    points, roof, outline = slope_with(lambda xy, slope: slope + rng.uniform(0.4, 3.0, len(xy)))
    assert len(partition_planes(outline, points, roof).polygons) == 1


def test_what_stands_low_is_no_patch():
    points, roof, outline = slope_with(lambda xy, slope: slope + 0.3)
    assert len(partition_planes(outline, points, roof).polygons) == 1
