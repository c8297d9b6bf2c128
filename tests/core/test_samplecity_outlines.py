"""The sample city's official outlines and its GeoPackages."""

import sqlite3

import numpy as np
import pytest
import shapely

from urbanmap_qgis.io.official.gsi import read_gsi_buildings, reproject
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.samplecity.truth import outlines
from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage


@pytest.fixture(scope="module")
def city():
    return make_scene(100, "canyon", 2)


@pytest.fixture(scope="module")
def written(city, tmp_path_factory):
    folder = tmp_path_factory.mktemp("city")
    return folder / "footprints", outlines.write_outlines(city, folder, np.random.SeedSequence(1))


def test_outlines_are_rough_within_the_stated_limits(city):
    plans = {building.id: building.outline for building in city.buildings}
    rough = outlines.rough_outlines(city.buildings, np.random.default_rng(5))
    assert {outline.building for outline in rough} == set(plans)
    for outline in rough:
        true = plans[outline.building]
        reach = outlines.MAX_SHIFT + outlines.DETAIL + np.radians(outlines.MAX_ROTATION) * true.length / 4
        assert outline.plan.is_valid and outline.plan.hausdorff_distance(true) < reach
        assert outline.plan.centroid.distance(true.centroid) < outlines.MAX_SHIFT + 0.1
    shifts = [outline.plan.centroid.distance(plans[outline.building].centroid) for outline in rough]
    assert 0.15 < np.mean(shifts) < 0.5


def test_gml_reads_back_as_the_same_outlines(city, written):
    folder, summary = written
    path, = folder.glob("FG-GML-533946-BldA-*.xml")
    read = reproject(read_gsi_buildings(path), "EPSG:6677")
    expected = outlines.rough_outlines(city.buildings, np.random.default_rng(np.random.SeedSequence(1)))
    assert len(read) == len(expected) == summary["outlines"]
    for got, outline, identity in zip(read.geometries, expected, read.attributes["gml_id"]):
        assert got.hausdorff_distance(outline.plan) < 0.001
        assert summary["building_of"][identity] == outline.building
    assert set(read.attributes["type"]) <= {"堅ろう建物", "普通建物"}


def test_geopackage_holds_the_layers(written):
    folder, summary = written
    with sqlite3.connect(folder / "gsi_buildings.gpkg") as connection:
        assert connection.execute("PRAGMA application_id").fetchone() == (0x47504B47,)
        rows = connection.execute("SELECT geom, gml_id FROM BldA").fetchall()
        assert connection.execute("SELECT geometry_type_name, srs_id, z FROM gpkg_geometry_columns").fetchall() == [
            ("POLYGON", 6677, 0)]
        west, south, east, north = connection.execute(
            "SELECT min_x, min_y, max_x, max_y FROM gpkg_contents").fetchone()
    shapes = [shapely.from_wkb(blob[8:]) for blob, _ in rows]
    assert len(shapes) == summary["outlines"] and all(blob[:4] == b"GP\x00\x01" for blob, _ in rows)
    np.testing.assert_allclose(shapely.total_bounds(shapes), [west, south, east, north])


def test_geopackage_keeps_types_heights_and_empty_layers(tmp_path):
    point = shapely.Point(1.0, 2.0, 3.0)
    write_geopackage(tmp_path / "町.gpkg", [
        Layer("points", [point, point], {"n": np.array([1, 2]), "w": [0.5, None], "t": ["a", "b"], "f": [True, False]}),
        Layer("none", [], {"n": []})])
    with sqlite3.connect(tmp_path / "町.gpkg") as connection:
        rows = connection.execute("SELECT geom, n, w, t, f FROM points").fetchall()
        types = {name: kind for _, name, kind, *_ in connection.execute("PRAGMA table_info(points)")}
    assert [row[1:] for row in rows] == [(1, 0.5, "a", 1), (2, None, "b", 0)]
    assert types == {"fid": "INTEGER", "geom": "BLOB", "n": "INTEGER", "w": "DOUBLE", "t": "TEXT", "f": "BOOLEAN"}
    assert shapely.from_wkb(rows[0][0][8:]).equals(point) and shapely.from_wkb(rows[0][0][8:]).has_z
