"""urbanmap:vectormap through Processing."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
import shapely

ALGORITHM = "urbanmap:vectormap"
EAST, NORTH = -7000.0, -34000.0


@pytest.fixture
def lines(polygon_layer):
    wkts = [shapely.LineString([(EAST, NORTH + y, 12.0), (EAST + 60, NORTH + y, 12.0)]).wkt for y in (0.0, 3.25, 6.5)]
    return polygon_layer(wkts, "EPSG:6677", {"class": ["solid", "dashed", "solid"]}, kind="LineStringZ")


@pytest.fixture
def drive(tmp_path):
    rows = [f"{t},{EAST + 5 * t},{NORTH + 4.9},13.5,0,0,90" for t in np.arange(0, 12.1, 0.5)]
    path = tmp_path / "drive.csv"
    path.write_text("time,x,y,z,roll,pitch,heading\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return str(path)


def outputs(tmp_path, **more):
    return {"OUTPUT_LANES": str(tmp_path / "lanes.gpkg"), "OUTPUT_BOUNDS": str(tmp_path / "bounds.gpkg"), **more}


def test_lanes_bounds_findings_and_files(run, read_layer, lines, drive, tmp_path):
    results = run(ALGORITHM, {"LINES": lines, "TRAJECTORY": [drive], **outputs(
        tmp_path, OUTPUT_CENTRES=str(tmp_path / "centres.gpkg"), OUTPUT_FINDINGS=str(tmp_path / "findings.gpkg"),
        OUTPUT_LANELET2=str(tmp_path / "map.osm"), OUTPUT_PROJECTOR=str(tmp_path / "map_projector_info.yaml"))})
    lanes = [row.attributes for row in read_layer(results["OUTPUT_LANES"])]
    assert results["LANES"] == 2 and results["LENGTH"] == pytest.approx(120.0, abs=0.1)
    assert sorted(lane["evidence"] for lane in lanes) == ["beside a dashed line", "drive"]
    driven = next(lane for lane in lanes if lane["evidence"].startswith("drive"))
    assert driven["width"] == pytest.approx(3.25) and driven["right"] == 1 - driven["lane_id"]
    assert {"yields_to", "yields_by", "confidence"} <= set(driven)
    assert len(read_layer(results["OUTPUT_BOUNDS"])) == 3
    centres = read_layer(results["OUTPUT_CENTRES"])
    assert all("Z" in row.wkt.split("(")[0] for row in centres)
    assert results["FINDINGS"] == len(read_layer(results["OUTPUT_FINDINGS"])) == 4
    text = (tmp_path / "map.osm").read_text(encoding="utf-8")
    assert text.count('v="lanelet"') == 2 and 'k="ele" v="12.0000"' in text
    assert "projector_type: TransverseMercator" in (tmp_path / "map_projector_info.yaml").read_text(encoding="utf-8")


def test_ways_follow_the_confidence_asked_for_and_tell_who_yields(run, read_layer, polygon_layer, tmp_path):
    def line(*points):
        return shapely.LineString([(EAST + x, NORTH + y, 12.0) for x, y in points]).wkt

    along = [line((x, y), (x + 60, y)) for x in (0.0, 90.0) for y in (3.5, 0.0, -3.5)]
    across = [line((x, y), (x, y + 60)) for y in (-75.0, 15.0) for x in (71.5, 75.0, 78.5)]
    stop_lines = [line((60.3, 0.1), (60.3, 3.4)), line((89.7, -3.4), (89.7, -0.1)),
                  line((71.6, -15.0), (74.9, -15.0)), line((75.1, 15.0), (78.4, 15.0))]
    layer = polygon_layer([*along, *across, *stop_lines], "EPSG:6677", {
        "class": ["solid"] * 12 + ["stop line"] * 4, "colour": ["white", "yellow", "white"] * 4 + ["white"] * 4},
        kind="LineStringZ")
    drives = []
    for number, (begin, end) in enumerate((((-10, 1.7), (50, 1.7)), ((160, -1.7), (100, -1.7)),
                                           ((73.2, -80), (73.2, -30)), ((76.8, 80), (76.8, 30)),
                                           ((100, 1.7), (160, 1.7)), ((50, -1.7), (-10, -1.7)),
                                           ((73.2, 30), (73.2, 80)), ((76.8, -30), (76.8, -80)))):
        places = np.linspace(begin, end, 30)
        heading = np.degrees(np.arctan2(end[0] - begin[0], end[1] - begin[1])) % 360
        rows = [f"{t},{EAST + x},{NORTH + y},13.5,0,0,{heading}" for t, (x, y) in enumerate(places)]
        drives.append(tmp_path / f"drive{number}.csv")
        drives[-1].write_text("time,x,y,z,roll,pitch,heading\n" + "\n".join(rows) + "\n", encoding="utf-8")
    found = {}
    for confidence in (0.9, 1.0):
        results = run(ALGORITHM, {"LINES": layer, "TRAJECTORY": list(map(str, drives)), "WAY_CONFIDENCE": confidence,
                                  **outputs(tmp_path, OUTPUT_FINDINGS=str(tmp_path / "findings.gpkg"))})
        found[confidence] = ([row.attributes for row in read_layer(results["OUTPUT_LANES"])],
                             [row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])])
    ways = [lane for lane in found[0.9][0] if lane["kind"] == "virtual"]
    assert len(ways) == 12 and all(0.9 <= way["confidence"] < 1.0 for way in ways)
    assert {way["yields_by"] for way in ways if way["yields_to"]} >= {"side it comes from"}
    assert found[0.9][1].count("right of way inferred") == 1
    assert not [lane for lane in found[1.0][0] if lane["kind"] == "virtual"]
    assert found[1.0][1].count("way possible") == 12


def test_without_trajectory_it_says_that_directions_are_unknown(run, lines, feedback, tmp_path):
    results = run(ALGORITHM, {"LINES": lines, **outputs(tmp_path)})
    assert results["LANES"] == 0 and results["FINDINGS"] == 3
    assert any("Without trajectories" in text for text in feedback.warnings)


def test_drive_of_another_place_is_told(run, lines, feedback, tmp_path):
    path = tmp_path / "far.csv"
    path.write_text("time,x,y,z,roll,pitch,heading\n0,0,0,0,0,0,90\n9,50,0,0,0,0,90\n", encoding="utf-8")
    run(ALGORITHM, {"LINES": lines, "TRAJECTORY": [str(path)], **outputs(tmp_path)})
    assert any("No lane was made" in text for text in feedback.warnings)


def test_lines_without_class_are_refused(run, polygon_layer, tmp_path):
    layer = polygon_layer(["LineString (0 0, 9 0)"], "EPSG:6677", {}, kind="LineString")
    with pytest.raises(Exception, match="no field class"):
        run(ALGORITHM, {"LINES": layer, **outputs(tmp_path)})


def test_missing_trajectory_is_refused_before_the_run(run, lines, tmp_path):
    with pytest.raises(Exception, match="does not exist"):
        run(ALGORITHM, {"LINES": lines, "TRAJECTORY": [str(tmp_path / "none.csv")], **outputs(tmp_path)})


def test_bounds_edited_by_hand_keep_their_ids_and_shared_nodes(run, read_layer, lines, drive, polygon_layer, tmp_path):
    first = run(ALGORITHM, {"LINES": lines, "TRAJECTORY": [drive], **outputs(tmp_path)})
    rows = list(read_layer(first["OUTPUT_BOUNDS"]))
    assert sorted(row.attributes["bound_id"] for row in rows) == [0, 1, 2]
    # The dashed one is moved by 0.2 m; ids are others now, and the order is turned round.
    shapes = [shapely.from_wkt(row.wkt.replace("LineStringZ", "LINESTRING Z")) for row in rows][::-1]
    names = [41 + row.attributes["bound_id"] for row in rows][::-1]
    kinds = [row.attributes["class"] for row in rows][::-1]
    moved = [shapely.transform(shape, lambda xyz: xyz + np.array([0.0, 0.2, 0.0]), include_z=True)
             if kind == "dashed" else shape for shape, kind in zip(shapes, kinds)]
    edited = polygon_layer([shape.wkt for shape in moved], "EPSG:6677", {"bound_id": names, "class": kinds},
                           kind="LineStringZ")
    (tmp_path / "second").mkdir()
    second = run(ALGORITHM, {"LINES": edited, "TRAJECTORY": [drive], **outputs(tmp_path / "second")})
    found = {row.attributes["bound_id"]: row for row in read_layer(second["OUTPUT_BOUNDS"])}
    assert sorted(found) == [41, 42, 43] and second["LANES"] == 2
    for name, kind, shape in zip(names, kinds, moved):
        row = found[name]
        there = shapely.from_wkt(row.wkt.replace("LineStringZ", "LINESTRING Z"))
        assert row.attributes["class"] == kind and shapely.hausdorff_distance(there, shape) < 0.05
    # Both lanes have the nodes of the bound between them.
    lanes = [shapely.from_wkt(row.wkt) for row in read_layer(second["OUTPUT_LANES"])]
    between = shapely.get_coordinates(shapely.from_wkt(found[names[kinds.index("dashed")]].wkt.replace(
        "LineStringZ", "LINESTRING Z")))
    assert all({tuple(place) for place in between} <= {tuple(place) for place in shapely.get_coordinates(lane)}
               for lane in lanes)


def test_street_objects_and_rails_go_into_the_files(run, read_layer, lines, drive, polygon_layer, tmp_path):
    def layer(rows, kind, columns):
        return polygon_layer(rows, "EPSG:6677", columns, kind=kind)

    objects = layer([f"POINT Z ({EAST + 20} {NORTH + 9} 12)", f"POINT Z ({EAST + 40} {NORTH + 9} 12)"], "PointZ", {
        "kind": ["lamp post", "signal"], "height": [8.0, 6.0]})
    rails = layer([f"LINESTRING Z ({EAST + 5} {NORTH + 7} 12, {EAST + 25} {NORTH + 7} 12)"], "LineStringZ",
                  {"height": [0.8]})
    results = run(ALGORITHM, {"LINES": lines, "TRAJECTORY": [drive], "OBJECTS": objects, "RAILS": rails, **outputs(
        tmp_path, OUTPUT_FINDINGS=str(tmp_path / "findings.gpkg"), OUTPUT_LANELET2=str(tmp_path / "map.osm"),
        OUTPUT_OPENDRIVE=str(tmp_path / "map.xodr"))})
    osm, drive_file = ((tmp_path / name).read_text(encoding="utf-8") for name in ("map.osm", "map.xodr"))
    assert osm.count('v="pole"') == 2 and osm.count('v="guard_rail"') == 1 and "traffic_light" not in osm
    assert drive_file.count('type="pole"') == 2 and drive_file.count('subtype="guardRail"') == 1
    told = [row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])]
    assert told.count("signal without stop line") == 1
    with pytest.raises(Exception, match="no field kind"):
        run(ALGORITHM, {"LINES": lines, "OBJECTS": layer(["POINT (1 2)"], "Point", {"height": [1.0]}),
                        **outputs(tmp_path)})


def test_orthophoto_shows_the_edge_of_the_road_without_kerbs(run, read_layer, polygon_layer, drive, tmp_path):
    wkts = [shapely.LineString([(EAST, NORTH + y, 12.0), (EAST + 60, NORTH + y, 12.0)]).wkt for y in (3.25, 6.5)]
    lines = polygon_layer(wkts, "EPSG:6677", {"class": ["solid", "dashed"]}, kind="LineStringZ")
    rows = NORTH + 30.0 - 0.1 * (np.arange(400) + 0.5)
    road = np.abs(rows - NORTH - 5.0) < 6.8
    image = np.where(road[:, None, None], [100, 102, 105], [175, 165, 150]) + np.random.default_rng(3).integers(
        -4, 5, (400, 600, 3))
    paths = []
    for crs in ("EPSG:6677", "EPSG:6676"):
        paths.append(tmp_path / f"{crs[-4:]}.tif")
        with rasterio.open(paths[-1], "w", driver="GTiff", width=600, height=400, count=3, dtype="uint8", crs=crs,
                           transform=rasterio.Affine(0.1, 0, EAST, 0, -0.1, NORTH + 30.0)) as target:
            target.write(np.moveaxis(image.astype(np.uint8), 2, 0))
    given = {"LINES": lines, "TRAJECTORY": [drive],
             **outputs(tmp_path, OUTPUT_FINDINGS=str(tmp_path / "findings.gpkg"))}
    results = run(ALGORITHM, {**given, "ORTHOPHOTO": str(paths[0])})
    assert results["LANES"] == 2
    assert "road border" in {row.attributes["class"] for row in read_layer(results["OUTPUT_BOUNDS"])}
    assert "edge from the image" in {row.attributes["kind"] for row in read_layer(results["OUTPUT_FINDINGS"])}
    with pytest.raises(Exception, match="EPSG:6676.*reproject one of them"):
        run(ALGORITHM, {**given, "ORTHOPHOTO": str(paths[1])})
