"""Shapes, regions, groups and faces of the core's geometry."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.alpha_shape import alpha_shape, default_alpha, signed_area
from urbanmap_qgis.geometry.grid_regions import grid_regions
from urbanmap_qgis.geometry.linked_groups import linked_groups
from urbanmap_qgis.geometry.solid import GROUND, OUTER_WALL, ROOF, multipolygon, volume
from urbanmap_qgis.geometry.solid_faces import face_normal, solids_of


def lattice(columns, rows, step=1.0):
    x, y = np.meshgrid(np.arange(columns) * step, np.arange(rows) * step)
    return np.column_stack([x.ravel(), y.ravel()])


def test_lattice_gives_its_rectangle():
    xy = lattice(11, 6)
    (ring,) = alpha_shape(xy, 0.8)
    polygon = shapely.Polygon(xy[ring])
    assert polygon.equals(shapely.box(0, 0, 10, 5))
    assert signed_area(xy[ring]) == pytest.approx(50.0)
    assert len(ring) == 2 * (10 + 5)  # every boundary point of the lattice, in order
    assert np.hypot(*np.diff(xy[ring], axis=0).T).max() == pytest.approx(1.0)


def test_courtyard_is_a_clockwise_ring_after_the_outer_one():
    xy = lattice(13, 13)
    xy = xy[~((xy > 3.5) & (xy < 8.5)).all(axis=1)]
    outer, hole = alpha_shape(xy, 0.8)
    assert signed_area(xy[outer]) == pytest.approx(144.0)
    assert signed_area(xy[hole]) == pytest.approx(-36.0, abs=2.0)  # its corners may be cut by half a cell each


def test_two_roofs_that_touch_in_one_point_stay_two_rings():
    xy = lattice(9, 9)
    in_one = (xy <= 4).all(axis=1)
    in_two = (xy >= 4).all(axis=1)
    xy = xy[in_one | in_two]
    rings = alpha_shape(xy, 0.75)
    areas = [shapely.Polygon(xy[r]) for r in rings]
    assert all(a.is_valid for a in areas)
    assert sum(a.area for a in areas) >= 32.0
    assert sum(map(len, rings)) == len(np.concatenate(rings))


@pytest.mark.paper("J 5.3.3, 2")
def test_area_equals_the_small_triangles_for_random_points():
    from scipy.spatial import Delaunay
    xy = np.random.default_rng(4).uniform(0, 20, (800, 2))
    rings = alpha_shape(xy, 0.9)
    triangles = xy[Delaunay(xy).simplices]
    a, b, c = (np.hypot(*(triangles[:, i] - triangles[:, (i + 1) % 3]).T) for i in range(3))
    area = shapely.area(shapely.polygons(triangles))
    expected = area[a * b * c / (4 * area) < 0.9].sum()
    assert sum(signed_area(xy[r]) for r in rings) == pytest.approx(expected, rel=1e-9)


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 360), st.integers(0, 10_000))
def test_turned_points_give_the_turned_shape(angle, seed):
    xy = np.random.default_rng(seed).uniform(0, 10, (120, 2))
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turned = xy @ np.array([[c, s], [-s, c]]) + [5e5, 4e6]
    one = {tuple(sorted(r.tolist())) for r in alpha_shape(xy, 1.5)}
    two = {tuple(sorted(r.tolist())) for r in alpha_shape(turned, 1.5)}
    assert one == two


def test_no_area_gives_no_ring():
    assert alpha_shape(np.zeros((2, 2)), 1.0) == []
    assert alpha_shape(np.column_stack([np.arange(9.0), np.arange(9.0)]), 1.0) == []
    assert alpha_shape(lattice(3, 3, 10.0), 1.0) == []


def test_wrong_input():
    with pytest.raises(InputError):
        alpha_shape(np.zeros((5, 3)), 1.0)
    with pytest.raises(InputError):
        alpha_shape(np.zeros((5, 2)), -1.0)
    with pytest.raises(InputError):
        default_alpha(0.0)


def test_regions_touch_along_sides_and_are_counted_row_by_row():
    classes = np.array([[0, 2, 2, 0, 1],
                        [1, 0, 2, 1, 1],
                        [1, 1, 0, 2, 0]])
    assert grid_regions(classes).tolist() == [[0, 1, 1, 0, 2],
                                              [3, 0, 1, 2, 2],
                                              [3, 3, 0, 4, 0]]


@pytest.mark.parametrize("seed", range(5))
def test_each_class_falls_apart_as_its_mask_does(seed):
    classes = np.random.default_rng(seed).integers(0, 4, (17, 23))
    found = grid_regions(classes)
    assert ((found == 0) == (classes == 0)).all()
    for kind in (1, 2, 3):
        alone, count = ndimage.label(classes == kind)
        pairs = np.unique(np.stack([alone[alone > 0], found[alone > 0]]), axis=1)
        assert pairs.shape[1] == count == len(np.unique(pairs[1]))


@pytest.mark.parametrize("count", [1, 2, 7, 40, 150, 400])
@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 1.0])
def test_groups_and_their_numbers_are_those_of_scipy(count, share):
    rng = np.random.default_rng(count)
    one, two = rng.integers(0, count, (2, int(share * count)))
    found, group = linked_groups(one, two, count)
    wanted = connected_components(coo_matrix((np.ones(len(one)), (one, two)), (count, count)), directed=False)
    assert found == wanted[0] and (group == wanted[1]).all() and len(group) == count


def test_a_long_chain_in_any_order_is_one_group():
    order = np.random.default_rng(3).permutation(140)
    found, group = linked_groups(order[:-1], order[1:], 140)
    assert found == 1 and not group.any()


def box(x, y, z, width, depth, height):
    """Faces of a box as polygons, counterclockwise seen from outside."""
    corner = np.array([[x + i * width, y + j * depth, z + k * height] for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return [shapely.Polygon(corner[list(ring)]) for ring in rings]


def test_a_box_comes_back_as_a_solid_with_its_surfaces():
    solid, = solids_of(shapely.MultiPolygon(box(-7000, -34000, 10, 8, 5, 3)))
    assert len(solid.vertices) == 8 and sorted(solid.surface_type) == sorted([GROUND, ROOF] + [OUTER_WALL] * 4)
    assert volume(solid) == 8 * 5 * 3
    assert shapely.equals_exact(shapely.normalize(multipolygon([solid])),
                                shapely.normalize(shapely.MultiPolygon(box(-7000, -34000, 10, 8, 5, 3))), 1e-3)


def test_boxes_apart_are_two_solids_and_touching_at_a_corner_too():
    faces = box(0, 0, 0, 2, 2, 2) + box(2, 2, 0, 2, 2, 2)
    assert [len(solid.faces) for solid in solids_of(shapely.MultiPolygon(faces))] == [12]
    faces = box(0, 0, 0, 2, 2, 2) + box(2, 2, 2, 2, 2, 2)
    assert [len(solid.faces) for solid in solids_of(shapely.MultiPolygon(faces))] == [6, 6]


def test_normals_look_outwards():
    solid, = solids_of(shapely.MultiPolygon(box(0, 0, 0, 4, 4, 4)))
    middle = solid.vertices.mean(axis=0)
    for face in solid.faces:
        away = solid.vertices[list(face[0])].mean(axis=0) - middle
        assert face_normal(solid.vertices, face) @ away > 1.9


def test_nothing_gives_nothing():
    assert solids_of(shapely.MultiPolygon()) == []
