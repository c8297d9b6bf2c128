"""Faults of Lanelet2 files: a sound map has none, and each rule notices what breaks it."""

from __future__ import annotations

from dataclasses import replace
from string import Formatter

import pytest

from scripts.make_rule_page import PAGE, rules_page
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.osm import OsmFile, OsmNode, OsmRelation, OsmWay, read_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.checks.rule_table import MAP_RULES, SEVERITIES, map_rules

LANE = {"type": "lanelet", "subtype": "road", "location": "urban", "one_way": "yes", "speed_limit": "40",
        "participant:vehicle": "yes"}


def node(number, x, y):
    """A node on a plane about the equator, where 1 m is 9e-6 degrees."""
    return OsmNode(number, y / 110574.0, x / 111319.49,
                   {"local_x": str(x), "local_y": str(y), "ele": "1"})


def sound_map():
    """Two lanelets in a row, one beside the second, a stop line and a crosswalk with their rules."""
    nodes = [node(10 * row + column, 20.0 * column, 3.0 * row) for row in (1, 2, 3) for column in (1, 2, 3)]
    nodes += [node(41, 60.5, 3.2), node(42, 60.5, 5.8),
              *(node(50 + k, *place) for k, place in enumerate([(58, 2), (58, 10), (59.5, 2), (59.5, 10)]))]
    ways = [OsmWay(10 * row + column + 100, (10 * row + column, 10 * row + column + 1),
                   {"type": "line_thin", "subtype": "solid", "lane_change": "no"})
            for row in (1, 2, 3) for column in (1, 2)]
    ways += [OsmWay(141, (41, 42), {"type": "stop_line"}), OsmWay(150, (50, 51), {"type": "pedestrian_marking"}),
             OsmWay(151, (52, 53), {"type": "pedestrian_marking"})]

    def lanelet(number, left, right, *rules, **tags):
        return OsmRelation(number, (("way", left, "left"), ("way", right, "right"),
                                    *(("relation", rule, "regulatory_element") for rule in rules)), {**LANE, **tags})

    relations = [lanelet(200, 121, 111), lanelet(201, 122, 112, 300, 301), lanelet(202, 132, 122),
                 OsmRelation(203, (("way", 150, "left"), ("way", 151, "right")),
                             {"type": "lanelet", "subtype": "crosswalk", "location": "urban",
                              "participant:pedestrian": "yes"}),
                 OsmRelation(300, (("way", 141, "refers"),), {"type": "regulatory_element", "subtype": "road_marking"}),
                 OsmRelation(301, (("relation", 203, "refers"),), {"type": "regulatory_element",
                                                                   "subtype": "crosswalk"})]
    return OsmFile({one.identifier: one for one in nodes}, {one.identifier: one for one in ways},
                   {one.identifier: one for one in relations})


def changed(**parts):
    """The sound map with elements put in the place of others (None takes one out)."""
    whole = sound_map()
    made = {}
    for name in ("nodes", "ways", "relations"):
        made[name] = {**getattr(whole, name), **parts.get(name, {})}
        made[name] = {number: one for number, one in made[name].items() if one is not None}
    return replace(whole, **made, repeated=parts.get("repeated", ()))


def faults(content):
    return {fault.rule for fault in check_map(content) if fault.severity != "info"} - {"routing.graph-001"}


def way(number, **tags):
    held = sound_map().ways[number]
    return replace(held, tags={name: value for name, value in {**held.tags, **tags}.items() if value is not None})


def relation(number, **tags):
    held = sound_map().relations[number]
    tags = {name.replace("__", ":"): value for name, value in tags.items()}
    return replace(held, tags={name: value for name, value in {**held.tags, **tags}.items() if value is not None})


def moved(number, **tags):
    held = sound_map().nodes[number]
    return replace(held, tags={**held.tags, **tags})


def priority(*roles):
    """A right_of_way element that the first lanelet refers to."""
    return {"relations": {
        200: replace(relation(200), members=(*relation(200).members, ("relation", 302, "regulatory_element"))),
        302: OsmRelation(302, tuple(("relation", number, role) for number, role in roles),
                         {"type": "regulatory_element", "subtype": "right_of_way"})}}


