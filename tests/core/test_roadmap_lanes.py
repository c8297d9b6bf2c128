"""Lanes from lines and drives that are laid out here, and what Lanelet2 says of the file."""

from __future__ import annotations

import numpy as np
import pyproj
import pytest
import shapely

from tests.core.laid_out_roads import ANGLE, EAST, NORTH, avenue, drive, lane_at, line, place
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.osm import read_osm, write_osm
from urbanmap_qgis.roadmap.formats.lanelet_map import META, lanelet_elements
from urbanmap_qgis.roadmap.formats.map_projection import map_coordinates, write_projector
from urbanmap_qgis.roadmap.lanes.road_axes import axes_of
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapArea, MapLine, areas_of, lines_of
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

WKT = pyproj.CRS.from_epsg(6677).to_wkt()


def stop(x, y0, y1):
    return MapLine(place([(x, y0), (x, y1)]), "stop line", "white", 0.45)


@pytest.fixture(scope="module")
def crossing():
    """The avenue before and behind a junction, both directions driven in the kerb lanes (traffic on the left)."""
    lines = [*avenue(0, 60), *avenue(90, 150), stop(60.3, 0.1, 6.9), stop(89.7, -6.9, -0.1)]
    zebra = MapArea(shapely.Polygon(place([(63, -7), (67, -7), (67, 7), (63, 7)])), "crosswalk",
                    place([(1, 0)])[0, :2] - place([(0, 0)])[0, :2])
    drives = [drive((-10, 5.2), (160, 5.2)), drive((160, -5.2), (-10, -5.2))]
    return build_vector_map(lines, [zebra], drives)


def kerb_lane(built, x, y):
    where = shapely.Point(place([(x, y)])[0, :2])
    (number,) = [k for k in range(len(built.lanes)) if built.area(k).contains(where)]
    return number


def course(lane):
    """1 where a lane runs along the street's frame, -1 against it."""
    chord = lane.centre[-1, :2] - lane.centre[0, :2]
    return float(np.sign(chord @ [np.cos(ANGLE), np.sin(ANGLE)]))


def test_all_lanes_have_bounds_widths_and_the_direction_that_drives_show(crossing):
    lanes = [lane for lane in crossing.lanes if lane.kind == "lane"]
    assert len(lanes) == 8 and crossing.left_hand is True
    for number, lane in enumerate(crossing.lanes[:8]):
        y = (lane.centre[:, :2] - [EAST, NORTH]) @ [-np.sin(ANGLE), np.cos(ANGLE)]
        assert lane.width == pytest.approx(3.5, abs=1e-3)
        assert course(lane) == (1.0 if y.mean() > 0 else -1.0)
        left, right = crossing.coordinates(number, "left"), crossing.coordinates(number, "right")
        ahead = lane.centre[-1, :2] - lane.centre[0, :2]
        across = left[0, :2] - right[0, :2]
        assert ahead[0] * across[1] - ahead[1] * across[0] > 0


def test_neighbours_share_their_bound_and_opposite_lanes_the_centre_line(crossing):
    outer, inner = kerb_lane(crossing, 30, 5.2), kerb_lane(crossing, 30, 1.7)
    across = kerb_lane(crossing, 30, -1.7)
    lanes = crossing.lanes
    assert lanes[outer].right_neighbour == inner and lanes[inner].left_neighbour == outer
    assert lanes[outer].right == lanes[inner].left and lanes[outer].left_neighbour == -1
    assert lanes[inner].opposite == across and lanes[inner].right == lanes[across].right


