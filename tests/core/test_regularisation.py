"""Main directions and straightened outlines with known answers."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate
from shapely.geometry.polygon import orient

from urbanmap_qgis.buildings.polygons.regularisation import main_directions, regularise_ring
from urbanmap_qgis.errors import InputError

FAR = np.array([3e5, 4e6])
ELL = shapely.Polygon([(0, 0), (20, 0), (20, 8), (8, 8), (8, 18), (0, 18)])


def boundary(polygon, noise, seed, step=0.4):
    xy = shapely.get_coordinates(orient(polygon).exterior)
    parts = [np.linspace(a, b, max(round(np.hypot(*(b - a)) / step), 1), endpoint=False)
             for a, b in zip(xy[:-1], xy[1:])]
    ring = np.vstack(parts)
    return ring + np.random.default_rng(seed).uniform(-noise, noise, ring.shape)


def test_main_directions_by_length():
    edges = np.array([[10, 0], [0, 5], [-10, 0], [0, -5], [1, 1]], float)
    assert main_directions(edges) == pytest.approx([0.0])
    wing = np.array([[5, 5], [-5, 5], [-5, -5], [5, -5]], float)
    np.testing.assert_allclose(main_directions(np.vstack([edges[:4], wing])), [0.0, 45.0], atol=1e-9)


def test_direction_near_the_right_angle_does_not_split():
    angles = np.radians([0.5, 89.5, 180.5, 269.5])
    found = main_directions(10 * np.column_stack([np.cos(angles), np.sin(angles)]))
    assert len(found) == 1
    assert min(found[0], 90 - found[0]) == pytest.approx(0.0, abs=0.6)


@settings(max_examples=15, deadline=None)
@given(st.floats(0, 360), st.integers(0, 1000))
def test_noisy_ell_becomes_six_square_corners(angle, seed):
    shape = rotate(ELL, angle, origin=(0, 0))
    ring, curved, rms = regularise_ring(boundary(shape, 0.15, seed) + FAR, 0.6)
    assert not curved
    assert len(ring) == 6
    edges = np.roll(ring, -1, axis=0) - ring
    unit = edges / np.hypot(*edges.T)[:, None]
    assert np.abs(np.sum(unit * np.roll(unit, 1, axis=0), axis=1)).max() < 1e-6
    corners = shapely.points(shapely.get_coordinates(shape) + FAR)
    assert shapely.distance(shapely.multipoints(ring), corners).max() < 0.25
    assert rms < 0.15


def test_step_wider_than_the_tolerance_stays():
    shape = shapely.Polygon([(0, 0), (20, 0), (20, 10), (12, 10), (12, 11.5), (0, 11.5)])
    ring, _, _ = regularise_ring(boundary(shape, 0.05, 1), 0.6)
    assert shapely.hausdorff_distance(shapely.Polygon(ring), shape) < 0.3


def test_long_oblique_wall_keeps_its_direction():
    shape = shapely.Polygon([(0, 0), (20, 0), (20, 8), (12, 16), (0, 16)])
    ring, _, _ = regularise_ring(boundary(shape, 0.1, 2), 0.6)
    assert shapely.hausdorff_distance(shapely.Polygon(ring), shape) < 0.3


def test_curved_building_falls_back():
    ring, curved, _ = regularise_ring(boundary(shapely.Point(0, 0).buffer(15), 0.1, 3), 0.6)
    assert curved
    circle = shapely.Point(0, 0).buffer(15)
    polygon = shapely.Polygon(ring)
    assert polygon.is_valid
    assert shapely.hausdorff_distance(polygon, circle) < 0.6


def test_outward_moves_every_wall():
    ring, _, _ = regularise_ring(boundary(shapely.box(0, 0, 12, 8), 0.0, 1), 0.6, lambda a, b: 0.25)
    assert shapely.Polygon(ring).bounds == pytest.approx((-0.25, -0.25, 12.25, 8.25), abs=1e-6)


def test_too_few_points():
    with pytest.raises(InputError):
        regularise_ring(np.zeros((3, 2)), 0.6)
