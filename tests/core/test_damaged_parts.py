"""Files of which one part is damaged, as trials with scripts/fuzz.py found them: the sentence names row or element."""

from __future__ import annotations

import json
import shutil
import sqlite3
import struct
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import pytest
import rasterio
from rasterio._err import CPLE_AppDefinedError

from scripts import fuzz_sound as sound
from tests.city_models import town
from tests.core.test_map_check import sound_map
from tests.core.test_rinex_observations import epoch_3, field, header_3
from urbanmap_qgis.aerial.markings.marking_files import levels_of_orthophoto
from urbanmap_qgis.aerial.markings.orthophoto_reader import colour_bands
from urbanmap_qgis.aerial.orthophotos.vehicle_filter import OrthophotoSource
from urbanmap_qgis.citymodel.citygml.value_reader import leaf_value, plain_number
from urbanmap_qgis.citymodel.cityjson.reader import read_cityjson
from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
from urbanmap_qgis.citymodel.tiles.tiles_writer import tiles_folder_trouble
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.orbits.sp3 import read_sp3
from urbanmap_qgis.gnss.rinex.observation_file import read_observations
from urbanmap_qgis.imagery.views.orthophoto_source import orthophoto_source
from urbanmap_qgis.io.conversion.geoid import read_geoid
from urbanmap_qgis.io.files.guard import read_json
from urbanmap_qgis.io.files.named_table import plain_name
from urbanmap_qgis.io.osm import read_osm, write_osm
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.job.job_file import read_job
from urbanmap_qgis.job.job_progress import file_state_of
from urbanmap_qgis.job.recognition.contents import recognise_file
from urbanmap_qgis.mobile.gps_time import sampled_span, time_range

LONG = "9" * 400


def refused(read, path, text, words):
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        read(path)


@pytest.mark.parametrize(("number", "shown"), [(LONG, "9{20}"), ("-" + LONG, "-9{19}"), ("NaN", "NaN"),
                                               ("1e999", "1e999"), ("-Infinity", "-Infinity")])
def test_numbers_of_json_that_are_none_are_named_with_their_line(tmp_path, number, shown):
    refused(lambda path: read_json(path, "a camera file"), tmp_path / "a.json", f'{{"a": 1,\n"b": {number}}}',
            f"a.json cannot be read as a camera file: “{shown}” in its line 2 is no number")


def test_long_numbers_of_json_that_can_be_used_are_read(tmp_path):
    (tmp_path / "a.json").write_text(f'[{"9" * 300}, -1, 1e5]')
    assert read_json(tmp_path / "a.json", "numbers") == [int("9" * 300), -1, 1e5]


@pytest.mark.parametrize(("old", "new", "words"), [
    ('id="11"', 'id="x"', "a.osm: node x cannot be read .“x” is no number"),
    ('id="11" ', "", r"a.osm: node \(element 1 of the file\) cannot be read .“id” is missing"),
    ('ref="12"', 'ref=""', "a.osm: way 111 cannot be read"),
    ('ref="121"', 'reff="121"', "a.osm: relation 200 cannot be read .“ref” is missing"),
    ('lon="', 'lan="', "a.osm: node 11 cannot be read .“lon” is missing"),
    ('k="ele" v="1"', 'k="ele" v="inf"', "a.osm: node 11 cannot be read")])
def test_elements_of_lane_maps(tmp_path, old, new, words):
    write_osm(tmp_path / "sound.osm", sound_map())
    text = (tmp_path / "sound.osm").read_text(encoding="utf-8")
    assert old in text
    refused(read_osm, tmp_path / "a.osm", text.replace(old, new, 1), words)


GSI_GRID = "36.0 139.0 0.016667 0.025 3 2 1 ver1\n1 2\n3 4\n5 6\n"
ISG = ("begin_of_head\nlat min : 36.0\nlat max : 36.2\nlon min : 139.0\ndelta lat : 0.1\ndelta lon : 0.1\nnrows : 3\n"
       "ncols : 2\nend_of_head\n1 2\n3 4\n5 6\n")


@pytest.mark.parametrize(("text", "old", "new", "words"), [
    (GSI_GRID, "139.0", "a", "line 1 cannot be read"), (GSI_GRID, "3 2 1", "3 2.5 1", "line 1 cannot be read"),
    (GSI_GRID, " 0.025 3 2 1 ver1", "", "line 1 cannot be read"), (GSI_GRID, "3 4", "3 4.4.4", "line 3 cannot be read"),
    (GSI_GRID, "36.0", "inf", "first node and the steps"), (GSI_GRID, "0.025", "0", "first node and the steps"),
    (GSI_GRID, "0.025", "nan", "line 1 cannot be read"), (GSI_GRID, "3 2 1", "-3 -2 1", "its header says 6"),
    (ISG, "lat max : 36.2", "", "“lat max” of its header cannot be read"),
    (ISG, "nrows : 3", "nrows : 3.0.0", "“nrows” of its header cannot be read"),
    (ISG, "lon min : 139.0", "lon min : 1e999", "“lon min” of its header cannot be read"),
    (ISG, "delta lat : 0.1", "delta lat : 0.0", "first node and the steps"),
    (ISG, "3 4", "3 x", "line 11 cannot be read")])
