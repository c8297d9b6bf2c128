"""What surveys and roads bring that a lane map must not answer wrongly: each becomes a finding, or is right."""

from __future__ import annotations

import numpy as np
import pyproj
import pytest
import shapely

from tests.core import laid_out_roads as roads
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.formats.lanelet_map import lanelet_elements
from urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapLine, lines_of
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

WKT = pyproj.CRS.from_epsg(6677).to_wkt()


def kinds(built):
    return {finding.kind for finding in built.findings}


def is_sound(built):
    """Whether the map's files can be written and break no rule of the validators."""
    opendrive_tree(built, WKT)
    elements, _ = lanelet_elements(built, WKT)
    return not [fault for fault in check_map(elements) if fault.severity == "error"]


def test_without_drives_paint_alone_tells_and_ways_through_junctions_are_inferred():
    lines = [*roads.avenue(0, 60), *roads.avenue(90, 150), roads.stop(60.3, 0.1, 6.9)]
    built = build_vector_map(lines, [roads.arrow(30, 5.2), roads.arrow(30, -5.2, back=True)],
                             settings=MapSettings(traffic="left"))
    assert "no drive" in kinds(built)
    assert all(lane.evidence.startswith("inferred") for lane in built.lanes if lane.kind == "virtual")
    assert {roads.course(built.lanes[roads.lane_at(built, 30, y)]) for y in (5.2, 1.7)} == {1.0}
    assert {roads.course(built.lanes[roads.lane_at(built, 30, y)]) for y in (-5.2, -1.7)} == {-1.0}
    far = [lane for lane in built.lanes if lane.centre[:, :2].mean(axis=0)[0] > roads.place([(80, 0)])[0, 0]]
    assert {lane.evidence for lane in far} <= {"beyond the junction", "beside a dashed line", "across the centre line"}
    assert {roads.course(built.lanes[roads.lane_at(built, 120, y)]) for y in (5.2, 1.7)} == {1.0}


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e308, -1e15])
def test_a_corner_that_is_no_place_is_refused_by_its_line(bad):
    sound = shapely.LineString([(0, 0, np.nan), (10, 0, np.nan)])
    damaged = shapely.from_wkb(shapely.to_wkb(shapely.LineString([(0, 0, 1), (5, bad, 1), (9, 0, 1)])))
    assert len(lines_of([sound], {"class": ["stop line"]})) == 1
    with pytest.raises(InputError, match="Line 2 "):
        lines_of([sound, damaged], {"class": ["stop line", "solid"]})


def test_a_corner_that_lies_beyond_any_road_is_refused_by_its_line():
    """Followed metre by metre it took minutes."""
    stray = shapely.LineString([(0, 0, 1), (5, 99_999_999.0, 1), (9, 0, 1)])
    with pytest.raises(InputError, match="Line 1 .*100000 km"):
        lines_of([stray], {"class": ["solid"]})


def test_drives_of_another_place_change_nothing():
    lines = roads.avenue(0, 60)
    far = DrivenPath(roads.drive((0, 5.2), (60, 5.2)).places + np.array([5000.0, 5000.0, 0.0]))
    built = build_vector_map(lines, (), [far])
    assert not built.lanes and built.left_hand is None and "no lane made" in kinds(built)


def test_drives_in_one_direction_leave_the_side_of_the_traffic_open():
    built = build_vector_map(roads.avenue(0, 60), (), [roads.drive((-10, 5.2), (70, 5.2))])
    assert built.left_hand is None
    solid = [MapLine(one.points, "solid", "white") for one in roads.avenue(0, 60)]
    alone = build_vector_map(solid, (), [roads.drive((-10, 5.2), (70, 5.2))])
    assert len(alone.lanes) == 1 and "no lane made" in kinds(alone)


def test_arrows_that_contradict_each_other_make_no_lane():
    lines = [roads.line(0.0, 0, 60), roads.line(3.5, 0, 60)]
    built = build_vector_map(lines, [roads.arrow(15, 1.7), roads.arrow(45, 1.7, back=True)])
    assert not built.lanes and {"direction contradicts", "no lane made"} <= kinds(built)


def test_arrow_against_the_drive_is_told_and_the_drive_believed():
    lines = [roads.line(0.0, 0, 60), roads.line(3.5, 0, 60)]
    areas = [roads.arrow(15, 1.7, back=True), roads.arrow(30, 1.7, back=True), roads.arrow(45, 1.7, back=True)]
    built = build_vector_map(lines, areas, [roads.drive((0, 1.7), (60, 1.7))])
    assert [roads.course(lane) for lane in built.lanes] == [1.0] and "direction contradicts" in kinds(built)


@pytest.mark.parametrize("right, told, lanes", [
    (5.2, "Drives, arrows or stop lines contradict each other about the direction here.", 3),
    (1.7, "Lanes beside each other would keep to the wrong side of the road here.", 4)])