def test_drive_makes_a_virtual_lane_through_the_junction(crossing):
    virtual = [lane for lane in crossing.lanes if lane.kind == "virtual" and lane.evidence == "drive"]
    assert len(virtual) == 2 and {lane.turn for lane in virtual} == {"straight"}
    before, behind = kerb_lane(crossing, 30, 5.2), kerb_lane(crossing, 120, 5.2)
    (through,) = crossing.lanes[before].successors
    assert crossing.lanes[through].successors == [behind]
    assert np.allclose(crossing.coordinates(through, "left")[0], crossing.coordinates(before, "left")[-1])
    assert np.allclose(crossing.coordinates(through, "right")[-1], crossing.coordinates(behind, "right")[0])
    open_ends = [finding for finding in crossing.findings if finding.kind == "open end"]
    assert len(open_ends) == 8  # only at the outer ends: inner lanes are connected by the rule of the road


def test_stop_line_and_crosswalk_are_referred_to(crossing):
    outer = crossing.lanes[kerb_lane(crossing, 30, 5.2)]
    assert len(outer.stop_lines) == 1
    (through,) = outer.successors
    assert crossing.lanes[through].crosswalks == [0] and not outer.crosswalks
    assert not [finding for finding in crossing.findings if finding.kind == "stop line without lane"]


def test_strip_without_evidence_is_a_finding_and_no_lane():
    built = build_vector_map([line(0.0, 0, 50), line(3.0, 0, 50)])
    assert not built.lanes
    assert {finding.kind for finding in built.findings} == {"no lane made", "no drive"}
    made = next(finding for finding in built.findings if finding.kind == "no lane made")
    assert [made.x, made.y] == pytest.approx(place([(25.0, 1.5)])[0, :2], abs=0.5)


def test_strip_beside_a_solid_line_is_not_taken_for_a_lane():
    built = build_vector_map([line(0.0, 0, 50), line(3.0, 0, 50), line(6.0, 0, 50)], (), [drive((0, 1.5), (50, 1.5))])
    assert len(built.lanes) == 1


def test_contradicting_drives_make_no_lane_and_are_told():
    both = [drive((0, 1.5), (50, 1.5)), drive((50, 1.5), (0, 1.5))]
    built = build_vector_map([line(0.0, 0, 50), line(3.0, 0, 50)], (), both)
    assert not built.lanes
    assert "direction contradicts" in {finding.kind for finding in built.findings}


def test_lane_of_missing_line_is_not_invented():
    """Seven metres between the edges: the line between the lanes is gone."""
    built = build_vector_map([line(0.0, 0, 50), line(7.0, 0, 50)], (), [drive((0, 5.2), (50, 5.2))])
    assert not built.lanes
    assert "driven without lane" in {finding.kind for finding in built.findings}


def test_gap_of_a_bound_is_drawn_through_and_told():
    lines = [line(0.0, 0, 60), line(3.0, 0, 20), line(3.0, 35, 60)]
    built = build_vector_map(lines, (), [drive((0, 1.5), (60, 1.5))])
    assert sum(shapely.LineString(lane.centre[:, :2]).length for lane in built.lanes) == pytest.approx(60.0, abs=1.0)
    assert sum(bound.unseen for bound in built.bounds) == pytest.approx(15.0, abs=0.5)
    assert "bound not seen" in {finding.kind for finding in built.findings}
    short = build_vector_map(lines, (), [drive((0, 1.5), (60, 1.5))], MapSettings(bridge=5.0))
    assert not any(bound.unseen > 1.0 for bound in short.bounds)


def test_right_hand_traffic_turns_the_lane_across_the_centre_line():
    lines = [line(3.5, 0, 60), line(0.0, 0, 60, "solid", "yellow"), line(-3.5, 0, 60)]
    one = drive((0, -1.7), (60, -1.7))
    right = build_vector_map(lines, (), [one], MapSettings(traffic="right"))
    assert {course(lane) for lane in right.lanes} == {1.0, -1.0}
    left = build_vector_map(lines, (), [one], MapSettings(traffic="left"))
    assert [course(lane) for lane in left.lanes] == [1.0]  # to its left lies no other direction


