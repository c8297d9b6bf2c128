"""What files are: the sample city, real data, and files that are damaged, cut off or named otherwise."""

from __future__ import annotations

import gzip
import json
import shutil
import sqlite3
import struct
import zipfile
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.job.file_facts import KIND_NAMES
from urbanmap_qgis.job.recognition.contents import recognise_file, recognise_files
from urbanmap_qgis.job.roles import parts_of, put_to_use, uses_of
from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"

CITY = {
    "README.txt": "other", "aerial/camera.json": "camera", "aerial/exterior.csv": "exterior",
    "aerial/frame_01.tif": "frame", "aerial/ortho.tif": "orthophoto", "als/als.laz": "points",
    "footprints/FG-GML-533946-BldA-20240401-0001.xml": "gsi_outlines", "footprints/gsi_buildings.gpkg": "outlines",
    "gnss/pass_01.obs": "observations", "gnss/pass_01_trajectory.csv": "trajectory",
    "gnss/satellites.nav": "navigation", "gnss/gnss.json": "other", "lines/calibration.json": "calibration",
    "lines/camera_1.png": "line_image", "lines/camera_1_times.csv": "image_times", "lines/scans.csv.gz": "scans",
    "lines/tie_points.csv": "ties", "mms/calibration.json": "calibration", "mms/survey_01.laz": "points",
    "mms/survey_01_images.csv": "poses", "mms/survey_01_trajectory.csv": "trajectory",
    "models/buildings.city.json": "city_model", "models/buildings.geojson": "outlines",
    "truth/control_survey_01.csv": "control", "truth/edges.gpkg": "lines", "truth/footprints.gpkg": "outlines",
    "truth/ground.tif": "elevation", "truth/markings.gpkg": "markings", "truth/occlusion/frame_01.tif": "frame_mask",
    "truth/summary.json": "other", "truth/wall_offsets.csv": "table", "truth/areas.gpkg": "areas"}
"""Kinds of the sample city's files."""

REAL = {
    "aerial/drift/*.jpg": "frame", "aerial/odm/**/100_*.tif": "frame", "aerial/odm/**/camera.json": "camera",
    "aerial/odm/**/exterior.csv": "exterior", "aerial/odm/dsm.tif": "elevation", "aerial/odm/recon*.json": "other",
    "aerial/sind/*.osm": "lane_map", "aerial/sind/*.png": "frame", "aerial/uav_markings/*.JPG": "frame",
    "aerial/uav_markings/*.json": "other", "aerial/us_tiles/lanes_*.geojson": "lines",
    "aerial/us_tiles/tile_*.jpg": "orthophoto", "als/**/*.laz": "points", "als/**/outlines*.gpkg": "outlines",
    "als/ign/*_buildings.gpkg": "outlines", "als/**/*.gml": "city_model", "als/**/*.city.json": "city_model",
    "als/**/*.obj": "mesh", "als/delft_west/*_roofs.gpkg": "roofs", "als/delft_west/peers.csv": "table",
    "als/ign/test_data_rgb.tif": "orthophoto", "als/plateau/**/*.jpg": "texture",
    "city/aerial/frame_*.tif": "frame", "city/aerial/camera.json": "camera", "city/aerial/exterior.csv": "exterior",
    "city/aerial/ortho.tif": "orthophoto", "city/als/*.laz": "points", "city/mms/*.laz": "points",
    "city/footprints/*.xml": "gsi_outlines", "city/footprints/*.gpkg": "outlines", "city/mms/*_images.csv": "poses",
    "city/mms/calibration.json": "calibration", "city/**/*_trajectory.csv": "trajectory",
    "city/truth/control_*.csv": "control", "city/truth/markings.gpkg": "markings", "city/truth/areas.gpkg": "areas",
    "city/truth/occlusion/frame_*.tif": "frame_mask", "city/truth/occlusion/ortho*.tif": "raster",
    "city/truth/ground.tif": "elevation", "city/truth/vehicles.gpkg": "areas", "city/truth/visible_count.tif": "raster",
    "gnss/**/*.obs": "observations", "gnss/**/*.20?": "navigation", "gnss/**/*.19?": "navigation",
    "gnss/**/trajectory.csv": "trajectory", "gnss/**/groundTruth*.csv": "table", "gnss/**/*.kml": "lines",
    "gnss/**/buildings.gpkg": "outlines", "gsi/*.xml": "gsi_outlines", "gsi/*.geojson": "outlines",
    "mobile/**/trajectory.csv": "trajectory", "mobile/**/*_trajectory.csv": "trajectory", "mobile/**/*.laz": "points",
    "mobile/**/calibration.json": "calibration", "mobile/**/ground.tif": "elevation", "mobile/**/*.feather": "other",
    "mobile/**/*.npz": "other", "mobile/motorway_lines/*.gpkg": "lines", "roads/*.gml": "city_model",
    "rules/autoware/map/**/*.osm": "lane_map", "rules/plateau4/**/*.gml": "city_model", "**/LICENSE*.txt": "other"}
