"""Roof polygons by the two cases of J 5.3.3, and the chain from points."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate

from urbanmap_qgis.buildings.outlines.courtyards import with_courtyards
from urbanmap_qgis.buildings.outlines.decks import ground_without_decks
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.polygons.hough_lines import BoundaryLine
from urbanmap_qgis.buildings.polygons.radius_outliers import EXPECTED_NEIGHBOURS, default_radius, remove_radius_outliers
from urbanmap_qgis.buildings.polygons.roof_polygon import paper_roof_polygons, roof_polygon
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.buildings.segmentation import segment_buildings
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all


def line(boundary, first, last, point, direction):
    return BoundaryLine(np.array(point, float), np.array(direction, float), first, last, last - first + 1)


@pytest.mark.paper("J 5.3.3, 4")
def test_shared_corners_are_taken_as_they_are():
    boundary = np.array([[0, 0], [10, 0], [10, 6], [0, 6]], float)
    lines = [line(boundary, 0, 1, [5, 0], [1, 0]), line(boundary, 2, 3, [5, 6], [-1, 0]),
             line(boundary, 1, 2, [10, 3], [0, 1]), line(boundary, 3, 0, [0, 3], [0, -1])]
    assert roof_polygon(lines, boundary).equals(shapely.box(0, 0, 10, 6))


@pytest.mark.paper("J 5.3.3, 4")
def test_unmatched_ends_become_perpendicular_images():
    # Figure 5-5: the corner at (10, 0) has no common point; the other three have
    boundary = np.array([[0, 0.0], [9, 0.2], [9.8, 1], [10, 6], [0, 6]])
    lines = [line(boundary, 0, 1, [0, 0], [1, 0]), line(boundary, 2, 3, [10, 0], [0, 1]),
             line(boundary, 3, 4, [0, 6], [-1, 0]), line(boundary, 4, 0, [0, 0], [0, -1])]
    expected = shapely.Polygon([(0, 0), (9, 0), (10, 1), (10, 6), (0, 6)])
    assert roof_polygon(lines, boundary).equals(expected)


def printed_steps(lines, boundary):
    """J 5.3.3, step 4 as printed: begins with the first point of the first edge, the last edge adds nothing."""
    ring, current, left = [boundary[lines[0].first]], lines[0], lines[1:]
    while left:
        following = min(left, key=lambda edge: np.hypot(*(boundary[edge.first] - boundary[current.last])))
        if following.first == current.last:
            ring.append(boundary[current.last])
        else:
            ring += [current.project(boundary[current.last]), following.project(boundary[following.first])]
        left = [edge for edge in left if edge is not following]
        current = following
    return shapely.Polygon(ring)


@pytest.mark.paper("J 5.3.3, 4")
def test_the_last_corner_is_drawn_as_the_others():
    # A corner cut between the last and the first edge, which the printed steps would draw as a long diagonal.
    boundary = np.array([[1, 0], [10, 0], [10, 10], [0, 10], [0, 1.0]])
    lines = [line(boundary, 0, 1, [5, 0], [1, 0]), line(boundary, 1, 2, [10, 5], [0, 1]),
             line(boundary, 2, 3, [5, 10], [-1, 0]), line(boundary, 3, 4, [0, 5], [0, -1])]
    assert roof_polygon(lines, boundary).area == pytest.approx(99.5)
    assert printed_steps(lines, boundary).area == pytest.approx(95.0)


def test_needs_three_edges():
    with pytest.raises(InputError):
        roof_polygon([], np.zeros((4, 2)))


SHAPES = {
    "rectangle": shapely.box(0, 0, 20, 12),
    "ell": shapely.Polygon([(0, 0), (20, 0), (20, 8), (8, 8), (8, 18), (0, 18)]),
    "tee": shapely.Polygon([(0, 0), (24, 0), (24, 8), (16, 8), (16, 20), (8, 20), (8, 8), (0, 8)]),
}


def points_in(polygon, density, seed):
    x0, y0, x1, y1 = polygon.bounds
    rng = np.random.default_rng(seed)
    xy = rng.uniform([x0, y0], [x1, y1], (int(density * (x1 - x0) * (y1 - y0)), 2))
    return xy[shapely.contains_xy(polygon, xy)]


@settings(max_examples=8, deadline=None)
@given(st.sampled_from(sorted(SHAPES)), st.floats(0, 90), st.integers(0, 1000))
def test_shapes_come_back_within_the_point_spacing(name, angle, seed):
    shape = rotate(SHAPES[name], angle)
    xy = points_in(shape, 8.0, seed)
    (roof,) = paper_roof_polygons(xy[:, 0], xy[:, 1], np.ones(len(xy), int), 8.0)
    union = shapely.union(roof.polygon, shape).area
    assert shapely.intersection(roof.polygon, shape).area / union > 0.9
    # J's polygon follows the outermost points, so it is smaller than the roof
    assert roof.polygon.area < shape.area


def test_courtyard_stays_open():
    shape = shapely.difference(shapely.box(0, 0, 30, 30), shapely.box(10, 10, 20, 20))
    xy = points_in(shape, 8.0, 5)
    (roof,) = paper_roof_polygons(xy[:, 0], xy[:, 1], np.ones(len(xy), int), 8.0)
    assert len(roof.polygon.interiors) == 1
    assert shapely.Polygon(roof.polygon.interiors[0]).area == pytest.approx(100.0, rel=0.2)


def test_each_roof_has_its_polygon_and_none_is_dropped():
    one, two = points_in(shapely.box(0, 0, 10, 10), 6.0, 1), points_in(shapely.box(10, 0, 20, 10), 6.0, 2)
    xy = np.vstack([one, two, [[40.0, 40.0]], [[50.0, 50.0]]])
    roof = np.concatenate([np.full(len(one), 4), np.full(len(two), 2), [9], [0]])
    roofs = paper_roof_polygons(xy[:, 0], xy[:, 1], roof, 6.0)
    assert [r.roof_number for r in roofs] == [2, 4, 9]
    assert roofs[2].polygon is None
    assert roofs[2].status == "too few points"


def test_wrong_density():
    with pytest.raises(InputError):
        paper_roof_polygons(np.zeros(3), np.zeros(3), np.ones(3, int), 0.0)


# Radius outlier removal against counts by brute force


@pytest.mark.paper("J 5.3.3, 1")
def test_counts_agree_with_all_pairs():
    xy = np.random.default_rng(1).uniform(0, 10, (300, 2))
    near = np.hypot(*(xy[:, None] - xy[None]).transpose(2, 0, 1)) <= 0.7
    expected = near.sum(axis=1) - 1 >= 4
    assert 0 < expected.sum() < 300
    np.testing.assert_array_equal(remove_radius_outliers(xy, 0.7, 4), expected)


def test_lone_points_leave_and_corners_of_a_roof_stay():
    density = 8.0
    rng = np.random.default_rng(2)
    roof = rng.uniform(0, 20, (int(400 * density), 2))
    keep = remove_radius_outliers(np.vstack([roof, [[30.0, 30.0], [40.0, 5.0]]]), default_radius(density))
    assert not keep[-2:].any()
    assert keep[:-2].mean() > 0.999


def test_default_radius_holds_the_expected_number():
    assert np.pi * default_radius(7.0) ** 2 * 7.0 == pytest.approx(EXPECTED_NEIGHBOURS)


def test_empty_and_wrong_input():
    assert remove_radius_outliers(np.zeros((0, 2)), 1.0).shape == (0,)
    with pytest.raises(InputError):
        remove_radius_outliers(np.zeros((3, 2)), 0.0)
    with pytest.raises(InputError):
        default_radius(0.0)


# Roofs that a classification left out: a tower of class 1 on a podium of class 6


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


# Courtyards that an outline leaves out


BLOCK = shapely.box(0, 0, 24, 24)
COURT = shapely.box(8, 6, 17, 16)


def points(density=8.0, court=COURT, seed=1):
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-5, 29, (2, int(34 * 34 * density)))
    low = ~shapely.contains_xy(BLOCK, x, y) | shapely.contains_xy(court, x, y)
    return x, y, low


def cut(x, y, low, density=8.0):
    return with_courtyards(np.array([BLOCK, None], dtype=object), x, y, low, density)


@pytest.mark.parametrize("density", [2.0, 8.0, 20.0])
def test_a_courtyard_is_cut_out_at_its_walls(density):
    made = cut(*points(density), density)
    assert made[1] is None and len(made[0].interiors) == 1
    hole = shapely.Polygon(made[0].interiors[0])
    assert hole.intersection(COURT).area / hole.union(COURT).area > (0.75 if density < 5 else 0.9)


def test_trees_in_a_courtyard_do_not_close_it():
    x, y, low = points()
    crown = np.hypot(x - 12, y - 11) < 2.5
    low &= ~(crown & (np.random.default_rng(2).random(len(x)) < 0.5))
    hole = shapely.Polygon(cut(x, y, low)[0].interiors[0])
    assert hole.intersection(COURT).area / hole.union(COURT).area > 0.85


@pytest.mark.parametrize("court", [shapely.Polygon(), shapely.box(10, 10, 13, 13), shapely.box(4, 12, 20, 13.2),
                                   shapely.box(0, 0, 24, 1.4)], ids=["none", "small", "narrow", "at the outline"])
def test_roofs_skylights_gaps_and_inexact_outlines_make_no_courtyard(court):
    assert cut(*points(court=court))[0].equals(BLOCK)


def test_turning_the_scene_turns_the_courtyard():
    x, y, low = points()
    turned = shapely.affinity.rotate(shapely.MultiPoint(np.column_stack([x, y])), 30, origin=(0, 0))
    places = shapely.get_coordinates(turned)
    block = np.array([shapely.affinity.rotate(BLOCK, 30, origin=(0, 0))], dtype=object)
    made = with_courtyards(block, places[:, 0], places[:, 1], low, 8.0)[0]
    assert made.area == pytest.approx(cut(x, y, low)[0].area, rel=0.03)


def test_a_deck_taken_for_ground_is_put_back_to_the_street():
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-10, 34, (2, 15000))
    deck = shapely.contains_xy(shapely.box(0, 0, 24, 12), x, y)
    tower = shapely.contains_xy(shapely.box(0, 12, 24, 24), x, y)
    z = np.where(deck, 5.0, np.where(tower, 40.0, 0.0))
    ground = np.where(deck | tower, 5.0, 0.0)  # the filter ran over the deck
    made = ground_without_decks(np.array([BLOCK, None], object), x, y, z, ground, 7.7)
    assert (made[deck | tower] == 0).all() and (made[~(deck | tower)] == 0).all()


def test_ground_of_a_slope_and_of_a_courtyard_stay():
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-10, 34, (2, 15000))
    slope = 0.3 * x
    court = shapely.contains_xy(COURT, x, y)
    z = np.where(shapely.contains_xy(BLOCK, x, y) & ~court, 30.0, slope)
    assert (ground_without_decks(np.array([BLOCK], object), x, y, z, slope, 7.7) == slope).all()
