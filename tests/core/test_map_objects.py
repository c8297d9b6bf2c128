"""Posts, signals, boards and rails in a lane map's files, and which stop line a signal governs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pyproj
import pytest
import shapely

from tests.core import laid_out_roads as roads
from tests.core import object_scene as scene
from tests.core.lane_map_judges import judge, loaded_by, opendrive_issues
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.osm import read_osm, write_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.formats.lanelet_map import META, lanelet_elements
from urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree, write_opendrive
from urbanmap_qgis.roadmap.formats.opendrive_tags import drive_faults
from urbanmap_qgis.roadmap.lanes.street_corners import cut_at_corners
from urbanmap_qgis.roadmap.map_objects import (
    LAMP,
    POLE,
    SIGN,
    SIGNAL,
    TREE,
    RoadsideObject,
    objects_of,
    rails_of,
    signals_of_stop_lines,
)
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapLine
from urbanmap_qgis.roadmap.objects.object_records import BOLLARD, DOUBTFUL, MEASURED, OTHER
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings, ObjectSettings

WKT = pyproj.CRS.from_epsg(6677).to_wkt()
AZIMUTH = 90.0 - np.degrees(roads.ANGLE)
"""Degrees, of the street's own x axis."""


def thing(kind, x, y, **more):
    """An object at a place of the street's own frame."""
    return RoadsideObject(kind, roads.place([(x, y)])[0], **more)


def signal(x, y, towards, **more):
    """A signal whose arm of 4.5 m runs across the street, to its left (1) or right (-1)."""
    azimuth = (AZIMUTH - 90.0 * towards) % 360.0
    return thing(SIGNAL, x, y, height=6.4, diameter=0.2, azimuth=azimuth, arm=(4.5, 5.4), head_height=0.9,
                 **more)


@pytest.fixture
def built():
    """The avenue before and behind a junction, a stop line on either side."""
    lines = [*roads.avenue(0, 60), *roads.avenue(90, 150), roads.stop(60.3, 0.1, 6.9), roads.stop(89.7, -6.9, -0.1)]
    drives = [roads.drive((-10, 5.2), (160, 5.2)), roads.drive((160, -5.2), (-10, -5.2))]
    return build_vector_map(lines, (), drives)


def stop_near(built, x):
    """Number of the stop line at a place along the street."""
    place = roads.place([(x, 0.0)])[0, :2]
    return int(np.argmin([np.hypot(*(stop[:, :2].mean(axis=0) - place)) for stop in built.stop_lines]))


def test_a_signal_governs_the_stop_line_whose_lanes_it_hangs_above(built):
    built.objects = [signal(62.0, 9.0, -1), signal(92.0, 9.0, -1), signal(58.0, -9.0, 1), thing(POLE, 62.0, -9.0)]
    governed, findings = signals_of_stop_lines(built)
    assert governed == {stop_near(built, 60.3): [0, 1], stop_near(built, 89.7): [2]} and not findings


@pytest.mark.parametrize("odd, why", [
    (signal(62.0, 9.0, -1, sure=False), "doubtful"),
    (thing(SIGNAL, 62.0, 9.0, height=6.0), "No arm"),
    (signal(30.0, 9.0, -1), "no lane"),  # before the stop line, far from it
    (thing(SIGNAL, 62.0, 4.5, azimuth=AZIMUTH, arm=(4.5, 5.4)), "no lane"),  # along the road
])
def test_what_the_geometry_does_not_tell_is_a_finding_and_a_pole(built, odd, why):
    built.objects = [odd]
    governed, (finding,) = signals_of_stop_lines(built)
    assert not governed and finding.kind == "signal without stop line" and why in finding.text
    assert (finding.x, finding.y) == pytest.approx(odd.foot[:2])
    ways = {way.tags["type"] for way in lanelet_elements(built, WKT)[0].ways.values()}
    assert "traffic_light" not in ways
    signals = [one.get("id") for one in opendrive_tree(built, WKT)[0].getroot().iter("signal")]
    assert signals and all(one.startswith("stop") for one in signals)


