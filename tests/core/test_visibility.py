"""Lines of sight from a frame to the ground, against geometry that can be worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.visibility import off_ground, visible_ground
from urbanmap_qgis.geometry.grid import Grid

GRID = Grid(1000.0, 2000.0, 0.5, 200, 240)
LEVEL = 10.0


def town(height=40.0):
    """Flat ground and one block of 10 x 10 m at x 1060 to 1070, y 1940 to 1950."""
    x, y = GRID.centres()
    block = ((x > 1060) & (x < 1070))[None, :] & ((y > 1940) & (y < 1950))[:, None]
    ground = np.full(GRID.shape, LEVEL)
    return ground, np.where(block, LEVEL + height, LEVEL), block


def marched(centre, ground, surface):
    """The same by walking along every ray in small steps."""
    x, y = GRID.centres()
    x, y = np.meshgrid(x, y)
    seen = np.ones(GRID.shape, bool)
    for share in np.linspace(0.002, 0.4, 400):
        row, column, inside = GRID.cells((x + share * (centre[0] - x)).ravel(), (y + share * (centre[1] - y)).ravel())
        ray = ground + share * (centre[2] - ground)
        seen &= ~((surface[row, column].reshape(GRID.shape) > ray) & inside.reshape(GRID.shape))
    return seen


@pytest.mark.parametrize("centre", [(1065.0, 1945.0, 510.0), (1010.0, 1990.0, 210.0), (900.0, 1900.0, 160.0),
                                    (1300.0, 1945.0, 310.0), (1065.0, 2200.0, 260.0), (1030.25, 1945.25, 110.0)])
def test_shadow_of_a_block_against_marched_rays(centre):
    ground, surface, block = town()
    seen = visible_ground(np.array(centre), GRID, ground, surface)
    truth = marched(centre, ground, surface)
    assert (seen != truth)[~block].mean() < 0.004
    assert (~truth & ~block).sum() > 100 or centre[2] == 510.0


def test_length_of_the_shadow():
    ground, surface, _ = town(height=40.0)
    centre = np.array([1020.0, 1945.0, LEVEL + 200.0])
    seen = visible_ground(centre, GRID, ground, surface)
    row, _, _ = GRID.cells(np.array([1945.0]), np.array([1945.0]))
    line = seen[row[0]]
    x, _ = GRID.centres()
    hidden = x[~line & (x > 1070)]
    # The roof's far edge, 50 m from the nadir, throws its shadow to 50 * 200 / (200 - 40) = 62.5 m.
    assert hidden.max() == pytest.approx(1082.5, abs=0.8)
    assert hidden.min() == pytest.approx(1070.25, abs=0.5)


def test_low_things_hide_nothing():
    ground, surface, _ = town(height=4.0)
    assert visible_ground(np.array([900.0, 1945.0, 100.0]), GRID, ground, surface).all()
    assert not visible_ground(np.array([900.0, 1945.0, 100.0]), GRID, ground, surface, threshold=2.0).all()


def test_a_hill_hides_ground_without_a_surface():
    x, _ = GRID.centres()
    ground = np.tile(LEVEL + 60 * np.exp(-((x - 1060) / 6) ** 2), (GRID.rows, 1))
    seen = visible_ground(np.array([1010.0, 1950.0, LEVEL + 100.0]), GRID, ground)
    behind = (x > 1072) & (x < 1085)
    assert not seen[100, behind].any() and seen[100, x < 1055].all()


def test_noise_of_the_ground_hides_nothing():
    ground = LEVEL + np.random.default_rng(1).normal(0, 0.1, GRID.shape)
    assert visible_ground(np.array([950.0, 1900.0, 200.0]), GRID, ground, ground).all()


def test_a_tower_as_high_as_the_camera_hides_all_behind():
    ground, surface, _ = town(height=300.0)
    seen = visible_ground(np.array([1020.0, 1945.0, 210.0]), GRID, ground, surface)
    x, _ = GRID.centres()
    assert not seen[110, x > 1071].any()


def test_unknown_heights():
    ground, surface, _ = town()
    ground[:10], surface[50:60] = np.nan, np.nan
    seen = visible_ground(np.array([1065.0, 1945.0, 510.0]), GRID, ground, surface)
    assert not seen[:10].any() and seen[50:60].all()
    assert not off_ground(surface, ground, 5.0)[50:60].any()
