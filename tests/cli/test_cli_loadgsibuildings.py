"""`qgis_process run urbanmap:loadgsibuildings` on files with Japanese names."""

from __future__ import annotations

import zipfile

import pytest

RING = "35.69 139.76 35.69 139.7601 35.6901 139.7601 35.6901 139.76 35.69 139.76"
OBJECT = (
    '<BldA gml:id="{0}"><fid>fid-{0}</fid><area><gml:Surface srsName="fguuid:jgd2011.bl"><gml:patches>'
    "<gml:PolygonPatch><gml:exterior><gml:Ring><gml:curveMember><gml:Curve><gml:segments><gml:LineStringSegment>"
    f"<gml:posList>{RING}</gml:posList></gml:LineStringSegment></gml:segments></gml:Curve></gml:curveMember></gml:Ring>"
    "</gml:exterior></gml:PolygonPatch></gml:patches></gml:Surface></area><type>普通建物</type></BldA>")
DATASET = ('<?xml version="1.0" encoding="UTF-8"?><Dataset xmlns:gml="http://www.opengis.net/gml/3.2" '
           'xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema">{}</Dataset>')


@pytest.fixture
def folder(tmp_path):
    """A folder with a map sheet as .xml and one in a .zip."""
    place = tmp_path / "建物 データ"
    place.mkdir()
    (place / "FG-GML-533946-BldA-20240401-0001.xml").write_text(DATASET.format(OBJECT.format("a")), "utf-8")
    with zipfile.ZipFile(place / "まとめ.zip", "w") as archive:
        archive.writestr("FG-GML-533947-BldA-20240401-0001.xml", DATASET.format(OBJECT.format("b")))
    return place


def test_folder_to_geopackage(run_algorithm, folder, tmp_path):
    target = tmp_path / "建物.gpkg"
    done = run_algorithm("urbanmap:loadgsibuildings", INPUT=folder, OUTPUT=target)
    assert done.code == 0, done.err
    assert done.results["BUILDINGS"] == 2 and done.results["CRS_NAME"] == "EPSG:6677"
    assert done.results["OUTPUT"] == str(target) and target.stat().st_size > 0


def test_cut_off_file_is_one_sentence_and_leaves_nothing(run_algorithm, folder, tmp_path):
    path = folder / "FG-GML-533946-BldA-20240401-0001.xml"
    path.write_text(path.read_text("utf-8")[:-30], "utf-8")
    done = run_algorithm("urbanmap:loadgsibuildings", INPUT=path, OUTPUT=tmp_path / "out.gpkg")
    assert done.code == 1 and "not whole" in done.err + done.out and "Traceback" not in done.err + done.out
    assert sorted(item.name for item in tmp_path.iterdir()) == [folder.name]
