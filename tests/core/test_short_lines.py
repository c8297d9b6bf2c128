"""Short pieces of lines beside sure ones: which are lines."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.lines.line_chains import StrokeChain
from urbanmap_qgis.roadmap.lines.short_lines import supported_chains

ROAD = [np.array([(0.0, y), (50.0, y)]) for y in (0.0, 3.5, 7.0)]
WIDTHS = [0.15] * 3


def piece(x0, y0, x1, y1, painted=None, width=0.15):
    length = float(np.hypot(x1 - x0, y1 - y0))
    return StrokeChain(np.array([(x0, y0), (x1, y1)], float), [0], length if painted is None else painted, width)


def is_line(one, axes=ROAD, widths=WIDTHS):
    return supported_chains([one], axes, widths) == [one]


def test_piece_at_the_width_of_the_lanes_beside_is_a_line():
    assert is_line(piece(20, 10.5, 23, 10.5))


@pytest.mark.parametrize("one", [
    piece(20, 10.0, 23, 10.0),  # at no width that lanes have here
    piece(20, 5.25, 23, 5.25),  # between the lines of a lane: a symbol's shaft
    piece(20, 10.5, 23, 11.2),  # askew
    piece(20, 10.5, 21, 10.5),  # too little paint
    piece(20, 10.5, 30, 10.5, painted=1.6),  # scraps in a row
    piece(20, 10.5, 23, 10.5, width=0.26),  # of another width
    piece(20, 40.0, 23, 40.0),  # far from all lines
], ids=["width", "within", "askew", "little", "scraps", "broad", "far"])
def test_other_pieces_are_none(one):
    assert not is_line(one)


def test_piece_that_continues_a_line_is_one_near_its_end_only():
    assert is_line(piece(55, 3.5, 58, 3.5))
    assert not is_line(piece(80, 3.5, 83, 3.5))


def test_one_line_alone_tells_of_no_width():
    assert not is_line(piece(20, 3.5, 23, 3.5), ROAD[:1], WIDTHS[:1])
    assert is_line(piece(55, 0.0, 58, 0.0), ROAD[:1], WIDTHS[:1])


def test_without_sure_lines_none_is_taken():
    assert supported_chains([piece(0, 0, 3, 0)], [], []) == []
