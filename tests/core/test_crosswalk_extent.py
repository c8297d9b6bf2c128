"""How far a crosswalk reaches: bars drawn to known places, some of them missing."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.roadmap.lines.crosswalk_extent import BarRow, extended
from urbanmap_qgis.roadmap.lines.crosswalks import find_crosswalks
from urbanmap_qgis.roadmap.lines.strokes import all_strokes

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
