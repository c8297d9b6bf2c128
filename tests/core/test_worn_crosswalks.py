"""Worn crosswalks beside sure ones: bars in pieces, ends without paint, and what must not become one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import affinity

from urbanmap_qgis.roadmap.lines.crosswalk_extent import BarRow
from urbanmap_qgis.roadmap.lines.crosswalks import find_crosswalks
from urbanmap_qgis.roadmap.lines.strokes import all_strokes
from urbanmap_qgis.roadmap.lines.worn_crosswalks import bar_patterns, faced_rows

PITCH, WIDTH, LENGTH = 0.9, 0.45, 4.0


def bars(x, y, count=8, pieces=((0.0, LENGTH),)):
    """A crosswalk whose bars run along y; `pieces` are what is left of each, m."""
    return [shapely.box(x + k * PITCH, y + low, x + k * PITCH + WIDTH, y + high)
            for k in range(count) for low, high in pieces]


def found(paint):
    return [row.area for row in find_crosswalks(all_strokes(paint), paint)]


def near(areas, x, y, count):
    """Areas that a crosswalk of `count` bars there overlaps by 70 %."""
    true = shapely.union_all(bars(x, y, count)).envelope
    return [area for area in areas if area.intersection(true).area > 0.7 * area.union(true).area]


SURE = bars(0.0, 0.0) + bars(0.0, 200.0)
WORN = ((0.0, 0.9), (1.3, 2.9), (3.3, 4.0))


def flakes(x, y, count=7, pieces=WORN):
    """Bars of which strips too narrow for a bar are left."""
    return [shapely.box(x + k * PITCH + 0.105, y + low, x + k * PITCH + 0.345, y + high)
            for k in range(count) for low, high in pieces]


def test_bars_in_pieces_are_a_crosswalk_where_sure_ones_show_the_pattern():
    worn = [affinity.rotate(piece, 4.0, origin=(103.0, 102.0)) for piece in flakes(100.0, 100.0)]
    assert found(worn) == [] and len(found([*SURE, *worn])) == 3


def test_rings_are_no_pieces_of_bars():
    rings = [shapely.Point(100.0 + k * PITCH, 100.0).buffer(0.35).boundary.buffer(0.06) for k in range(6)]
    assert any(np.allclose(stroke.axis[0], stroke.axis[-1], atol=0.3) for stroke in all_strokes(rings))
    assert len(found([*SURE, *rings])) == 2


@pytest.mark.parametrize("paint", [
    bars(100.0, 100.0, 2),  # too few, and nothing faces them
    [*flakes(100.0, 100.0), shapely.box(99.0, 96.0, 108.0, 108.0)],  # paint between them as well
    flakes(100.0, 100.0, 7, ((-5.0, -3.1), (-3.0, -0.2), (0.0, 2.8), (3.0, 5.8), (6.0, 9.0))),  # lines that go on
    [shapely.box(100.0 + x, 100.0, 100.4 + x, 102.0) for x in (0.0, 0.7, 2.1, 2.7, 4.3, 4.9)]])  # no common distance
def test_what_is_no_worn_crosswalk(paint):
    assert len(found([*SURE, *paint])) == 2


def test_worn_end_is_that_of_the_crosswalk_across_the_same_street():
    areas = found([*SURE, *bars(0.0, 16.0, 5)])
    assert near(areas, 0.0, 16.0, 8)
    low = find_crosswalks(all_strokes([*SURE, *bars(0.0, 16.0, 5)]), [*SURE, *bars(0.0, 16.0, 5)])
    assert sorted(round(row.fill, 1) for row in low) == [0.6, 1.0, 1.0]  # what is only told counts as without paint


def test_two_bars_are_one_on_the_other_side_of_the_junction_only():
    assert near(found([*SURE, *bars(0.0, 16.0, 3)]), 0.0, 16.0, 8)
    assert not near(found([*SURE, *bars(0.0, 50.0, 3)]), 0.0, 50.0, 8)


@pytest.mark.parametrize(("x", "y"), [(0.0, 90.0), (1.4, 16.0), (-9.0, 16.0)])  # far off; no common end; beside it
def test_crosswalks_of_other_streets_stay_as_long_as_they_are(x, y):
    assert near(found([*SURE, *bars(x, y, 5)]), x, y, 5)


def row(y, first=0, count=8, fill=1.0):
    return BarRow(np.array([0.0, 1.0]), first * PITCH, PITCH, count, WIDTH / 2, (0.0, y), (0.0, y + LENGTH), fill)


def test_a_row_is_not_made_longer_through_another_one_nor_where_hardly_anything_of_it_shows():
    rows = [row(0.0), row(16.0, count=5), row(16.5, first=6, count=4)]
    assert faced_rows(rows)[1].count == 5
    assert [one.count for one in faced_rows([row(0.0, count=20), row(16.0, count=5, fill=0.4)])] == [20, 5]
    assert [one.count for one in faced_rows([row(0.0), row(16.0, count=3)])] == [8, 8]
    assert [one.count for one in faced_rows([row(0.0), row(100.0, count=3)])] == [8]


def test_a_pattern_is_what_two_rows_share():
    assert bar_patterns([row(0.0)]) == []
    (pattern,) = bar_patterns([row(0.0), row(16.0), replace(row(32.0), pitch=1.2)])
    assert (pattern.pitch, pattern.half, pattern.length) == pytest.approx((PITCH, WIDTH / 2, LENGTH))
