"""Lanes from paint alone: stop lines that vehicles hide, arrows read the wrong way, pavements, false crosswalks."""

from __future__ import annotations

import pytest
import shapely

from tests.core.laid_out_roads import arrow, course, lane_at, line, place, stop
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

LEFT = MapSettings(traffic="left")


def plain_lanes(built):
    return [lane for lane in built.lanes if lane.kind == "lane"]


def has_lane(built, x, y):
    where = shapely.Point(place([(x, y)])[0, :2])
    return any(built.area(number).contains(where) for number in range(len(built.lanes)))


@pytest.mark.parametrize("places", [(40,), (40, 20)])
def test_arrows_against_a_stop_line_make_no_lane_and_are_told(places):
    lines = [line(7.0, 0, 50), line(3.5, 0, 50), line(0.0, 0, 50), line(-3.5, 0, 50)]
    built = build_vector_map([*lines, stop(50.3, 0.1, 6.9)], [arrow(x, 1.7, back=True) for x in places], [], LEFT)
    assert not has_lane(built, 25, 1.7)
    assert "direction contradicts" in {finding.kind for finding in built.findings}


@pytest.mark.parametrize("ends", [(0.1, 3.4), (-3.4, 3.4)])
def test_stop_line_across_all_that_is_known_of_a_road_tells_no_direction(ends):
    strip = [line(3.5, 0, 30), line(0.0, 0, 30)]
    assert not plain_lanes(build_vector_map([*strip, stop(30.3, *ends)], (), [], LEFT))


def test_pavement_beyond_the_outer_end_of_a_stop_line_is_no_lane():
    lines = [line(y, 0, 50) for y in (10.0, 7.0, 3.5, 0.0, -3.5)]
    paint = [arrow(20, 8.5)]
    built = build_vector_map([*lines, stop(50.3, 0.1, 6.9)], paint, [], LEFT)
    assert has_lane(built, 25, 5.2) and not has_lane(built, 25, 8.5)
    assert has_lane(build_vector_map(lines, paint, [], LEFT), 25, 8.5)


def test_bonnet_of_a_vehicle_before_a_stop_line_tells_no_direction():
    """A short bar right before the stop line of the whole half of the road is no line of its own."""
    lines = [line(7.0, 0, 50), line(3.5, 0, 50), line(0.0, 0, 50), line(-3.5, 0, 50), line(-7.0, 0, 50)]
    paint = [*lines, stop(50.3, 0.1, 6.9), stop(46.5, 3.6, 5.4)]
    built = build_vector_map(paint, (), [], LEFT)
    assert course(built.lanes[lane_at(built, 25, 1.7)]) == 1.0
    assert course(built.lanes[lane_at(built, 25, 5.2)]) == 1.0


def test_worn_inner_end_of_a_stop_line_still_tells_both_sides_of_a_short_arm():
    """Half of the inner lane's bar is worn; across the solid line traffic leads away, on 20 m of road too."""
    lines = [line(7.0, 0, 20), line(3.5, 0, 20), line(0.0, 0, 20), line(-3.5, 0, 20)]
    built = build_vector_map([*lines, stop(20.3, 1.9, 6.9)], (), [], LEFT)
    assert course(built.lanes[lane_at(built, 10, 1.7)]) == 1.0
    assert course(built.lanes[lane_at(built, 10, -1.7)]) == -1.0
