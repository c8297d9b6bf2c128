"""Real GSI outlines against what other programs make of them."""

import json
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely.geometry import shape

from urbanmap_qgis.io.official.gsi import read_gsi_buildings, reproject

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data"
SAMPLE = DATA / "gsi" / "FG-GML-sample-BldA.xml"
CITY = DATA / "city" / "footprints"

pytestmark = pytest.mark.skipif(not SAMPLE.is_file(), reason=f"no real data in {DATA}")


def test_real_sheet_equals_another_converters_result():
    buildings = read_gsi_buildings(SAMPLE)
    expected = json.loads((DATA / "gsi" / "FG-GML-sample-BldA.expected.geojson").read_text(encoding="utf-8"))
    assert len(buildings) == len(expected["features"]) == 7 and buildings.notes == ()
    for geometry, name, feature in zip(buildings.geometries, buildings.attributes["gml_id"], expected["features"]):
        assert name == feature["properties"]["id"]
        assert geometry.normalize().equals_exact(shape(feature["geometry"]).normalize(), 1e-12)
    assert sum(len(geometry.interiors) for geometry in buildings.geometries) == 14
    assert set(buildings.attributes["type"]) == {"堅ろう建物", "堅ろう無壁舎", "普通建物", "普通無壁舎"}


def test_folder_of_two_sheets():
    assert len(read_gsi_buildings(DATA / "gsi")) == 8


def test_city_outlines_in_metres():
    ogr = pytest.importorskip("osgeo.ogr", reason="GDAL's Python bindings are not importable")
    ogr.UseExceptions()
    (path,) = CITY.glob("FG-GML-*.xml")
    buildings = reproject(read_gsi_buildings(path))
    assert buildings.crs.to_epsg() == 6677
    layer = ogr.Open(str(CITY / "gsi_buildings.gpkg"))
    expected = {feature["gml_id"]: shapely.from_wkb(bytes(feature.GetGeometryRef().ExportToWkb()))
                for feature in layer.GetLayer(0)}
    assert len(buildings) == len(expected) == 123
    for geometry, name in zip(buildings.geometries, buildings.attributes["gml_id"]):
        np.testing.assert_allclose(shapely.get_coordinates(geometry), shapely.get_coordinates(expected[name]),
                                   atol=1e-4)  # the GML is rounded to 9 decimals, 0.1 mm
