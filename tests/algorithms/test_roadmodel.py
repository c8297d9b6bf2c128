"""urbanmap:roadmodel through Processing."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

ALGORITHM = "urbanmap:roadmodel"
EAST_WEST = [[-60, -3], [60, -3], [60, 3], [-60, 3]]
NORTH = [[-2, 3], [2, 3], [2, 60], [-2, 60]]
BRIDGE = [[20, -5], [32, -5], [32, 5], [20, 5]]
X, Y = -5000.0, -35000.0


def layer(path, rings, crs="EPSG:6677", kind="Polygon"):
    """A GeoJSON file of shapes about a place in Tokyo."""
    places = [[[x + X, y + Y] for x, y in ring] for ring in rings]
    shapes = [{"type": "Feature", "properties": {}, "geometry": {
        "type": kind, "coordinates": [[*ring, ring[0]]] if kind == "Polygon" else ring}} for ring in places]
    text = {"type": "FeatureCollection", "features": shapes,
            "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{crs.partition(':')[2]}"}}}
    path.write_text(json.dumps(text), encoding="utf-8")
    return str(path)


def test_surfaces_lines_citygml_and_report(run, read_layer, tmp_path):
    results = run(ALGORITHM, {
        "ROADS": layer(tmp_path / "roads.geojson", [EAST_WEST, NORTH]),
        "BRIDGES": layer(tmp_path / "bridges.geojson", [BRIDGE]), "FUNCTION": "4", "DATA_DATE": "2026-04-01",
        "OUTPUT": str(tmp_path / "surfaces.gpkg"), "OUTPUT_AXES": str(tmp_path / "axes.gpkg"),
        "OUTPUT_FINDINGS": str(tmp_path / "findings.gpkg"), "OUTPUT_CITYGML": str(tmp_path / "city"),
        "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert (results["SURFACES"], results["JUNCTIONS"], results["FINDINGS"]) == (6, 1, 0)
    rows = [row.attributes for row in read_layer(results["OUTPUT"])]
    assert sorted(row["kind"] for row in rows) == ["bridge", "junction", "road", "road", "road", "road"]
    assert {row["function"] for row in rows} == {"4"} and {row["source"] for row in rows} == {"official"}
    assert sum(row["area"] for row in rows) == pytest.approx(720 + 228)
    assert {row.attributes["road_id"] for row in read_layer(results["OUTPUT_AXES"])} == set(range(1, 7))
    files = list((tmp_path / "city" / "udx" / "tran").iterdir())
    assert len(files) == 1 and "tran:Road" in files[0].read_text(encoding="utf-8")
    assert "6 surfaces" in (tmp_path / "report.html").read_text(encoding="utf-8")
    checked = run("urbanmap:checkcitymodel", {"INPUT_FOLDER": str(tmp_path / "city"), "OUTPUT": "memory:"})
    assert (checked["OBJECTS"], checked["ERRORS"], checked["WARNINGS"]) == (6, 0, 0)


def test_what_cannot_be_used_is_refused_in_one_sentence(run, tmp_path):
    roads = layer(tmp_path / "roads.geojson", [EAST_WEST, NORTH])
    with pytest.raises(Exception, match="degrees"):
        run(ALGORITHM, {"ROADS": layer(tmp_path / "degrees.geojson", [EAST_WEST], "EPSG:6668"), "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="no polygons or lines"):
        run(ALGORITHM, {"ROADS": layer(tmp_path / "points.geojson", [[[0, 0], [9, 9]]], kind="MultiPoint"),
                        "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="77 is no code"):
        run(ALGORITHM, {"ROADS": roads, "FUNCTION": "77", "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="is no day"):
        run(ALGORITHM, {"ROADS": roads, "DATA_DATE": "April", "OUTPUT": "memory:"})
    other = layer(tmp_path / "bridges.geojson", [BRIDGE], "EPSG:6676")
    with pytest.raises(Exception, match="Bridges"):
        run(ALGORITHM, {"ROADS": roads, "BRIDGES": other, "OUTPUT": "memory:"})


RDEDG = """<?xml version="1.0" encoding="UTF-8"?>
<Dataset xmlns:gml="http://www.opengis.net/gml/3.2" xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema" gml:id="D">
<RdEdg gml:id="K1"><fid>1</fid><orgGILvl>2500</orgGILvl><loc><gml:Curve gml:id="K1-g" srsName="fguuid:jgd2011.bl">
<gml:segments><gml:LineStringSegment><gml:posList>35.69 139.76 35.691 139.761</gml:posList></gml:LineStringSegment>
</gml:segments></gml:Curve></loc><type>x</type></RdEdg></Dataset>"""


def test_edges_of_the_gsi_in_degrees_are_to_be_reprojected(run, tmp_path):
    path = tmp_path / "FG-GML-533946-RdEdg-20240401-0001.xml"
    path.write_text(RDEDG, encoding="utf-8")
    with pytest.raises(Exception, match="degrees in .*reproject"):
        run(ALGORITHM, {"ROADS": str(path), "OUTPUT": "memory:"})


def test_edges_that_do_not_close_are_findings(run, read_layer, tmp_path):
    lines = [[[-60, -3], [60, -3]], [[60, 3], [-60, 3]], [[200, 0], [300, 0]]]
    results = run(ALGORITHM, {"ROADS": layer(tmp_path / "edges.geojson", lines, kind="LineString"),
                              "OUTPUT": "memory:", "OUTPUT_FINDINGS": str(tmp_path / "findings.gpkg")})
    assert results["SURFACES"] == 1 and results["FINDINGS"] == 2
    assert {row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])} == {"edge not closed"}


def test_roads_that_operators_cut_are_cut_anew(run, read_layer, real_data, tmp_path):
    files = [real_data / "roads" / f"394271{number}2_tran_6697_op.gml" for number in (6, 7)]
    if not all(file.exists() for file in files):
        pytest.skip("the roads are not there")
    for file in files:
        shutil.copy(file, tmp_path)
    loaded = run("urbanmap:loadcitymodel", {"INPUT_FOLDER": str(tmp_path), "OUTPUT": "memory:",
                                            "OUTPUT_ROADS": str(tmp_path / "roads.gpkg")})
    rows = read_layer(loaded["OUTPUT_ROADS"])
    junctions = sum(row.attributes["section"] == "4" for row in rows)
    assert (len(rows), junctions, loaded["BUILDINGS"]) == (206, 63, 0)
    bridges = f"{loaded['OUTPUT_ROADS']}|layername=roads|subset=section = '3'"
    made = run(ALGORITHM, {"ROADS": loaded["OUTPUT_ROADS"], "BRIDGES": bridges, "DATA_DATE": "2026-04-01",
                           "OUTPUT": str(tmp_path / "surfaces.gpkg"), "OUTPUT_CITYGML": str(tmp_path / "city")})
    assert made["SURFACES"] == pytest.approx(206, rel=0.05) and made["JUNCTIONS"] == pytest.approx(63, rel=0.1)
    surfaces = read_layer(made["OUTPUT"])
    assert {row.attributes["function"] for row in surfaces} == {row.attributes["function"] for row in rows}
    assert sum(row.attributes["kind"] == "bridge" for row in surfaces) == 15
    assert sum(row.geometry.area() for row in surfaces) == pytest.approx(sum(row.geometry.area() for row in rows),
                                                                        rel=1e-5)
    checked = run("urbanmap:checkcitymodel", {"INPUT_FOLDER": str(tmp_path / "city"), "OUTPUT": "memory:"})
    assert (checked["OBJECTS"], checked["ERRORS"], checked["WARNINGS"]) == (made["SURFACES"], 0, 0)


def survey_layers(tmp_path):
    """Edges and upper edges of the crossing of known measures, its roads and stop lines, as files."""
    from tests.core.surveyed_scene import crossing, official

    def lines(path, rows):
        shapes = [{"type": "Feature", "properties": properties, "geometry": {
            "type": kind, "coordinates": coordinates}} for properties, kind, coordinates in rows]
        path.write_text(json.dumps({"type": "FeatureCollection", "features": shapes, "crs": {
            "type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}}}), encoding="utf-8")
        return str(path)

    def moved(points):
        return [[x + X, y + Y, *more] for x, y, *more in points]

    edges = [({"edge_id": number, "kind": "kerb", "height": one.height, "sigma": one.sigma, "sigma_z": one.sigma_z,
               "chain": one.chain, "gap": 0.0}, one) for number, one in enumerate(crossing())]
    stops = [[[-18, 0], [-18, 6]], [[18, 0], [18, -6]], [[0, 18], [4, 18]], [[0, -18], [-4, -18]]]
    return {
        "EDGES": lines(tmp_path / "edges.geojson", [(row, "LineString", moved(one.foot.tolist()))
                                                    for row, one in edges]),
        "TOPS": lines(tmp_path / "tops.geojson", [({"edge_id": row["edge_id"]}, "LineString", moved(one.top.tolist()))
                                                  for row, one in edges]),
        "ROADS": lines(tmp_path / "official.geojson", [({}, "Polygon", [moved(official().exterior.coords)])]),
        "STOP_LINES": lines(tmp_path / "stops.geojson", [({"class": "stop line"}, "LineString", moved(stop))
                                                         for stop in stops])}


def test_a_survey_gives_areas_steps_citygml_and_report(run, read_layer, tmp_path):
    results = run(ALGORITHM, {
        **survey_layers(tmp_path), "LOD": "3.3", "DATA_DATE": "2026-04-01", "OUTPUT": str(tmp_path / "roads.gpkg"),
        "OUTPUT_AREAS": str(tmp_path / "areas.gpkg"), "OUTPUT_STEPS": str(tmp_path / "steps.gpkg"),
        "OUTPUT_FINDINGS": str(tmp_path / "findings.gpkg"), "OUTPUT_CITYGML": str(tmp_path / "city"),
        "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert (results["SURFACES"], results["JUNCTIONS"]) == (5, 1)
    rows = [row.attributes for row in read_layer(results["OUTPUT_AREAS"])]
    assert {row["kind"] for row in rows} == {"carriageway", "junction", "sidewalk", "road, not surveyed"}
    assert {row["source"] for row in rows if row["kind"] == "carriageway"} == {"measured"}
    steps = [row.attributes for row in read_layer(results["OUTPUT_STEPS"])]
    assert all(row["height"] == pytest.approx(0.15, abs=2e-3) for row in steps)
    assert {row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])} >= {"end of the survey"}
    (file,) = (tmp_path / "city" / "udx" / "tran").iterdir()
    text = file.read_text(encoding="utf-8")
    assert text.count("<tran:TrafficArea ") == sum(row["kind"] != "road, not surveyed" for row in rows)
    assert "LOD3.3" in (tmp_path / "report.html").read_text(encoding="utf-8")
    checked = run("urbanmap:checkcitymodel", {"INPUT_FOLDER": str(tmp_path / "city"), "OUTPUT": "memory:"})
    assert (checked["OBJECTS"], checked["ERRORS"], checked["WARNINGS"]) == (5, 0, 0)
    run("urbanmap:exportcitymodel", {"CITY_MODEL": str(tmp_path / "city"), "OUTPUT_CITYGML": str(tmp_path / "again"),
                                     "OUTPUT_CITYJSON": str(tmp_path / "roads.city.json")})
    roads = json.loads((tmp_path / "roads.city.json").read_text(encoding="utf-8"))["CityObjects"].values()
    areas = [area for road in roads for shape in road["geometry"] for area in shape.get("semantics", {}).get(
        "surfaces", ())]
    assert len(roads) == 5 and len(areas) == sum(row["kind"] != "road, not surveyed" for row in rows)
    checked = run("urbanmap:checkcitymodel", {"INPUT_FOLDER": str(tmp_path / "again"), "OUTPUT": "memory:"})
    assert (checked["OBJECTS"], checked["ERRORS"], checked["WARNINGS"]) == (5, 0, 0)


def test_a_model_of_which_hardly_an_edge_was_measured_is_called_bad(run, tmp_path):
    """As under snow: all edges are doubtful, so nothing of the model can be believed unseen."""
    layers = survey_layers(tmp_path)
    for status, level in (("measured", "look"), ("doubtful", "bad")):
        table = json.loads(Path(layers["EDGES"]).read_text(encoding="utf-8"))
        for feature in table["features"]:
            feature["properties"] |= {"status": status, "reason": "its face is not seen"}
        Path(layers["EDGES"]).write_text(json.dumps(table), encoding="utf-8")
        run(ALGORITHM, {**layers, "LOD": "3.3", "OUTPUT": "memory:", "OUTPUT_AREAS": "memory:",
                        "OUTPUT_REPORT": str(tmp_path / "report.html")})
        text = (tmp_path / "report.html").read_text(encoding="utf-8")
        assert f'class="verdict {level}"' in text and ("Only 0% of the borders" in text) == (level == "bad")


def test_a_level_without_what_it_is_made_of_is_refused(run, tmp_path):
    with pytest.raises(Exception, match="Measured edges"):
        run(ALGORITHM, {"LOD": "3.0", "ROADS": layer(tmp_path / "roads.geojson", [EAST_WEST]), "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="Edges or surfaces of roads"):
        run(ALGORITHM, {"LOD": "1", "EDGES": survey_layers(tmp_path)["EDGES"], "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="edge_id"):
        run(ALGORITHM, {"LOD": "3.0", "EDGES": survey_layers(tmp_path)["EDGES"],
                        "TOPS": survey_layers(tmp_path)["STOP_LINES"], "OUTPUT": "memory:"})