@pytest.fixture
def furnished(built):
    """The avenue with one of everything."""
    built.objects = [signal(62.0, 9.0, -1), signal(58.0, -9.0, 1), thing(LAMP, 20.0, 8.0, height=8.5, diameter=0.18),
                     thing(SIGN, 40.0, 8.0, height=2.9, diameter=0.08, azimuth=AZIMUTH + 180.0, board=(0.7, 0.8, 12.4)),
                     thing(TREE, 100.0, -8.0, height=7.0, diameter=0.25), thing(POLE, 120.0, 8.0, height=3.0)]
    rail = roads.place([(x, 7.4) for x in range(10, 31, 2)])
    built.rails = [np.column_stack([rail, np.full(len(rail), 0.8)])]
    return built


def test_lanelet2_has_poles_boards_rails_and_lights_with_their_stop_lines(furnished, tmp_path):
    elements, coordinates = lanelet_elements(furnished, WKT, 40.0)
    kinds = [way.tags["type"] for way in elements.ways.values()]
    assert [kinds.count(kind) for kind in ("pole", "traffic_sign", "guard_rail", "traffic_light")] == [5, 1, 1, 2]
    lights = [one for one in elements.relations.values() if one.tags.get("subtype") == "traffic_light"]
    assert [sorted(part for *_, part in one.members) for one in lights] == [["ref_line", "refers"]] * 2
    held = {number for one in elements.relations.values() if one.tags["type"] == "lanelet"
            for kind, number, part in one.members if part == "regulatory_element"}
    assert {number for number, one in elements.relations.items() if one in lights} <= held
    path = tmp_path / "map.osm"
    write_osm(path, elements, META)
    rules = sum(one.tags["type"] == "regulatory_element" for one in elements.relations.values())
    loaded = loaded_by(judge("python"), path, coordinates.origin)
    assert loaded == [len(furnished.lanes), rules, [], []]


def test_our_own_check_finds_nothing_new_in_it(furnished, tmp_path):
    counts = []
    for objects, rails in ((furnished.objects, furnished.rails), ([], [])):
        furnished.objects, furnished.rails = objects, rails
        path = tmp_path / f"{len(objects)}.osm"
        write_osm(path, lanelet_elements(furnished, WKT, 40.0)[0], META)
        counts.append(sorted(one.rule for one in check_map(read_osm(path)) if one.severity == "error"))
    assert counts[0] == counts[1]


def test_opendrive_has_objects_and_signals_that_asams_checker_takes(furnished, tmp_path):
    tree, notes = opendrive_tree(furnished, WKT, 40.0)
    assert not notes
    root = tree.getroot()
    assert not list(drive_faults(root))
    kinds = [one.get("type") for one in root.iter("object")]
    assert [kinds.count(kind) for kind in ("pole", "tree", "barrier")] == [5, 1, 1]
    repeated = list(root.iter("repeat"))
    assert sum(float(one.get("length")) for one in repeated) == pytest.approx(20.0, abs=0.2)
    named = {one.get("name"): one for one in root.iter("signal")}
    assert set(named) == {"stop line", "traffic light", "sign, kind unknown"}
    assert named["sign, kind unknown"].get("type") == "-1" and named["sign, kind unknown"].find("validity") is None
    assert named["traffic light"].find("dependency").get("id").startswith("stop")
    lights = [one.find("positionInertial") for one in root.iter("signal") if one.get("name") == "traffic light"]
    assert all(light is not None for light in lights)  # they hang in the junction, beyond the roads of their lanes
    origin = [float(root.find("header/offset").get(axis)) for axis in "xy"]
    heads = [[float(light.get("x")) + origin[0], float(light.get("y")) + origin[1], float(light.get("z"))]
             for light in lights]
    true = sorted(one.head.tolist() for one in furnished.objects[:2])
    assert np.array(sorted(heads)) == pytest.approx(np.array(true))
    write_opendrive(tmp_path / "map.xodr", tree)
    assert opendrive_issues(tmp_path / "map.xodr", tmp_path) == []