def test_grids_of_a_geoid(tmp_path, text, old, new, words):
    name = "a.isg" if text is ISG else "a.asc"
    (tmp_path / name).write_text(text)
    assert read_geoid(tmp_path / name).heights.shape == (3, 2)
    assert old in text
    refused(read_geoid, tmp_path / name, text.replace(old, new), words)


def test_limits_of_a_geoid_are_those_of_nodes_or_of_cells(tmp_path):
    """Three rows from 36.0 to 36.2 are nodes, from 36.0 to 36.3 cells."""
    (tmp_path / "a.isg").write_text(ISG)
    (tmp_path / "b.isg").write_text(ISG.replace("36.2", "36.3"))
    assert read_geoid(tmp_path / "a.isg").south == pytest.approx(36.0)
    assert read_geoid(tmp_path / "b.isg").south == pytest.approx(36.05)


def sp3(*epochs):
    """Orbits of one satellite, x 1000 km times the number of the epoch."""
    head = "#cP2019  4 28  0  0  0.00000000       1 ORBIT IGS14 HLM  IGS"
    rows = [f"{epoch}\nPG01{1000.0 * number:14.6f}{-20000.0:14.6f}{9000.0:14.6f}{12.5:14.6f}"
            for number, epoch in enumerate(epochs, 1)]
    return "\n".join([head, *rows, ""])


@pytest.mark.parametrize("epoch", ["*  2019  4 2X  0 15  0.00000000", f"*  2019  4 28  0 {LONG}  0.0", "*  2019  4"])
def test_an_epoch_of_orbits_that_is_damaged_does_not_move_positions_to_the_one_before(tmp_path, epoch):
    sound = [f"*  2019  4 28  0 {minute:2d}  0.00000000" for minute in (0, 15, 30)]
    (tmp_path / "a.sp3").write_text(sp3(*sound))
    assert read_sp3(tmp_path / "a.sp3").place[0, :, 0] == pytest.approx([1e6, 2e6, 3e6])
    refused(read_sp3, tmp_path / "a.sp3", sp3(sound[0], epoch, sound[2]), "a.sp3: line 4 cannot be read")
    (tmp_path / "a.sp3").write_text(sp3(*sound[:2]) + epoch)  # the last line breaks off
    assert read_sp3(tmp_path / "a.sp3").place[0, :, 0] == pytest.approx([1e6, 2e6])


@pytest.fixture
def cityjson(tmp_path):
    """Content of a sound CityJSON file."""
    write_model_cityjson(tmp_path / "sound.city.json", town())
    return json.loads((tmp_path / "sound.city.json").read_text(encoding="utf-8"))


def _key(content):
    return next(key for key, item in content["CityObjects"].items() if item.get("geometry"))


@pytest.mark.parametrize("vertex", [[1, 2], [1, 2, 3, 4], ["a", 1, 2], [[1], 2, 3], None])
def test_vertices_of_cityjson(tmp_path, cityjson, vertex):
    cityjson["vertices"][5] = vertex
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), "vertex 5 is no list of three numbers")


def test_vertices_all_of_six_numbers_are_not_taken_for_twice_as_many(tmp_path, cityjson):
    cityjson["vertices"] = [[*vertex, *vertex] for vertex in cityjson["vertices"]]
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), "vertex 0 is no list of three numbers")


@pytest.mark.parametrize("change", [{"scale": [1, 1]}, {"scale": "x"}, {"translate": None}])
def test_transform_of_cityjson(tmp_path, cityjson, change):
    cityjson["transform"].update(change)
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), "a.city.json: transform cannot be read")


def test_appearance_of_cityjson(tmp_path, cityjson):
    cityjson["appearance"] = {"textures": ["a"]}
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), "a.city.json: appearance cannot be read")


@pytest.mark.parametrize("damage", [{"geometry": 5}, {"geometry": ["x"]}, {"children": [[1]]}, {"attributes": [1]}])
def test_objects_of_cityjson(tmp_path, cityjson, damage):
    key = _key(cityjson)
    cityjson["CityObjects"][key].update(damage)
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), f"a.city.json: {key} cannot be read")


@pytest.mark.parametrize(("ring", "words"), [(["a"], "a ring of {} is no list of vertices"),
                                             ([0, 1, 10**6], "{} names a vertex that is not there")])
