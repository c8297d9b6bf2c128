"""The Delaunay surface against an independent triangulation, and its rasters against planes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.terrain.delaunay import (
    Blocks,
    block_triangles,
    bridge,
    cancel_twins,
    circumcircles,
    extreme_in_cells,
    highest_in_cells,
    open_edges,
    triangulate,
)
from urbanmap_qgis.terrain.rasterise import rasterise


def on_lattice(points):
    """Points on exact 1/64 m, so that the rounding inside changes nothing."""
    return np.unique(np.round(points * 64) / 64, axis=0)


def scattered(count, seed=1, size=60.0):
    return on_lattice(np.random.default_rng(seed).random((count, 2)) * size)


def as_set(triangles):
    return {tuple(sorted(corners)) for corners in triangles.tolist()}


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1]))


def without_disc(points):
    return points[np.hypot(points[:, 0] - 30, points[:, 1] - 30) > 14]


@pytest.mark.paper("J 3.2.1.1, DSM")
@pytest.mark.parametrize("points", [scattered(20_000), without_disc(scattered(15_000, 2)),
                                    scattered(3_000, 3) + np.array([84_900.0, 447_500.0]), scattered(30, 4)],
                         ids=["dense", "hole", "large coordinates", "few"])
def test_same_triangles_as_qhull(points):
    triangles = triangulate(*points.T)
    reference = Delaunay(points - points.mean(axis=0)).simplices
    differing = as_set(triangles) ^ as_set(reference)
    # Four points on one circle have two right answers; on a lattice that happens.
    assert len(differing) < 0.02 * len(reference)
    assert (areas(points, triangles) > 0).all()
    assert areas(points, triangles).sum() == pytest.approx(np.abs(areas(points, reference)).sum(), rel=1e-12)


def test_no_point_inside_a_circumcircle():
    points = scattered(400)
    triangles = triangulate(*points.T)
    cx, cy, radius = circumcircles(*points.T, triangles)
    distance = np.hypot(points[:, 0] - cx[:, None], points[:, 1] - cy[:, None])
    assert (distance >= radius[:, None] * (1 - 1e-9) - 1e-3).all()


def test_regular_raster_is_covered_once():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(120) * 0.5, np.arange(90) * 0.5))
    triangles = triangulate(x, y)
    assert len(triangles) == 2 * 119 * 89
    assert areas(np.column_stack((x, y)), triangles).sum() == pytest.approx(59.5 * 44.5)


def test_blocks_give_each_small_triangle_once():
    points = scattered(6_000)
    blocks = Blocks(side=17.0, radius=3.0, scale=1024.0)
    found = [tuple(sorted(corners)) for column in range(-2, 5) for row in range(-2, 5)
             for corners in block_triangles(*points.T, blocks, column, row).tolist()]
    reference = Delaunay(points).simplices
    small = as_set(reference[circumcircles(*points.T, reference)[2] <= 3.0])
    assert len(found) == len(set(found))
    assert len(set(found) ^ small) < 0.02 * len(small)


@given(st.lists(st.tuples(st.integers(0, 40), st.integers(0, 40)), min_size=3, max_size=60, unique=True))
@settings(max_examples=60, deadline=None)
def test_any_points_cover_their_hull(places):
    points = np.array(places, dtype=float)
    centred = points - points[0]
    if np.linalg.matrix_rank(centred) < 2:
        with pytest.raises(InsufficientDataError):
            triangulate(*points.T)
        return
    triangles = triangulate(*points.T)
    assert areas(points, triangles).sum() == pytest.approx(shapely.MultiPoint(points).convex_hull.area)




def test_too_few_points():
    with pytest.raises(InsufficientDataError, match="three points"):
        triangulate(np.array([0.0, 1.0]), np.array([0.0, 1.0]))


def test_duplicates_are_used_once():
    points = np.array([[0, 0], [10, 0], [0, 10], [10, 10], [10, 10], [0, 0]], dtype=float)
    assert len(triangulate(*points.T)) == 2


def test_open_edges_of_two_triangles():
    triangles = np.array([[0, 1, 2], [2, 1, 3]])
    assert {tuple(edge) for edge in open_edges(triangles).tolist()} == {(0, 1), (2, 0), (1, 3), (3, 2)}
    assert len(cancel_twins(np.empty((0, 2), dtype=np.int64))) == 0


def test_open_edges_of_patches_that_touch_in_corners():
    points = scattered(4_000)
    triangles = triangulate(*points.T)
    some = triangles[np.random.default_rng(1).random(len(triangles)) < 0.6]
    edges = some[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert np.array_equal(open_edges(some), cancel_twins(edges))


def test_bridge_fills_only_the_open_side():
    # A square ring: outer side 4, inner side 2; covered between, open inside.
    outer = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
    inner = np.array([[1, 1], [3, 1], [3, 3], [1, 3]], dtype=float)
    points = np.concatenate((outer, inner))
    rim = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [5, 4], [6, 5], [7, 6], [4, 7]])
    triangles = bridge(*points.T, rim)
    assert areas(points, triangles).sum() == pytest.approx(4.0)
    assert set(triangles.ravel().tolist()) == {4, 5, 6, 7}


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(-50, 50)), max_size=80))
def test_extremes_of_cells(values):
    cell = np.array([item[0] for item in values], dtype=np.int64)
    height = np.array([item[1] for item in values], dtype=float)
    highest = extreme_in_cells(cell, height, 6, highest=True)
    for number in range(6):
        assert highest[number] == max(height[cell == number], default=-np.inf)
    first = highest_in_cells(cell, height, 6, tie=(height * 0, np.arange(len(cell), dtype=float)))
    assert [cell[index] for index in first] == sorted(set(cell.tolist()))


def test_ties_do_not_depend_on_the_order():
    rng = np.random.default_rng(5)
    x, y = rng.random((2, 200))
    z = np.round(rng.random(200), 1)
    cell = (x * 4).astype(np.int64)
    turn = rng.permutation(200)
    a = highest_in_cells(cell, z, 4, tie=(x, y))
    b = highest_in_cells(cell[turn], z[turn], 4, tie=(x[turn], y[turn]))
    assert np.array_equal(a, turn[b])


def test_plane_is_reproduced_everywhere_inside():
    points = scattered(5_000)
    height = 3.0 + 0.5 * points[:, 0] - 0.25 * points[:, 1]
    grid = Grid.covering(0, 0, 59.9, 59.9, 0.5)
    raster = np.full(grid.shape, np.nan, dtype=np.float32)
    rasterise(*points.T, height, triangulate(*points.T), grid, raster)
    cx, cy = grid.centres()
    expected = 3.0 + 0.5 * cx[None, :] - 0.25 * cy[:, None]
    assert not np.isnan(raster[4:-4, 4:-4]).any()
    assert np.nanmax(np.abs(raster - expected)) < 1e-4


def test_one_triangle_fills_the_centres_it_covers():
    grid = Grid(0.0, 4.0, 1.0, 4, 4)
    raster = np.full(grid.shape, np.nan)
    rasterise(np.array([0.0, 4.0, 0.0]), np.array([0.0, 0.0, 4.0]), np.array([0.0, 4.0, 0.0]),
              np.array([[0, 1, 2]]), grid, raster)
    # Heights equal x; the diagonal runs through cell centres, which count as covered.
    expected = np.array([[0.5, np.nan, np.nan, np.nan], [0.5, 1.5, np.nan, np.nan], [0.5, 1.5, 2.5, np.nan],
                         [0.5, 1.5, 2.5, 3.5]])
    np.testing.assert_allclose(raster, expected)


def test_only_empty_cells_are_written_when_asked():
    grid = Grid(0.0, 2.0, 1.0, 2, 2)
    raster = np.array([[7.0, np.nan], [np.nan, 7.0]])
    rasterise(np.array([-1.0, 5.0, -1.0]), np.array([-1.0, -1.0, 5.0]), np.ones(3), np.array([[0, 1, 2]]), grid,
              raster, only_empty=True)
    assert raster.tolist() == [[7.0, 1.0], [1.0, 7.0]]
