"""Arrows by where they stand: so far before crosswalks as others, not in lines or letters; kinds by the map's own."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely import affinity

from tests.core.test_roadmap_lines import arrow, broad, placed, work_of
from urbanmap_qgis.roadmap.lines.arrow_places import ArrowSurroundings, before_crosswalks, crosswalk_ahead, usual_values
from urbanmap_qgis.roadmap.lines.crosswalks import Crosswalk
from urbanmap_qgis.roadmap.lines.strokes import all_strokes


def street(y, before, *paint):
    """A lane along x with its lines, paint so far before a crosswalk of six bars."""
    lines = [shapely.box(-20, y + side - 0.075, before, y + side + 0.075) for side in (-1.6, 1.6)]
    bars = [shapely.box(before, y + at - 0.225, before + 3.0, y + at + 0.225) for at in np.arange(-2.25, 2.5, 0.9)]
    return [*lines, *bars, *(affinity.translate(one, 0.0, y) for one in paint)]


WORN = shapely.get_parts(arrow("straight").difference(shapely.box(2.9, -1, 6, -0.04)))
"""One side of the head is gone."""


def arrows_of(paint, colours=None):
    return [area for area in work_of(paint, colours).areas if area.kind.startswith("arrow")]


@pytest.mark.parametrize("before, number, told", [(10.7, 3, 1), (10.7, 2, 0), (14.0, 3, 0), (9.8, 3, 0)])
def test_worn_arrow_is_known_where_three_others_stand_as_far_before_a_crosswalk(before, number, told):
    paint = [part for k in range(number) for part in street(15.0 * k, 10.7, arrow("straight"))]
    found = arrows_of([*paint, *street(60.0, before, *WORN)])
    assert len(found) == number + told
    assert all(area.heading == pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)
               for area in found)


def test_distance_is_that_to_the_crosswalk_ahead_whose_bars_run_along():
    row = Crosswalk(shapely.box(10, -3, 13, 3), (), 0.9, 7, np.array([1.0, 0.0]), 1.0)
    turned = Crosswalk(shapely.box(5, -3, 8, 3), (), 0.9, 7, np.array([0.0, 1.0]), 1.0)
    tails, courses = np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 5.0]]), np.array([[1.0, 0.0], [-1.0, 0.0], [1.0, 0.0]])
    assert np.allclose(before_crosswalks(tails, courses, [turned, row]), [10.0, np.nan, np.nan], equal_nan=True)


def test_usual_values_are_those_that_enough_share():
    assert usual_values(np.array([10.6, 24.7, 10.9, 40.0, 10.7, 24.9]), 0.4, 2) == pytest.approx([10.7, 24.8])
    assert usual_values(np.zeros(0), 0.4, 2) == []


@pytest.mark.parametrize("more, denied", [([], False), ([(-2.4, -0.3)], True), ([(5.4, 7.6)], True),
                                          ([(-2.4, -1.8)], False), ([(-5.0, -3.0)], False)])
def test_what_goes_on_as_a_line_is_no_arrow(more, denied):
    paint = [arrow("straight"), *(shapely.box(low, -0.075, high, 0.075) for low, high in more)]
    about = ArrowSurroundings(all_strokes(paint), [])
    assert about.deny(paint[0], np.zeros(2), np.array([1.0, 0.0]), [0]) is denied


def test_what_lies_among_yellow_letters_is_no_arrow():
    letters = [shapely.box(0.5, y, 4.5, y + 0.17) for y in (-0.45, 0.28)]
    streets = street(0.0, 10.7, arrow("straight"), *letters)
    colours = ["white"] * (len(streets) - 2) + ["yellow"] * 2
    assert not arrows_of(streets, colours)
    assert len(arrows_of(streets[:-2], colours[:-2])) == 1


@pytest.mark.parametrize("others, kind", [("straight", "arrow straight"), ("straight left", "arrow, kind unknown")])
def test_a_second_head_that_may_be_worn_away_counts_for_little_where_none_is_painted(others, kind):
    """Beside the place of the second head half of the shaft is bare."""
    worn = broad("straight").difference(shapely.box(0.95, -2, 1.3, 2)).difference(shapely.box(1.5, -2, 1.85, 2))
    paint = [part for k in range(3) for part in street(15.0 * k, 10.7, broad(others))]
    found = arrows_of([*paint, *street(-30.0, 20.0, *shapely.get_parts(worn))])
    low = placed([shapely.Point(2.5, -30.0)])[0]
    (open_kind,) = [area.kind for area in found if area.polygon.distance(low) < 2.0]
    assert len(found) == 4 and open_kind == kind


def test_without_a_line_near_the_crosswalk_of_its_road_tells_a_direction():
    row = Crosswalk(shapely.box(10, -3, 13, 3), (), 0.9, 7, np.array([1.0, 0.0]), 1.0)
    assert crosswalk_ahead(np.zeros(2), [row]) is row.direction
    assert all(crosswalk_ahead(np.array(place), [row]) is None for place in ([0.0, 5.0], [-40.0, 0.0]))
    worn = shapely.get_parts(arrow("straight").difference(shapely.union_all([
        shapely.box(1.0, -1, 1.5, 1), shapely.box(2.3, -1, 2.8, 1)])))
    lines, paint = street(0.0, 10.7, *worn)[:2], street(0.0, 10.7, *worn)[2:]
    assert len(arrows_of(paint)) == len(arrows_of([*lines, *paint])) == 1 and not arrows_of(list(worn))
