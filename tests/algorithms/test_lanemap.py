"""urbanmap:lanemap through Processing: polygons of paint and drives become a map and its files."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely

ALGORITHM = "urbanmap:lanemap"
EAST, NORTH = -7000.0, -34000.0


def bar(x0, x1, y, width=0.15):
    return shapely.box(EAST + x0, NORTH + y - width / 2, EAST + x1, NORTH + y + width / 2).wkt


@pytest.fixture
def given(polygon_layer, tmp_path):
    """Two lanes each way of 60 m, dashes between those of one direction, driven both ways in the kerb lanes."""
    paint = [bar(0, 60, y) for y in (-6.5, 0.0, 6.5)]
    paint += [bar(x, x + 3, y) for y in (-3.25, 3.25) for x in range(2, 58, 8)]
    colours = ["white", "yellow", "white"] + ["white"] * (len(paint) - 3)
    trajectories = []
    for number, (y, sign, heading) in enumerate(((4.9, 1, 90), (-4.9, -1, 270))):
        rows = [f"{t},{EAST + 30 + sign * (5 * t - 30)},{NORTH + y},13.5,0,0,{heading}"
                for t in np.arange(0, 12.1, 0.5)]
        path = tmp_path / f"drive{number}.csv"
        path.write_text("time,x,y,z,roll,pitch,heading\n" + "\n".join(rows) + "\n", encoding="utf-8")
        trajectories.append(str(path))
    return {"MARKINGS": polygon_layer(paint, "EPSG:6677", {"colour": colours}), "TRAJECTORY": trajectories}


def outputs(tmp_path, *more):
    return {name: str(tmp_path / f"{name}.{suffix}") for name, suffix in (
        ("OUTPUT_LANES", "gpkg"), ("OUTPUT_BOUNDS", "gpkg"), *more)}


def test_markings_and_drives_become_lanes_and_files(run, read_layer, given, tmp_path):
    results = run(ALGORITHM, {**given, **outputs(tmp_path, ("OUTPUT_LINES", "gpkg"), ("OUTPUT_LANELET2", "osm"),
                                                 ("OUTPUT_OPENDRIVE", "xodr"), ("OUTPUT_REPORT", "html"),
                                                 ("OUTPUT_FINDINGS", "gpkg"))})
    lanes = [row.attributes for row in read_layer(results["OUTPUT_LANES"])]
    assert results["LANES"] == len(lanes) == 4
    assert [lane["width"] for lane in lanes] == pytest.approx([3.25] * 4, abs=0.05)
    assert {row.attributes["class"] for row in read_layer(results["OUTPUT_LINES"])} == {"solid", "dashed"}
    assert (tmp_path / "OUTPUT_LANELET2.osm").read_text(encoding="utf-8").count('v="lanelet"') == 4
    root = ET.parse(tmp_path / "OUTPUT_OPENDRIVE.xodr").getroot()
    (road,) = root.findall("road")
    assert road.get("rule") == "LHT" and sorted(int(lane.get("id")) for lane in road.iter("lane")) == [-2, -1, 0, 1, 2]
    page = (tmp_path / "OUTPUT_REPORT.html").read_text(encoding="utf-8")
    assert "4 lanes of" in page and "not connected" not in page and page.count("<svg") == 1 and "open end" in page
    assert results["FINDINGS"] == len(read_layer(results["OUTPUT_FINDINGS"]))


def test_without_drives_lines_are_made_and_it_is_said_that_directions_are_unknown(run, given, feedback, tmp_path):
    results = run(ALGORITHM, {"MARKINGS": given["MARKINGS"], **outputs(tmp_path, ("OUTPUT_LINES", "gpkg"))})
    assert results["LANES"] == 0 and (tmp_path / "OUTPUT_LINES.gpkg").is_file()
    assert any("Without trajectories" in text for text in feedback.warnings)


def test_missing_trajectory_is_refused_before_anything_runs(run, given, tmp_path):
    with pytest.raises(Exception, match="does not exist"):
        run(ALGORITHM, {**given, "TRAJECTORY": [str(tmp_path / "none.csv")], **outputs(tmp_path)})
    assert not (tmp_path / "OUTPUT_LANES.gpkg").exists()
