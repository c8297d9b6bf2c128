"""OpenDRIVE files, read back by a reader of the tests and compared with the lanes they were made of."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pyproj
import pytest
import shapely

from tests.core import laid_out_roads as roads
from tests.core import opendrive_reader as reader
from tests.core.lane_map_judges import JUDGES
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree, write_opendrive
from urbanmap_qgis.roadmap.formats.opendrive_tags import DriveNode, drive_faults
from urbanmap_qgis.roadmap.formats.plan_view import along_plan, fit_plan_view, fit_profile, plan_length
from urbanmap_qgis.roadmap.formats.road_layout import (
    LaneRoad,
    RoadLayout,
    bounds_along_ways,
    road_layout,
    with_straight_ends,
)
from urbanmap_qgis.roadmap.map_records import Bound, DrivenPath, MapLine, VectorMap
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

WKT = pyproj.CRS.from_epsg(6677).to_wkt()
CLOSE = 0.05  # m


def built_crossing(mirrored=False, settings=None):
    """The avenue before and behind a junction, driven both ways; mirrored for traffic on the right."""
    sign = -1.0 if mirrored else 1.0
    lines = [*roads.avenue(0, 60), *roads.avenue(90, 150), roads.stop(60.3, sign * 0.1, sign * 6.9)]
    drives = [roads.drive((-10, sign * 5.2), (160, sign * 5.2)), roads.drive((160, -sign * 5.2), (-10, -sign * 5.2))]
    return build_vector_map(lines, [roads.zebra(63, 67, -7, 7)], drives, settings=settings)


def built_bend():
    """A road of two lanes each way that bends by 70 degrees with its heights, and goes straight on."""
    turn = np.linspace(0.0, 1.2, 60)

    def bent(radius):
        arc = np.column_stack([radius * np.sin(turn), 40.0 - radius * np.cos(turn)])
        ahead = arc[-1] + np.arange(1.0, 30.0, 3.0)[:, None] * [np.cos(1.2), np.sin(1.2)]
        return roads.place(np.vstack([arc, ahead]))

    lines = [MapLine(bent(r), kind, "yellow" if r == 40.0 else "white") for r, kind in (
        (33.5, "solid"), (36.75, "dashed"), (40.0, "solid"), (43.25, "dashed"), (46.5, "solid"))]
    return build_vector_map(lines, (), [DrivenPath(bent(35.0)), DrivenPath(bent(45.0)[::-1])])


MAPS = {"crossing": built_crossing, "right-hand": lambda: built_crossing(True), "bend": built_bend}


@pytest.fixture(scope="module", params=MAPS)
def case(request, tmp_path_factory):
    """A map and its file, read back."""
    built = bounds_along_ways(MAPS[request.param]())
    path = tmp_path_factory.mktemp("map") / "map.xodr"
    tree, notes = opendrive_tree(built, WKT, 50.0)
    assert not notes
    write_opendrive(path, tree)
    return built, path, *reader.read_roads(path)


def test_files_are_as_their_tags_are_declared(case):
    assert list(drive_faults(ET.parse(case[1]).getroot())) == []


def test_tags_that_are_not_as_declared_are_named():
    root = DriveNode(("OpenDRIVE",), {})
    road = root.add("road", length=-1.0, id=1, junction=-1, rule="middle")
    road.add("link").add("predecessor", elementType="road")
    lane = road.add("lanes").add("laneSection").add("left").add("lane", id=1, type="driving")
    lane.add("link").add("predecessor", id=2)
    lane.add("width", sOffset=0.0, a=float("nan"), b=0.0, c=0.0, d=0.0)
    assert sorted(drive_faults(root)) == [
        "OpenDRIVE/road/lanes/laneSection/left/lane/width: a is nan",
        "OpenDRIVE/road/link/predecessor: elementId is missing",
        "OpenDRIVE/road: length is -1",
        "OpenDRIVE/road: rule is middle"]
    with pytest.raises(KeyError):
        road.add("bridge")
    with pytest.raises(KeyError):
        lane.add("speed", min=3.0)


def offset_of(root):
    header = root.find("header/offset")
    return np.array([float(header.get("x")), float(header.get("y"))])


def test_axes_and_borders_lie_on_the_bounds_of_the_lanes(case):
    built, _, root, read = case
    layout = road_layout(built)
    assert sorted(lane for road in layout.roads for lane in road.lanes) == list(range(len(built.lanes)))
    for number, road in enumerate(layout.roads):
        written = read[str(number + 1)]
        for place, bound in enumerate(road.bounds):
            lane = place - road.axis
            truth = shapely.LineString(built.bound_points(built.bounds[bound])[:, :2] - offset_of(root))
            s = np.linspace(0.0, written.length, 41)
            places = np.array([written.border(lane, one) for one in s])
            assert shapely.distance(shapely.points(places), truth).max() < CLOSE
            back = shapely.points(shapely.get_coordinates(truth))
            assert shapely.distance(back, shapely.LineString(places)).max() < CLOSE


def test_heights_are_those_of_the_axis(case):
    built, _, _, read = case
    for number, road in enumerate(road_layout(built).roads):
        axis = built.bound_points(built.bounds[road.bounds[road.axis]])
        written = read[str(number + 1)]
        assert written.height(0.0) == pytest.approx(axis[0, 2], abs=0.02)
        assert written.height(written.length) == pytest.approx(axis[-1, 2], abs=0.02)


def test_sides_of_the_lanes_follow_the_rule_of_the_road(case):
    built, _, _, read = case
    assert built.left_hand is not None
    for number, road in enumerate(road_layout(built).roads):
        written = read[str(number + 1)]
        assert written.element.get("rule") == ("LHT" if built.left_hand else "RHT")
        for place, lane in enumerate(road.lanes):
            identifier = road.lane_id(place)
            along = (identifier > 0) == built.left_hand  # what the format says of this lane's direction
            _x, _y, heading = written.axis(written.length / 2)
            chord = built.lanes[lane].centre[-1, :2] - built.lanes[lane].centre[0, :2]
            assert (chord @ [np.cos(heading), np.sin(heading)] > 0) == along


def test_linked_lanes_meet_and_all_successors_are_in_the_file(case):
    built, _, root, read = case
    assert reader.widest_gap(root, read) < 0.01
    layout = road_layout(built)
    for number, lane in enumerate(built.lanes):
        road, place = layout.of_lane[number]
        for follower in lane.successors:
            other, at = layout.of_lane[follower]
            ids = layout.roads[road].lane_id(place), layout.roads[other].lane_id(at)
            if layout.roads[other].junction >= 0:
                linked = {(one.get("incomingRoad"), link.get("from"), one.get("connectingRoad"), link.get("to"))
                          for one in root.iter("connection") for link in one.iter("laneLink")}
                assert (str(road + 1), str(ids[0]), str(other + 1), str(ids[1])) in linked
            else:
                kind = "successor" if layout.roads[road].ahead[place] else "predecessor"
                assert read[str(road + 1)].lanes[ids[0]].find(f"link/{kind}").get("id") == str(ids[1])


def test_file_is_valid_by_the_schema_of_the_standard(case):
    etree = pytest.importorskip("lxml.etree", reason="lxml is not installed")
    schema = next(JUDGES.parent.glob("lib/python*/site-packages/qc_opendrive/schema/1.7.0/opendrive_17_core.xsd"), None)
    if schema is None:
        pytest.skip("asam-qc-opendrive, which brings the schema, is not installed; run: make judges")
    etree.XMLSchema(etree.parse(str(schema))).assertValid(etree.parse(str(case[1])))


def test_header_tells_where_the_map_lies_and_marks_what_is_painted(tmp_path):
    built = built_crossing()
    tree, _ = opendrive_tree(built, WKT, 50.0)
    root = tree.getroot()
    header = root.find("header")
    assert (header.get("revMajor"), header.get("revMinor")) == ("1", "7")
    reference = pyproj.CRS.from_user_input(header.find("geoReference").text)
    assert reference.is_projected and reference.to_dict()["lat_0"] == 36
    low = np.array(built.nodes)[:, :2].min(axis=0)
    assert (low - offset_of(root) >= 0).all() and (low - offset_of(root) < 100).all()
    marks = {(mark.get("type"), mark.get("color")) for mark in root.iter("roadMark")}
    assert marks == {("solid", "white"), ("solid", "yellow"), ("broken", "white"), ("none", "standard")}
    (signal,) = root.iter("signal")
    assert (signal.get("type"), signal.get("orientation")) == ("294", "+")
    assert float(signal.get("width")) == pytest.approx(6.8, abs=0.01)
    validity = signal.find("validity")
    assert sorted(map(int, (validity.get("fromLane"), validity.get("toLane")))) == [1, 2]
    (walk,) = root.iter("object")
    assert walk.get("type") == "crosswalk" and len(list(walk.iter("cornerLocal"))) == 4
    assert {float(one.get("max")) for one in root.iter("speed")} == {50.0}


def test_crosswalk_corners_come_back_where_they_were():
    built = built_crossing()
    tree, _ = opendrive_tree(built, WKT)
    root = tree.getroot()
    element = next(road for road in root.findall("road") if road.find("objects") is not None)
    (section,) = element.iter("laneSection")
    read = reader.ReadRoad(element, {int(lane.get("id")): lane for lane in section.iter("lane")})
    walk = element.find("objects/object")
    x, y, heading = read.axis(float(walk.get("s")))
    t = float(walk.get("t"))
    base = np.array([x - t * np.sin(heading), y + t * np.cos(heading)]) + offset_of(root)
    turned = np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])
    corners = np.array([[float(c.get("u")), float(c.get("v"))] for c in walk.iter("cornerLocal")]) @ turned + base
    truth = shapely.get_coordinates(built.crosswalks[0].polygon.exterior)[:-1, :2]
    assert np.abs(corners - truth).max() < 0.02


def test_opposite_ways_share_a_bound_that_opendrive_has_in_the_direction_of_each():
    built = built_crossing()
    ways = [number for number, lane in enumerate(built.lanes) if lane.kind == "virtual"]
    sides = [{built.lanes[number].left, built.lanes[number].right} for number in ways]
    turned = [number for number in ways if not (built.lanes[number].left_forward and built.lanes[number].right_forward)]
    assert len(turned) == 1 and sum(bool(one & other) for one in sides for other in sides if one is not other) // 2 == 3
    along = bounds_along_ways(built)
    for number in ways:
        assert along.lanes[number].left_forward and along.lanes[number].right_forward
        for side in ("left", "right"):
            assert np.array_equal(along.coordinates(number, side), built.coordinates(number, side))


def test_roads_with_a_skew_end_meet_those_of_the_junction_without_a_gap(tmp_path):
    built = built_crossing()
    road = next(one for one in road_layout(built).roads if one.behind and one.behind[0] == "junction"
                and len(one.lanes) > 1)
    nearest = built.bounds[road.bounds[1]].nodes[-1]
    built.nodes[nearest] = built.nodes[nearest] + [*(0.4 * np.array([np.cos(roads.ANGLE), np.sin(roads.ANGLE)])), 0.0]
    write_opendrive(tmp_path / "map.xodr", opendrive_tree(built, WKT)[0])
    root, read = reader.read_roads(tmp_path / "map.xodr")
    assert reader.widest_gap(root, read) < 0.01
    plain = with_straight_ends(built, road_layout(built))
    moved = np.linalg.norm(np.array(plain.nodes) - np.array(built.nodes), axis=1)
    assert moved[nearest] == pytest.approx(0.4, abs=0.02) and moved[[k for k in range(len(moved)) if k != nearest]].max(
        ) < 0.02


def test_ends_of_roads_that_hang_on_each_other_lie_on_one_line():
    """The outermost node of three lanes is an inner one of the two lanes that go on beside them."""
    ends = [(0.0, 0.0), (0.2, 3.0), (-0.1, 6.0), (0.5, 9.0), (0.0, 12.0)]
    nodes = [np.array([x, y, 1.0]) for x, y in ends]
    nodes += [np.array([-20.0, y, 1.0]) for _, y in ends] + [np.array([20.0, y, 1.0]) for _, y in ends]
    bounds = [Bound([5 + k, k], "solid") for k in range(4)] + [Bound([k, 10 + k], "solid") for k in (2, 3, 4)]
    built = VectorMap(nodes=nodes, bounds=bounds, lanes=[])
    layout = RoadLayout([LaneRoad([0, 1, 2], [0, 1, 2, 3], 0, [True] * 3),
                         LaneRoad([3, 4], [4, 5, 6], 0, [True] * 2)], {})
    made = np.array(with_straight_ends(built, layout).nodes)
    assert np.abs(made[:5, 0]).max() < 0.001  # the two that nothing moves say where the line is
    assert np.array_equal(made[:5, 1], np.array(ends)[:, 1])


def test_junctions_hold_the_ways_that_were_driven():
    root = opendrive_tree(built_crossing(settings=MapSettings(infer_ways=False)), WKT)[0].getroot()
    assert len(root.findall("junction")) == 1 and len(list(root.iter("connection"))) == 2
    connecting = [road for road in root.findall("road") if road.get("junction") != "-1"]
    assert len(connecting) == 2
    for road in connecting:
        assert {end.get("elementType") for end in road.find("link")} == {"road"} and len(road.find("link")) == 2


def test_heights_that_are_unknown_are_left_out():
    lines = [MapLine(np.column_stack([one.points[:, :2], np.full(len(one.points), np.nan)]), one.kind, one.colour)
             for one in roads.avenue(0, 60)]
    built = build_vector_map(lines, (), [roads.drive((-10, 5.2), (70, 5.2))], MapSettings(traffic="left"))
    root = opendrive_tree(built, WKT)[0].getroot()
    assert built.lanes and not list(root.iter("elevation"))
    assert "nan" not in " ".join(value for element in root.iter() for value in element.attrib.values())


def test_plan_of_line_arc_and_curve_is_told_as_such():
    straight = np.column_stack([np.arange(0.0, 50.0, 5.0), np.zeros(10)])
    assert [one.kind for one in fit_plan_view(straight)] == ["line"]
    turn = np.linspace(0.0, 1.0, 80)
    circle = np.column_stack([30 * np.sin(turn), 30 * (1 - np.cos(turn))])
    (arc,) = fit_plan_view(circle)
    assert arc.kind == "arc" and arc.curvature == pytest.approx(1 / 30.0, rel=0.01)
    wave = np.column_stack([np.arange(0.0, 60.0), 3.0 * np.sin(np.arange(0.0, 60.0) / 9.0)])
    elements = fit_plan_view(wave)
    assert {one.kind for one in elements} >= {"cubic"}
    places, heading = along_plan(elements, np.linspace(0.0, plan_length(elements), 500))
    assert shapely.distance(shapely.points(places), shapely.LineString(wave)).max() < 0.03
    assert np.abs(np.diff(np.unwrap(heading))).max() < 0.02  # no kink
    assert plan_length(elements) == pytest.approx(shapely.LineString(places).length, abs=0.01)


def test_profile_keeps_its_ends_and_its_tolerance():
    s = np.linspace(0.0, 40.0, 81)
    values = 3.0 + 0.2 * np.sin(s / 5.0)
    pieces = fit_profile(s, values, 0.005)
    held = []
    for one in s:
        piece = [p for p in pieces if p.s <= one + 1e-9][-1]
        ds = one - piece.s
        held.append(piece.a + ds * (piece.b + ds * (piece.c + ds * piece.d)))
    assert np.abs(np.array(held) - values).max() <= 0.006
    assert held[0] == values[0] and held[-1] == pytest.approx(values[-1])
    assert len(fit_profile(s, np.full(81, 3.0))) == 1


def test_plane_without_a_proj_string_is_refused():
    local = pyproj.CRS.from_wkt('LOCAL_CS["site",UNIT["metre",1]]').to_wkt()
    with pytest.raises(InputError, match="PROJ"):
        opendrive_tree(built_crossing(), local)
