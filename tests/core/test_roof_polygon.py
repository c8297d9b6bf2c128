"""Roof polygons by the two cases of J 5.3.3, and the chain from points."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate

from urbanmap_qgis.buildings.polygons.hough_lines import BoundaryLine
from urbanmap_qgis.buildings.polygons.roof_polygon import paper_roof_polygons, roof_polygon
from urbanmap_qgis.errors import InputError


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
