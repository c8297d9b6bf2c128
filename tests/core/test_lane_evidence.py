"""Lanes of short arms, between symbols, and beyond junctions: what shows them, and what does not."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.laid_out_roads import arrow, avenue, course, drive, lane_at, line, path_line, place, stop
from urbanmap_qgis.roadmap.lanes.bound_continuation import continued
from urbanmap_qgis.roadmap.lanes.road_sections import Axis, BoundTrack
from urbanmap_qgis.roadmap.lanes.section_preparation import prepared_sections
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

LEFT = MapSettings(traffic="left")


def plain_lanes(built):
    return [lane for lane in built.lanes if lane.kind == "lane"]


def length(built):
    return sum(shapely.LineString(lane.centre[:, :2]).length for lane in plain_lanes(built))


def has_lane(built, x, y):
    where = shapely.Point(place([(x, y)])[0, :2])
    return any(built.area(number).contains(where) for number in range(len(built.lanes)))


def street(x0, x1, centre="yellow"):
    """One lane each way."""
    return [line(3.5, x0, x1), line(0.0, x0, x1, "solid", centre), line(-3.5, x0, x1)]


def test_row_of_symbols_between_two_lines_makes_no_bound():
    """A worn row of symbols was taken for a line as long as the road's own, but a third of it is painted."""
    symbols = line(2.2, 10, 40, confidence=0.35)
    built = build_vector_map([*street(0, 50), symbols], (), [drive((0, 1.7), (50, 1.7))], LEFT)
    (lane,) = [lane for lane in plain_lanes(built) if lane.evidence == "drive"]
    assert lane.width == pytest.approx(3.5, abs=0.05)
    assert shapely.LineString(lane.centre[:, :2]).length == pytest.approx(50.0, abs=1.0)


def test_two_parts_of_one_line_that_overlap_are_one_bound():
    lines = [line(3.5, 0, 50), line(0.0, 0, 35, "solid", "yellow"), line(0.02, 20, 50, "solid", "yellow")]
    built = build_vector_map(lines, (), [drive((0, 1.7), (50, 1.7))], LEFT)
    assert length(built) == pytest.approx(50.0, abs=1.0)


def test_short_arm_with_a_stop_line_has_lanes():
    """16 m of a road before a junction: its begins and ends lie so near that they were one cross-section."""
    built = build_vector_map([*street(0, 16), stop(16.3, 0.1, 3.4)], (), [], LEFT)
    assert sorted(course(lane) for lane in plain_lanes(built)) == [-1.0, 1.0]
    assert course(built.lanes[lane_at(built, 8, 1.7)]) == 1.0
    for lane in plain_lanes(built):
        assert shapely.LineString(lane.centre[:, :2]).length == pytest.approx(16.0, abs=1.0)


def test_short_strip_with_an_arrow_alone_stays_a_finding():
    built = build_vector_map(street(0, 16), [arrow(8, 1.7)], [], LEFT)
    assert not plain_lanes(built)


def test_stop_line_that_ends_at_a_dashed_line_of_two_strips_parts_the_directions():
    """The middle line is dashed, or worn so: the strip across it is no second lane of the same direction."""
    lines = [line(3.5, 0, 50), line(0.0, 0, 50, "dashed"), line(-3.5, 0, 50)]
    built = build_vector_map([*lines, stop(50.3, 0.1, 3.4)], (), [], LEFT)
    assert course(built.lanes[lane_at(built, 25, 1.7)]) == 1.0
    assert course(built.lanes[lane_at(built, 25, -1.7)]) == -1.0


def test_stop_line_in_the_middle_of_a_road_is_a_part_of_a_symbol():
    lines = [*avenue(0, 80), stop(40, 3.6, 6.9)]
    driven = [drive((80, 1.7), (0, 1.7))]
    built = build_vector_map(lines, (), driven, MapSettings(traffic="right"))
    lane = built.lanes[lane_at(built, 20, 5.2)]
    assert lane.evidence == "beside a dashed line" and course(lane) == -1.0
    assert shapely.LineString(lane.centre[:, :2]).length == pytest.approx(80.0, abs=1.5)


def test_edge_of_a_vehicle_beside_the_lanes_stops_none():
    """It was taken for a stop line, 5 m before the true one, from the edge line outwards: lanes ended there."""
    lines = [*street(0, 50), line(-7.0, 0, 50)]
    driven = [drive((0, 1.7), (50, 1.7))]
    for beside in (), (stop(45.0, 3.4, 5.6),), (stop(45.0, 3.4, 4.2), stop(45.0, 4.5, 5.6)):
        built = build_vector_map([*lines, stop(50.2, 0.1, 3.4), *beside], (), driven, LEFT)
        lane = built.lanes[lane_at(built, 25, 1.7)]
        assert shapely.LineString(lane.centre[:, :2]).length == pytest.approx(50.2, abs=1.0)


def test_road_beyond_the_junction_tells_directions():
    """The arm at 80 to 130 m was not driven and has neither arrows nor stop lines."""
    near = [drive((0, 1.7), (50, 1.7)), drive((50, -1.7), (0, -1.7))]
    built = build_vector_map([*street(0, 50, "white"), *street(80, 130, "white")], (), near)
    for y, along in ((1.7, 1.0), (-1.7, -1.0)):
        lane = built.lanes[lane_at(built, 105, y)]
        assert course(lane) == along and lane.evidence == "beyond the junction"


