"""Ghosts below a road: a few points by detours of the beam, under a thin layer of many more."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.terrain.ghost_points import without_ghosts

SHAPE = 6, 6
CELL = 14  # in the middle: row 2, column 2
ROAD = 10.0


def road(points=60, heights=(ROAD - 0.04, ROAD + 0.04)):
    """Cells and heights of a road of so many points a cell."""
    cell = np.repeat(np.arange(SHAPE[0] * SHAPE[1]), points)
    return cell, np.random.default_rng(1).uniform(*heights, len(cell))


def with_points(cells, heights, number, height):
    return np.append(cells, np.full(number, CELL)), np.append(heights, np.full(number, height))


@pytest.mark.parametrize("depth", [0.5, 2.0, 7.0, 14.0])
def test_few_points_below_a_road_are_ghosts(depth):
    cell, height = with_points(*road(), 3, ROAD - depth)
    found, lowest = without_ghosts(cell, height, SHAPE)
    assert np.isinf(found[-3:]).all() and np.array_equal(found[:-3], height[:-3])
    assert lowest == pytest.approx([height[:-3][cell[:-3] == number].min() for number in range(36)])


@pytest.mark.parametrize(("number", "gone"), [(20, True), (40, False)])
def test_ghosts_are_a_twentieth_at_most(number, gone):
    """Of the 540 points of the layer in nine cells."""
    cell, height = with_points(*road(), number, ROAD - 2.0)
    assert np.isinf(without_ghosts(cell, height, SHAPE)[0][-number:]).all() == gone


def test_clusters_at_several_depths_go():
    cell, height = with_points(*with_points(*road(), 3, ROAD - 1.0), 3, ROAD - 6.0)
    assert np.isinf(without_ghosts(cell, height, SHAPE)[0][-6:]).all()


def test_foot_of_a_wall_stays():
    """A wall is no thin layer: its lowest points are its own."""
    cell, height = with_points(*road(heights=(ROAD, ROAD + 8.0)), 3, ROAD - 2.0)
    found, lowest = without_ghosts(cell, height, SHAPE)
    assert np.array_equal(found, height) and lowest[CELL] == ROAD - 2.0


def test_lower_ground_that_goes_on_stays():
    cell, height = road()
    height[cell % SHAPE[1] < 3] -= 2.0
    assert np.array_equal(without_ghosts(cell, height, SHAPE)[0], height)


def test_points_left_out_before_stay_left_out():
    cell, height = with_points(*road(), 1, np.inf)
    found, lowest = without_ghosts(cell, height, SHAPE)
    assert np.array_equal(found, height) and np.isfinite(lowest).all()