def test_rings_of_cityjson(tmp_path, cityjson, ring, words):
    key = _key(cityjson)
    cityjson["CityObjects"][key]["geometry"][0]["boundaries"][0][0] = ring
    refused(read_cityjson, tmp_path / "a.city.json", json.dumps(cityjson), words.format(key))


def test_an_orthophoto_damaged_within(tmp_path):
    """Its head is sound, so that it opens; the pixels are asked for later."""
    path = tmp_path / "a.tif"
    with rasterio.open(path, "w", driver="GTiff", width=400, height=400, count=3, dtype="uint8", crs="EPSG:6677",
                       compress="deflate", transform=rasterio.Affine(0.1, 0, 0, 0, -0.1, 0)) as file:
        file.write(np.random.default_rng(1).integers(0, 255, (3, 400, 400), np.uint8))
    image = orthophoto_source(path)
    data = path.read_bytes()
    path.write_bytes(data[:3000] + bytes(len(data) - 6000) + data[-3000:])
    with pytest.raises(InputError, match=r"a\.tif is damaged"):
        image.window(0, 0, 400, 400)


def raster(path, cell=0.5):
    with rasterio.open(path, "w", driver="GTiff", width=40, height=40, count=1, dtype="uint8", crs="EPSG:6677",
                       transform=rasterio.Affine(cell, 0, 12345.25, 0, -cell, 2)) as file:
        file.write(np.ones((1, 40, 40), np.uint8))
    return path


@pytest.mark.parametrize("read", [RasterSampler, OrthophotoSource, orthophoto_source, read_geoid, levels_of_orthophoto])
def test_a_raster_whose_system_is_no_text(tmp_path, read):
    data = raster(tmp_path / "a.tif").read_bytes()
    name = b"JGD2011 / Japan Plane Rectangular CS IX"
    assert data.count(name) >= 1
    (tmp_path / "b.tif").write_bytes(data.replace(name, name[:10] + b"\xb2\x8b;Un\xbbS" + name[17:]).replace(
        struct.pack("<H", 6677), struct.pack("<H", 32767)))
    with pytest.raises(InputError, match="b.tif"):
        read(tmp_path / "b.tif")


@pytest.mark.parametrize("read", [RasterSampler, levels_of_orthophoto])
def test_a_raster_with_cells_of_no_size(tmp_path, read):
    with pytest.raises(InputError, match="cells of no size"):
        read(raster(tmp_path / "a.tif", 1e-200))


def test_an_epoch_of_observations_at_no_time_is_left_out_and_told(tmp_path):
    epochs = "".join(epoch_3(30.0 * number, ["G01" + field(2.0e7 + number)]) for number in range(3))
    (tmp_path / "a.obs").write_text(header_3({"G": ["C1C"]}) + epochs.replace("30.0000000", "       nan"))
    found = read_observations(tmp_path / "a.obs")
    assert np.diff(found.time) == pytest.approx([60.0]) and found.code == pytest.approx([2.0e7, 2.0e7 + 2])
    assert "2 lines fit in no epoch" in found.notes[0]


def test_a_kind_of_observation_without_a_band_is_no_code(tmp_path):
    text = header_3({"G": ["C1C", "S1C"]}).replace("C1C S1C", "C1C C  ")
    (tmp_path / "a.obs").write_text(text + epoch_3(0.0, ["G01" + field(2.0e7) + field(3.0e7)]))
    assert read_observations(tmp_path / "a.obs").code == pytest.approx([2.0e7])


@pytest.mark.parametrize("span", [sampled_span, time_range])
def test_gps_times_that_are_no_numbers_do_not_hide_the_span_of_the_others(make_cloud, tmp_path, span):
    count, time = np.arange(1000.0), np.linspace(5000.0, 5100.0, 1000)
    time[[0, 500, 999]] = np.nan, np.inf, -np.inf
    path = make_cloud(tmp_path / "a.laz", count, count, count % 7, gps_time=time)
    assert span(open_cloud([path])) == pytest.approx((5000.0, 5100.0), abs=6.0)
    none = make_cloud(tmp_path / "b.laz", count, count, count % 7, gps_time=np.full(1000, np.nan))
    with pytest.raises(InputError, match="No GPS time in b.laz is a number"):
        span(open_cloud([none]))


@pytest.mark.parametrize(("old", "new", "words"), [
    ('"algorithm"', '"algorithms"', "step 1 cannot be read"), ('"steps"', '"step"', "steps cannot be read"),
    ('"inputs"', '"input"', "inputs cannot be read"),
    ('"MIN_ROOF_AREA": 20.0', '"MIN_ROOF_AREA": 1e999', "“1e999” in its line")])