def test_road_beyond_the_junction_tells_nothing_where_its_middle_is_displaced():
    moved = [line(y, 80, 130) for y in (5.5, 2.0, -1.5)]
    near = [drive((0, 1.7), (50, 1.7)), drive((50, -1.7), (0, -1.7))]
    built = build_vector_map([*street(0, 50, "white"), *moved], (), near)
    assert not has_lane(built, 105, 3.7)


def test_only_strips_in_the_course_of_a_lane_take_its_direction():
    """A guiding strip on the pavement, 3.5 m beside the road, leaves a strip of lane width: no lane."""
    near = [drive((0, 1.7), (50, 1.7)), drive((50, -1.7), (0, -1.7))]
    built = build_vector_map([*street(0, 50), *street(80, 130), line(7.0, 80, 130)], (), near)
    assert len([lane for lane in plain_lanes(built) if lane.evidence == "beyond the junction"]) == 2


def test_bound_between_two_others_goes_on_from_five_metres():
    lines = [line(3.5, 0, 20), line(-3.5, 0, 20), path_line([(6, 0), (12, 0)], "solid", "yellow")]
    built = build_vector_map(lines, (), [drive((0, 1.7), (20, 1.7))], LEFT)
    assert len(plain_lanes(built)) == 2
    assert max(bound.unseen for bound in built.bounds) == pytest.approx(14.0, abs=2.0)


@pytest.mark.parametrize(("seen", "to"), [(12, 36), (8, 24), (4, 4)])
def test_outermost_bound_goes_on_by_twice_what_is_seen(seen, to):
    """It lies beside the middle line; what is seen over less than 5 m shows no course."""
    edge = path_line([(x, 3.5) for x in range(0, seen + 1, 2)])
    lines = [line(0.0, 0, 60, "solid", "yellow"), edge, line(-3.5, 0, 60)]
    (section, _stops), = prepared_sections(lines, (), LEFT)
    ends = sorted(track.end - track.start for track in section.tracks)
    assert ends[0] == pytest.approx(to, abs=0.6) and ends[-1] == pytest.approx(60.0, abs=0.6)


@pytest.mark.parametrize("seed", range(20))
def test_bound_far_from_an_uneven_axis_goes_on_without_turning_back(seed):
    """The axis wavers by 0.1 m; 12 m away its cross-sections meet."""
    along = np.arange(0.0, 81.0, 2.0)
    axis = Axis(np.column_stack([along, np.random.default_rng(seed).normal(0.0, 0.1, len(along))]))
    tracks = []
    for across, start in ((12.0, 40), (8.5, 0)):
        points = np.array([[x, across, 0.0] for x in range(start, 81)])
        chainage, offset = axis.local(points[:, :2])
        rows = np.flatnonzero(chainage > np.append(-1.0, np.maximum.accumulate(chainage)[:-1]))
        piece = (chainage[0], chainage[-1], line(across, start, 80))
        tracks.append(BoundTrack(points[rows], chainage[rows], offset[rows], [piece]))
    edge = max(continued(tracks, axis, (), LEFT), key=lambda track: np.median(track.offset))
    assert edge.points[0, 0] < 20.0 and (np.diff(edge.points[:, 0]) > 0.0).all()


def test_long_gap_is_bridged_at_a_constant_distance_to_the_axis():
    """Both parts are short and end a little askew: their prolongations miss each other by more than the bound's."""
    lean = np.array([0.0, 0.015])
    parts = [line(3.5, 0, 12), line(3.5, 38, 50)]
    askew = [type(one)(one.points + np.column_stack([0 * one.points[:, 0], np.linspace(*lean * side, len(one.points))
                                                     * 10, 0 * one.points[:, 0]]), one.kind)
             for one, side in zip(parts, (1, 1))]
    built = build_vector_map([line(0.0, 0, 50), *askew], (), [drive((0, 1.7), (50, 1.7))], LEFT)
    assert length(built) == pytest.approx(50.0, abs=1.5)


def test_strip_between_the_edge_line_and_a_guiding_strip_is_the_pavement():
    """A mark on it looks like an arrow; the same strip up to a white line is a lane."""
    driven = [drive((0, 1.7), (50, 1.7)), drive((50, -1.7), (0, -1.7))]
    pavement = build_vector_map([*street(0, 50), line(7.8, 0, 50, "solid", "yellow")], [arrow(25, 5.6)], driven, LEFT)
    assert not has_lane(pavement, 40, 5.6)
    lane = build_vector_map([*street(0, 50), line(7.8, 0, 50)], [arrow(25, 5.6)], driven, LEFT)
    assert course(lane.lanes[lane_at(lane, 40, 5.6)]) == 1.0


def test_pavement_takes_no_direction_from_beyond_the_junction():
    near = [drive((0, 1.7), (50, 1.7)), drive((50, -1.7), (0, -1.7)), drive((0, 5.6), (50, 5.6))]
    lines = [*street(0, 50), line(7.8, 0, 50), *street(80, 130), line(7.8, 80, 130, "solid", "")]
    built = build_vector_map(lines, (), near)
    assert has_lane(built, 105, 1.7) and not has_lane(built, 105, 5.6)