"""Kinds of real files by patterns."""


def test_a_line_alone_is_no_table(tmp_path):
    (tmp_path / "note.txt").write_text("delivered, complete", encoding="utf-8")
    assert recognise_file(tmp_path / "note.txt")[0].kind == "other"


@pytest.mark.parametrize("place", CITY)
def test_files_of_the_sample_city(small_city, place):
    found = recognise_file(small_city / place)
    assert found[0].kind == CITY[place] and not any(item.problem for item in found)
    assert found[0].kind in KIND_NAMES


def test_facts_of_the_sample_city(small_city):
    cloud, = recognise_file(small_city / "mms/survey_01.laz")
    drive, = recognise_file(small_city / "mms/survey_01_trajectory.csv")
    outlines, = recognise_file(small_city / "footprints/gsi_buildings.gpkg")
    official, = recognise_file(small_city / "footprints/FG-GML-533946-BldA-20240401-0001.xml")
    observed, = recognise_file(small_city / "gnss/pass_01.obs")
    assert "6677" in cloud.crs_wkt and cloud.count > 100_000
    assert drive.times[0] <= cloud.times[0] < cloud.times[1] <= drive.times[1]
    assert cloud.extent[0] <= drive.extent[0] and drive.extent[2] <= cloud.extent[2]
    assert outlines.count == official.count > 5
    assert 139.7 < official.extent[0] < official.extent[2] < 139.8 and 35.6 < official.extent[1] < 35.8
    assert 139.7 < observed.extent[0] < 139.8 and observed.times[0] - drive.times[0] > 1.39e9
    layers = recognise_file(small_city / "truth/markings.gpkg")
    assert [item.layer for item in layers] == ["aerial", "mms"] and layers[0].source.endswith("|layername=aerial")


@pytest.mark.skipif(not DATA.is_dir(), reason="real data are not beside the checkout")
@pytest.mark.slow
def test_real_files_are_told():
    """More than 200 real files of all kinds; the worst defect is a confident wrong kind."""
    checked, wrong = set(), {}
    for pattern, kind in REAL.items():
        for path in DATA.glob(pattern):
            if path in checked or path.name.startswith("."):
                continue
            checked.add(path)
            found = recognise_file(path)
            if kind not in {item.kind for item in found} or any(item.problem for item in found):
                wrong[str(path.relative_to(DATA))] = [(item.kind, item.problem) for item in found]
    assert not wrong
    assert len(checked) >= 200


def cut(path: Path, place: Path, share: float = 0.6) -> Path:
    data = path.read_bytes()
    place.write_bytes(data[:int(len(data) * share)])
    return place


@pytest.mark.parametrize("place", [
    "als/als.laz", "aerial/frame_01.tif", "aerial/ortho.tif", "footprints/gsi_buildings.gpkg",
    "footprints/FG-GML-533946-BldA-20240401-0001.xml", "models/buildings.city.json", "models/buildings.geojson",
    "aerial/camera.json", "mms/calibration.json", "lines/camera_1.png"])
