"""Ways through a junction that no drive shows: which are made, and which are not."""

from __future__ import annotations

import numpy as np
import pytest

from tests.core.laid_out_roads import arrow, avenue, drive, lane_at, path_line, place, stop, zebra
from urbanmap_qgis.roadmap.lanes.movement_confidence import ArrowStatistics
from urbanmap_qgis.roadmap.map_records import MapLine
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings


def stops():
    return [stop(60.3, 0.1, 6.9), stop(89.7, -6.9, -0.1),
            MapLine(place([(71.6, -15.0), (74.9, -15.0)]), "stop line", "white", 0.45),
            MapLine(place([(75.1, 15.0), (78.4, 15.0)]), "stop line", "white", 0.45)]


def arms():
    """An avenue with two lanes each way and a street with one, 3.5 m wide."""
    lines = [*avenue(0, 60), *avenue(90, 150)]
    for y0, y1 in ((-75.0, -15.0), (15.0, 75.0)):
        rows = np.arange(y0, y1 + 0.1, 5.0)
        lines += [path_line([(x, y) for y in rows], "solid", colour)
                  for x, colour in ((71.5, "white"), (75.0, "yellow"), (78.5, "white"))]
    return lines


def drives():
    return [drive((-10, 5.2), (50, 5.2)), drive((50, -5.2), (-10, -5.2)), drive((100, 5.2), (160, 5.2)),
            drive((160, -5.2), (100, -5.2)), drive((73.2, -80), (73.2, -30)), drive((76.8, -30), (76.8, -80)),
            drive((73.2, 30), (73.2, 80)), drive((76.8, 80), (76.8, 30))]


def ways(built, x, y):
    """Turn and the place at which it begins of all virtual lanes from the lane at a place."""
    return {(built.lanes[way].turn, built.lanes[way].successors[0])
            for way in built.lanes[lane_at(built, x, y)].successors if built.lanes[way].kind == "virtual"}


@pytest.fixture(scope="module")
def plain():
    return build_vector_map([*arms(), *stops()], (), drives())


def test_without_arrows_lanes_lead_straight_on_and_the_outermost_turn(plain):
    into_left, into_right = lane_at(plain, 73.2, 40), lane_at(plain, 76.8, -40)
    assert ways(plain, 30, 5.2) == {("straight", lane_at(plain, 120, 5.2)), ("left", into_left)}
    assert ways(plain, 30, 1.7) == {("straight", lane_at(plain, 120, 1.7)), ("right", into_right)}
    assert ways(plain, 73.2, -40) == {("straight", into_left), ("left", lane_at(plain, 30, -5.2)),
                                      ("right", lane_at(plain, 120, 1.7))}


def test_every_movement_is_told_as_inferred_and_lies_clear_of_other_lanes(plain):
    virtual = [k for k, lane in enumerate(plain.lanes) if lane.kind == "virtual"]
    assert len(virtual) == 2 * 4 + 2 * 3
    assert {plain.lanes[k].evidence for k in virtual} == {"inferred from the rule of the road"}
    for k in virtual:
        area = plain.area(k)
        assert area.is_valid
        for other, lane in enumerate(plain.lanes):
            if lane.kind == "lane":
                assert area.intersection(plain.area(other)).area < 0.06 * area.area


def test_arrows_tell_the_movements():
    arrows = [arrow(50, 5.2, "arrow left"), arrow(50, 1.7, "arrow straight")]
    built = build_vector_map([*arms(), *stops()], arrows, drives())
    assert ways(built, 30, 5.2) == {("left", lane_at(built, 73.2, 40))}
    assert ways(built, 30, 1.7) == {("straight", lane_at(built, 120, 1.7))}
    told = {built.lanes[way].evidence for y in (5.2, 1.7) for way in built.lanes[lane_at(built, 30, y)].successors}
    assert told == {"inferred from arrows"}


def possible(built):
    return [one.text for one in built.findings if one.kind == "way possible"]


def test_a_lane_without_a_known_arrow_beside_a_known_one_is_offered_straight_on_only():
    drawn = [*arms(), *stops()], [arrow(50, 1.7, "arrow straight")], drives()
    built = build_vector_map(*drawn)
    assert ways(built, 30, 5.2) == set()
    assert sum("straight on" in text for text in possible(built)) >= 1
    every = build_vector_map(*drawn, MapSettings(way_confidence=0.0))
    assert {turn for turn, _ in ways(every, 30, 5.2)} == {"straight"} and not possible(every)
    (way,) = every.lanes[lane_at(every, 30, 5.2)].successors
    assert 0.0 < every.lanes[way].confidence < 0.9


def test_an_arrow_leaves_the_lane_beyond_it_one_turn():
    built = build_vector_map([*arms(), *stops()], [arrow(50, 1.7, "arrow left")], drives())
    assert {built.lanes[way].evidence for way in built.lanes[lane_at(built, 30, 5.2)].successors} <= {
        "inferred from arrows"}
    assert "straight" not in {turn for turn, _ in ways(built, 30, 5.2)}


def test_the_one_lane_whose_arrow_is_open_leads_straight_on_where_no_other_does():
    arrows = [arrow(50, 5.2, "arrow left"), arrow(50, 1.7, "arrow, kind unknown")]
    built = build_vector_map([*arms(), *stops()], arrows, drives())
    assert ways(built, 30, 1.7) == {("straight", lane_at(built, 120, 1.7))}
    (way,) = built.lanes[lane_at(built, 30, 1.7)].successors
    assert built.lanes[way].evidence == "inferred from the rule of the road"
    assert 0.9 < built.lanes[way].confidence < 0.98
    ends = build_vector_map([line for line in [*arms(), *stops()] if line.points[:, 0].max() < place([(85.0, 0.0)])[
        0, 0]], arrows, drives())
    assert not ways(ends, 30, 1.7)


def test_where_most_lanes_have_arrows_one_without_is_not_trusted():
    few, many = ArrowStatistics(20, 0), ArrowStatistics(20, 12, {"only": 6}, {("only", "straight"): 3})
    assert few.painted() < 0.1 and many.painted() > 0.9
    assert 0.3 < many.by_arrows("only", "straight") < 0.6
    assert many.by_arrows("only", "straight") < ArrowStatistics(
        90, 60, {"only": 60}, {("only", "straight"): 30}).by_arrows("only", "straight") < 0.52


def test_without_a_sign_of_a_junction_no_way_is_made():
    built = build_vector_map(arms(), (), drives())
    assert not [lane for lane in built.lanes if lane.kind == "virtual"]


def test_only_driven_ways_where_asked():
    built = build_vector_map([*arms(), *stops()], (), [*drives(), drive((-10, 5.2), (160, 5.2))],
                             MapSettings(infer_ways=False))
    assert [lane.evidence for lane in built.lanes if lane.kind == "virtual"] == ["drive"]


def test_a_driven_way_stays_driven():
    built = build_vector_map([*arms(), *stops()], (), [*drives(), drive((-10, 5.2), (160, 5.2))])
    (straight,) = [built.lanes[way] for way in built.lanes[lane_at(built, 30, 5.2)].successors
                   if built.lanes[way].turn == "straight"]
    assert straight.evidence == "drive"


def test_crosswalk_ahead_is_a_junction_too():
    built = build_vector_map(arms(), [zebra(63, 67, -7, 7)], drives(), MapSettings(way_confidence=0.0))
    assert ways(built, 30, 5.2) and not ways(built, 120, -5.2)
