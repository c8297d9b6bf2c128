"""Hough lines over ordered boundary points with known edges."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry.polygon import orient

from urbanmap_qgis.buildings.polygons.hough_lines import fit_line, hough_lines
from urbanmap_qgis.errors import InputError


def boundary(polygon, step=0.5):
    """Points along the ring of a polygon, its corners among them, counterclockwise."""
    xy = shapely.get_coordinates(orient(polygon).exterior)
    parts = [np.linspace(a, b, max(round(np.hypot(*(b - a)) / step), 1), endpoint=False)
             for a, b in zip(xy[:-1], xy[1:])]
    return np.vstack(parts)


RECTANGLE = shapely.box(0, 0, 12, 7)
ELL = shapely.Polygon([(0, 0), (20, 0), (20, 8), (8, 8), (8, 18), (0, 18)])


@pytest.mark.paper("J 5.3.3, 3")
@pytest.mark.parametrize(("polygon", "edges"), [(RECTANGLE, 4), (ELL, 6)])
def test_every_edge_once_and_corners_shared_by_two(polygon, edges):
    xy = boundary(polygon)
    lines = hough_lines(xy, 5, 0.2)
    assert len(lines) == edges
    assert sorted(line.first for line in lines) == sorted(line.last for line in lines)
    corners = {tuple(c) for c in shapely.get_coordinates(polygon).tolist()}
    assert {tuple(xy[line.first].tolist()) for line in lines} == corners


def test_longest_edge_comes_first():
    lines = hough_lines(boundary(ELL), 5, 0.2)
    assert lines[0].count == 41
    assert abs(lines[0].direction[0]) == pytest.approx(1.0)


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 360), st.integers(0, 1000))
def test_noise_and_rotation_keep_the_edges(angle, seed):
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[c, s], [-s, c]])
    xy = boundary(RECTANGLE) + np.random.default_rng(seed).uniform(-0.05, 0.05, (76, 2))
    lines = hough_lines(xy @ turn + [4e5, 5e6], 5, 0.25)
    assert len(lines) == 4
    for line in lines:
        direction = turn @ line.direction  # back to the axes
        assert np.abs(direction).max() > np.cos(np.radians(1.5))


@pytest.mark.paper("J 5.3.3, 3")
def test_short_sequences_across_a_line_are_not_edges():
    # a comb: the teeth's tips lie on one line, but no five of them are consecutive
    x = np.arange(0, 20, 0.5)
    y = np.where(np.arange(len(x)) % 4 == 0, 3.0, 5.0 + (np.arange(len(x)) % 4))
    comb = np.column_stack([x, y])
    base = np.column_stack([np.arange(20, -0.5, -0.5), np.zeros(41)])
    lines = hough_lines(np.vstack([comb, base]), 5, 0.2)
    assert not [line for line in lines if abs(line.point[1] - 3.0) < 0.3 and abs(line.direction[0]) > 0.99]


def test_circle_of_few_points_ends():
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    assert hough_lines(np.column_stack([np.cos(angle), np.sin(angle)]) * 10, 5, 0.05) == []


def test_all_points_on_one_line():
    (line,) = hough_lines(np.column_stack([np.arange(10.0), np.zeros(10)]), 5, 0.2)
    assert (line.first, line.last, line.count) == (0, 9, 10)


def test_fit_line_is_total_least_squares():
    xy = np.random.default_rng(3).normal(size=(50, 2)) @ np.array([[5.0, 2.0], [0.0, 0.4]]) + [7, 9]
    point, direction = fit_line(xy)
    _, _, v = np.linalg.svd(xy - xy.mean(axis=0))
    np.testing.assert_allclose(point, xy.mean(axis=0))
    assert abs(direction @ v[0]) == pytest.approx(1.0)


def test_wrong_input():
    with pytest.raises(InputError):
        hough_lines(np.zeros((9, 2)), 2, 0.3)
    with pytest.raises(InputError):
        hough_lines(np.zeros((9, 2)), 5, 0.0)
    assert hough_lines(np.zeros((3, 2)), 5, 0.3) == []