def test_parts_of_a_job(small_city, tmp_path, old, new, words):
    text = sound.job(tmp_path / "a.json", small_city).read_text(encoding="utf-8")
    assert old in text
    refused(read_job, tmp_path / "a.json", text.replace(old, new, 1), words)


def test_a_shapefile_with_corners_or_places_that_are_no_numbers(tmp_path):
    """Nothing is raised where files are recognised."""
    data = sound.shapefile(".shp")(tmp_path / "a.shp", tmp_path).read_bytes()
    corner = 100 + 8 + 44 + 4  # of the first polygon, behind head, record, box and parts
    (tmp_path / "a.shp").write_bytes(data[:corner] + struct.pack("<d", np.nan) + data[corner + 8:])
    assert "corners that are no numbers" in recognise_file(tmp_path / "a.shp")[0].problem
    (tmp_path / "a.shp").write_bytes(data[:36] + struct.pack("<d", np.nan) + data[44:])
    assert "not finite" in recognise_file(tmp_path / "a.shp")[0].problem


def test_a_tileset_nested_without_end_is_another_programs(tmp_path):
    (tmp_path / "tileset.json").write_text("[" * 100_000)
    assert "another program" in tiles_folder_trouble(tmp_path)


def test_a_geopackage_with_a_damaged_polygon_or_name(small_city, tmp_path):
    """Nothing is raised where files are recognised, nor where it is asked whether they have changed."""
    path = Path(shutil.copy(small_city / "footprints/gsi_buildings.gpkg", tmp_path / "a.gpkg"))
    with sqlite3.connect(path) as base:
        table, geometry = base.execute("SELECT table_name, column_name FROM gpkg_geometry_columns").fetchone()
        name, shape = base.execute(f"SELECT rowid, {geometry} FROM {table}").fetchone()
        base.execute("PRAGMA writable_schema = 1")
        for (trigger,) in base.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            base.execute(f"DROP TRIGGER {trigger}")
        base.execute(f"UPDATE {table} SET {geometry} = ? WHERE rowid = ?", (shape[:-30], name))
    assert "a.gpkg" in recognise_file(path)[0].problem
    data = path.read_bytes()
    with sqlite3.connect(path) as base:
        moment, = base.execute("SELECT last_change FROM gpkg_contents").fetchone()
    path.write_bytes(data.replace(moment.encode(), b"\x88" + moment.encode()[1:]))
    assert len(file_state_of(str(path))) == 2


def test_a_city_model_at_no_place(tmp_path, cityjson):
    cityjson["metadata"]["geographicalExtent"] = [0, 0, 0, 1, 1, 1]
    text = json.dumps(cityjson).replace("[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1e999, 1, 1]")
    (tmp_path / "a.city.json").write_text(text)
    assert recognise_file(tmp_path / "a.city.json")[0].problem


def test_a_column_name_of_brackets_without_end_is_compared_at_once():
    """It took minutes: each bracket was followed to the end of the line."""
    assert plain_name("[" * 3000 + "a" * 200_000).startswith("[[[")
    assert plain_name("Ellipsoid Height (m)") == "ellipsoidheight"


def test_endless_numbers_of_citygml_stay_texts():
    element = Element("a")
    element.text = "1e999"
    assert plain_number("1e999") is None and plain_number("-2.5e3") == -2500.0
    assert leaf_value(element, lambda *_: "") == "1e999"
    element.set("uom", "m")
    assert leaf_value(element, lambda *_: "") == "1e999"


class _StumblingRaster:
    """What GDAL opens, and stumbles over the keys of its place when it is asked for the bands' colours."""

    @property
    def colorinterp(self):
        raise CPLE_AppDefinedError(1, 1, "Key GTModelTypeGeoKey has count=196, whereas only 1 is legal")


def test_an_orthophoto_whose_head_is_damaged_is_a_sentence():
    with pytest.raises(InputError, match="a.tif is damaged: .*GTModelTypeGeoKey"):
        colour_bands(_StumblingRaster(), Path("a.tif"))


def test_one_point_without_a_time_is_counted(make_cloud, tmp_path):
    time = np.linspace(400_000, 400_060, 500)
    x, y = np.random.default_rng(1).uniform(0, 50, (2, 500))
    for zeros in (1, 3):
        time[:zeros] = 0.0
        cloud = open_cloud([make_cloud(tmp_path / f"{zeros}.laz", x, y, x, gps_time=time)])
        with pytest.raises(InputError, match=rf"{zeros} of 500 points in {zeros}\.laz have the GPS time 0"):
            time_range(cloud)
    late = np.linspace(0, 60, 500)  # a survey that begins with the week
    assert time_range(open_cloud([make_cloud(tmp_path / "w.laz", x, y, x, gps_time=late)])) == (0.0, 60.0)
