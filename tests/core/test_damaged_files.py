"""Damaged files, as trials with scripts/fuzz.py found them: each is refused in one sentence."""

from __future__ import annotations

import gzip
import importlib.util
import json
import struct
import sys
import zipfile
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import rasterio
from pyproj import CRS

from tests.solid_files import read_solids
from urbanmap_qgis.aerial.frames.camera import read_camera
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.orthophotos.vehicle_filter import OrthophotoSource
from urbanmap_qgis.citymodel.citygml.reader import open_citygml
from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
from urbanmap_qgis.citymodel.model import CityReference
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.gnss.orbits.sp3 import read_sp3
from urbanmap_qgis.io.official import gsi_gml, gsi_sources
from urbanmap_qgis.io.official.gsi import read_gsi_buildings
from urbanmap_qgis.io.points.pointcloud import iter_chunks, open_cloud
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.image_poses import read_image_poses
from urbanmap_qgis.mobile.lines.range_scans import read_scans
from urbanmap_qgis.mobile.lines.tie_points import read_tie_points
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

ROOT = Path(__file__).resolve().parents[2]
DATASET = ('<Dataset xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema" '
           'xmlns:gml="http://www.opengis.net/gml/3.2">{}</Dataset>')


@pytest.fixture
def cloud(make_cloud, tmp_path):
    """`cloud(suffix, point_format)`: bytes of a sound file of 2,000 points, and where to put the damaged one."""

    def make(suffix="laz", point_format=6):
        count = np.arange(2000.0)
        return bytearray(make_cloud(tmp_path / f"sound.{suffix}", count, count, count % 7,
                                    point_format=point_format).read_bytes()), tmp_path / f"damaged.{suffix}"

    return make


def read_whole(path):
    for _ in iter_chunks(open_cloud([path])):
        pass


def points_start(data):
    return struct.unpack_from("<I", data, 96)[0]


@pytest.mark.parametrize("suffix", ["las", "laz"])
@pytest.mark.parametrize("count", [2**32, 2**62])
def test_more_points_than_the_file_has_room_for(cloud, suffix, count):
    data, path = cloud(suffix)
    struct.pack_into("<Q", data, 247, count)
    path.write_bytes(data)
    with pytest.raises(InputError, match=r"damaged.* points"):
        read_whole(path)


@pytest.mark.parametrize("number", [2**31, 2**32 - 1, 0])
def test_more_chunks_than_the_file_has_room_for(cloud, number):
    data, path = cloud()
    (table,) = struct.unpack_from("<q", data, points_start(data))
    struct.pack_into("<I", data, table + 4, number)
    path.write_bytes(data)
    with pytest.raises(InputError, match="chunks"):
        read_whole(path)


@pytest.mark.parametrize("layer", range(9))
def test_layers_longer_than_their_chunk(cloud, layer):
    """The decoder made room for as much as was stated: 4 GB for each layer."""
    data, path = cloud()
    struct.pack_into("<I", data, points_start(data) + 8 + 30 + 4 + 4 * layer, 2**32 - 1)
    path.write_bytes(data)
    with pytest.raises(InputError, match="lengths within a chunk"):
        read_whole(path)


@pytest.mark.parametrize(("place", "kind", "value", "words"), [
    (100, "<I", 2**32 - 1, "variable length records"), (96, "<I", 2**31, "do not fit its size"),
    (94, "<H", 10, "do not fit its size"), (105, "<H", 0, "too short"), (104, "<B", 63, "point format"),
    (25, "<B", 9, "version"), (131, "<d", 0.0, "scales"), (131, "<d", 1e305, "scales"),
    (155, "<d", float("nan"), "scales"),
    (243, "<I", 2**31, "extended records")])
def test_headers_that_cannot_be_true(cloud, place, kind, value, words):
    data, path = cloud("las")
    struct.pack_into(kind, data, place, value)
    path.write_bytes(data)
    with pytest.raises(InputError, match=words):
        read_whole(path)


def test_extra_attributes_of_no_known_kind(make_cloud, tmp_path):
    """The decoder divided by their length."""
    count = np.arange(100.0)
    data = bytearray(make_cloud(tmp_path / "sound.las", count, count, count % 7, extra={"a": count}).read_bytes())
    for kind in (0, 200):
        place = data.index(b"LASF_Spec\0") - 2 + 54
        data[place + 2:place + 4] = bytes((kind, 0))
        with pytest.raises(InputError, match="extra attributes"):
            read_whole(write(tmp_path / "a.las", bytes(data)))


def test_chunks_larger_than_any(cloud):
    """The decoder made room for 4,000 million points."""
    data, path = cloud(point_format=3)
    place = data.index(b"laszip encoded\0") - 2 + 54 + 12
    struct.pack_into("<I", data, place, 2**32 - 2**15)
    path.write_bytes(data)
    with pytest.raises(InputError, match="its chunks hold 4,294,934,528 points"):
        read_whole(path)


