"""urbanmap:roadedges through Processing."""

from __future__ import annotations

import re
import sqlite3

import laspy
import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.core.road_scene import KERB_AT, Street, to_local, write_drive

ALGORITHM = "urbanmap:roadedges"


@pytest.fixture
def drive(tmp_path):
    def write(street=None, **more):
        trajectory = write_drive(tmp_path / "plain.las", street or Street(length=30.0), **more)
        cloud = laspy.read(tmp_path / "plain.las")
        cloud.header.add_crs(CRS.from_epsg(6677))
        cloud.write(tmp_path / "drive.las")
        rows = np.column_stack([trajectory.time, trajectory.place, trajectory.angles])
        np.savetxt(tmp_path / "drive.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
        return {"POINTS": [str(tmp_path / "drive.las")], "TRAJECTORY": str(tmp_path / "drive.csv")}
    return write


def outputs(tmp_path, **more):
    return {"OUTPUT": str(tmp_path / "edges.gpkg"), **more}


def test_heights_in_feet_are_refused(run, drive, tmp_path):
    """A kerb of 12 cm would be one of 39, higher than any."""
    given = drive()
    cloud = laspy.read(tmp_path / "drive.las")
    cloud.header.vlrs.clear()
    cloud.header.add_crs(CRS.from_user_input("EPSG:6677+8228"))
    cloud.write(tmp_path / "drive.las")
    with pytest.raises(Exception, match=r"counts heights in units of 0\.3048 m; convert them to metres"):
        run(ALGORITHM, {**given, **outputs(tmp_path)})


def test_edges_and_tops_are_lines_in_space(run, read_layer, drive, tmp_path):
    results = run(ALGORITHM, {**drive(), "OUTPUT_TOPS": str(tmp_path / "tops.gpkg"), **outputs(tmp_path)})
    (edge,), (top,) = read_layer(results["OUTPUT"]), read_layer(results["OUTPUT_TOPS"])
    assert (edge.attributes["kind"], edge.attributes["status"]) == ("kerb", "measured")
    assert edge.attributes["sigma"] == pytest.approx(results["MEDIAN_SIGMA"]) and results["MEDIAN_SIGMA"] > 0.01
    foot, crest = (shapely.get_coordinates(shapely.from_wkt(row.wkt), include_z=True) for row in (edge, top))
    assert np.abs(to_local(foot, 0.0)[:, 1] - KERB_AT).max() < 0.02
    assert np.median(crest[:, 2] - foot[:, 2]) == pytest.approx(edge.attributes["height"], abs=1e-6)
    assert results["KERB_LENGTH"] == pytest.approx(30.0, abs=2.0) and results["EDGES"] == 1


def test_edges_objects_and_walls_come_together(run, drive, polygon_layer, tmp_path):
    wall = "PolygonZ ((-7000 -34009 10, -6990 -34009 10, -6990 -34009 14, -7000 -34009 10))"
    run(ALGORITHM, {**drive(), "OUTPUT_PACKAGE": str(tmp_path / "all.gpkg"), **outputs(tmp_path),
                    "WALLS": polygon_layer([wall], "EPSG:6677", {"building_id": ["b 7"], "sigma": [0.02]},
                                           kind="PolygonZ"),
                    "OBJECTS": polygon_layer(["PointZ (-6995 -34003 14)"], "EPSG:6677", {"name": ["sign"]},
                                             kind="PointZ")})
    with sqlite3.connect(tmp_path / "all.gpkg") as database:
        kinds = dict(database.execute("SELECT table_name, geometry_type_name FROM gpkg_geometry_columns"))
        assert kinds == {"edges": "LINESTRING", "upper_edges": "LINESTRING", "objects": "POINT", "walls": "POLYGON"}
        assert database.execute("SELECT building_id, sigma FROM walls").fetchall() == [("b 7", 0.02)]
        assert database.execute("SELECT name FROM objects").fetchall() == [("sign",)]
        assert database.execute("SELECT kind FROM edges").fetchall() == [("kerb",)]


def test_objects_without_a_place_to_go_are_refused(run, drive, polygon_layer, tmp_path):
    with pytest.raises(Exception, match="name the GeoPackage"):
        run(ALGORITHM, {**drive(), **outputs(tmp_path),
                        "OBJECTS": polygon_layer(["Point (0 0)"], "EPSG:6677", {}, kind="Point")})


def test_a_road_without_kerbs_says_so(run, read_layer, drive, feedback, tmp_path):
    results = run(ALGORITHM, {**drive(Street(length=30.0, kerb=0.0)), **outputs(tmp_path)})
    assert results["EDGES"] == 0 and not read_layer(results["OUTPUT"]) and results["MEDIAN_SIGMA"] is None
    assert any("No kerb was found" in text for text in feedback.warnings)
    (told,) = [text for text in feedback.infos if "No kerb was found beside" in text]
    left, right = re.search(r"beside ([0-9]+) m .* and ([0-9]+) m on", told).groups()
    assert left == right and int(left) > 20
    (told,) = [text for text in feedback.infos if "do not show surely" in text]
    least, asked = map(float, re.search(r"lower than ([0-9.]+) cm .* asked for, ([0-9.]+) cm", told).groups())
    assert asked == 3.0 and 3.5 < least < 4.5


def test_trajectory_of_another_place_is_refused(run, drive, tmp_path):
    inputs = drive()
    rows = np.loadtxt(inputs["TRAJECTORY"], delimiter=",", skiprows=1)
    rows[:, 1] += 5000.0
    np.savetxt(inputs["TRAJECTORY"], rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    with pytest.raises(Exception, match="from where the vehicle was"):
        run(ALGORITHM, {**inputs, **outputs(tmp_path)})


def test_sparse_points_are_refused(run, drive, tmp_path):
    with pytest.raises(Exception, match="ground points a square metre"):
        run(ALGORITHM, {**drive(Street(length=30.0, spacing=0.6)), **outputs(tmp_path)})


def test_the_lane_map_takes_the_edges(run, read_layer, drive, polygon_layer, tmp_path):
    """A line 3.2 m before the kerb and a drive between them: the lane's right bound is the kerb."""
    inputs = drive(Street(length=40.0))
    edges = run(ALGORITHM, {**inputs, **outputs(tmp_path)})["OUTPUT"]
    line = shapely.LineString([(-7000, -34000 - KERB_AT + 3.2, 10.0), (-6960, -34000 - KERB_AT + 3.2, 10.0)]).wkt
    rows = np.loadtxt(inputs["TRAJECTORY"], delimiter=",", skiprows=1)
    rows[:, 2] -= 2.4
    np.savetxt(tmp_path / "beside.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    results = run("urbanmap:vectormap", {
        "LINES": polygon_layer([line], "EPSG:6677", {"class": ["solid"]}, kind="LineStringZ"), "EDGES": edges,
        "TRAJECTORY": [str(tmp_path / "beside.csv")], "OUTPUT_LANES": str(tmp_path / "lanes.gpkg"),
        "OUTPUT_BOUNDS": str(tmp_path / "bounds.gpkg")})
    lane, = (row.attributes for row in read_layer(results["OUTPUT_LANES"]))
    assert lane["width"] == pytest.approx(3.2, abs=0.03)
    assert sorted(row.attributes["class"] for row in read_layer(results["OUTPUT_BOUNDS"])) == ["road border", "solid"]