def test_sound_map_has_no_faults_but_its_ends():
    found = check_map(sound_map())
    assert not [fault for fault in found if fault.severity == "error"]
    assert {fault.rule for fault in found} == {
        "routing.graph-001", "routing.graph-002", "routing.graph-003", "Lanelet2.Load-006",
        "Crosswalk.RegulatoryElementDetails-003"}
    lonely = [fault.element for fault in found if fault.severity == "warning"]
    assert lonely == ["lanelet 202"]  # beside the second lanelet, with nothing before or behind it


CASES = {
    "File.RepeatedId-001": {"repeated": (("way", 111),)},
    "File.MissingReference-001": {"nodes": {41: None}},
    "File.MissingReference-002": {"ways": {141: replace(way(141), nodes=(41,))}},
    "File.MissingReference-003": {"ways": {141: None}},
    "File.Coordinates-001": {"nodes": {11: replace(moved(11), latitude=139.0)}},
    "File.Coordinates-002": {"nodes": {11: moved(11, local_x="900")}},
    "File.Coordinates-003": {"nodes": {41: node(41, 90000.0, 3.2)}},
    "File.Height-001": {"nodes": {97: replace(node(97, 0, 0), tags={"local_x": "0", "local_y": "0"})}},
    "File.Height-002": {"nodes": {12: moved(12, ele="11"), 22: moved(22, ele="11")},
                        "ways": {111: replace(way(111), nodes=(11, 12, 13))}},
    "Lanelet2.Load-001": {"relations": {300: relation(300, subtype=None)}},
    "Lanelet2.Load-002": {"relations": {200: replace(relation(200), members=(("way", 121, "left"),))}},
    "Lanelet2.Load-003": priority((201, "yield")),
    "Lanelet2.Load-004": {"relations": {300: relation(300, subtype="traffic_sign")},
                          "ways": {141: way(141, subtype=None)}},
    "Lanelet2.Load-005": {"relations": {300: relation(300, subtype="road_markings")}},
    "Lanelet2.Load-007": {"relations": {301: replace(relation(301), members=())}},
    "Lanelet2.Unused-001": {"relations": {201: replace(
        relation(201), members=relation(201).members[:2] + relation(201).members[3:])}},
    "Lanelet2.Yield-001": priority((200, "right_of_way")),
    "Lanelet2.Yield-002": priority((200, "right_of_way"), (200, "yield")),
    "Lanelet2.Yield-003": priority((203, "right_of_way"), (200, "yield")),
    "Lanelet2.Members-001": {"relations": {300: replace(relation(300), members=(
        ("way", 141, "refers"), ("relation", 200, "ref_line")))}},
    "Lanelet2.Members-002": {"relations": {300: replace(relation(300), members=(
        ("way", 141, "refers"), ("way", 141, "refline")))}},
    "Lanelet2.Participants-003": {"relations": {203: relation(203, participant__pedestrian=None,
                                                              participant__vehicle="yes")}},
    "Lanelet2.Participants-001": {"relations": {200: relation(200, participant__vehicle=None)}},
    "Lanelet2.SpeedLimit-002": {"relations": {200: relation(200, speed_limit="fast")}},
    "mapping.mandatory_tags": {"relations": {200: relation(200, subtype=None)}},
    "mapping.unknown_tag_values": {"ways": {111: way(111, type="line_thinn")}},
    "mapping.bool_tags": {"relations": {200: relation(200, one_way="maybe")}},
    "mapping.duplicated_points": {"ways": {111: replace(way(111), nodes=(11, 11, 12))}},
    "mapping.points_too_close": {"nodes": {99: node(99, 20.02, 3.0)},
                                 "ways": {111: replace(way(111), nodes=(11, 99, 12))}},
    "mapping.curvature_too_big": {"nodes": {99: node(99, 30.0, 3.3), 96: node(96, 30.4, 3.0), 95: node(95, 30.8, 3.3)},
                                  "ways": {111: replace(way(111), nodes=(11, 99, 96, 95, 12))}},
    "Shape.Bounds-001": {"nodes": {98: node(98, 30.0, 8.0)}, "ways": {111: replace(way(111), nodes=(11, 98, 12))}},
    "Shape.Bounds-002": {"nodes": {98: node(98, 30, 3.5), 99: node(99, 29, 2.5), 96: node(96, 29, 3.5)},
                         "ways": {111: replace(way(111), nodes=(11, 98, 99, 96, 12))}},
    "Shape.Bounds-003": {"nodes": {99: node(99, 20.0, 3.0)}, "ways": {111: replace(way(111), nodes=(11, 99))}},
    "Shape.Width-001": {"nodes": {31: node(31, 20, 19), 32: node(32, 40, 19), 33: node(33, 60, 19)}},
    "Shape.Twin-001": {"relations": {209: replace(relation(200), identifier=209)}},
    "Shape.Overlap-001": {"nodes": {number: node(number, x, y) for number, x, y in (
        (94, 20.5, 3.4), (95, 39.5, 3.4), (96, 20.5, 6.4), (97, 39.5, 6.4))},
        "ways": {198: OsmWay(198, (94, 95), way(111).tags), 199: OsmWay(199, (96, 97), way(111).tags)},
        "relations": {209: OsmRelation(209, (("way", 199, "left"), ("way", 198, "right")), LANE)}},
    "Shape.StopLine-001": {"nodes": {41: node(41, 50.0, 4.5), 42: node(42, 53.0, 4.5)}},
    "Shape.Turn-001": {"relations": {200: relation(200, turn_direction="left")}},
    "Lane.BorderSharing-001": {"nodes": {94: node(94, 40, 6), 95: node(95, 60, 6)}, "ways": {
        199: OsmWay(199, (94, 95), way(122).tags)}, "relations": {
        202: replace(relation(202), members=(("way", 132, "left"), ("way", 199, "right")))}},
    "Lane.LocalCoordinatesDeclaration-001": {"nodes": {97: OsmNode(97, 0.0, 0.0, {"ele": "1"})}},
    "Lane.LongitudinalSubtypeConnection-002": {"relations": {200: relation(200, subtype="bus_lane")}},
    "Lane.LaneChangeAttribute-001": {"ways": {122: way(122, lane_change=None)}},
    "Lane.LaneletGeometry-001": {"ways": {111: replace(way(111), nodes=(11, 22))}},
    "Lane.SpeedLimitValidity-001": {"relations": {200: relation(200, speed_limit="fast")}},
    "Lane.SpeedLimitValidity-002": {"relations": {200: relation(200, speed_limit="500")}},
    "Lane.RoadLaneletAttribute-001": {"relations": {200: relation(200, location="urbn")}},
    "Lane.RoadLaneletAttribute-002": {"relations": {200: relation(200, one_way="maybe")}},
    "StopLine.MissingRegulatoryElements-001": {"relations": {300: replace(relation(300), members=())}},
    "Intersection.RoadMarkings-001": {"relations": {300: replace(relation(300), members=())}},
    "Intersection.IntersectionAreaTagging-004": {"relations": {200: relation(200, turn_direction="left")}},
    "Intersection.TurnDirectionTagging-002": {"relations": {200: relation(200, turn_direction="leftt")}},
    "Intersection.IntersectionAreaDanglingReference-001": {"relations": {200: relation(200, intersection_area="77")}},
    "Crosswalk.MissingRegulatoryElements-001": {"relations": {301: replace(relation(301), members=())}},
    "Crosswalk.RegulatoryElementDetails-011": {"relations": {203: relation(203, participant__pedestrian="no")}},
}