def test_cut_files_get_a_sentence(small_city, tmp_path, place):
    found, *_ = recognise_file(cut(small_city / place, tmp_path / Path(place).name))
    assert found.problem.endswith(".") and Path(place).name in found.problem and not found.usable


@pytest.mark.parametrize("name", ["empty.laz", "empty.csv", "empty.gpkg", "empty"])
def test_empty_files_get_a_sentence(tmp_path, name):
    (tmp_path / name).touch()
    assert "is empty" in recognise_file(tmp_path / name)[0].problem


@pytest.mark.parametrize("suffix", [".laz", ".gpkg", ".shp", ".zip"])
def test_noise_under_a_known_name_gets_a_sentence(tmp_path, suffix):
    path = tmp_path / f"noise{suffix}"
    path.write_bytes(np.random.default_rng(5).integers(0, 256, 5000, dtype=np.uint8).tobytes())
    assert recognise_file(path)[0].problem.endswith(".")


@pytest.mark.parametrize("place", ["als/als.laz", "footprints/gsi_buildings.gpkg", "mms/survey_01_trajectory.csv",
                                   "gnss/satellites.nav", "aerial/camera.json", "aerial/ortho.tif"])
def test_names_decide_nothing(small_city, tmp_path, place):
    path = tmp_path / "data.bin"
    shutil.copy(small_city / place, path)
    found, *_ = recognise_file(path)
    assert found.kind == CITY.get(place) and not found.problem
    assert bool(found.notes) == place.endswith((".laz", ".gpkg", ".tif"))


def test_damaged_tables_are_told_with_their_kind(small_city, tmp_path):
    text = (small_city / "mms/survey_01_trajectory.csv").read_text(encoding="utf-8").splitlines()
    (tmp_path / "t.csv").write_text("\n".join([*text[:50], "361400.9,nan,1,2,3,4,5", *text[60:90]]), encoding="utf-8")
    (tmp_path / "cut.csv").write_text("\n".join([*text[:50], text[50][:20]]), encoding="utf-8")
    for name in ("t.csv", "cut.csv"):
        found, = recognise_file(tmp_path / name)
        assert found.kind == "trajectory" and found.problem


