"""Worn stop lines before crosswalks: as far as the sure ones of the map lie."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely import affinity

from tests.core.test_roadmap_lines import back, work_of

PIECES = [shapely.box(-2.1, -1.5, -1.9, -0.9), shapely.box(-2.05, -0.4, -1.9, 0.1), shapely.box(-2.1, 0.7, -1.85, 1.5)]
"""A stop line 45 cm wide from y = -1.5 to 1.5 as wear leaves it."""


def street(y, *bars):
    """A lane along x that ends 2 m before a crosswalk of six bars at x = 0, and what is painted there."""
    lines = [shapely.box(-40, y + side - 0.075, -2.2, y + side + 0.075) for side in (-1.6, 1.6)]
    zebra = [shapely.box(0, y + at - 0.225, 3, y + at + 0.225) for at in np.arange(-2.25, 2.5, 0.9)]
    return [*lines, *zebra, *(affinity.translate(bar, 0.0, y) for bar in bars)]


def stops_of(paint, colours=None):
    return [line for line in work_of(paint, colours).lines if line.kind == "stop line"]


@pytest.mark.parametrize("number, along, told", [(3, 0.0, 1), (2, 0.0, 0), (3, -1.2, 0)])
def test_pieces_are_a_stop_line_where_three_whole_ones_lie_as_far_before_a_crosswalk(number, along, told):
    whole = shapely.box(-2.2, -1.5, -1.75, 1.5)
    sure = [part for k in range(number) for part in street(23.7 * k, whole)]
    found = stops_of([*sure, *street(95.0, *(affinity.translate(piece, along) for piece in PIECES))])
    assert len(found) == number + told
    for line in found[number:]:
        ends = back(line.points)
        assert np.abs(ends[:, 0] + 1.95).max() < 0.25 and np.ptp(ends[:, 1]) == pytest.approx(3.0, abs=0.3)
        assert 0.25 < line.confidence <= 0.7


def test_yellow_pieces_are_no_stop_line():
    whole = shapely.box(-2.2, -1.5, -1.75, 1.5)
    sure = [part for k in range(3) for part in street(23.7 * k, whole)]
    worn = street(95.0, *PIECES)
    colours = ["white"] * (len(sure) + len(worn) - 3) + ["yellow"] * 3
    assert len(stops_of([*sure, *worn], colours)) == 3
