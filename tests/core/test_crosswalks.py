"""How far a crosswalk reaches: bars drawn to known places, some of them missing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import affinity

from urbanmap_qgis.roadmap.lines.crosswalk_extent import BarRow, extended
from urbanmap_qgis.roadmap.lines.crosswalks import find_crosswalks
from urbanmap_qgis.roadmap.lines.strokes import all_strokes
from urbanmap_qgis.roadmap.lines.worn_crosswalks import bar_patterns, faced_rows

PITCH, HALF, LENGTH = 0.9, 0.225, 4.0


def row(first, count, fill=np.nan, along=(0.0, 1.0)):
    """Bars from number `first` on, to the north, one beside the other to the west."""
    return BarRow(np.array(along), first * PITCH, PITCH, count, HALF, (0.0, 0.0), (0.0, LENGTH), fill)


def paint(*numbers, low=0.0, high=LENGTH):
    return shapely.STRtree([shapely.box(-k * PITCH - HALF, low, -k * PITCH + HALF, high) for k in numbers])


@pytest.mark.parametrize(("painted", "first", "count"), [
    (range(10), 0, 10),
    (range(-3, 7), -3, 10),
    ((*range(5), *range(7, 10)), 0, 10),  # two bars worn away, three beyond them
    ((*range(-4, -1), *range(5)), -4, 9),
    ((*range(5), 7), 0, 5),  # one stroke some way off is something else
    ((*range(5), *range(9, 14)), 0, 5),  # four missing: another thing
    (range(1, 4), 1, 3)])  # without those that nothing shows
def test_bars_that_belong_to_a_row(painted, first, count):
    found = extended(row(0, 5), paint(*painted))
    assert found.first == pytest.approx(first * PITCH) and found.count == count


def test_ends_and_fill_of_bars():
    found = extended(row(0, 5), paint(*range(5), low=-1.0, high=4.6))
    assert found.near == pytest.approx((0.0, -1.0), abs=0.15) and found.far == pytest.approx((0.0, 4.6), abs=0.15)
    assert found.fill == pytest.approx(1.0, abs=0.05)
    assert found.area.area == pytest.approx(5.6 * (4 * PITCH + 2 * HALF), rel=0.05)


def test_paint_between_the_bars_too_is_no_crosswalk():
    whole = shapely.STRtree([shapely.box(-10.0, 0.0, 10.0, LENGTH)])
    assert extended(row(0, 5), whole).fill == pytest.approx(0.0)


@pytest.mark.parametrize(("whole", "halves", "slope"), [((0, 1, 2, 3, 4), range(7, 16), -0.13),
                                                        ((0, 1, 2, 3, 14, 15), range(7, 14), -0.3)])
def test_crosswalk_of_which_a_shadow_cuts_halves_off_is_one_and_not_askew(whole, halves, slope):
    """The border of the shadow runs askew through the bars, and two of them are hidden."""
    bars = [shapely.box(k * PITCH - HALF, 0.0, k * PITCH + HALF, LENGTH) for k in whole]
    bars += [shapely.box(k * PITCH - HALF, 2.0 + slope * (k - 7), k * PITCH + HALF, LENGTH) for k in halves]
    (found,) = find_crosswalks(all_strokes(bars), bars)
    true = shapely.box(-HALF, 0.0, 15 * PITCH + HALF, LENGTH)
    assert found.area.intersection(true).area > 0.95 * found.area.union(true).area


# Worn crosswalks beside sure ones: bars in pieces, ends without paint, and what must not become one


PITCH, WIDTH, LENGTH = 0.9, 0.45, 4.0


def bars(x, y, count=8, pieces=((0.0, LENGTH),)):
    """A crosswalk whose bars run along y; `pieces` are what is left of each, m."""
    return [shapely.box(x + k * PITCH, y + low, x + k * PITCH + WIDTH, y + high)
            for k in range(count) for low, high in pieces]


def found(paint):
    return [bar_row.area for bar_row in find_crosswalks(all_strokes(paint), paint)]


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


def bar_row(y, first=0, count=8, fill=1.0):
    return BarRow(np.array([0.0, 1.0]), first * PITCH, PITCH, count, WIDTH / 2, (0.0, y), (0.0, y + LENGTH), fill)


def test_a_row_is_not_made_longer_through_another_one_nor_where_hardly_anything_of_it_shows():
    rows = [bar_row(0.0), bar_row(16.0, count=5), bar_row(16.5, first=6, count=4)]
    assert faced_rows(rows)[1].count == 5
    assert [one.count for one in faced_rows([bar_row(0.0, count=20), bar_row(16.0, count=5, fill=0.4)])] == [20, 5]
    assert [one.count for one in faced_rows([bar_row(0.0), bar_row(16.0, count=3)])] == [8, 8]
    assert [one.count for one in faced_rows([bar_row(0.0), bar_row(100.0, count=3)])] == [8]


def test_a_pattern_is_what_two_rows_share():
    assert bar_patterns([bar_row(0.0)]) == []
    (pattern,) = bar_patterns([bar_row(0.0), bar_row(16.0), replace(bar_row(32.0), pitch=1.2)])
    assert (pattern.pitch, pattern.half, pattern.length) == pytest.approx((PITCH, WIDTH / 2, LENGTH))
