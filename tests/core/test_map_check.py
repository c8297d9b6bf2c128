"""Faults of Lanelet2 files: a sound map has none, and each rule notices what breaks it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.osm import OsmFile, OsmNode, OsmRelation, OsmWay, read_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map

LANE = {"type": "lanelet", "subtype": "road", "location": "urban", "one_way": "yes", "speed_limit": "40"}


def node(number, x, y):
    """A node on a plane about the equator, where 1 m is 9e-6 degrees."""
    return OsmNode(number, y / 110574.0, x / 111319.49,
                   {"local_x": str(x), "local_y": str(y), "ele": "1"})


def sound_map():
    """Two lanelets in a row, one beside the second, a stop line and a crosswalk with their rules."""
    nodes = [node(10 * row + column, 20.0 * column, 3.0 * row) for row in (1, 2, 3) for column in (1, 2, 3)]
    nodes += [node(41, 60.5, 3.2), node(42, 60.5, 5.8),
              *(node(50 + k, *place) for k, place in enumerate([(62, 2), (62, 10), (65, 2), (65, 10)]))]
    ways = [OsmWay(10 * row + column + 100, (10 * row + column, 10 * row + column + 1),
                   {"type": "line_thin", "subtype": "solid"}) for row in (1, 2, 3) for column in (1, 2)]
    ways += [OsmWay(141, (41, 42), {"type": "stop_line"}), OsmWay(150, (50, 51), {"type": "pedestrian_marking"}),
             OsmWay(151, (52, 53), {"type": "pedestrian_marking"})]

    def lanelet(number, left, right, *rules, **tags):
        return OsmRelation(number, (("way", left, "left"), ("way", right, "right"),
                                    *(("relation", rule, "regulatory_element") for rule in rules)), {**LANE, **tags})

    relations = [lanelet(200, 121, 111), lanelet(201, 122, 112, 300, 301), lanelet(202, 132, 122),
                 OsmRelation(203, (("way", 150, "left"), ("way", 151, "right")),
                             {"type": "lanelet", "subtype": "crosswalk", "location": "urban"}),
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
    return {(fault.severity, fault.rule) for fault in check_map(content)} - {("info", "routing graph")}


def way(number):
    return sound_map().ways[number]


def relation(number, **tags):
    held = sound_map().relations[number]
    return replace(held, tags={name: value for name, value in {**held.tags, **tags}.items() if value is not None})


def test_sound_map_has_no_faults_but_its_ends():
    found = check_map(sound_map())
    assert {fault.rule for fault in found} == {"routing graph"}
    lonely = [fault.element for fault in found if fault.severity == "warning"]
    assert lonely == ["lanelet 202"]  # beside the second lanelet, with nothing before or behind it


CASES = {
    "repeated id": ("error", {"repeated": (("way", 111),)}),
    "missing reference": ("error", {"nodes": {41: None}}),
    "mandatory tag": ("error", {"relations": {200: relation(200, subtype=None)}}),
    "bounds": ("error", {"relations": {200: replace(relation(200), members=(("way", 121, "left"),))}}),
    "points too close": ("warning", {"nodes": {99: node(99, 20.02, 3.0)},
                                     "ways": {111: replace(way(111), nodes=(11, 99, 12))}}),
    "duplicated point": ("warning", {"ways": {111: replace(way(111), nodes=(11, 11, 12))}}),
    "geometry": ("error", {"nodes": {98: node(98, 30.0, 8.0)}, "ways": {111: replace(way(111), nodes=(11, 98, 12))}}),
    "width": ("warning", {"nodes": {31: node(31, 20, 19), 32: node(32, 40, 19), 33: node(33, 60, 19)}}),
    "border not shared": ("warning", {"ways": {199: replace(way(122), identifier=199)}, "relations": {
        202: replace(relation(202), members=(("way", 132, "left"), ("way", 199, "right")))}}),
    "not referred to": ("error", {"relations": {201: replace(
        relation(201), members=relation(201).members[:2] + relation(201).members[3:])}}),
    "speed limit": ("info", {"relations": {200: relation(200, speed_limit=None)}}),
    "local coordinates": ("error", {"nodes": {97: OsmNode(97, 0.0, 0.0, {"ele": "1"})}}),
    "height": ("warning", {"nodes": {97: replace(node(97, 0, 0), tags={"local_x": "0", "local_y": "0"})}}),
}


@pytest.mark.parametrize("rule", CASES)
def test_rule_notices_what_breaks_it(rule):
    severity, parts = CASES[rule]
    before = faults(sound_map())
    assert (severity, rule) not in before
    assert (severity, rule) in faults(changed(**parts))


def test_stop_line_and_crosswalk_without_rule_are_warnings():
    without = changed(relations={300: None, 301: None, 201: replace(relation(201), members=relation(201).members[:2])})
    texts = [fault.text for fault in check_map(without) if fault.rule == "not referred to"]
    assert sorted(texts) == ["No regulatory element refers to this crosswalk.",
                             "No regulatory element refers to this stop line."]


def test_fault_has_the_place_of_its_element():
    (fault,) = [fault for fault in check_map(changed(repeated=(), relations={200: relation(200, location=None)}))
                if fault.rule == "mandatory tag"]
    assert (fault.severity, fault.element) == ("warning", "lanelet 200")
    assert [fault.longitude * 111319.49, fault.latitude * 110574.0] == pytest.approx([40.0, 6.0], abs=0.01)


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