def test_road_on_a_bridge_has_no_lanes_with_the_street_below():
    high = [MapLine(one.points + np.array([0, 1.0, 6.0]), one.kind) for one in (line(2.0, 0, 60), line(5.0, 0, 60))]
    built = build_vector_map([line(0.0, 0, 60), line(3.0, 0, 60), *high], (), [drive((0, 1.5), (60, 1.5))])
    assert len(built.lanes) == 1 and built.lanes[0].width == pytest.approx(3.0, abs=0.01)


def test_curve_keeps_its_width_and_bounds_stay_on_their_lines():
    turn = np.linspace(0.0, 1.2, 60)
    arcs = [place(np.column_stack([r * np.sin(turn), r * (1 - np.cos(turn)) + 40 - r])) for r in (40.0, 43.2)]
    path = place(np.column_stack([41.6 * np.sin(turn), 41.6 * (1 - np.cos(turn)) - 1.6]))
    built = build_vector_map([MapLine(arc, "solid") for arc in arcs], (), [DrivenPath(path)])
    assert built.lanes and all(lane.width == pytest.approx(3.2, abs=0.03) for lane in built.lanes)
    for bound in built.bounds:
        points = shapely.points(built.bound_points(bound)[:, :2])
        assert min(shapely.distance(shapely.LineString(arc[:, :2]), points).max() for arc in arcs) < 0.02


def test_tables_of_layers_become_lines_and_areas():
    shapes = [shapely.LineString(place([(0, 0), (9, 0)])), None]
    (made,) = lines_of(shapes, {"class": ["dashed", "solid"], "colour": [None, "white"], "chain": [4, 5]})
    assert (made.kind, made.colour, made.chain) == ("dashed", "", 4)
    square = shapely.MultiPolygon([shapely.box(0, 0, 4, 4)])
    (area,) = areas_of([square, square], {"class": ["arrow left", "unknown"], "heading": [90.0, None]})
    assert area.kind == "arrow left" and area.heading == pytest.approx([1.0, 0.0])


def test_osm_file_comes_back_as_it_was_written(crossing, tmp_path):
    elements, _ = lanelet_elements(crossing, WKT, speed_limit=40)
    write_osm(tmp_path / "map.osm", elements, META)
    back = read_osm(tmp_path / "map.osm")
    assert set(back.nodes) == set(elements.nodes) and dict(back.ways) == dict(elements.ways)
    assert dict(back.relations) == dict(elements.relations) and not back.repeated
    heights = [float(node.tags["ele"]) for node in back.nodes.values()]
    assert min(heights) > 9.0 and max(heights) < 12.0


def test_damaged_osm_is_refused_in_a_sentence(tmp_path):
    path = tmp_path / "map.osm"
    for text in ("<osm><node id='1' lat='x' lon='2'/></osm>", "<osm><node", "<gpx/>"):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match=r"map\.osm"):
            read_osm(path)


def test_local_coordinates_are_those_of_the_projector_file(tmp_path):
    xy = place([(0, 0), (100, 0), (0, 50)])[:, :2]
    made = map_coordinates(xy, WKT, "MGRS")
    assert made.grid == "54SUE"
    utm = np.column_stack(pyproj.Transformer.from_crs(6677, 32654, always_xy=True).transform(*xy.T))
    assert np.allclose(made.local, utm % 1e5, atol=0.01)
    about = map_coordinates(xy, WKT)
    assert np.abs(about.local).max() < 120.0
    write_projector(tmp_path / "map_projector_info.yaml", about, "WGS84")
    text = (tmp_path / "map_projector_info.yaml").read_text(encoding="utf-8")
    assert "projector_type: TransverseMercator\nvertical_datum: WGS84\nmap_origin:\n  latitude: 35.69" in text


