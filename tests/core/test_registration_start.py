"""Correlation of shifts, and the best way through them."""

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.mobile.registration.start.correlation_start import (
    CELL,
    ScoreImage,
    alternative_spread,
    best_path,
    centred,
    peaks,
    score_image,
    shift_scores,
)
from urbanmap_qgis.mobile.registration.start.reference import Coverage


def test_scores_of_shifts_are_the_sums_of_what_points_fall_on():
    rng = np.random.default_rng(4)
    image = ScoreImage(-20, -30, rng.uniform(0, 1, (60, 50)).astype(np.float32))
    reach = 5
    for count in (4, 400):  # few far apart, and many
        x, y = rng.uniform(-4.5, 6.5, count), rng.uniform(-6.5, 6.5, count)
        weight = rng.uniform(0.2, 1, count)
        scores = shift_scores(x, y, weight, image, reach)
        for north, east in ((0, 0), (-5, 3), (4, -2), (5, 5)):
            column = np.floor(x / CELL).astype(int) + east + 20
            row = np.floor(-y / CELL).astype(int) - north + 30
            inside = (column >= 0) & (column < 50) & (row >= 0) & (row < 60)
            plain = (image.score[row[inside], column[inside]] * weight[inside]).sum()
            assert np.isclose(scores[north + reach, east + reach], plain, rtol=1e-4, atol=1e-4)


def test_points_far_from_the_reference_score_nothing():
    image = ScoreImage(0, 0, np.ones((10, 10), np.float32))
    assert not shift_scores(np.array([500.0]), np.array([500.0]), np.ones(1), image, 3).any()


def test_score_image_lies_where_the_coverage_is():
    share = np.zeros((100, 120), dtype=np.float32)
    share[40, 70] = 1.0
    grid = Grid(1000.03, 2000.07, 0.1, 100, 120)
    image = score_image(Coverage(grid, share), 0.05)
    row, column = np.unravel_index(image.score.argmax(), image.score.shape)
    assert abs((image.left + column + 0.5) * CELL - (1000.03 + 7.05)) <= CELL / 2
    assert abs(-(image.top + row + 0.5) * CELL - (2000.07 - 4.05)) <= CELL / 2


def test_best_way_is_the_best_of_all_ways():
    rng = np.random.default_rng(8)
    scores = rng.uniform(0, 3, (4, 3, 3)).astype(np.float32)
    wander = np.array([0.02, 0.03, 0.02])  # two cells from block to block at most
    chainage = best_path(scores, wander, 2.5)
    offsets = np.array(list(itertools.product((-1, 0, 1), (-1, 0, 1))))  # north, east

    def value(states):
        total = sum(scores[k, offsets[s, 0] + 1, offsets[s, 1] + 1] for k, s in enumerate(states))
        total -= ((offsets[states[0]] * CELL) ** 2).sum() / (2 * 2.5 ** 2)
        for k in range(3):
            steps = offsets[states[k + 1]] - offsets[states[k]]
            total -= (steps ** 2).sum() * CELL ** 2 / (2 * wander[k])
        return total

    ways = list(itertools.product(range(9), repeat=4))
    values = np.array([value(states) for states in ways])
    best = ways[int(values.argmax())]
    assert [tuple(offsets[s]) for s in best] == [tuple(shift[::-1]) for shift in chainage.shift]
    for block in range(4):
        for state in range(9):
            through = max(v for v, states in zip(values, ways) if states[block] == state)
            deficit = chainage.deficit[block, offsets[state, 0] + 1, offsets[state, 1] + 1]
            assert np.isclose(deficit, values.max() - through, atol=1e-3)


def test_a_long_wait_lets_the_error_jump():
    scores = np.zeros((2, 21, 21), dtype=np.float32)
    scores[0, 10, 10] = scores[1, 10, 16] = 30.0  # 1.2 m further east after the wait
    stiff, free = best_path(scores, np.array([0.005]), 10.0), best_path(scores, np.array([0.4]), 10.0)
    assert tuple(free.shift[1]) == (6, 0) and tuple(free.shift[0]) == (0, 0)
    assert abs(stiff.shift[1, 0] - stiff.shift[0, 0]) <= 1


def test_equal_places_widen_the_spread_and_one_place_does_not():
    one = np.zeros((1, 41, 41), dtype=np.float32)
    one[0, 20, 20] = 40.0
    two = one.copy()
    two[0, 20, 30] = 40.0
    alone, both = (alternative_spread(best_path(s, np.zeros(0), 10.0), 0.5)[0] for s in (one, two))
    assert alone.max() < 1e-6
    assert np.isclose(both[0, 0], 0.5 * 2.0 ** 2, rtol=0.05) and both[1, 1] < 1e-3


def test_centred_and_peaks():
    scores = np.zeros((1, 11, 11), dtype=np.float32)
    scores[0, 7, 3] = 5.0  # two north, two west
    scores[0, 7, 8] = 4.0
    about = centred(scores, np.array([[-2, 2]]))
    assert about[0, 5, 5] == 5.0
    places, heights = peaks(about[0], 3, 2)
    assert tuple(places[0]) == (5, 0) and heights[0] == 4.0


@pytest.mark.parametrize("y_max", [40.0, -400.0])
def test_the_image_of_scores_covers_the_reference(y_max):
    grid = Grid(30.0, y_max, 0.1, 200, 100)
    share = np.zeros(grid.shape, np.float32)
    share[50:60, 20:30] = 1.0
    image = score_image(SimpleNamespace(grid=grid, share=share), 0.1)
    assert image.score.shape == (round(20.0 / CELL), round(10.0 / CELL))
    row, column = np.unravel_index(image.score.argmax(), image.score.shape)
    assert -(image.top + row + 0.5) * CELL == pytest.approx(y_max - 5.5, abs=0.4)
    assert (image.left + column + 0.5) * CELL == pytest.approx(32.5, abs=0.4)
