"""The building chain as a user runs it: `qgis_process`, in one command."""

from __future__ import annotations

import json
import sqlite3

import numpy as np
import pytest
import shapely

from tests.solid_files import read_solids
from urbanmap_qgis.buildings.solids.validity import check_solid

EAST, NORTH = -7000.0, -35000.0
PLAN = {"家": shapely.box(EAST, NORTH, EAST + 10, NORTH + 15),
        "高低": shapely.box(EAST + 30, NORTH, EAST + 50, NORTH + 12),
        "空き地": shapely.box(EAST + 70, NORTH, EAST + 80, NORTH + 10)}


@pytest.fixture(scope="module")
def survey(synthetic, make_cloud, tmp_path_factory):
    """Two point files and outlines of a house, a building of two levels and an empty lot, under Japanese names."""
    folder = tmp_path_factory.mktemp("測量 2026")
    high = shapely.box(EAST + 40, NORTH, EAST + 50, NORTH + 12)
    scene = synthetic.Scene([
        synthetic.flat(PLAN["家"], 12.30),
        synthetic.Block(PLAN["高低"], (synthetic.Part(PLAN["高低"], 10.0), synthetic.Part(high, 16.0)))],
        margin=35.0, noise=0.02)
    points, _ = scene.points()
    clouds = [make_cloud(folder / name, *part.T, return_number=1, number_of_returns=1)
              for name, part in zip(("点群 1.laz", "点群 2.las"), np.array_split(points, 2))]
    outlines = folder / "建物 外周.geojson"
    outlines.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
        "features": [{"type": "Feature", "properties": {"名称": name}, "geometry": shapely.geometry.mapping(plan)}
                     for name, plan in PLAN.items()]}), encoding="utf-8")
    return {"POINTS": clouds, "FOOTPRINTS": outlines}


def check_models(folder, results):
    """Assert what the survey's buildings are known to be."""
    rows = rows_of(folder / "モデル.gpkg")
    assert [row["名称"] for row in rows] == list(PLAN)
    assert [row["status"] for row in rows] == ["ok", "ok", "not modelled"]
    assert rows[2]["reason"] == "there are no points of a building in its outline"
    assert [row["roofs"] for row in rows] == [1, 2, 0]
    assert rows[0]["volume"] == pytest.approx(150 * 9.3, rel=0.02)
    assert rows[1]["volume"] == pytest.approx(120 * 7.0 + 120 * 13.0, rel=0.02)
    assert rows[0]["base"] + rows[0]["height"] == pytest.approx(12.30, abs=0.05)
    assert (results["BUILDINGS"], results["MODELLED"]) == (3, 2)
    assert 0 < results["RMSE_Z95"] < 0.1
    solids = [solid for item in read_solids(folder / "都市.city.json") for solid in item.solids]
    assert len(solids) == 2
    assert [str(problem) for solid in solids for problem in check_solid(solid)] == []


def rows_of(path):
    """Rows of the only layer of a GeoPackage, with the number of styles saved beside it."""
    with sqlite3.connect(path) as connection:
        connection.row_factory = sqlite3.Row
        (name,) = connection.execute("SELECT table_name FROM gpkg_contents WHERE data_type IN "
                                     "('features', 'attributes') AND table_name != 'layer_styles'").fetchone()
        return connection.execute(f'SELECT * FROM "{name}"').fetchall()


def styles_of(path):
    """Number of default styles in a GeoPackage; each must bring its 3D symbols."""
    with sqlite3.connect(path) as connection:
        styles = connection.execute("SELECT styleQML FROM layer_styles WHERE useAsDefault").fetchall()
    assert all("<renderer-3d" in style for (style,) in styles)
    return len(styles)


def test_from_points_to_models_in_one_command(run_algorithm, survey, tmp_path):
    folder = tmp_path / "成果 物"
    folder.mkdir()
    files = {"OUTPUT": "モデル.gpkg", "OUTPUT_SURFACES": "面.gpkg", "OUTPUT_CITYJSON": "都市.city.json",
             "OUTPUT_REPORT": "報告.html", "OUTPUT_MESH": "網.obj"}
    done = run_algorithm("urbanmap:buildingsfromals", **survey, WORKERS=2,
                         **{name: folder / file for name, file in files.items()})
    assert done.code == 0, done.err
    assert set(done.results) == {*files, "BUILDINGS", "MODELLED", "RMSE_Z95"}
    assert {name: done.results[name] for name in files} == {name: str(folder / file) for name, file in files.items()}
    assert {path.name for path in folder.iterdir()} == {*files.values(), "網.mtl"}
    check_models(folder, done.results)
    assert styles_of(folder / "モデル.gpkg") == styles_of(folder / "面.gpkg") == 1
    assert {row["surface_type"] for row in rows_of(folder / "面.gpkg")} == {
        "roof", "outer wall", "inner wall", "ground"}
    assert "</html>" in (folder / "報告.html").read_text(encoding="utf-8")