def test_objects_of_a_table_are_known_kinds_with_what_is_known():
    points = [shapely.Point(1, 2, 3), shapely.Point(4, 5, 6), None]
    columns = {"kind": ["signal", "bench", "pole"], "azimuth": [90.0, None, None], "arm": [4.0, None, None],
               "arm_height": [5.0, None, None], "status": ["doubtful", "measured", "measured"]}
    (found,) = objects_of(points, columns)
    assert found.kind == SIGNAL and not found.sure and np.isnan(found.height)
    assert found.head == pytest.approx([5.0, 2.0, 8.0])
    (rail,) = rails_of([shapely.LineString([(0, 0, 1), (3, 0, 1)])], {"height": [0.8]})
    assert rail.tolist() == [[0, 0, 1, 0.8], [3, 0, 1, 0.8]]


@pytest.mark.parametrize("cell", ["abc", "0x10", "いいえ"])
def test_a_value_of_an_object_or_rail_that_is_no_number_is_refused_with_its_row(cell):
    with pytest.raises(InputError, match=f"posts: “{cell}” in row 2 of the column arm is no number"):
        objects_of([shapely.Point(1, 2, 3)] * 2, {"kind": ["pole"] * 2, "arm": [None, cell]}, "posts")
    with pytest.raises(InputError, match=f"“{cell}” in row 1 of the column height is no number"):
        rails_of([shapely.LineString([(0, 0, 1), (3, 0, 1)])], {"height": [cell]})
    (found,) = objects_of([shapely.Point(1, 2, 3)], {"kind": ["pole"], "arm": [""], "height": ["6.5"]})
    assert np.isnan(found.arm[0]) and found.height == 6.5


def test_a_stop_line_of_lanes_of_two_roads_is_one_signal_that_the_second_refers_to(furnished, tmp_path):
    """Lanes that do not share their bound are roads of their own; ids of signals stand once in a file."""
    stop = stop_near(furnished, 60.3)
    first, second = (number for number, lane in enumerate(furnished.lanes) if stop in lane.stop_lines)
    lanes = furnished.lanes
    side = "left" if lanes[second].left in (lanes[first].left, lanes[first].right) else "right"
    furnished.bounds.append(furnished.bounds[getattr(lanes[second], side)])
    lanes[second] = replace(lanes[second], **{side: len(furnished.bounds) - 1})
    tree, _ = opendrive_tree(furnished, WKT, 40.0)
    root = tree.getroot()
    assert not list(drive_faults(root))
    ids = [one.get("id") for one in root.iter("signal")]
    assert len(ids) == len(set(ids))
    owners = {tag: {road.get("id") for road in root.findall("road") if any(
        one.get("id") == f"stop{stop}" for one in road.iter(tag))} for tag in ("signal", "signalReference")}
    assert [len(one) for one in owners.values()] == [1, 1] and owners["signal"] != owners["signalReference"]
    (light,) = signals_of_stop_lines(furnished)[0][stop]
    assert {one.get("id") for one in root.iter("signalReference")} == {f"stop{stop}", f"signal{light}"}
    held = [one.find("validity") for one in root.iter() if one.get("id") == f"stop{stop}" and one.tag != "dependency"]
    assert all(one.get("fromLane") == one.get("toLane") for one in held)
    write_opendrive(tmp_path / "map.xodr", tree)
    assert not opendrive_issues(tmp_path / "map.xodr", tmp_path)


# Bollards and boxes of a made-up street: where they stand, and what is none of them


def found_of(tmp_path, *makers, angle=0.0):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=30.0), angle, 1,
                             more=lambda rng: np.concatenate([make(rng) for make in makers]))
    return street_objects([tmp_path / "drive.las"], trajectory, ObjectSettings(survey_sigma=0.0)).objects


def bollard(along, across, top=0.9, lean=(0.0, 0.0)):
    return lambda rng: scene.post(rng, along, across, top, 0.14, lean=lean)