@pytest.mark.parametrize("value", ["-inf", "1e400", "nan"])
def test_orbits_that_hold_no_number(tmp_path, value):
    head = "#cP2019  4 28  0  0  0.00000000       1 ORBIT IGS14 HLM  IGS"
    for epoch, x in ((value, "15000.000000"), ("0.0", value)):
        if (epoch, x) == ("0.0", "nan"):  # one that is not there
            continue
        with pytest.raises(InputError, match="not finite"):
            read_sp3(write(tmp_path / "a.sp3", f"{head}\n*  2019  4 28  0  0  {epoch}\nPG01{x:>14}"
                           f"{-20000.0:14.6f}{9000.0:14.6f}{12.5:14.6f}\n"))


@pytest.mark.parametrize("read", [lambda path: RasterSampler(path), lambda path: OrthophotoSource(path)])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_rasters_whose_place_is_no_number(tmp_path, read, value):
    with rasterio.open(tmp_path / "a.tif", "w", driver="GTiff", width=4, height=4, count=1, dtype="uint8",
                       crs="EPSG:6677", transform=rasterio.Affine(0.5, 0, 12345.25, 0, -0.5, 2)) as file:
        file.write(np.ones((1, 4, 4), np.uint8))
    data = (tmp_path / "a.tif").read_bytes()
    stated = struct.pack("<d", 12345.25)
    assert data.count(stated) == 1
    with pytest.raises(InputError, match="not finite"):
        read(write(tmp_path / "b.tif", data.replace(stated, struct.pack("<d", value))))


def test_sound_files_of_all_kinds_pass(cloud):
    for suffix in ("las", "laz"):
        for point_format in (0, 1, 3, 6, 7, 8):
            data, path = cloud(suffix, point_format)
            path.write_bytes(data)
            read_whole(path)


