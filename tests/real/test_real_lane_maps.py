"""A real Lanelet2 map of a junction, checked."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.io.osm import read_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map
from urbanmap_qgis.roadmap.checks.rule_table import map_rules

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
SIND = DATA / "aerial" / "sind" / "Changchun_Pudong.osm"
AUTOWARE = DATA / "rules" / "autoware"

GROUPS = {"area": "Area", "crosswalk": "Crosswalk", "intersection": "Intersection", "lane": "Lane",
          "stop_line": "StopLine", "traffic_light": "TrafficLight"}
RENAMED = {"Crosswalk.CrosswalkSafetyAttributes": "Crosswalk.SafetyAttributes",
           "Crosswalk.RegulatoryElementDetailsForCrosswalks": "Crosswalk.RegulatoryElementDetails",
           "TrafficLight.MissingReferrersForTrafficLights": "TrafficLight.MissingReferrers",
           "TrafficLight.MissingRegulatoryElementsForTrafficLights": "TrafficLight.MissingRegulatoryElements",
           "TrafficLight.RegulatoryElementDetailsForTrafficLights": "TrafficLight.RegulatoryElementDetails",
           "TrafficLight.TrafficLightFacing": "TrafficLight.CorrectFacing"}

pytestmark = pytest.mark.skipif(not SIND.is_file(), reason="the real test data are not beside the checkout")


def test_a_real_map_is_read_whole_and_its_missing_tags_are_told():
    content = read_osm(SIND)
    assert sum(relation.tags.get("type") == "lanelet" for relation in content.relations.values()) == 37
    faults = check_map(content)
    found = Counter(fault.rule for fault in faults)
    assert found["mapping.mandatory_tags"] == 41 and found["File.Height-001"] == 1
    assert found["StopLine.MissingRegulatoryElements-001"] == 4
    assert not [rule for rule in found if rule.startswith(("File.M", "File.R", "File.C", "Shape.B", "Lanelet2.L"))]
    places = np.array([(fault.longitude, fault.latitude) for fault in faults])
    assert np.isfinite(places).all()


def code_of(case):
    """The begin of the codes of a case's validator."""
    code = GROUPS[case["group"]] + "." + "".join(word.capitalize() for word in case["validator"].split("_"))
    return RENAMED.get(code, code)


def named(case, faults):
    """Whether the faults name what is wrong in a case: its codes, and the elements that are in the message's place.

    A file that the reference refuses to load has no codes: then a rule on loading must tell. A number that is both
    in the codes and among the elements was read from the code.
    """
    own = [fault for fault in faults if fault.rule.startswith(code_of(case) + "-")]
    if not case["codes"]:
        return bool(own or [fault for fault in faults if fault.rule.startswith("Lanelet2.Load")])
    codes = {int(fault.rule[-3:]) for fault in own}
    wanted = set(map(int, case["codes"]))
    elements = {int(fault.element.split()[-1]) for fault in own}
    either = case["issues"] == 1 and len(wanted) > 1
    return (wanted & codes if either else wanted <= codes) and set(case["primitives"]) - wanted <= elements


@pytest.mark.skipif(not AUTOWARE.is_dir(), reason="the validator's maps are not beside the checkout")
def test_faulty_maps_are_named_for_the_right_reason_and_clean_ones_pass():
    cases = json.loads((AUTOWARE / "expected.json").read_text(encoding="utf-8"))
    faults = {case["map"]: check_map(read_osm(AUTOWARE / "map" / case["map"])) for case in cases}
    faulty = [case for case in cases if case["issues"] != 0]
    missed = [case["test"] for case in faulty if not named(case, faults[case["map"]])]
    print(f"named for the right reason: {len(faulty) - len(missed)} of {len(faulty)}; missed: {missed}")
    assert len(missed) <= 0.05 * len(faulty)
    for case in cases:
        if case["issues"] == 0:
            told = [fault for fault in faults[case["map"]] if fault.rule.startswith(code_of(case) + "-")]
            assert not told, (case["test"], told)


@pytest.mark.skipif(not AUTOWARE.is_dir(), reason="the validator's maps are not beside the checkout")
def test_the_validators_own_sample_has_no_error():
    faults = check_map(read_osm(AUTOWARE / "map" / "sample_map.osm"))
    assert not [fault for fault in faults if fault.severity == "error"]


@pytest.mark.skipif(not AUTOWARE.is_dir(), reason="the validator's table is not beside the checkout")
def test_codes_and_severities_are_the_official_ones():
    official = json.loads((AUTOWARE / "config" / "issues_info.json").read_text(encoding="utf-8"))
    discontinued = {f"Crosswalk.RegulatoryElementDetails-{number}" for number in ("004", "005", "008")}
    discontinued |= {"Lane.RoadShoulder-002"}
    ours = {rule.code: rule for rule in map_rules().values() if rule.code in official}
    assert set(official) - set(ours) == discontinued
    for code, rule in ours.items():
        assert (rule.severity, rule.primitive) == (official[code]["severity"].lower(), official[code]["primitive"])