def test_lanelet2_loads_the_map_and_routes_through_the_junction(crossing, tmp_path):
    lanelet2 = pytest.importorskip("lanelet2")
    import autoware_lanelet2_extension_python.regulatory_elements  # noqa: F401  its rules

    elements, coordinates = lanelet_elements(crossing, WKT)
    write_osm(tmp_path / "map.osm", elements, META)
    projector = lanelet2.projection.UtmProjector(lanelet2.io.Origin(*coordinates.origin))
    loaded, errors = lanelet2.io.loadRobust(str(tmp_path / "map.osm"), projector)
    assert not list(errors)
    assert len(loaded.laneletLayer) == len(crossing.lanes) + 1  # and the crosswalk
    rules = lanelet2.traffic_rules.create(lanelet2.traffic_rules.Locations.Germany,
                                          lanelet2.traffic_rules.Participants.Vehicle)
    graph = lanelet2.routing.RoutingGraph(loaded, rules)
    assert not list(graph.checkValidity())
    ids = [number for number, relation in elements.relations.items() if relation.tags.get("subtype") == "road"]
    start = loaded.laneletLayer[ids[kerb_lane(crossing, 30, 5.2)]]
    end = loaded.laneletLayer[ids[kerb_lane(crossing, 120, 5.2)]]
    assert graph.getRoute(start, end) is not None and graph.getRoute(end, start) is None
    assert graph.right(start) is not None and graph.left(start) is None
    assert len(start.regulatoryElements) == 1


def street(*kinds):
    """Lines of 60 m, 3.5 m apart."""
    return [line(3.5 * k, 0, 60, kind) for k, kind in enumerate(kinds)]


def axis_along(y=3.5, **told):
    shape = shapely.LineString(place([(-20, y), (80, y)]))
    return axes_of([shape], {name: [value] for name, value in told.items()})


def test_fields_of_road_axes_are_read_as_openstreetmap_has_them():
    (one,) = axis_along(oneway="yes", maxspeed="30 mph", lanes="2")
    assert (one.oneway, one.lanes) == (1, 2) and one.speed_limit == pytest.approx(48.28, abs=0.01)
    assert [axis_along(oneway=word)[0].oneway for word in ("-1", "no", None)] == [-1, 0, None]
    assert np.isnan(axis_along(maxspeed="none")[0].speed_limit) and axis_along(speed_limit=40)[0].speed_limit == 40


def test_one_way_axis_gives_undriven_strips_direction_and_speed_limit():
    built = build_vector_map(street("solid", "solid", "solid"), axes=axis_along(oneway="-1", maxspeed="40"))
    assert [course(lane) for lane in built.lanes] == [-1.0, -1.0]
    assert {lane.evidence for lane in built.lanes} == {"road axis"}
    assert {lane.speed_limit for lane in built.lanes} == {40.0}
    tags = [one.tags for one in lanelet_elements(built, WKT, speed_limit=60)[0].relations.values()]
    assert {tag["speed_limit"] for tag in tags} == {"40"}


def test_two_way_axis_tells_only_where_the_numbers_of_lanes_agree_and_the_side_is_known():
    left, right = MapSettings(traffic="left"), MapSettings(traffic="right")
    lines = street("solid", "solid", "solid")
    for settings, wanted in ((left, {1.7: -1.0, 5.2: 1.0}), (right, {1.7: 1.0, 5.2: -1.0})):
        built = build_vector_map(lines, settings=settings, axes=axis_along(oneway="no"))
        assert {y: course(built.lanes[kerb_lane(built, 30, y)]) for y in wanted} == wanted
    assert not build_vector_map(lines, settings=left, axes=axis_along(oneway="no", lanes="4")).lanes
    assert not build_vector_map(lines, axes=axis_along(oneway="no")).lanes
    assert not build_vector_map(lines, settings=left, axes=axis_along(y=40.0, oneway="no")).lanes


def test_drive_is_believed_more_than_a_road_axis():
    built = build_vector_map(street("solid", "solid"), (), [drive((0, 1.7), (60, 1.7))], axes=axis_along(oneway="-1"))
    assert [course(lane) for lane in built.lanes] == [1.0]


