"""Alpha shapes with known boundaries."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.alpha_shape import alpha_shape, default_alpha, signed_area


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