def write(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


LONG = "1" * 200_000


@pytest.mark.parametrize(("name", "read", "content"), [
    ("t.csv", read_trajectory, f"time,x,y,z,roll,pitch,heading\n1,{LONG},2,3,0,0,0\n2,1,2,3,0,0,0\n"),
    ("t.csv", read_trajectory, b"\xff\xfe\x00garbage"),
    ("e.csv", read_exterior, f"image,x,y,z,omega,phi,kappa\na,{LONG}e9,0,0,0,0,0\n"),
    ("p.csv", read_tie_points, f"set,time,x_mms,y_mms,x_ref,y_ref\n1,{LONG},1,1,1,1\n"),
    ("c.json", read_calibration, "[" * 100_000), ("c.json", read_camera, "[" * 100_000),
    ("c.json", read_solids, '{"a":' * 100_000), ("c.json", read_calibration, json.dumps({"scanners": [
        {"id": "1", "lever_arm_m": [0, 0, 10**400]}]})),
    ("c.json", read_calibration, '{"scanners": [{"id": "1", "lever_arm_m": [0, 0, NaN]}]}'),
    ("c.json", read_camera, '{"focal_length_mm": ' + "9" * 400 + "}"),
    ("c.json", read_solids, '{"type": "CityJSON", "CityObjects": {}, "vertices": [[' + "9" * 400 + ", 0, 0]]}"),
    ("c.json", read_solids, '{"type": "CityJSON", "CityObjects": {}, "vertices": [[0, 0, 1]], '
                              '"transform": {"scale": [1e308, 1, 1e999], "translate": [0, 0, 0]}}'),
])
def test_tables_and_json(tmp_path, name, read, content):
    with pytest.raises(InputError) as refused:
        read(write(tmp_path / name, content))
    assert name in str(refused.value) and "codec" not in str(refused.value)


def test_citygml_3_is_refused_by_its_version(tmp_path):
    path = write(tmp_path / "a.gml", '<core:CityModel xmlns:core="http://www.opengis.net/citygml/3.0" '
                 'xmlns:bldg="http://www.opengis.net/citygml/building/3.0"><core:cityObjectMember><bldg:Building/>'
                 "</core:cityObjectMember></core:CityModel>")
    with ExitStack() as stack, pytest.raises(InputError, match="a.gml is CityGML 3.0"):
        open_citygml(path, stack, ReadingNotes(), CityReference(epsg=6677))


@pytest.mark.parametrize("vertices", ["[" + "9" * 400 + ", 0, 0]", "[0, 0]", '"a"'])
def test_buildings_that_are_damaged_further_down(tmp_path, vertices):
    """What is read while buildings are walked through is refused as what is read at once."""
    path = write(tmp_path / "c.json", '{"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], '
                 '"translate": [0, 0, 0]}, "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/6677"'
                 '}, "CityObjects": {"a": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "1", '
                 '"boundaries": [[[0, 1, 2]]]}]}}, "vertices": [[0, 0, 0], [1, 0, 0], ' + vertices + "]}")
    with pytest.raises(InputError, match=r"c\.json"):
        list(open_cityjson(path, ReadingNotes()).buildings)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("column", [0, 3, 9, 12])
def test_sbet_that_holds_no_number(tmp_path, value, column):
    records = np.zeros((20, 17))
    records[:, 0], records[:, 1], records[:, 2] = np.arange(20) * 0.1, 0.62, 2.43
    records[7, column] = value
    records.astype("<f8").tofile(tmp_path / "t.sbet")
    with pytest.raises(InputError, match="no number in record 8"):
        read_trajectory(tmp_path / "t.sbet", CRS.from_epsg(6677).to_wkt())


@pytest.mark.parametrize("value", ["nan", "inf", "-1e999"])
def test_poses_and_scans_that_hold_no_number(tmp_path, value):
    with pytest.raises(InputError, match="no number in row 3"):
        read_image_poses(write(tmp_path / "p.csv", "id,time,x,y,z,roll,pitch,heading\na,1,2,3,4,0,0,0\n"
                               f"b,1,2,3,4,0,0,{value}\n"))
    for column in ("time", "angle"):
        values = {"time": "1", "angle": "2", column: value}
        with pytest.raises(InputError, match="return 2"):
            list(read_scans([write(tmp_path / "s.csv", "time,angle,range\n1,2,3\n"
                                   f"{values['time']},{values['angle']},3\n")]))


def test_scans_whose_packing_is_damaged(tmp_path):
    data = bytearray(gzip.compress(b"time,angle,range\n" + b"".join(b"%d.5,1,%d\n" % (row, row * 7919 % 1000)
                                                                  for row in range(5000))))
    data[len(data) // 2] ^= 0xFF
    with pytest.raises(InputError, match=r"s\.csv\.gz"):
        list(read_scans([write(tmp_path / "s.csv.gz", bytes(data))]))


@pytest.mark.parametrize("before", ["", "<!-- <a> " + "x" * 300_000 + " -->", "<?note <a>?>", "<!-- -->" * 10])
def test_document_type_is_refused_wherever_it_stands(tmp_path, before):
    text = f'<?xml version="1.0"?>{before}<!DOCTYPE d [<!ENTITY a "b">]>{DATASET.format("")}'
    with pytest.raises(InputError, match="document type"):
        read_gsi_buildings(write(tmp_path / "a.xml", text))


@pytest.mark.parametrize("encoding", ["rot13", "hex", "base64", "utf-16", "idna", "no-such", "zlib"])
def test_odd_encodings(tmp_path, encoding):
    text = f'<?xml version="1.0" encoding="{encoding}"?>{DATASET.format("")}'
    with pytest.raises(InputError):
        read_gsi_buildings(write(tmp_path / "a.xml", text))


def test_object_without_end_and_prolog_without_end(tmp_path, monkeypatch):
    with pytest.raises(InputError, match="no object in its first 4 MB"):
        read_gsi_buildings(write(tmp_path / "b.xml", "<!--" + "x" * 2**23))
    monkeypatch.setattr(gsi_gml, "_LARGEST_OBJECT", 2**20)
    text = DATASET.format("<BldA><name>" + "x" * 2**22 + "</name></BldA>")
    with pytest.raises(InputError, match="more than 1 MB"):
        read_gsi_buildings(write(tmp_path / "a.xml", text))


def test_zip_in_a_zip_that_grows_without_end(tmp_path, monkeypatch):
    monkeypatch.setattr(gsi_sources, "_LARGEST_ZIP", 2**21)
    with zipfile.ZipFile(tmp_path / "a.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("inner.zip", bytes(2**23))
    with pytest.raises(InputError, match="unpack it first"):
        read_gsi_buildings(tmp_path / "a.zip")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the trials limit memory as Linux does")
@pytest.mark.parametrize("name", ["LAS 1.4", "LAZ", "LAZ 1.4", "SBET", "CityJSON", "GSI XML"])
def test_a_few_trials_of_damage(small_city, tmp_path, name):
    spec = importlib.util.spec_from_file_location("urbanmap_fuzz", ROOT / "scripts" / "fuzz.py")
    fuzz = importlib.util.module_from_spec(spec)
    sys.modules["urbanmap_fuzz"] = fuzz
    spec.loader.exec_module(fuzz)
    found, lines = fuzz.trial(name, small_city, 15, 7, tmp_path, None)
    assert not lines and sum(found.values()) == 15


def test_cells_that_find_no_room(tmp_path, monkeypatch):
    from rasterio.errors import RasterioIOError

    from urbanmap_qgis.io.files import atomic

    target = tmp_path / "a.tif"
    with pytest.raises(OutputError, match=r"a\.tif cannot be written \(a reason\)"), atomic.written_beside(target):
        raise RasterioIOError("a reason")
    monkeypatch.setattr(atomic.shutil, "disk_usage", lambda folder: SimpleNamespace(free=4096))
    with pytest.raises(OutputError, match="make room on its disk"), atomic.written_beside(target):
        raise RasterioIOError("Read or write failed.")


def test_points_that_find_no_room(tmp_path):
    """What the compressor says where the disk is full."""
    from lazrs import LazrsError

    from urbanmap_qgis.io.files.atomic import written_beside

    with pytest.raises(OutputError, match="make room on its disk"), written_beside(tmp_path / "a.laz") as path:
        path.write_bytes(b"half")
        raise LazrsError("IoError: Failed to call write")
    assert not list(tmp_path.iterdir())
    with pytest.raises(LazrsError), written_beside(tmp_path / "a.laz"):
        raise LazrsError("another")
