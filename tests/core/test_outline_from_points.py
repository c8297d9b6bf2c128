"""Outlines recovered from points of known shapes."""

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate

from urbanmap_qgis.buildings.polygons.outline_from_points import outline_from_points
from urbanmap_qgis.errors import InputError, InsufficientDataError


def unordered(polygon, density, seed):
    x0, y0, x1, y1 = polygon.bounds
    xy = np.random.default_rng(seed).uniform([x0, y0], [x1, y1], (int(density * (x1 - x0) * (y1 - y0)), 2))
    return xy[shapely.contains_xy(polygon, xy)].T


def scan_lines(polygon, along, across, seed):
    rng = np.random.default_rng(seed)
    x0, y0, x1, y1 = polygon.bounds
    x, y = np.meshgrid(np.arange(x0, x1, along) + rng.uniform(0, along),
                       np.arange(y0, y1, across) + rng.uniform(0, across))
    xy = np.column_stack([x.ravel(), y.ravel()]) + rng.normal(0, 0.03, (x.size, 2))
    return xy[shapely.contains_xy(polygon, xy)].T


def overlap(one, two):
    return shapely.intersection(one, two).area / shapely.union(one, two).area


TEE = rotate(shapely.Polygon([(0, 0), (24, 0), (24, 8), (16, 8), (16, 20), (8, 20), (8, 8), (0, 8)]), 17)


def test_size_is_not_biased_by_the_points_inside():
    # without the correction each wall would stand 0.45 spacings, 0.16 m, inside
    moves = []
    for seed in range(4):
        found = outline_from_points(*unordered(TEE, 8.0, seed), 8.0)
        assert overlap(found.outline, TEE) > 0.97
        assert found.status == "regular"
        moves.append((found.outline.area - TEE.area) / TEE.length)
    assert abs(np.mean(moves)) < 0.05


def test_sparse_scan_lines_do_not_shrink_the_walls_along_them():
    # 0.25 m along, 1 m across: walls along the lines lie 0.5 m outside the last line on average
    shape = shapely.box(0, 0, 24, 14)
    heights = []
    for seed in range(12):
        found = outline_from_points(*scan_lines(shape, 0.25, 1.0, seed), 4.0)
        x0, y0, x1, y1 = found.outline.bounds
        assert x1 - x0 == pytest.approx(24.0, abs=0.3)
        heights.append(y1 - y0)
    assert np.mean(heights) == pytest.approx(14.0, abs=0.25)


def test_courtyard():
    shape = shapely.difference(shapely.box(0, 0, 30, 30), shapely.box(10, 10, 20, 20))
    found = outline_from_points(*unordered(shape, 8.0, 3), 8.0)
    assert len(found.outline.interiors) == 1
    assert overlap(found.outline, shape) > 0.97


def test_round_building_is_told_as_curved():
    shape = shapely.Point(0, 0).buffer(12)
    found = outline_from_points(*unordered(shape, 8.0, 1), 8.0)
    assert found.status == "curved"
    assert overlap(found.outline, shape) > 0.96


def test_party_wall_without_gap_or_overlap():
    neighbour = shapely.box(20, -5, 40, 20)
    found = outline_from_points(*unordered(shapely.box(0, 0, 20, 12), 8.0, 7), 8.0, neighbours=[neighbour])
    assert shapely.intersection(found.outline, neighbour).area == pytest.approx(0.0, abs=1e-9)
    shared = shapely.intersection(found.outline.buffer(1e-6), neighbour.exterior).length
    assert shared == pytest.approx(12.0, abs=0.4)
    assert overlap(found.outline, shapely.box(0, 0, 20, 12)) > 0.97


def test_too_few_points_and_wrong_density():
    with pytest.raises(InsufficientDataError):
        outline_from_points(np.arange(5.0), np.arange(5.0), 8.0)
    with pytest.raises(InputError):
        outline_from_points(np.arange(5.0), np.arange(5.0), 0.0)