def test_drive_against_the_traffic_is_told_and_where_drives_contradict_no_lane_is_made(right, told, lanes):
    """The outer lane is driven against the traffic, and rightly too, or its neighbour alone rightly."""
    drives = [roads.drive((-10, right), (160, right)), roads.drive((160, -5.2), (-10, -5.2)),
              roads.drive((160, 5.2), (-10, 5.2))]
    built = build_vector_map(roads.avenue(0, 150), (), drives)
    assert len(built.lanes) == lanes and is_sound(built)
    assert told in {finding.text for finding in built.findings if finding.kind == "direction contradicts"}


@pytest.mark.parametrize(("traffic", "told"), [("left", 1), ("right", 0), ("auto", 0)])
def test_one_drive_beyond_the_centre_line_is_told_where_the_side_of_the_traffic_is_known(traffic, told):
    built = build_vector_map(roads.avenue(0, 60), (), [roads.drive((70, 5.2), (-10, 5.2))],
                             MapSettings(traffic=traffic))
    assert roads.course(built.lanes[roads.lane_at(built, 30, 5.2)]) == -1.0
    assert sum("other direction's side" in finding.text for finding in built.findings) == told


def test_lanes_that_would_keep_to_the_wrong_side_are_not_inferred():
    """Both sides of a yellow line have arrows as if traffic were on the right, where drives show the left."""
    lines = [*roads.avenue(0, 60), *roads.avenue(200, 260)]
    drives = [roads.drive((200, 5.2), (260, 5.2)), roads.drive((260, -5.2), (200, -5.2))]
    built = build_vector_map(lines, [roads.arrow(30, 5.2, back=True), roads.arrow(30, -5.2)], drives)
    assert built.left_hand is True and "direction contradicts" in kinds(built)
    middle = [lane for lane in built.lanes if roads.place([(100, 0)])[0, 0] > lane.centre[:, 0].mean()]
    sides = [(lane.centre[:, :2].mean(axis=0) - [roads.EAST, roads.NORTH]) @ [-np.sin(roads.ANGLE), np.cos(roads.ANGLE)]
             for lane in middle]
    assert all(abs(side) > 3.5 for side in sides)  # those beside the centre line are not made


def test_dead_end_is_an_open_end_with_its_place():
    lines = [roads.line(0.0, 0, 40), roads.line(3.5, 0, 40)]
    built = build_vector_map(lines, (), [roads.drive((0, 1.7), (38, 1.7))])
    ends = [finding for finding in built.findings if finding.kind == "open end"]
    assert len(ends) == 2 and any(np.hypot(*(roads.place([(40, 1.75)])[0, :2] - [one.x, one.y])) < 1.0 for one in ends)
    assert is_sound(built)


def circle(radius, first=0.0, last=2 * np.pi, kind="solid"):
    turn = np.linspace(first, last, 120)
    return MapLine(roads.place(np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])), kind)


def test_roundabout_has_lanes_in_its_own_direction_that_lead_round():
    """Clockwise, as traffic on the left has it; the outer line is open at two entries."""
    lines = [circle(12.0, 0.05, 2 * np.pi - 0.05), circle(16.0, 0.2, np.pi - 0.2),
             circle(16.0, np.pi + 0.2, 2 * np.pi - 0.2)]
    turn = np.linspace(4 * np.pi, 0.0, 200)
    round_twice = DrivenPath(roads.place(np.column_stack([14 * np.cos(turn), 14 * np.sin(turn)])))
    built = build_vector_map(lines, (), [round_twice], MapSettings(traffic="left"))
    assert built.lanes and is_sound(built)
    middle = roads.place([(0, 0)])[0, :2]
    for number, lane in enumerate(built.lanes):
        across, along = lane.centre[:-1, :2] - middle, np.diff(lane.centre[:, :2], axis=0)
        assert (across[:, 0] * along[:, 1] - across[:, 1] * along[:, 0] < 0).all()
        radii = np.linalg.norm(np.vstack([built.coordinates(number, side) for side in ("left", "right")])[:, :2]
                               - middle, axis=1)
        assert radii.min() > 11.5 and radii.max() < 16.5
    length = sum(shapely.LineString(lane.centre[:, :2]).length for lane in built.lanes)
    assert length == pytest.approx(2 * np.pi * 14, rel=0.02)
    onward, seen = 0, []
    while onward not in seen:
        seen.append(onward)
        (onward,) = built.lanes[onward].successors
    assert onward == 0 and len(seen) == len(built.lanes)


