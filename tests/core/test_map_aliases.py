"""Other places where what is seen fits: modes of odds over shifts that were drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.localisation.map_aliases import STEP, ScoreField, alias_modes

SIZE = 41
MIDDLE = SIZE // 2


def surface(*hills, between=1e-6):
    """Log odds with cells (rows north, columns east of the middle) of given odds, all others at `between`."""
    odds = np.full((SIZE, SIZE), between)
    odds[MIDDLE, MIDDLE] = 1.0
    for row, column, height in hills:
        odds[MIDDLE + row, MIDDLE + column] = height
    return np.log(odds)


def test_shift_and_share_of_other_modes():
    found = alias_modes(surface((0, 12, 0.5), (-10, -6, 0.25)), 2.0)
    assert found.shift == pytest.approx(np.array([[12.0, 0.0], [-6.0, -10.0]]) * STEP)
    assert found.share == pytest.approx([0.5 / 1.75, 0.25 / 1.75], abs=0.002)


@pytest.mark.parametrize(("valley", "count"), [(0.2, 1), (0.35, 0)])
def test_only_what_a_valley_parts_is_another_mode(valley, count):
    """Along a street without features the odds are a ridge: six tenths of the lower hill part the two."""
    assert len(alias_modes(surface((0, 12, 0.5), between=valley), 2.0).shift) == count


@pytest.mark.parametrize(("away", "count"), [(4, 0), (5, 1)])
def test_what_is_near_is_the_same_place(away, count):
    assert len(alias_modes(surface((away, 0, 0.5)), 2.0).shift) == count


def test_hills_near_a_likelier_one_are_one_with_it():
    found = alias_modes(surface((0, 12, 0.5), (0, 15, 0.3)), 2.0)
    assert found.shift == pytest.approx(np.array([[12.0, 0.0]]) * STEP)
    assert found.share == pytest.approx([0.8 / 1.8], abs=0.002)


def test_score_is_highest_where_the_map_was_moved_from():
    """Points seen 1.5 m west and 1 m south of the corner of two walls that the map has."""
    wall = np.concatenate([np.column_stack([np.arange(0.25, 20, 0.5), np.full(40, 10.25)]),
                           np.column_stack([np.full(20, 10.25), np.arange(0.25, 10, 0.5)])])
    field = ScoreField.of(wall, (-10.0, -10.0, 30.0, 30.0), 0.3)
    score = field.shifted(wall[::2] - [1.5, 1.0], 6)
    assert np.unravel_index(score.argmax(), score.shape) == (6 + 2, 6 + 3)
    assert score.max() == pytest.approx(30 * np.log1p(1 / 0.05), rel=0.02)
