"""Who yields in a junction without known lights or signs."""

from __future__ import annotations

from dataclasses import replace

import pytest
import shapely

from tests.core.laid_out_roads import drive, lane_at, place
from tests.core.test_lane_movements import arms, drives, stops
from urbanmap_qgis.roadmap.lanes.right_of_way import complete_rights, rights_of_way
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

ALL = MapSettings(way_confidence=0.0)


@pytest.fixture(scope="module")
def crossing():
    """The avenue with two lanes each way across the street with one, stop lines on all arms."""
    return build_vector_map([*arms(), *stops()], (), drives(), ALL)


def way(built, x, y, turn):
    """The virtual lane of a turn from the lane at a place."""
    (number,) = [one for one in built.lanes[lane_at(built, x, y)].successors if built.lanes[one].turn == turn]
    return number


def test_the_street_waits_for_the_avenue_and_who_turns_across_for_the_oncoming(crossing):
    avenue, street = way(crossing, 30, 5.2, "straight"), way(crossing, 73.2, -40, "straight")
    across = way(crossing, 120, -1.7, "right")
    assert crossing.lanes[street].yields_to[avenue] == "fewer lanes"
    assert crossing.lanes[across].yields_to[avenue] == "turns across the oncoming traffic"
    assert avenue not in {first for lane in (avenue,) for first in crossing.lanes[lane].yields_to}
    assert not crossing.lanes[avenue].yields_to


def test_the_file_holds_only_rights_before_all_that_is_met(crossing):
    (junction,) = crossing.intersections
    assert way(crossing, 30, 5.2, "straight") in junction.yields
    for first, waiting in junction.yields.items():
        assert not crossing.lanes[first].yields_to
        assert all(first in crossing.lanes[last].yields_to for last in waiting)
        met = [other for other in junction.lanes if other not in (first, *waiting)
               and crossing.lanes[other].left != crossing.lanes[first].left
               and crossing.area(other).intersection(crossing.area(first)).area
               > 0.1 * min(crossing.area(other).area, crossing.area(first).area)]
        begin = crossing.lanes[first].centre[0]
        assert all(abs(crossing.lanes[other].centre[0] - begin).max() < 0.01 for other in met)


def test_a_finding_says_that_it_is_inferred(crossing):
    (told,) = [one for one in crossing.findings if one.kind == "right of way inferred"]
    assert "fewer lanes" in told.text and "No light or sign is known" in told.text
    (junction,) = crossing.intersections
    ring = shapely.Polygon([crossing.nodes[node][:2] for node in junction.ring])
    assert ring.contains(shapely.Point(told.x, told.y))


@pytest.mark.parametrize(("left_hand", "waits"), [(True, True), (False, False)])
def test_between_equal_roads_the_side_decides(crossing, left_hand, waits):
    """One lane of the avenue beside the street alone: the avenue's comes from the west, the street's from the south."""
    number, other = way(crossing, 30, 5.2, "straight"), way(crossing, 73.2, -40, "straight")
    alone = replace(crossing, left_hand=left_hand, lanes=[
        replace(lane, left_neighbour=-1, right_neighbour=-1, stop_lines=[], yields_to={},
                kind="virtual" if k in (number, other) else "lane") for k, lane in enumerate(crossing.lanes)])
    decided = rights_of_way(alone, [number, other])
    # Who drives north has the one from the west on his left.
    assert decided == {((other, number) if waits else (number, other)): "side it comes from"}
    assert complete_rights(alone, [number, other], decided) == ({number: [other]} if waits else {other: [number]})


def test_no_right_before_a_way_that_nothing_is_decided_for(crossing):
    """A way that no area covers is asked for nothing, but meets others all the same."""
    (junction,) = crossing.intersections
    first = next(iter(junction.yields))
    covered = [lane for lane in junction.lanes if lane != junction.yields[first][0]]
    assert first not in complete_rights(crossing, covered, rights_of_way(crossing, covered))


def test_a_road_with_stop_lines_waits_for_one_without_on_both_arms():
    through = [drive((-10, 5.2), (160, 5.2)), drive((160, -5.2), (-10, -5.2))]
    built = build_vector_map([*arms(), *stops()[2:]], (), [*drives(), *through], ALL)
    avenue, street = way(built, 30, 5.2, "straight"), way(built, 73.2, -40, "straight")
    assert built.lanes[street].yields_to[avenue] == "stop line"
    one_arm = build_vector_map([*arms(), *stops()[1:]], (), [*drives(), *through], ALL)
    avenue, street = way(one_arm, 30, 5.2, "straight"), way(one_arm, 73.2, -40, "straight")
    assert one_arm.lanes[street].yields_to[avenue] == "fewer lanes"  # the other arm's line may be worn


def test_places_of_the_street_frame_are_those_of_the_junction(crossing):
    (junction,) = crossing.intersections
    ring = shapely.Polygon([crossing.nodes[node][:2] for node in junction.ring])
    assert ring.contains(shapely.Point(place([(75, 0)])[0, :2]))
