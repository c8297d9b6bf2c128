"""urbanmap:checkvectormap through Processing."""

from __future__ import annotations

import pytest

ALGORITHM = "urbanmap:checkvectormap"
HEAD = '<?xml version="1.0"?><osm version="0.6">'
NODES = "".join(f'<node id="{n}" lat="35.69{y}" lon="139.75{x}"/>' for n, x, y in
                ((1, "000", "0000"), (2, "050", "0000"), (3, "000", "0027"), (4, "050", "0027")))
WAYS = "".join(f'<way id="{n}"><nd ref="{a}"/><nd ref="{b}"/><tag k="type" v="road_border"/></way>'
               for n, a, b in ((11, 1, 2), (12, 3, 4)))
LANELET = ('<relation id="20"><member type="way" ref="12" role="left"/><member type="way" ref="11" role="right"/>'
           '<tag k="type" v="lanelet"/><tag k="location" v="urban"/><tag k="subtype" v="road"/>'
           '<tag k="one_way" v="maybe"/></relation>')


def test_faults_are_told_with_their_places(run, read_layer, tmp_path):
    path = tmp_path / "map.osm"
    path.write_text(f"{HEAD}{NODES}{WAYS}{LANELET}</osm>", encoding="utf-8")
    results = run(ALGORITHM, {"INPUT": str(path), "OUTPUT": str(tmp_path / "faults.gpkg"),
                              "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert (results["LANELETS"], results["ERRORS"]) == (1, 1)
    rows = read_layer(results["OUTPUT"])
    (error,) = [row for row in rows if row.attributes["severity"] == "error"]
    assert error.attributes["rule"] == "Lane.RoadLaneletAttribute-002" and error.attributes["element"] == "lanelet 20"
    assert error.attributes["source"] == "Autoware"
    assert error.geometry.asPoint().x() == pytest.approx(139.7505, abs=1e-4)
    warnings = {row.attributes["rule"] for row in rows if row.attributes["severity"] == "warning"}
    assert {"mapping.bool_tags", "File.Height-001"} <= warnings and results["WARNINGS"] == len(warnings)
    assert "Lane.RoadLaneletAttribute-002" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_rules_left_out_are_not_told(run, tmp_path):
    path = tmp_path / "map.osm"
    path.write_text(f"{HEAD}{NODES}{WAYS}{LANELET}</osm>", encoding="utf-8")
    results = run(ALGORITHM, {"INPUT": str(path), "EXCLUDE": "Lane.Road, mapping.", "OUTPUT": "memory:"})
    assert results["ERRORS"] == 0
    with pytest.raises(Exception, match="begins with Nothing"):
        run(ALGORITHM, {"INPUT": str(path), "EXCLUDE": "Nothing", "OUTPUT": "memory:"})


def test_file_without_lanelets_is_refused(run, tmp_path):
    path = tmp_path / "map.osm"
    path.write_text(f"{HEAD}{NODES}</osm>", encoding="utf-8")
    with pytest.raises(Exception, match="holds no lanelets"):
        run(ALGORITHM, {"INPUT": str(path), "OUTPUT": "memory:"})
