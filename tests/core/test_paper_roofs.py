"""The paper's building method (J 5.3) against a brute-force histogram and formulas of a few lines."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.polygon_stage import cloud_roof_polygons
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.buildings.roofs.paper_roofs import paper_roofs
from urbanmap_qgis.buildings.segmentation import segment_buildings
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all
from urbanmap_qgis.settings.buildings import PolygonParameters, RoofParameters, SegmentationParameters

DENSITY = 7.0


def rectangle(x0, y0, x1, y1, height, seed, density=DENSITY, noise=0.03, slope=0.0):
    """Points (n, 3) spread over a rectangle."""
    rng = np.random.default_rng(seed)
    n = round((x1 - x0) * (y1 - y0) * density)
    x, y = rng.uniform(x0, x1, n), rng.uniform(y0, y1, n)
    return np.column_stack([x, y, height + slope * (x - x0) + rng.normal(0, noise, n)])


def brute_force_roofs(z, alpha, beta):
    """Number of roofs of heights z (n,), as J 5.3.2 says it: loops over 0.5 m bins 0.1 m apart."""
    first = int(np.floor(z.min() / 0.1)) - 7
    counts = []
    for k in range(first, int(np.ceil(z.max() / 0.1)) + 3):
        counts.append(sum(1 for value in z if k * 0.1 - 1e-9 <= value < k * 0.1 + 0.5 - 1e-9))
    maxima, k = [], 1
    while k < len(counts) - 1:
        end = k
        while end + 1 < len(counts) and counts[end + 1] == counts[k]:
            end += 1
        if counts[k] > counts[k - 1] and end + 1 < len(counts) and counts[k] > counts[end + 1] and counts[k] >= alpha:
            maxima.append((k, end))
        k = end + 1
    roofs = len(maxima)
    for (_, left), (right, _) in zip(maxima, maxima[1:]):
        roofs -= min(counts[left:right + 1]) > beta
    return roofs


@pytest.mark.paper("J 5.3.2, histogram", "J 5.3.2, alpha", "J 5.3.2, beta")
@pytest.mark.parametrize("seed", range(8))
def test_as_many_roofs_as_the_brute_force_histogram_has(seed):
    rng = np.random.default_rng(seed)
    parts = [rectangle(15 * i, 0, 15 * i + rng.uniform(5, 15), 10, rng.uniform(5, 9), 10 * seed + i,
                       noise=rng.uniform(0.05, 0.4)) for i in range(5)]
    points = np.concatenate(parts)
    outline = shapely.box(0, 0, 75, 10)
    beta = int(rng.integers(20, 200))
    found = paper_roofs(*points.T, outline, DENSITY, RoofParameters(method="paper", parapet_threshold=beta))
    assert len(found.roofs) == brute_force_roofs(points[:, 2], 350, beta)


def test_twin_towers_of_one_height_are_one_roof_of_two():
    points = np.concatenate([rectangle(0, 0, 40, 20, 8.0, 1), rectangle(0, 0, 10, 10, 30.0, 2),
                             rectangle(30, 0, 40, 10, 30.0, 3)])
    found = paper_roofs(*points.T, shapely.box(0, 0, 40, 20), DENSITY, RoofParameters(method="paper"))
    assert found.roofs.height == pytest.approx([8.0, 30.0], abs=0.05)
    assert set(found.roof_of_point[points[:, 2] > 20]) == {2}
    assert found.roofs.height_max[1] == points[:, 2].max()


@pytest.mark.parametrize(("points", "outline"), [
    (rectangle(0, 0, 10, 10, 5.0, 1, slope=1.0), shapely.box(0, 0, 10, 10)),
    (rectangle(0, 0, 8, 5, 6.0, 2), shapely.box(0, 0, 8, 5))], ids=["steep", "40 m2"])
def test_a_steep_roof_and_a_small_building_have_none(points, outline):
    found = paper_roofs(*points.T, outline, DENSITY, RoofParameters(method="paper"))
    assert len(found.roofs) == 0 and not found.roof_of_point.any()


def test_points_beside_the_outline_belong_to_the_roof_but_not_to_the_histogram():
    roof = rectangle(0, 0, 10, 10, 9.0, 1)
    eave, ground = rectangle(10, 0, 11, 10, 9.0, 2), rectangle(11, 0, 12, 10, 0.0, 3, density=100)
    points = np.concatenate([roof, eave, ground])
    found = paper_roofs(*points.T, shapely.box(0, 0, 10, 10), DENSITY, RoofParameters(method="paper"))
    assert len(found.roofs) == 1
    assert (found.roof_of_point[:len(roof) + len(eave)] == 1).all()
    assert not found.roof_of_point[len(roof) + len(eave):].any()


@pytest.mark.paper("J 5.3.1", "J 5.3.4")
def test_the_whole_chain_takes_all_points_and_leaves_small_buildings_out(tmp_path, make_cloud):
    outlines = clean_footprints(np.array([shapely.box(0, 0, 20, 20), shapely.box(20.5, 0, 40, 20),
                                          shapely.box(60, 0, 68, 5)], object))
    parts = [rectangle(0, 0, 20, 20, 12.0, 1), rectangle(20.5, 0, 40, 20, 18.0, 2), rectangle(60, 0, 68, 5, 6.0, 3)]
    rng = np.random.default_rng(4)
    ground = np.column_stack([rng.uniform(-20, 90, 30000), rng.uniform(-20, 40, 30000), rng.normal(0, 0.03, 30000)])
    ground = ground[~shapely.contains_xy(shapely.union_all(outlines.polygons), ground[:, 0], ground[:, 1])]
    points = np.concatenate([*parts, ground])
    classes = np.repeat([6, 5, 2], [len(parts[0]), len(parts[1]) + len(parts[2]), len(ground)])
    path = make_cloud(tmp_path / "c.laz", *points.T, classification=classes)
    made = segment_buildings(open_cloud([path]), outlines, tmp_path / "b.laz",
                             SegmentationParameters(method="paper"))
    assert (made.shift_x == 0).all() and (made.shift_status == "kept").all()
    taken = read_all(open_cloud([tmp_path / "b.laz"]), ("x", "y", "z", "building_id"))
    for number, polygon in zip(outlines.ids, outlines.polygons):
        x_min, y_min, x_max, y_max = polygon.bounds
        inside = ((points[:, 0] > x_min - 1) & (points[:, 0] < x_max + 1) & (points[:, 1] > y_min - 1)
                  & (points[:, 1] < y_max + 1))
        assert abs((taken["building_id"] == number).sum() - inside.sum()) <= 2  # the file's lattice of 1 mm
    roofs = segment_cloud_roofs(open_cloud([tmp_path / "b.laz"]), outlines, tmp_path / "r.laz",
                                RoofParameters(method="paper"), made.ground, DENSITY)
    assert roofs.building_id.tolist() == [1, 2]
    drawn = cloud_roof_polygons(open_cloud([tmp_path / "r.laz"]), outlines,
                                PolygonParameters("paper", height="maximum"))
    assert drawn.building_id == [1, 2]
    assert drawn.height == pytest.approx([12.0, 18.0], abs=0.2)
    for polygon, outline in zip(drawn.polygon, outlines.polygons):
        assert polygon.intersection(outline).area / polygon.union(outline).area > 0.85
