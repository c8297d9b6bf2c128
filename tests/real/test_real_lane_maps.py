"""A real Lanelet2 map of a junction, checked."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.io.osm import read_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map

SIND = Path(__file__).resolve().parents[3] / "shared" / "data" / "aerial" / "sind" / "Changchun_Pudong.osm"

pytestmark = pytest.mark.skipif(not SIND.is_file(), reason="the real test data are not beside the checkout")


def test_a_real_map_is_read_whole_and_its_missing_tags_are_told():
    content = read_osm(SIND)
    assert sum(relation.tags.get("type") == "lanelet" for relation in content.relations.values()) == 37
    faults = check_map(content)
    found = Counter((fault.severity, fault.rule) for fault in faults)
    assert found["error", "mandatory tag"] == 22 and found["warning", "height"] == 1
    assert not [rule for severity, rule in found if severity == "error" and rule != "mandatory tag"]
    places = np.array([(fault.longitude, fault.latitude) for fault in faults])
    assert np.isfinite(places).all(axis=1).sum() > 20
