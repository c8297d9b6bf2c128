"""Roofs that a classification left out: a tower of class 1 on a podium of class 6."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.buildings.segmentation import segment_buildings
from urbanmap_qgis.buildings.unclassified_roofs import unclassified_roof_points
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all

OUTLINE = shapely.box(0, 0, 30, 20)


def scene(seed=1, density=9.0):
    """Ground, a podium (class 6) with a tower (class 1) on it, and a tree (class 1) over the podium."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-25, 55, (2, int(80 * 80 * density)))
    z, classes, several = np.zeros(len(x)), np.full(len(x), 2), np.zeros(len(x), bool)
    podium, tower = shapely.contains_xy(OUTLINE, x, y), shapely.contains_xy(shapely.box(4, 4, 14, 14), x, y)
    tree = np.hypot(x - 24, y - 10) < 3
    z[podium], classes[podium] = 9.0, 6
    z[tower], classes[tower] = 48.7, 1
    z[tree], classes[tree], several[tree] = 9 + rng.uniform(1, 8, tree.sum()), 1, True
    return x, y, z + rng.normal(0, 0.03, len(x)), classes, several, tower, tree


def test_a_smooth_surface_is_a_roof_and_a_tree_is_none():
    x, y, z, classes, several, tower, tree = scene()
    high, known = tower | tree, classes == 6
    found = unclassified_roof_points(x[high], y[high], z[high], several[high], x[known], y[known], OUTLINE, 9.0)
    assert found[tower[high]].mean() > 0.95 and found[tree[high]].mean() < 0.05


def test_a_car_on_the_roof_is_too_small():
    x, y = np.random.default_rng(1).uniform(0, 2.2, (2, 60))
    found = unclassified_roof_points(x + 5, y + 5, np.full(60, 10.5), np.zeros(60, bool), np.zeros(0), np.zeros(0),
                                     OUTLINE, 9.0)
    assert not found.any()


def test_the_tower_stands_in_the_roofs(tmp_path, make_cloud):
    x, y, z, classes, several, tower, _ = scene()
    path = make_cloud(tmp_path / "c.laz", x, y, z, classification=classes, number_of_returns=np.where(several, 2, 1),
                      return_number=1)
    footprints = clean_footprints(np.array([OUTLINE], object))
    made = segment_buildings(open_cloud([path]), footprints, tmp_path / "b.laz")
    taken = read_all(open_cloud([tmp_path / "b.laz"]), ("z",))["z"]
    assert (taken > 40).sum() > 0.95 * tower.sum()
    roofs = segment_cloud_roofs(open_cloud([tmp_path / "b.laz"]), footprints, tmp_path / "r.laz", ground=made.ground)
    assert roofs.height == pytest.approx([9.0, 48.7], abs=0.1)