@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_bollards_stand_where_they_are(tmp_path, angle):
    true = np.array([[8.0, 5.0], [9.5, 5.0], [20.0, -6.0]])
    things = found_of(tmp_path, *(bollard(*place) for place in true), angle=angle)
    things = sorted(things, key=lambda thing: to_local(thing.foot[None], angle)[0, 0])
    assert [(thing.kind, thing.status) for thing in things] == [(BOLLARD, MEASURED)] * 3
    feet = np.array([to_local(thing.foot[None], angle)[0] for thing in things])
    assert np.abs(feet[:, :2] - true).max() < 0.04
    assert [thing.height for thing in things] == pytest.approx([0.9] * 3, abs=0.1)
    assert [thing.diameter for thing in things] == pytest.approx([0.14] * 3, abs=0.04)


def test_a_bollard_under_a_crown_is_no_trunk(tmp_path):
    things = found_of(tmp_path, bollard(15.0, 5.0), lambda rng: scene.tree(rng, 16.2, 5.0, trunk=2.4, radius=1.8))
    assert sorted(thing.kind for thing in things) == [BOLLARD, "tree"]
    found, = (one for one in things if one.kind == BOLLARD)
    assert to_local(found.foot[None], 0.0)[0, 0] == pytest.approx(15.0, abs=0.05)


def test_close_things_make_a_bollard_doubtful_unless_it_stands_in_a_row(tmp_path):
    def beside(rng):
        return scene.wall(rng, 11.0, 5.5, 1.2, 1.0)

    alone, = (one for one in found_of(tmp_path, bollard(12.0, 5.0), beside) if one.kind == BOLLARD)
    assert alone.status == DOUBTFUL and "close beside" in alone.reason
    row = [one for one in found_of(tmp_path, bollard(12.0, 5.0), bollard(13.8, 5.0), beside) if one.kind == BOLLARD]
    assert [one.status for one in row] == [MEASURED] * 2
    other = [one for one in found_of(tmp_path, bollard(12.0, 5.0), bollard(13.8, 5.0, 1.2), beside)
             if one.kind == BOLLARD]
    assert sorted(one.status for one in other) == [DOUBTFUL, MEASURED]


@pytest.mark.parametrize("make", [
    lambda rng: scene.post(rng, 15.0, 5.0, 3.0),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.45),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.9, lean=(0.5, 0.0)),
    lambda rng: scene.post(rng, 15.0, 5.0, 0.9, 0.5),
    lambda rng: np.concatenate([scene.post(rng, 15.0, 5.0, 1.3), scene.post(rng, 15.0, 5.0, 3.0, low=1.45)])],
    ids=["post", "stone", "leaning", "thick", "hidden in the middle"])
def test_what_is_no_bollard(tmp_path, make):
    assert not any(thing.kind == BOLLARD for thing in found_of(tmp_path, make))


@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_a_cabinet_is_a_box(tmp_path, angle):
    cabinet, = found_of(tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)), angle=angle)
    assert (cabinet.kind, cabinet.status, cabinet.board) == (OTHER, MEASURED, None)
    assert np.abs(to_local(cabinet.foot[None], angle)[0][:2] - [15.0, 5.5]).max() < 0.05
    assert cabinet.height == pytest.approx(1.3, abs=0.1) and cabinet.diameter == pytest.approx(0.9, abs=0.06)
    # Its longer side runs along the street.
    assert abs((cabinet.azimuth + angle + 90.0) % 180.0 - 90.0) < 4.0


def test_a_box_among_other_things_is_doubtful(tmp_path):
    """Parts of a thinly measured vehicle look like boxes."""
    boxes = [one for one in found_of(
        tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)),
        lambda rng: scene.box(rng, 16.1, 5.5, 0.65, (0.9, 0.4, 1.3))) if one.kind == OTHER]
    assert boxes and {one.status for one in boxes} == {DOUBTFUL}


