"""urbanmap:roadspace through Processing: a drive between kerbs with lines and a sign becomes road areas and objects."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.core import object_scene as scene
from tests.core.road_scene import EAST, KERB_AT, NORTH, Street, to_map, write_drive
from urbanmap_qgis.io.osm import read_osm

ALGORITHM = "urbanmap:roadspace"
STREET = Street(length=60.0, rough=0.06)


@pytest.fixture
def given(polygon_layer, tmp_path):
    """A street between a kerb and a verge, with edge lines, and a sign on the verge."""
    trajectory = write_drive(tmp_path / "plain.las", STREET, more=lambda rng: scene.sign(rng, 30.0, -7.0))
    cloud = laspy.read(tmp_path / "plain.las")
    cloud.header.add_crs(CRS.from_epsg(6677))
    cloud.write(tmp_path / "drive.las")
    rows = np.column_stack([trajectory.time, trajectory.place, trajectory.angles])
    np.savetxt(tmp_path / "drive.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    paint = []
    for across in (-1.75, 1.75):
        ring = shapely.get_coordinates(shapely.box(2.0, across - 0.075, 58.0, across + 0.075))
        paint.append(shapely.Polygon(to_map(np.column_stack([ring, np.zeros(len(ring))]), 0.0)[:, :2]).wkt)
    return {"POINTS": [str(tmp_path / "drive.las")], "TRAJECTORY": str(tmp_path / "drive.csv"), "TRAFFIC": "left",
            "MARKINGS": polygon_layer(paint, "EPSG:6677", {"colour": ["white", "white"]})}


def test_a_drive_becomes_areas_objects_and_city_models(run, read_layer, given, tmp_path):
    results = run(ALGORITHM, {
        **given, "DATA_DATE": "2026-04-01", **{name: str(tmp_path / f"{name}.gpkg") for name in (
            "OUTPUT", "OUTPUT_AREAS", "OUTPUT_STEPS", "OUTPUT_FINDINGS", "OUTPUT_OBJECTS", "OUTPUT_EDGES",
            "OUTPUT_LANES")},
        "OUTPUT_CITYGML": str(tmp_path / "roads"), "OUTPUT_FURNITURE": str(tmp_path / "furniture"),
        "OUTPUT_LANELET2": str(tmp_path / "map.osm"), "OUTPUT_OPENDRIVE": str(tmp_path / "map.xodr"),
        "OUTPUT_REPORT": str(tmp_path / "report.html"), "OUTPUT_OBJECT_REPORT": str(tmp_path / "objects.html")})
    rows = [row.attributes for row in read_layer(results["OUTPUT_AREAS"])]
    kinds = {row["kind"] for row in rows}
    assert "carriageway" in kinds and "sidewalk" not in kinds  # nothing tells where one would end
    assert "no sidewalks" in {row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])}
    signs = [row for row in read_layer(results["OUTPUT_OBJECTS"]) if row.attributes["kind"] == "sign"]
    assert len(signs) == 1 and results["OBJECTS"] >= 1
    assert list((tmp_path / "roads" / "udx" / "tran").glob("*.gml"))
    assert list((tmp_path / "furniture" / "udx" / "frn").glob("*.gml"))
    assert "LOD3.3" in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert read_layer(results["OUTPUT_EDGES"])
    ways = [way.tags.get("type") for way in read_osm(results["OUTPUT_LANELET2"]).ways.values()]
    assert ways.count("pole") >= 1 and ways.count("traffic_sign") == 1
    assert (tmp_path / "map.xodr").read_text(encoding="utf-8").count('type="-1"') >= 1


def test_markings_are_needed(run, given):
    given.pop("MARKINGS")
    with pytest.raises(Exception, match="MARKINGS|[Mm]arkings"):
        run(ALGORITHM, {**given, "OUTPUT": "memory:"})


def test_snow_over_the_kerbs_is_told_and_the_rest_is_kept(run, read_layer, feedback, given, tmp_path):
    """20 cm of snow: neither the kerb nor the border of the verge shows, and the surface is rough all over."""
    write_drive(tmp_path / "snow.las", Street(length=60.0, kerb=0.0, rough=0.0, verge=20.0),
                more=lambda rng: scene.sign(rng, 30.0, -7.0))
    cloud = laspy.read(tmp_path / "snow.las")
    cloud.z = np.asarray(cloud.z) + 0.2 + 0.01 * np.random.default_rng(3).standard_normal(len(cloud.z))
    cloud.header.add_crs(CRS.from_epsg(6677))
    cloud.write(tmp_path / "drive.las")
    results = run(ALGORITHM, {
        **given, **{name: str(tmp_path / f"{name}.gpkg") for name in (
            "OUTPUT", "OUTPUT_AREAS", "OUTPUT_FINDINGS", "OUTPUT_OBJECTS", "OUTPUT_EDGES", "OUTPUT_LANES")},
        "OUTPUT_LANELET2": str(tmp_path / "map.osm"), "OUTPUT_CITYGML": str(tmp_path / "roads"),
        "OUTPUT_REPORT": str(tmp_path / "report.html")})
    sentence = "No road model was made. There are no kerbs or road borders among the edges"
    assert any(sentence in text for text in feedback.warnings)
    assert sentence in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert results["SURFACES"] == 0 and not read_layer(results["OUTPUT"]) and not read_layer(results["OUTPUT_AREAS"])
    assert "OUTPUT_CITYGML" not in results
    assert [row.attributes["kind"] for row in read_layer(results["OUTPUT_OBJECTS"])] == ["sign"]
    assert read_layer(results["OUTPUT_LANES"]) and read_osm(results["OUTPUT_LANELET2"]).ways


def test_a_kerb_on_one_side_is_told_with_its_place(run, read_layer, feedback, polygon_layer, given, tmp_path):
    """Nothing shows the other side, and a line close to the kerb bounds no lane: the edges stay."""
    write_drive(tmp_path / "one.las", Street(length=60.0, verge=20.0))
    cloud = laspy.read(tmp_path / "one.las")
    cloud.header.add_crs(CRS.from_epsg(6677))
    cloud.write(tmp_path / "drive.las")
    ring = shapely.get_coordinates(shapely.box(2.0, 3.2, 58.0, 3.35))
    paint = shapely.Polygon(to_map(np.column_stack([ring, np.zeros(len(ring))]), 0.0)[:, :2]).wkt
    results = run(ALGORITHM, {**given, "MARKINGS": polygon_layer([paint], "EPSG:6677", {"colour": ["white"]}),
                              **{name: str(tmp_path / f"{name}.gpkg") for name in (
                                  "OUTPUT", "OUTPUT_FINDINGS", "OUTPUT_EDGES")}})
    assert any("No road model was made. The edges enclose no carriageway" in text for text in feedback.warnings)
    assert results["SURFACES"] == 0 and read_layer(results["OUTPUT_EDGES"])
    (finding,) = read_layer(results["OUTPUT_FINDINGS"])
    assert finding.attributes["kind"] == "edge without a carriageway" and results["FINDINGS"] == 1
    x, y = shapely.get_coordinates(shapely.from_wkt(finding.wkt))[0]
    assert abs(x - (EAST + 30.0)) < 3.0 and abs(y - (NORTH - KERB_AT)) < 0.1