@pytest.mark.parametrize("rule", CASES)
def test_rule_notices_what_breaks_it(rule):
    assert rule not in faults(sound_map())
    assert rule in faults(changed(**CASES[rule]))


DAMAGES = {
    "degrees of a node moved by a metre, its local coordinates not": ("File.Coordinates-002", {
        "nodes": {11: moved(11, local_x="21.0")}}),
    "misspelt subtype": ("mapping.unknown_tag_values", {"relations": {200: relation(200, subtype="rood")}}),
    "misspelt location": ("mapping.unknown_tag_values", {"relations": {200: relation(200, location="urbn")}}),
    "misspelt subtype of a line": ("mapping.unknown_tag_values", {"ways": {111: way(111, subtype="solidd")}}),
    "misspelt subtype of a virtual line": ("mapping.unknown_tag_values", {"ways": {
        111: way(111, type="virtual", subtype="dashd")}}),
    "bound that turns back on a straight": ("Shape.Bounds-002", {
        "nodes": {98: node(98, 35.0, 3.0), 99: node(99, 25.0, 3.0)},
        "ways": {111: replace(way(111), nodes=(11, 98, 99, 12))}}),
    "node at the origin of latitude and longitude": ("File.Coordinates-002", {"nodes": {
        **{number: replace(one, latitude=one.latitude + 35.0, longitude=one.longitude + 139.0)
           for number, one in sound_map().nodes.items()}, 11: replace(moved(11), latitude=0.0, longitude=0.0)}}),
    "one height in a map without heights": ("File.Height-002", {
        "nodes": {**{number: replace(one, tags={key: value for key, value in one.tags.items() if key != "ele"})
                     for number, one in sound_map().nodes.items()},
                  99: replace(node(99, 30.0, 3.0), tags={"local_x": "30.0", "local_y": "3.0", "ele": "10"})},
        "ways": {111: replace(way(111), nodes=(11, 99, 12))}}),
    "turn to the wrong side": ("Shape.Turn-001", {
        "nodes": {12: node(12, 36, 0), 22: node(22, 39, 2)}, "relations": {200: relation(200, turn_direction="left")}}),
    "misspelt participant": ("mapping.unknown_tag_values", {"relations": {
        200: relation(200, participant__vehicel="yes")}}),
    "misspelt type of a lanelet": ("mapping.unknown_tag_values", {"relations": {200: relation(200, type="lanelt")}}),
    "misspelt type of a rule": ("mapping.unknown_tag_values", {"relations": {300: relation(300, type="regulatory")}}),
    "exchanged latitude and longitude": ("File.Coordinates-001", {"nodes": {
        number: replace(one, latitude=one.longitude + 139.0) for number, one in sound_map().nodes.items()}}),
    "swapped sides": ("routing.graph-001", {"relations": {200: replace(relation(200), members=(
        ("way", 111, "left"), ("way", 121, "right"))), 202: None, 201: None}}),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_damage_is_found(damage):
    rule, parts = DAMAGES[damage]
    assert rule in {fault.rule for fault in check_map(changed(**parts))}


def test_every_rule_has_a_function_and_a_text_with_the_same_fields_in_both_languages():
    assert set(MAP_RULES.functions) == set(map_rules())
    for rule in map_rules().values():
        assert rule.severity in SEVERITIES and rule.source in ("Autoware", "Lanelet2", "UrbanMap")
        english, japanese = (sorted(name for _, name, *_ in Formatter().parse(text) if name)
                             for text in (rule.text, rule.japanese))
        assert english == japanese and rule.text.endswith((".", "?")), rule.code


def test_page_of_the_documentation_is_that_of_the_table():
    assert PAGE.read_text(encoding="utf-8") == rules_page()


def test_a_node_off_the_earth_in_a_map_without_local_coordinates_is_told_and_the_rest_is_checked():
    plain = {number: replace(one, tags={"ele": "1"}) for number, one in sound_map().nodes.items()}
    bent = {**plain, 98: OsmNode(98, 139.0, plain[11].longitude, {"ele": "1"})}
    ways = {111: replace(way(111), nodes=(11, 98, 12)), 132: way(132, type="line_thinn")}
    found = {fault.rule for fault in check_map(changed(nodes=bent, ways=ways))}
    assert {"File.Coordinates-001", "mapping.unknown_tag_values"} <= found
    assert not {rule for rule in found if rule.startswith(("Lanelet2.Load-002", "Shape.", "File.M"))}


def test_rules_can_be_left_out_by_code_or_its_begin():
    broken = changed(**CASES["mapping.bool_tags"])
    assert not any(fault.rule.startswith("mapping.") for fault in check_map(broken, ["mapping."]))
    assert "mapping.bool_tags" in {fault.rule for fault in check_map(broken, ["Lane.RoadLaneletAttribute-002"])}
    with pytest.raises(InputError, match="begins with Lanes"):
        check_map(broken, ["Lanes"])


def test_texts_are_japanese_for_a_japanese_user(monkeypatch):
    monkeypatch.setattr("urbanmap_qgis.io.files.rule_table.language", lambda: "ja")
    texts = {fault.rule: fault.text for fault in check_map(changed(**CASES["mapping.bool_tags"]))}
    assert texts["mapping.bool_tags"] == "one_way=maybe は yes か no でなければなりません。"


def test_stop_line_and_crosswalk_without_rule_are_errors():
    without = changed(relations={300: None, 301: None, 201: replace(relation(201), members=relation(201).members[:2])})
    rules = [fault.rule for fault in check_map(without) if fault.severity == "error"]
    assert sorted(rules) == ["Crosswalk.MissingRegulatoryElements-001", "StopLine.MissingRegulatoryElements-001"]


@pytest.mark.parametrize(("heights", "spike"), [((3, 1), True), ((3, 5), False), ((1, 1), False)])
def test_a_node_above_or_below_both_neighbours_is_a_spike(heights, spike):
    """A bound that rises by 2 m in 10 m, and falls again or rises on as far."""
    middle = replace(node(98, 30, 3), tags={**node(98, 30, 3).tags, "ele": str(heights[0])})
    broken = changed(nodes={98: middle, 12: moved(12, ele=str(heights[1]))},
                     ways={111: replace(way(111), nodes=(11, 98, 12)), 112: None}, relations={201: None, 202: None})
    found = [fault for fault in check_map(broken) if fault.rule == "File.Height-002"]
    assert [fault.element for fault in found] == (["node 98"] if spike else [])


def test_fault_has_the_place_of_its_element():
    (fault,) = [fault for fault in check_map(changed(relations={200: relation(200, location=None)}))
                if fault.rule == "mapping.mandatory_tags"]
    assert (fault.severity, fault.element, fault.source) == ("warning", "lanelet 200", "Lanelet2")
    assert [fault.longitude * 111319.49, fault.latitude * 110574.0] == pytest.approx([40.0, 6.0], abs=0.01)


def test_map_of_local_coordinates_only_is_checked():
    content = sound_map()
    nodes = {number: replace(one, latitude=float("nan"), longitude=float("nan"))
             for number, one in content.nodes.items()}
    assert faults(replace(content, nodes=nodes)) == set()


@pytest.mark.parametrize(("name", "value"), [("local_x", "abc"), ("local_y", "nan"), ("ele", "inf"), ("lat", "nan")])
def test_coordinates_that_are_no_numbers_are_refused(tmp_path, name, value):
    tags = {"local_x": "1", "local_y": "2", "ele": "3", "lat": "35.0"} | {name: value}
    inner = "".join(f'<tag k="{key}" v="{tags[key]}"/>' for key in ("local_x", "local_y", "ele"))
    path = tmp_path / "map.osm"
    path.write_text(f'<osm version="0.6"><node id="7" lat="{tags["lat"]}" lon="139.0">{inner}</node></osm>')
    with pytest.raises(InputError, match=r"map\.osm"):
        read_osm(path)


def test_a_map_with_a_document_type_is_refused(tmp_path):
    """Entities in it could be a bomb or name other files."""
    path = tmp_path / "map.osm"
    path.write_text('<?xml version="1.0"?><!DOCTYPE osm [<!ENTITY a "b">]><osm>&a;</osm>', encoding="utf-8")
    with pytest.raises(InputError, match="document type"):
        read_osm(path)