def test_bridge_over_a_street_takes_the_drive_of_its_own_height():
    above = np.array([0.0, 0.0, 6.5])
    deck = [MapLine(one.points + above, one.kind) for one in (roads.line(0.0, 0, 60), roads.line(3.5, 0, 60))]
    across = [MapLine(roads.place([(x, y) for y in np.arange(-30, 31, 5.0)]), "solid") for x in (28.0, 31.5)]
    below = roads.drive((29.7, -30), (29.7, 30))
    built = build_vector_map([*deck, *across], (), [below])
    assert len(built.lanes) == 1 and np.ptp(built.lanes[0].centre[:, 2]) < 1.0
    assert built.lanes[0].centre[:, 2].max() < 12.0 and "no lane made" in kinds(built)


@pytest.mark.parametrize(("traffic", "wanted"), [("left", True), ("right", False)])
def test_side_of_the_traffic_can_be_given(traffic, wanted):
    drives = [roads.drive((-10, 5.2), (70, 5.2))]
    built = build_vector_map(roads.avenue(0, 60), (), drives, MapSettings(traffic=traffic))
    assert built.left_hand is wanted
    made = {roads.course(lane) for lane in built.lanes}
    assert made == ({1.0, -1.0} if wanted else {1.0})  # across the centre line lies the other way only to its right


def test_where_a_metre_of_width_is_missing_no_lane_is_made():
    """Roadworks leave 2.0 m for 30 m between wide parts: too little for a lane."""
    narrow = [(0, 3.5), (20, 3.5), (25, 2.0), (55, 2.0), (60, 3.5), (80, 3.5)]
    x = np.arange(0.0, 81.0, 2.5)
    edge = np.interp(x, *np.array(narrow).T)
    lines = [roads.line(0.0, 0, 80), MapLine(roads.place(np.column_stack([x, edge])), "solid")]
    built = build_vector_map(lines, (), [roads.drive((0, 1.0), (80, 1.0))])
    assert all(lane.narrowest >= 2.2 for lane in built.lanes) and len(built.lanes) == 2
    (narrow,) = [finding for finding in built.findings if finding.kind == "too narrow"]
    assert [narrow.x, narrow.y] == pytest.approx(roads.place([(40.0, 1.0)])[0, :2], abs=3.0)


def test_worn_bound_goes_on_beside_its_neighbours_and_is_told():
    """The centre line is seen for a fifth of the road: its lanes are made, and what was not seen is told."""
    lines = [roads.line(6.5, 0, 60), roads.line(3.25, 0, 60, "dashed"), roads.line(0.0, 25, 37, "solid", "yellow"),
             roads.line(-3.25, 0, 60, "dashed"), roads.line(-6.5, 0, 60)]
    drives = [roads.drive((-10, 4.9), (70, 4.9)), roads.drive((70, -4.9), (-10, -4.9))]
    built = build_vector_map(lines, (), drives)
    assert sum(lane.kind == "lane" for lane in built.lanes) == 4
    centre = [bound for bound in built.bounds if bound.colour == "yellow"]
    assert sum(bound.unseen for bound in centre) == pytest.approx(50.0, abs=3.0) and "bound not seen" in kinds(built)
    elements, _ = lanelet_elements(built, WKT)
    assert sum(float(way.tags.get("unseen", 0)) for way in elements.ways.values()) == pytest.approx(50.0, abs=3.0)
    for bound in centre:
        y = (built.bound_points(bound)[:, :2] - [roads.EAST, roads.NORTH]) @ [-np.sin(roads.ANGLE), np.cos(roads.ANGLE)]
        assert np.abs(y).max() < 0.05


def test_scrap_of_a_line_beside_the_road_makes_no_lane():
    """Dashes at the edge and ten metres of yellow beside them (paving): no lane between."""
    lines = [roads.line(3.5, 0, 60), roads.line(0.0, 0, 60, "dashed"), roads.line(-3.5, 0, 10, "solid", "yellow")]
    built = build_vector_map(lines, (), [roads.drive((-10, 1.7), (70, 1.7))])
    assert built.lanes and all(built.area(number).contains(shapely.Point(roads.place([(x, 1.75)])[0, :2]))
                               for number, x in enumerate((5.0, 40.0)))
    assert len(built.lanes) == 2 and "no lane made" in kinds(built)


def test_stop_line_in_pieces_is_one_for_all_its_lanes():
    """Two lanes towards the junction with a solid line between: the stop line has a piece for each."""
    lines = [roads.line(7.0, 0, 60), roads.line(3.5, 0, 60), roads.line(0.0, 0, 60, "solid", "yellow"),
             roads.line(-3.5, 0, 60), roads.stop(60.3, 0.1, 3.4), roads.stop(60.3, 3.6, 6.9)]
    built = build_vector_map(lines, settings=MapSettings(traffic="left"))
    wanted = {5.2: 1.0, 1.7: 1.0, -1.7: -1.0}
    assert {y: roads.course(built.lanes[roads.lane_at(built, 30, y)]) for y in wanted} == wanted
