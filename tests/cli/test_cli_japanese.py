"""Runs as a Japanese surveyor makes them: language, paths, a shapefile in CP932, a zip with names in UTF-8."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
import zipfile
from dataclasses import replace

import numpy as np
import pytest
import shapely

EAST, NORTH = -7000.0, -35000.0
PLAN = shapely.box(EAST, NORTH, EAST + 10, NORTH + 15)

WRITE_SHAPEFILE = """
import sys
from osgeo import ogr, osr
path, wkt, name = sys.argv[1:]
crs = osr.SpatialReference()
crs.ImportFromEPSG(6677)
source = ogr.GetDriverByName("ESRI Shapefile").CreateDataSource(path)
layer = source.CreateLayer("outlines", crs, ogr.wkbPolygon, ["ENCODING=CP932"])
layer.CreateField(ogr.FieldDefn("名称", ogr.OFTString))
feature = ogr.Feature(layer.GetLayerDefn())
feature.SetField(0, name)
feature.SetGeometry(ogr.CreateGeometryFromWkt(wkt))
layer.CreateFeature(feature)
"""


@pytest.fixture(scope="module")
def japanese(linked_profile):
    profile = linked_profile()
    return replace(profile, changes={"LANG": "ja_JP.UTF-8", "LC_ALL": "", "LC_CTYPE": "C.UTF-8"})


@pytest.fixture(scope="module")
def survey(synthetic, make_cloud, tmp_path_factory):
    """A house as laser points, and its outline as a shapefile whose table is in CP932."""
    folder = tmp_path_factory.mktemp("測量 成果")
    points, _ = synthetic.Scene([synthetic.flat(PLAN, 12.3)], margin=30.0, noise=0.02).points()
    cloud = make_cloud(folder / "点群 ①.laz", *np.asarray(points).T, return_number=1, number_of_returns=1)
    outlines = folder / "外周線.shp"
    # In a process of its own: GDAL of QGIS beside that of rasterio.
    done = subprocess.run([sys.executable, "-c", WRITE_SHAPEFILE, str(outlines), PLAN.wkt, "表札：髙﨑ビル"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder, cloud, outlines


def test_models_with_a_report_in_japanese(japanese, survey):
    folder, cloud, outlines = survey
    done = japanese.run_algorithm("urbanmap:buildingsfromals", POINTS=[cloud], FOOTPRINTS=outlines,
                                  OUTPUT=folder / "建物.gpkg", OUTPUT_REPORT=folder / "報告書.html")
    assert done.code == 0, done.err
    with sqlite3.connect(folder / "建物.gpkg") as database:
        (table,) = database.execute("SELECT table_name FROM gpkg_geometry_columns").fetchone()
        rows = database.execute(f'SELECT 名称, status FROM "{table}"').fetchall()
        style, = database.execute("SELECT styleQML FROM layer_styles").fetchone()
    assert rows == [("表札：髙﨑ビル", "ok")]
    assert "標準偏差" in style or "高さ" in style
    text = (folder / "報告書.html").read_text(encoding="utf-8")
    assert '<html lang="ja">' in text and "建物モデル" in text and "外周線" in text
    assert "Building models" not in text


def test_the_toolbox_and_mistakes_are_in_japanese(japanese, survey, tmp_path):
    told = japanese.call("help", "urbanmap:buildingsfromals")
    assert "点群" in told.out and "Point clouds" not in told.out
    done = japanese.run_algorithm("urbanmap:buildingsfromals", POINTS=[tmp_path / "無い.laz"], FOOTPRINTS=survey[2],
                                  OUTPUT=tmp_path / "a.gpkg")
    assert done.code == 1 and "無い.laz" in done.err + done.out and "ください" in done.err + done.out
    assert "Traceback" not in done.err


def test_outlines_from_a_zip_with_japanese_names(japanese, tmp_path, small_city):
    packed = tmp_path / "基盤地図情報.zip"
    (sheet,) = (small_city / "footprints").glob("FG-GML-*.xml")
    with zipfile.ZipFile(packed, "w") as archive:  # names in UTF-8, as the zip says
        archive.write(sheet, f"建築物の外周線/{sheet.name}")
    done = japanese.run_algorithm("urbanmap:loadgsibuildings", INPUT=packed, OUTPUT=tmp_path / "外周.gpkg")
    assert done.code == 0 and done.results["BUILDINGS"] > 0, done.err