def test_kerbs_of_an_island_and_of_pavements_do_not_shorten_the_lanes():
    """Lane lines are worn before the island; strips between kerbs and walls begin and end elsewhere."""
    lines = [line(7.0, 0, 60), line(-7.0, 0, 60), line(3.5, 25, 60, "dashed"), line(-3.5, 25, 60, "dashed"),
             line(0.0, 0, 12, "solid", "yellow"), line(0.0, 40, 60, "solid", "yellow")]
    borders = [line(y, 14, 38, "road border", "") for y in (-0.4, 0.4)]
    borders += [line(y, 6, 66, "road border", "") for y in (-9.5, 9.5, -12.9, 12.9)]
    drives = [drive((-5, -5.2), (70, -5.2)), drive((70, 5.2), (-5, 5.2))]
    built = build_vector_map([*lines, *borders], [], drives, MapSettings(traffic="right"))
    for y in (-5.2, -1.9, 1.9, 5.2):
        for x in (4.0, 26.0, 50.0):
            assert course(built.lanes[lane_at(built, x, y)]) == (1.0 if y < 0 else -1.0)
    assert all(abs(spot[1]) < 7.1 for lane in built.lanes if lane.kind == "lane"
               for spot in _in_street(lane.centre))


@pytest.mark.parametrize("side", [-1, 1])
def test_lane_goes_on_where_an_islands_kerb_takes_the_place_of_the_centre_line(side):
    """A solid lane line parts it from the lane that was driven, so only what lies before it tells its direction."""
    lines = [line(7.0, 0, 60), line(-7.0, 0, 60), line(3.5, 0, 20, "dashed"), line(-3.5, 0, 20, "dashed"),
             line(3.5, 20, 60), line(-3.5, 20, 60), line(0.0, 0, 20, "solid", "yellow")]
    borders = [line(y, 20, 60, "road border", "") for y in (-0.4, 0.4)]
    drives = [drive((-5, -5.2), (65, -5.2)), drive((65, 5.2), (-5, 5.2))]
    built = build_vector_map([*lines, *borders], [], drives, MapSettings(traffic="right"))
    assert course(built.lanes[lane_at(built, 45.0, 1.9 * side)]) == -side
    apart = [one for one in lines if one.kind != "dashed"]  # no lane before it that has a direction
    with pytest.raises(ValueError):
        lane_at(build_vector_map([*apart, *borders], [], drives, MapSettings(traffic="right")), 45.0, 1.9 * side)


def test_worn_lines_that_hardly_overlap_are_one_road():
    """The centre line of a short arm is seen in its middle, the lane line on its far side before the stop line only."""
    centre = MapLine(place([(7.0, 0.0), (13.4, 0.0)]), "solid", "yellow", 0.15)
    before_stop = MapLine(place([(9.9, -3.5), (20.0, -3.5)]), "solid", "white", 0.15)
    lines = [line(7.0, 0, 20), line(3.5, 0, 20), centre, before_stop, line(-7.0, 0, 20)]
    built = build_vector_map(lines, [], [drive((20, 1.75), (0, 1.75))], MapSettings(traffic="right"))
    assert course(built.lanes[lane_at(built, 10.0, 1.75)]) == -1.0
    assert course(built.lanes[lane_at(built, 10.0, -1.75)]) == 1.0


def test_lanes_reach_the_end_of_the_road_though_something_begins_shortly_before():
    lines = [line(3.5, 0, 45), line(0.0, 0, 45, "solid", "yellow"), line(-3.5, 0, 45), line(7.0, 39.0, 44)]
    built = build_vector_map([*lines, stop(44.3, -3.4, -0.1)], [], [drive((0, -1.75), (45, -1.75))],
                             MapSettings(traffic="right"))
    lane = built.lanes[lane_at(built, 20.0, -1.75)]
    assert _in_street(lane.centre)[:, 0].max() == pytest.approx(44.3, abs=0.6)


def _in_street(points):
    """Points of the map in the street's own frame."""
    x, y = points[:, 0] - EAST, points[:, 1] - NORTH
    return np.column_stack([x * np.cos(ANGLE) + y * np.sin(ANGLE), y * np.cos(ANGLE) - x * np.sin(ANGLE)])