def test_long_trajectories_are_sampled(tmp_path):
    time = np.arange(0.0, 1200.0, 0.01)
    rows = np.column_stack([time, 5.0 * time, 10.0 + 0.0 * time, 0.0 * time, 0.0 * time, 0.0 * time, 90.0 + 0 * time])
    path = tmp_path / "long.csv"
    np.savetxt(path, rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    found, = recognise_file(path)
    assert found.kind == "trajectory" and path.stat().st_size > 4_000_000
    assert found.times == pytest.approx((0.0, 1199.99), abs=0.2)
    assert found.extent[2] == pytest.approx(6000.0, abs=2.0) and not found.notes


def sbet_records(count: int) -> np.ndarray:
    records = np.zeros((count, 17))
    records[:, 0] = np.arange(count) * 0.005 + 361_400.0
    records[:, 1], records[:, 2] = np.radians(35.69), np.radians(139.75) + np.arange(count) * 1e-8
    records[:, 3] = 50.0
    return records


def test_sbet_by_its_records(tmp_path):
    path = tmp_path / "nav.dat"
    path.write_bytes(sbet_records(3000).tobytes())
    found, = recognise_file(path)
    assert (found.kind, found.count, found.heights) == ("trajectory", 3000, "ellipsoidal")
    assert found.extent[:2] == pytest.approx((139.75, 35.69)) and "its name end" in found.notes[0]
    path.write_bytes(sbet_records(3000).tobytes()[:-50])
    assert "cut off" in recognise_file(path)[0].problem


@pytest.mark.parametrize("text, kind, count", [
    ("id,x,y,z,role\nA1,1.5,2.5,3.5,control\nA2,4,5,6,check\n", "cloud_control", 2),
    ("点名,x,y,z,x_als,y_als,z_als\nA1,1.5,2.5,3.5,1.6,2.4,3.4\n", "cloud_control", 1),
    ("point,image,column,row,x,y,z\nP,a.tif,10,20,1,2,3\nP,b.tif,11,21,1,2,3\n", "frame_control", 1),
    ("id,x,y,z\nA1,1.5,2.5,3.5\nA2,4,5,6\n", "table", None)])
def test_control_points_of_clouds_and_frames(tmp_path, text, kind, count):
    path = tmp_path / "点.csv"
    path.write_text(text, encoding="utf-8")
    found, = recognise_files([path])
    assert (found.kind, found.problem) == (kind, "") and (count is None or found.count == count)
    # A list of places may be anything: it is control only where the user says so.
    assert uses_of(found) == {"cloud_control": ("als_control",), "frame_control": ("frame_control",),
                              "table": ("als_control",)}[kind]
    assert ("als_control" in parts_of([found]).inputs) == (kind == "cloud_control")
    if kind == "table":
        assert parts_of(put_to_use([found], {found.source: "als_control"})).inputs == {"als_control": (str(path),)}


@pytest.mark.parametrize("text, kind", [
    ("点名,X座標,Y座標,標高,区分\nA,10,20,3,標定点\nB,11,21,4,検証点\n", "cloud_control"),
    ("写真名,X座標,Y座標,標高,ω,φ,κ\nf1,10,20,300,0,0,90\nf2,11,21,300,0,0,90\n", "exterior"),
    ("点名,緯度,経度,標高,区分\nA,35.1,139.2,3,標定点\n", "cloud_control"),
    ("画像名,時刻,X座標,Y座標,Z座標,ロール,ピッチ,方位角\ni,5,1,2,3,0,0,90\n", "poses")])
def test_tables_that_only_the_user_can_tell_say_where_to_tell_it(tmp_path, text, kind):
    path = tmp_path / "成果.csv"
    path.write_text(text, encoding="cp932")
    found, = recognise_file(path)
    assert found.kind == kind and "Import table" in found.problem


def test_a_navigation_text_in_degrees_below_a_head_says_where_to_read_it(tmp_path):
    path = tmp_path / "export.txt"
    names = "  TIME   LATITUDE   LONGITUDE   ELLIPSOID HEIGHT   ROLL   PITCH   HEADING"
    rows = [f"  {100 + k}  35.68 139.76 48.5 0 0 90" for k in range(5)]
    path.write_text("\n".join(["Export", "Datum: JGD2011", "", names, "", *rows]), encoding="utf-8")
    found, = recognise_file(path)
    assert found.kind == "trajectory" and "Import table" in found.problem


def test_a_list_of_places_says_where_it_can_be_read(tmp_path):
    path = tmp_path / "成果.csv"
    path.write_text("点名,X座標,Y座標,標高\nA,10,20,3\nB,11,21,4\n", encoding="cp932")
    found, = recognise_file(path)
    assert (found.kind, found.problem) == ("table", "") and "Import table" in found.notes[0]
    path.write_text("店名,緯度,経度\nA,35.1,139.2\nB,35.1,139.3\n", encoding="cp932")  # of no use here
    found, = recognise_file(path)
    assert (found.kind, found.notes) == ("table", ())


def test_points_as_text(tmp_path):
    places = np.random.default_rng(1).uniform(0.0, 100.0, (500, 3))
    np.savetxt(tmp_path / "p.xyz", places, "%.3f")
    np.savetxt(tmp_path / "p.csv", places, "%.3f", ",", header="x,y,z", comments="")
    np.savetxt(tmp_path / "t.csv", np.column_stack([np.arange(500), places]), "%.3f", ",")
    assert [recognise_file(tmp_path / name)[0].kind for name in ("p.xyz", "p.csv", "t.csv")] == [
        "text_points", "text_points", "table"]
    assert recognise_file(tmp_path / "p.xyz")[0].doubt


def test_polygons_without_names_are_told_by_size_with_a_doubt(tmp_path):
    import shapely

    sizes = {"houses": (10.0, 12.0), "dashes": (0.15, 5.0), "yards": (3.0, 4.0)}
    for name, (width, height) in sizes.items():
        boxes = [shapely.box(30.0 * k, 0.0, 30.0 * k + width, height) for k in range(9)]
        write_geopackage(tmp_path / f"{name[:1]}.gpkg", [Layer("a", boxes, {"n": list(range(9))})])
    found = {name: recognise_file(tmp_path / f"{name[:1]}.gpkg")[0] for name in sizes}
    assert {name: item.kind for name, item in found.items()} == {
        "houses": "outlines", "dashes": "markings", "yards": "areas"}
    assert all("told by the size" in item.doubt for item in found.values())


def test_a_field_with_the_size_says_nothing_of_what_polygons_are(tmp_path):
    import shapely

    boxes = [shapely.box(30.0 * k, 0.0, 30.0 * k + 12.0, 10.0) for k in range(9)]
    for name in ("路面標示　面", "建物"):
        write_geopackage(tmp_path / f"{name}.gpkg", [Layer("polygons", boxes, {"area": [120.0] * 9})])
    assert [recognise_file(tmp_path / f"{name}.gpkg")[0].kind for name in ("路面標示　面", "建物")] == [
        "markings", "outlines"]


def shapefile(place: Path, count: int = 4) -> Path:
    """A shapefile of squares of 12 m, written by the ESRI description."""
    records = b""
    for number in range(count):
        x = 40.0 * number
        ring = [(x, 0.0), (x, 12.0), (x + 12.0, 12.0), (x + 12.0, 0.0), (x, 0.0)]
        body = struct.pack("<i4d2i", 5, x, 0.0, x + 12.0, 12.0, 1, 5) + struct.pack("<i", 0)
        body += b"".join(struct.pack("<2d", *corner) for corner in ring)
        records += struct.pack(">2i", number + 1, len(body) // 2) + body
    head = struct.pack(">i5ii", 9994, 0, 0, 0, 0, 0, (100 + len(records)) // 2) + struct.pack("<2i", 1000, 5)
    place.write_bytes(head + struct.pack("<8d", 0.0, 0.0, 40.0 * count - 28.0, 12.0, 0, 0, 0, 0) + records)
    field = b"PLACE\0\0\0\0\0\0C" + b"\0" * 4 + bytes([10, 0]) + b"\0" * 14
    place.with_suffix(".dbf").write_bytes(struct.pack("<4BIHH20x", 3, 124, 1, 1, count, 65, 11) + field + b"\r")
    return place


def test_shapefiles(tmp_path):
    found, = recognise_files([shapefile(tmp_path / "a.shp").parent])
    assert (found.kind, found.count, found.extent) == ("outlines", 4, (0.0, 0.0, 132.0, 12.0))
    cut(tmp_path / "a.shp", tmp_path / "b.shp")
    assert "cut off" in recognise_file(tmp_path / "b.shp")[0].problem
    (tmp_path / "a.dbf").unlink()
    assert ".dbf" in recognise_file(tmp_path / "a.shp")[0].problem


def test_zips_and_databases(small_city, tmp_path):
    with zipfile.ZipFile(tmp_path / "d.zip", "w") as archive:
        archive.write(next((small_city / "footprints").glob("*.xml")), "FG-GML-533946-BldA-20240401-0001.xml")
    assert recognise_file(tmp_path / "d.zip")[0].kind == "gsi_outlines"
    cut(tmp_path / "d.zip", tmp_path / "cut.zip")
    assert "fetch it again" in recognise_file(tmp_path / "cut.zip")[0].problem
    with closing(sqlite3.connect(tmp_path / "plain.db")) as base:
        base.execute("CREATE TABLE t (a)")
    assert "no GeoPackage" in recognise_file(tmp_path / "plain.db")[0].problem
    packed = tmp_path / "day.nav.gz"
    packed.write_bytes(gzip.compress((small_city / "gnss/satellites.nav").read_bytes()))
    assert recognise_file(packed)[0].kind == "navigation"
    packed = tmp_path / "town.city.json.gz"
    packed.write_bytes(gzip.compress(json.dumps({"type": "CityJSON", "CityObjects": {"a": {}}}).encode()))
    assert [(one.path, one.kind, one.count) for one in recognise_file(packed)] == [(packed, "city_model", 1)]


def test_folders_leave_out_what_belongs_to_other_files(tmp_path):
    shapefile(tmp_path / "a.shp")
    (tmp_path / ".hidden.json").write_text("{}", encoding="utf-8")
    (tmp_path / "b.json").write_text(json.dumps({"urbanmap_job": 1, "wish": "buildings"}), encoding="utf-8")
    assert [item.kind for item in recognise_files([tmp_path, tmp_path / "b.json"])] == ["outlines", "job"]
    (tmp_path / "c_results").mkdir()
    (tmp_path / "c_results" / "d.json").write_text("{}", encoding="utf-8")
    assert len(recognise_files([tmp_path])) == 3
    (tmp_path / "c.urbanmap.json").write_text(json.dumps({"urbanmap_job": 1}), encoding="utf-8")
    assert [item.kind for item in recognise_files([tmp_path])] == ["outlines", "job", "job"]


def test_missing_files_get_a_sentence(tmp_path):
    assert "does not exist" in recognise_file(tmp_path / "nothing.laz")[0].problem


def kml(*placemarks, head=""):
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2" '
            f'xmlns:gx="http://www.google.com/kml/ext/2.2"><Document>{head}{"".join(placemarks)}</Document></kml>\n')


HOUSE = ("<Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>139.70,35.60,0 139.7002,35.60,0 "
         "139.7002,35.6002,0 139.70,35.6002,0 139.70,35.60,0</coordinates></LinearRing></outerBoundaryIs></Polygon>"
         "</Placemark>")
PATH = "<Placemark><LineString><coordinates>\n139.70,35.60,5\n139.71,35.61,5\n</coordinates></LineString></Placemark>"
TRACK = "<Placemark><gx:Track><when>2026-01-01T00:00:00Z</when><gx:coord>139.7 35.6 5</gx:coord></gx:Track></Placemark>"
PLACE = "<Placemark><name>T1</name><Point><coordinates>139.72,35.62</coordinates></Point></Placemark>"


@pytest.mark.parametrize(("text", "kind", "says", "extent"), [
    (kml(HOUSE, PLACE, head="<name>buildings</name>"), "outlines", "plane reference system",
     (139.7, 35.6, 139.72, 35.62)),
    (kml(HOUSE), "outlines", "plane reference system", (139.7, 35.6, 139.7002, 35.6002)),
    (kml(PATH, TRACK), "lines", "no trajectory", (139.7, 35.6, 139.71, 35.61)),
    (kml(PLACE), "places", "write control points as a table", (139.72, 35.62, 139.72, 35.62))])
@pytest.mark.parametrize("packed", [False, True])
def test_kml_and_kmz_say_what_they_are_and_what_to_do(tmp_path, text, kind, says, extent, packed):
    path = tmp_path / ("a.kmz" if packed else "a.kml")
    if packed:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("doc.kml", text)
            archive.writestr("files/icon.png", b"")
    else:
        path.write_text(text, encoding="utf-8")
    found, = recognise_file(path)
    assert (found.kind, found.problem) == (kind, "") and found.extent == pytest.approx(extent)
    assert "WGS 84" in found.crs_wkt and says in found.notes[0] and found.detail.startswith("KMZ" if packed else "KML")


@pytest.mark.parametrize(("text", "says"), [
    (kml(), "holds no feature"), (kml("<NetworkLink><Link/></NetworkLink>"), "holds links or pictures only"),
    (kml(PLACE.replace("35.62", "3562")), "no longitude and latitude"),
    (kml(PLACE.replace("35.62", "north")), "no numbers"), (kml(PLACE.replace(",35.62", "")), "no longitude"),
    (kml(PLACE)[:-20], "is cut off")])
@pytest.mark.parametrize("packed", [False, True])
def test_kml_of_no_use_gets_a_sentence(tmp_path, text, says, packed):
    path = tmp_path / ("a.kmz" if packed else "a.kml")
    if packed:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("doc.kml", text)
    else:
        path.write_text(text, encoding="utf-8")
    found, = recognise_file(path)
    assert says in found.problem and not found.usable
