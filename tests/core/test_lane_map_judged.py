"""Lane maps in the hands of others: the Lanelet2 library itself, with and without Autoware's rules, ASAM's checker and
SUMO take the files as they are."""

from __future__ import annotations

import subprocess

import numpy as np
import pyproj
import pytest
import shapely

from tests.core import laid_out_roads as roads
from tests.core.lane_map_judges import here, judge, loaded_by, opendrive_issues
from urbanmap_qgis.io.osm import OsmFile, OsmNode, read_osm, write_osm
from urbanmap_qgis.roadmap.formats.lanelet_map import META, lanelet_elements
from urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree, write_opendrive
from urbanmap_qgis.roadmap.map_cleaning import clean_map
from urbanmap_qgis.roadmap.map_records import Bound, MapLine, VectorMap
from urbanmap_qgis.roadmap.node_heights import fill_heights
from urbanmap_qgis.roadmap.vector_map import build_vector_map

WKT = pyproj.CRS.from_epsg(6677).to_wkt()


def lower(lines, where):
    """Lines without heights where a function of their points says so."""
    return [MapLine(np.where(where(one.points)[:, None] * [False, False, True], np.nan, one.points), one.kind,
                    one.colour, one.width, one.sigma) for one in lines]


@pytest.fixture(scope="module")
def built():
    """The avenue before and behind a junction with a stop line and a crosswalk, its far arm half without heights."""
    far = lower(roads.avenue(90, 150), lambda points: points[:, 0] > roads.place([(120, 0)])[0, 0])
    lines = [*roads.avenue(0, 60), *far, roads.stop(60.3, 0.1, 6.9), roads.stop(89.7, -6.9, -0.1)]
    drives = [roads.drive((-10, 5.2), (160, 5.2)), roads.drive((160, -5.2), (-10, -5.2))]
    return build_vector_map(lines, [roads.zebra(63, 67, -7, 7)], drives)


@pytest.fixture(scope="module", params=["lanelet2", "autoware"])
def lanelet2_file(request, built, tmp_path_factory):
    elements, coordinates = lanelet_elements(built, WKT, speed_limit=40, dialect=request.param)
    path = tmp_path_factory.mktemp("map") / "map.osm"
    write_osm(path, elements, META)
    rules = sum(one.tags["type"] == "regulatory_element" for one in elements.relations.values())
    return request.param, elements, path, coordinates.origin, len(built.lanes) + 1, rules


def test_lanelet2_itself_loads_the_map_with_every_rule(lanelet2_file):
    dialect, _, path, origin, lanelets, rules = lanelet2_file
    if dialect == "autoware":
        pytest.skip("the dialect of Autoware needs its extension, which the registry has for simple-lanelet2 only")
    assert loaded_by(judge("python"), path, origin) == [lanelets, rules, [], []]
    assert loaded_by(here(), path, origin) == [lanelets, rules, [], []]


def test_with_autowares_rules_both_dialects_load(lanelet2_file):
    _, _, path, origin, lanelets, rules = lanelet2_file
    assert rules == 4  # two stop lines, and the crosswalk for the lanes with and without a stop line before it
    assert loaded_by(here(), path, origin, "autoware") == [lanelets, rules, [], []]


def test_stop_line_stands_with_the_lanes_that_reach_the_crosswalk_behind_it(lanelet2_file):
    dialect, elements, *_ = lanelet2_file
    kind, role = ("crosswalk", "refers") if dialect == "autoware" else ("right_of_way", "yield")
    rules = [one for one in elements.relations.values() if one.tags.get("subtype") == kind
             and one.tags["type"] == "regulatory_element"]
    stops = [[number for _, number, part in one.members if part == "ref_line"] for one in rules]
    assert sorted(map(len, stops)) == [0, 1]
    assert all(any(part == role for *_, part in one.members) for one in rules)


def test_every_node_has_a_height_and_every_turn_an_area(lanelet2_file, built):
    _, elements, *_ = lanelet2_file
    assert all("ele" in node.tags for node in elements.nodes.values())
    assert all("lane_change" in way.tags for way in elements.ways.values()
               if way.tags["type"] in ("line_thin", "line_thick", "virtual", "road_border"))
    turning = [one for one in elements.relations.values() if "turn_direction" in one.tags]
    assert len(turning) == 4  # two driven ways, and those of the two inner lanes
    for one in turning:
        area = elements.ways[int(one.tags["intersection_area"])]
        assert area.tags == {"type": "intersection_area", "area": "yes"} and len(set(area.nodes)) >= 4


