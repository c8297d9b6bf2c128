"""Bars of a crossing vouch for each other: combs of any direction, and what is no comb."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_pieces import marking_pieces_of
from urbanmap_qgis.aerial.markings.signs.crossing_bars import BARS_REACH, crossing_bars
from urbanmap_qgis.aerial.markings.signs.strokes import strokes_of

PIXEL = 0.12


def drawn(places, length=4.0, width=0.45, turn=0.0, side=300):
    """How many of bars drawn at these places (m across, m along) are found, of how many pieces there are."""
    flags = np.zeros((side, side), np.uint8)
    along = np.array([np.cos(np.deg2rad(turn)), np.sin(np.deg2rad(turn))])
    across = np.array([-along[1], along[0]])
    for place, shift, *own in places:
        middle = side * PIXEL / 2 + across * place + along * shift
        sides = (np.outer((-1, 1, 1, -1), along) * (own or [length])[0] + np.outer((-1, -1, 1, 1), across) * width) / 2
        cv2.fillPoly(flags, [np.rint((middle + sides) / PIXEL).astype(np.int32)], 1)
    pieces = marking_pieces_of(flags > 0, flags, PIXEL, 12.0)
    accepted = pieces.size > 0
    accepted[0] = False
    found = crossing_bars(strokes_of(pieces, accepted, side, PIXEL), 0.8)
    return int(found.sum()), int(accepted.sum())


def drawn_with_parts(places, parts):
    """As `drawn`, with parts of bars 1 m long at such places too."""
    return drawn([*((*place, 4.0) for place in places), *((*place, 1.0) for place in parts)])


def comb(count, step=0.9):
    return [(step * (k - count / 2), 0.0) for k in range(count)]


@pytest.mark.parametrize("turn", [0.0, 17.0, 45.0, 90.0, 131.0])
@pytest.mark.parametrize("length", [2.0, 4.0, 5.5])
def test_bars_of_a_comb(turn, length):
    assert drawn(comb(6), length, turn=turn) == (6, 6)


def test_parts_of_a_worn_bar():
    """A bar of which two parts are left, beside four whole ones; a part beyond their ends stays out."""
    whole = comb(5)[:4]
    place = comb(5)[4][0]
    made = [drawn_with_parts(whole, [(place, shift) for shift in shifts]) for shifts in ((-1.2, 1.2), (-1.2, 3.2))]
    assert made == [(6, 6), (5, 6)]


def test_a_missing_bar_does_not_matter():
    bars = comb(7)
    assert drawn(bars[:3] + bars[4:]) == (6, 6)


@pytest.mark.parametrize(("places", "shape"), [
    (comb(2), {}),  # a pair has no step
    (comb(6, 2.5), {}),  # bays of a car park
    (comb(8, 1.3), {"width": 0.1}),  # ribs of a roof
    (comb(5), {"length": 0.9}),  # blocks of paving
    ([(0.9 * k, 1.9 * k) for k in range(-2, 3)], {}),  # each begins where the last one ends
    ([(0.0, 0.0), (0.8, 0.0), (2.0, 0.0)], {"width": 0.3}),  # no steady step
])
def test_what_is_no_comb(places, shape):
    found, pieces = drawn(places, **shape)
    assert found == 0 and pieces == len(places)


def test_the_reach_holds_all_that_vouches():
    assert CleanSettings().piece_reach >= BARS_REACH
