"""Strokes that others vouch for: before the bars of a crossing, and in line with sure ones."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_pieces import marking_pieces_of
from urbanmap_qgis.aerial.markings.signs.crossing_bars import CONFIDENCE
from urbanmap_qgis.aerial.markings.signs.strokes import strokes_of
from urbanmap_qgis.aerial.markings.signs.strokes_in_company import IN_LINE, STROKES_REACH, vouched_confidence

PIXEL = 0.12
COMB = [(0.9 * k, 0.0, 0.45, 4.0) for k in range(-2, 3)]


def found(strokes, *, bars=0, sure=(), turn=0.0, side=400):
    """Confidence by number of strokes, each (m across, m along, m wide, m long), that others vouch for; the first so
    many are bars, and those numbered are sure."""
    flags = np.zeros((side, side), np.uint8)
    along = np.array([np.cos(np.deg2rad(turn)), np.sin(np.deg2rad(turn))])
    across = np.array([-along[1], along[0]])
    middles = [side * PIXEL / 2 + across * place + along * shift for place, shift, *_shape in strokes]
    for middle, (*_place, width, length) in zip(middles, strokes):
        sides = (np.outer((-1, 1, 1, -1), along) * length + np.outer((-1, -1, 1, 1), across) * width) / 2
        cv2.fillPoly(flags, [np.rint((middle + sides) / PIXEL).astype(np.int32)], 1)
    pieces = marking_pieces_of(flags > 0, flags, PIXEL, 12.0)
    labels = np.zeros(flags.shape, int)
    labels.ravel()[pieces.inside] = pieces.labels
    piece = [labels[round(middle[1] / PIXEL), round(middle[0] / PIXEL)] for middle in middles]
    vouching, rules = np.zeros(len(pieces.size), bool), np.zeros(len(pieces.size), np.float32)
    vouching[piece[:bars]] = True
    rules[[piece[number] for number in sure]] = 1.0
    accepted = pieces.size > 0
    accepted[0] = False
    strokes = strokes_of(pieces, accepted, side, PIXEL)
    made = vouched_confidence(strokes, vouching, pieces.labels, rules[pieces.labels])
    assert (made[vouching] == np.float32(CONFIDENCE)).all()
    return {number: made[label] for number, label in enumerate(piece) if made[label] and number >= bars}


@pytest.mark.parametrize("turn", [0.0, 17.0, 45.0, 90.0, 131.0])
def test_a_stop_line_before_bars(turn):
    assert found([*COMB, (0.9, 4.0, 4.0, 0.45)], bars=5, turn=turn) == {5: CONFIDENCE}


@pytest.mark.parametrize("turn", [0.0, 17.0, 90.0])
def test_dashes_in_line_with_a_sure_one(turn):
    dashes = [(0.0, shift, 0.2, 3.0) for shift in (-12.0, 0.0, 12.0)]
    assert found(dashes, sure=[1], turn=turn) == {0: IN_LINE, 2: IN_LINE}


@pytest.mark.parametrize(("stroke", "bars"), [
    ((0.9, 4.0, 4.0, 0.45), 2),  # two bars say little
    ((0.9, 7.0, 4.0, 0.45), 5),  # too far off
    ((6.0, 4.0, 4.0, 0.45), 5),  # beside, not before them
    ((0.9, 4.0, 1.2, 0.3), 5),  # a block
    ((0.9, 4.0, 3.0, 1.2), 5),  # too wide
    ((3.0, 0.0, 0.45, 4.0), 5),  # along them
])
def test_what_is_no_stop_line(stroke, bars):
    assert found([*COMB[:bars], stroke], bars=bars) == {}


@pytest.mark.parametrize("stroke", [
    (0.6, 6.0, 0.2, 3.0),  # beside its axis
    (0.0, 16.0, 0.2, 3.0),  # too far off
    (0.0, 6.0, 0.6, 3.0),  # too wide
    (0.0, 6.0, 0.2, 1.2),  # too short
    (0.0, 6.0, 3.0, 0.2),  # across
])
def test_what_is_not_in_line(stroke):
    assert found([(0.0, 0.0, 0.2, 3.0), stroke], sure=[0]) == {}


def test_sure_ones_vouch_for_each_other_and_doubtful_ones_for_none():
    far, *two = (-15.0, 0.0, 0.2, 3.0), (0.0, 0.0, 0.2, 3.0), (0.0, 6.0, 0.2, 3.0)
    assert [list(found([far, *two], sure=sure)) for sure in ([0], [0, 1], [0, 1, 2], [])] == [[], [2], [1, 2], []]


def test_the_reach_holds_all_that_vouches():
    assert CleanSettings().piece_reach >= STROKES_REACH
