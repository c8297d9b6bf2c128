"""The cloth filter on made-up towns whose ground is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.sampling import sample
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.settings.terrain import ClothSettings
from urbanmap_qgis.terrain.cloth import LowestHeights, classify_ground, converged_cloth, first_cloth
from urbanmap_qgis.terrain.outliers import VOXEL, isolated, plausible
from urbanmap_qgis.terrain.trend import trend_surface

SIZE = 160.0
BLOCKS = [(20 + 40 * i, 20 + 40 * j, 45 + 40 * i, 45 + 40 * j, 8 + 5 * ((i * 7 + j * 3) % 5))
          for i in range(4) for j in range(4)]


def flat(x, y):
    return np.full(np.shape(x), 10.0)


def slope_of(degrees):
    return lambda x, y: 10.0 + np.tan(np.radians(degrees)) * x


def hills(x, y):
    return 10.0 + 15.0 * np.sin(x / 60.0) * np.cos(y / 80.0)


def town(ground, roofs, density=4.0, seed=3):
    """x, y, z and truth of a town: ground, and flat roofs (x0, y0, x1, y1, height)."""
    rng = np.random.default_rng(seed)
    x, y = rng.random((2, int(SIZE * SIZE * density))) * SIZE
    z, truth = ground(x, y), np.ones(len(x), dtype=bool)
    for x0, y0, x1, y1, height in roofs:
        roof = (x > x0) & (x < x1) & (y > y0) & (y < y1)
        z[roof], truth[roof] = ground((x0 + x1) / 2, (y0 + y1) / 2) + height, False
    return x + 500_000.0, y + 4_000_000.0, z + rng.normal(0, 0.03, len(z)), truth


def errors(x, y, z, truth, **parameters):
    """Shares of ground missed and of other points taken."""
    ground = classify_ground(x, y, z, ClothSettings(**parameters))
    return (~ground & truth).sum() / truth.sum(), (ground & ~truth).sum() / max((~truth).sum(), 1)


@pytest.mark.parametrize(("ground", "roofs", "missed"), [
    (flat, BLOCKS, 0.0005), (flat, [(30, 30, 130, 130, 3.0)], 0.0005), (flat, [(0, 30, 110, 130, 6.0)], 0.0005),
    (slope_of(10), BLOCKS, 0.001), (slope_of(20), BLOCKS, 0.01), (slope_of(20), [(30, 30, 130, 130, 30.0)], 0.01),
    (hills, BLOCKS, 0.005),
], ids=["town", "hall of 100 m", "hall at the border", "10 degrees", "20 degrees", "hall on 20 degrees", "hills"])
@pytest.mark.paper("J 3.2.3.1")
def test_ground_of_towns(ground, roofs, missed):
    type_one, type_two = errors(*town(ground, roofs))
    assert type_one <= missed and type_two <= 0.0005


@pytest.mark.parametrize("density", [0.5, 2.0, 15.0])
def test_densities(density):
    type_one, type_two = errors(*town(flat, BLOCKS, density))
    assert type_one < 0.005 and type_two < 0.002


def test_courtyards_in_a_closed_block():
    x, y, z, truth = town(flat, [(10, 10, 150, 150, 15.0)])
    for i in range(25, 150, 30):
        for j in range(25, 150, 30):
            yard = (np.abs(x - 500_000 - i) < 3) & (np.abs(y - 4_000_000 - j) < 3)
            z[yard], truth[yard] = 10.0, True
    type_one, type_two = errors(x, y, z, truth)
    assert type_one < 0.001 and type_two == 0


@pytest.mark.parametrize(("together", "depth"), [(1, 5), (3, 5), (6, 5), (6, 30)])
def test_low_points_do_not_pull_the_cloth(together, depth):
    x, y, z, truth = town(flat, BLOCKS, 8.0)
    rng = np.random.default_rng(7)
    cx, cy = rng.random((2, 30)) * SIZE
    low_x, low_y = (np.repeat(c, together) + rng.normal(0, 0.5, 30 * together) for c in (cx, cy))
    inside = (low_x > 0) & (low_x < SIZE) & (low_y > 0) & (low_y < SIZE)
    low_z = 10.0 - depth + rng.normal(0, 0.3, len(low_x))
    x, y, z = (np.concatenate(pair) for pair in ((x, low_x[inside] + 500_000.0), (y, low_y[inside] + 4_000_000.0),
                                                 (z, low_z[inside])))
    truth = np.concatenate((truth, np.zeros(inside.sum(), dtype=bool)))
    type_one, type_two = errors(x, y, z, truth)
    assert type_one < 0.02 and type_two < 0.001


def test_holes_and_irregular_outlines():
    x, y, z, truth = town(hills, BLOCKS)
    keep = ((np.abs((x - 500_000) - (y - 4_000_000)) < 50)
            & (np.hypot(x - 500_080, y - 4_000_080) > 25))
    type_one, type_two = errors(x[keep], y[keep], z[keep], truth[keep])
    assert type_one < 0.005 and type_two == 0


def test_kerbs_and_vehicles():
    x, y, z, truth = town(flat, [], 40.0)
    pavement = (x - 500_000) % 30 < 6
    z[pavement] += 0.15
    vehicle = ((x - 500_000) % 30 > 10) & ((x - 500_000) % 30 < 12) & ((y - 4_000_000) % 20 < 5)
    z[vehicle], truth[vehicle] = 11.5, False
    assert errors(x, y, z, truth) == (pytest.approx(0, abs=2e-3), 0)


def test_cloth_lies_on_the_ground_and_not_on_roofs():
    x, y, z, _truth = town(slope_of(10), BLOCKS)
    grid, heights, _ = converged_cloth(x, y, z, ClothSettings(), SILENT)
    assert np.isfinite(heights).all()
    px, py = np.random.default_rng(0).random((2, 500)) * (SIZE - 10) + 5
    off = sample(grid, heights, px + 500_000, py + 4_000_000) - slope_of(10)(px, py)
    assert np.abs(off).max() < 0.6
    assert np.median(np.abs(off)) < 0.05


@given(st.floats(-1e5, 1e5), st.floats(-200, 2000))
@settings(max_examples=10, deadline=None)
def test_moving_the_cloud_by_whole_nodes_changes_nothing(shift, lift):
    x, y, z, _truth = town(hills, BLOCKS, 1.0)
    step = 4.0 * round(shift / 4.0)
    lift = round(lift / 4.0) * 4.0
    a = classify_ground(x, y, z)
    b = classify_ground(x + step, y - step, z + lift)
    assert (a != b).mean() < 0.001


def test_order_of_points_does_not_matter():
    x, y, z, _truth = town(hills, BLOCKS, 2.0)
    turn = np.random.default_rng(1).permutation(len(x))
    assert np.array_equal(classify_ground(x, y, z)[turn], classify_ground(x[turn], y[turn], z[turn]))


def test_unusable_heights_are_not_ground():
    x, y, z, _truth = town(flat, [], 1.0)
    z[:5] = [np.nan, np.inf, -np.inf, 99_999.0, -99_999.0]
    ground = classify_ground(x, y, z)
    assert not ground[:5].any() and ground[5:].all()


def test_refusals():
    with pytest.raises(InsufficientDataError):
        classify_ground(np.zeros(3), np.zeros(3), np.full(3, np.nan))
    with pytest.raises(InputError):
        ClothSettings(resolution=0)
    with pytest.raises(InputError):
        ClothSettings(rigidness=0)


def test_a_few_points_do_not_fail():
    assert classify_ground(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([5.0, 5.0])).all()


def test_only_pits_cannot_be_draped():
    empty = np.full((6, 6), np.inf)
    levels = LowestHeights(empty.copy(), empty, np.zeros((6, 6), dtype=int))
    levels.lowest[2, 2] = 3.0
    with pytest.raises(InsufficientDataError):
        first_cloth(levels, ClothSettings())


def test_trend_continues_a_slope_across_a_gap():
    row, column = np.mgrid[:100, :100]
    lowest = 5.0 + 0.4 * column - 0.2 * row
    expected = lowest.copy()
    lowest[30:70, 40:90] = np.inf
    lowest[5:25, 5:25] += 20.0
    assert np.abs(trend_surface(lowest, 2.0) - expected).max() < 2.0


def test_isolated_points():
    rng = np.random.default_rng(2)
    x, y = rng.random((2, 2000)) * 40
    z = np.zeros(2000)
    x, y, z = np.append(x, [20.0, 20.0]), np.append(y, [20.0, 20.0]), np.append(z, [40.0, -30.0])
    assert np.flatnonzero(isolated(x, y, z)).tolist() == [2000, 2001]
    assert plausible(x, y, np.append(z[:-1], np.nan)).sum() == len(z) - 1


@pytest.mark.parametrize("gap", [1, 2, 3, 50])
def test_empty_levels_are_shrunk_without_bringing_points_together(gap):
    """Two groups of three points: neighbours where they are one voxel apart, strangers beyond."""
    z = 2.0 + VOXEL * np.repeat([0.0, gap], 3)
    flat = np.full(6, 0.5)
    assert isolated(flat, flat, z, neighbours=3).all() == (gap > 1)
    assert not isolated(flat, flat, z, neighbours=2).any()
