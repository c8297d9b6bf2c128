"""Fit of points to flat models."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.quality import RoofCell, height_differences, model_fit

WALLS = np.array([[0, 0, 10, 0, 0, 5], [10, 0, 10, 10, 0, 5], [10, 10, 0, 10, 0, 5], [0, 10, 0, 0, 0, 5.0]])
BOX = [RoofCell(shapely.box(0, 0, 10, 10), 5.0)]


def test_distances_to_roof_wall_and_edge():
    x, y, z = np.array([[5, 5, 7], [5, 5, 4], [12, 5, 2], [13, 5, 9], [9.5, 5, 3]], float).T
    fit = model_fit(x, y, z, BOX, WALLS)
    # over the roof by 2, under it by 1, 2 beside a wall, 3-4-5 off the edge, 0.5 inside a wall
    assert fit.rmse_3d == pytest.approx(np.sqrt((4 + 1 + 4 + 25 + 0.25) / 5))
    assert fit.coverage == pytest.approx(3 / 5)
    assert fit.rmse_z == pytest.approx(np.sqrt((4 + 1 + 4) / 3))
    assert fit.median_dz == pytest.approx(2)


def test_trimmed_rmse_leaves_out_the_worst_twentieth():
    x = np.linspace(1, 9, 100)
    z = np.full(100, 5.1)
    z[:5] = 50
    fit = model_fit(x, x, z, BOX, WALLS)
    assert fit.rmse_z95 == pytest.approx(0.1) and fit.rmse_z > 9


def test_the_upper_of_two_overlapping_roofs_counts():
    cells = [RoofCell(shapely.box(0, 0, 4, 4), 9.0), *BOX]
    dz = height_differences(np.array([1.0, 6.0, 20.0]), np.array([1.0, 6.0, 20.0]), np.full(3, 9.0), cells)
    assert dz[:2].tolist() == [0.0, 4.0] and np.isnan(dz[2])


def test_no_points_or_no_model_gives_no_figures():
    none = np.zeros(0)
    assert np.isnan(model_fit(none, none, none, BOX, WALLS).rmse_z)
    fit = model_fit(np.ones(2), np.ones(2), np.ones(2), [], WALLS[:0])
    assert fit.coverage == 0 and np.isnan(fit.rmse_3d)