def test_filled_heights_lie_between_known_ones_and_say_so(built):
    heights = np.array(built.nodes)[:, 2]
    filled = np.array(sorted(built.height_sigmas))
    assert len(filled) > 4 and np.isfinite(heights).all()
    known = np.delete(heights, filled)
    assert heights[filled].min() >= known.min() - 1e-9 and heights[filled].max() <= known.max() + 1e-9
    far = max(built.height_sigmas.values())
    assert 0.4 < far < 0.8  # 30 m from the last height known, at 2 %
    assert "height filled" in {finding.kind for finding in built.findings}


def test_a_stop_line_at_the_rim_of_the_heights_has_them_where_every_lane_has():
    stop = roads.stop(60.3, 0.1, 6.9)
    end = lower([stop], lambda points: np.arange(len(points)) == len(points) - 1)
    made = build_vector_map([*roads.avenue(0, 60), *end], [], [roads.drive((-10, 5.2), (70, 5.2))])
    assert made.stop_lines and not made.height_sigmas
    elements, _ = lanelet_elements(made, WKT)
    assert all("ele" in node.tags for node in elements.nodes.values())


def test_map_without_any_height_says_so_and_has_none():
    flat = lower(roads.avenue(0, 60), lambda points: np.ones(len(points), bool))
    built = build_vector_map(flat, (), [roads.drive((-10, 5.2), (70, 5.2))])
    assert built.lanes and not built.height_sigmas and fill_heights(built) == 0
    assert "no height" in {finding.kind for finding in built.findings}
    elements, _ = lanelet_elements(built, WKT)
    assert not any("ele" in node.tags for node in elements.nodes.values())


@pytest.mark.slow
def test_asams_checker_and_sumo_read_the_opendrive_file(built, tmp_path):
    tree, _ = opendrive_tree(built, WKT, 40.0)
    write_opendrive(tmp_path / "map.xodr", tree)
    kinds = {road.find("type").get("type") for road in tree.getroot().iter("road")}
    assert kinds == {"town"} and tree.getroot().find("road/type/speed").get("max") == "40"
    assert opendrive_issues(tmp_path / "map.xodr", tmp_path) == []
    done = subprocess.run([judge("netconvert"), "--opendrive-files", str(tmp_path / "map.xodr"), "-o",
                           str(tmp_path / "net.xml")], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "Error" not in done.stderr and (tmp_path / "net.xml").is_file()


def test_nodes_that_fall_together_become_one_and_loops_go():
    places = [(0, 0, 1), (5, 0, 1), (5.006, 0, 1), (10, 0, 1), (9, 1, 1), (9.5, -1, 1), (20, 0, 1)]
    built = VectorMap([np.array(place, float) for place in places], [Bound(list(range(7)), "solid")])
    clean_map(built)
    path = shapely.LineString(built.bound_points(built.bounds[0])[:, :2])
    assert path.is_simple and len(built.nodes) == len(built.bounds[0].nodes)
    assert np.linalg.norm(np.diff(shapely.get_coordinates(path), axis=0), axis=1).min() > 0.05
    assert shapely.get_coordinates(path)[[0, -1]].tolist() == [[0, 0], [20, 0]]


def test_nodes_on_two_levels_stay_two():
    built = VectorMap([np.array(place, float) for place in [(0, 0, 0), (9, 0, 0), (0.01, 0, 6), (9, 0.01, 6)]],
                      [Bound([0, 1], "solid"), Bound([2, 3], "solid")])
    clean_map(built)
    assert len(built.nodes) == 4


def test_map_with_local_coordinates_only_is_read(tmp_path):
    inner = '<tag k="local_x" v="3.5"/><tag k="local_y" v="-2"/>'
    path = tmp_path / "map.osm"
    path.write_text(f'<osm version="0.6"><node id="7" lat="" lon="">{inner}</node></osm>', encoding="utf-8")
    node = read_osm(path).nodes[7]
    assert np.isnan([node.latitude, node.longitude]).all() and node.tags == {"local_x": "3.5", "local_y": "-2"}
    write_osm(path, OsmFile({7: OsmNode(7, float("nan"), float("nan"), node.tags)}, {}, {}))
    assert 'lat="" lon=""' in path.read_text(encoding="utf-8")