def test_a_bollard_before_a_cabinet_does_not_hide_it(tmp_path):
    things = found_of(tmp_path, lambda rng: scene.box(rng, 15.0, 5.5, 0.65, (0.9, 0.4, 1.3)), bollard(15.2, 5.15, 0.8))
    assert any(thing.kind == OTHER and abs(to_local(thing.foot[None], 0.0)[0, 0] - 15.0) < 0.05 for thing in things)


@pytest.mark.parametrize("make", [
    lambda rng: scene.wall(rng, 14.0, 5.0, 1.5, 1.2),
    lambda rng: scene.box(rng, 15.0, 5.5, 0.8, (4.2, 1.7, 1.5)),
    lambda rng: scene.leaves(rng, 15.0, 5.0, 0.7, 0.6, 900.0)], ids=["wall", "car", "bush"])
def test_what_is_no_box(tmp_path, make):
    assert not any(thing.kind == OTHER for thing in found_of(tmp_path, make))


# Kerbs that turn round a corner: cut there, so that each street keeps its own lanes


def straight(start, end, kind="solid"):
    """A level line with a station each half metre."""
    length = np.hypot(*(np.array(end, float) - start))
    share = np.linspace(0.0, 1.0, int(2 * length) + 1)[:, None]
    plan = (1 - share) * np.array(start, float) + share * np.array(end, float)
    return MapLine(np.column_stack([plan, np.zeros(len(plan))]), kind)


def round_corner(radius, arms=40.0):
    """A border along the x axis that turns north with a radius."""
    angle = np.arange(0.0, 90.1, 5.0)
    arc = np.column_stack([radius * np.sin(np.radians(angle)), radius * (1.0 - np.cos(np.radians(angle)))])
    west = straight([-arms, 0.0], [0.0, 0.0], "road border").points[:-1]
    north = straight(arc[-1], [radius, radius + arms], "road border").points[1:]
    return MapLine(np.vstack([west, np.column_stack([arc, np.zeros(len(arc))]), north]), "road border")


@pytest.mark.parametrize("radius", [0.5, 3.0, 8.0])
def test_a_corner_is_cut_in_its_middle(radius):
    border = round_corner(radius)
    one, other = cut_at_corners([border])
    assert one.points[-1] == pytest.approx(other.points[0])
    middle = radius * np.array([np.sin(np.pi / 4), 1.0 - np.cos(np.pi / 4)])
    assert np.hypot(*(one.points[-1, :2] - middle)) < 1.0
    length = sum(np.hypot(*np.diff(part.points[:, :2], axis=0).T).sum() for part in (one, other))
    assert length == pytest.approx(np.hypot(*np.diff(border.points[:, :2], axis=0).T).sum())


def test_bends_of_roads_and_paint_stay_whole():
    bend, short = round_corner(40.0), straight([0.0, 0.0], [5.0, 0.0], "road border")
    paint = MapLine(round_corner(3.0).points, "solid")
    assert [id(line) for line in cut_at_corners([bend, short, paint])] == [id(bend), id(short), id(paint)]


def test_a_kerb_round_the_corner_costs_neither_street_its_lanes():
    """The side street's lines lie beside the longer arm's kerb only through the corner that both share."""
    lines = [round_corner(3.0, 60.0),
             straight([-60.0, -1.0], [-8.0, -1.0]), straight([-60.0, -4.5], [-8.0, -4.5]),
             straight([4.0, 11.0], [4.0, 60.0]), straight([7.5, 11.0], [7.5, 60.0])]
    drives = [DrivenPath(np.array([[-60.0, -2.75, 0.0], [-8.0, -2.75, 0.0]])),
              DrivenPath(np.array([[5.75, 60.0, 0.0], [5.75, 11.0, 0.0]]))]
    built = build_vector_map(lines, (), drives, MapSettings(traffic="left"))
    length = {False: 0.0, True: 0.0}
    for lane in built.lanes:
        if lane.kind == "lane":
            extent = np.ptp(lane.centre[:, :2], axis=0)
            length[bool(extent[1] > extent[0])] += float(extent.max())
    assert length[False] > 45.0 and length[True] > 42.0
