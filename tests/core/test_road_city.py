"""A road model as CityGML: what PLATEAU asks of its roads, judged by the checks of city models."""

from __future__ import annotations

import xml.etree.ElementTree as Xml

import pytest
import shapely
from pyproj import CRS

from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import check_city
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadspace.road_city import RoadDelivery, check_function, write_road_citygml
from urbanmap_qgis.roadspace.road_model import Structures, build_road_model
from urbanmap_qgis.roadspace.road_surface import surface_of

PLACE = (-5000.0, -35000.0)  # zone IX: in Tokyo
TRAN = "{http://www.opengis.net/citygml/transportation/2.0}"
URO = "{https://www.geospatial.jp/iur/uro/3.2}"


@pytest.fixture(scope="module")
def built():
    roads = shapely.union(shapely.box(-60, -3, 60, 3), shapely.box(-2, -60, 2, 0))
    bridge = shapely.box(20, -5, 32, 5)
    moved = [shapely.transform(shape, lambda points: points + PLACE) for shape in (roads, bridge)]
    return build_road_model(surface_of(moved[:1]), Structures(bridges=moved[1:]))


def test_roads_have_what_plateau_asks_for(built, tmp_path):
    delivery = RoadDelivery(function="4", material="digital topographic map", map_level=2500, created="2026-04-01")
    written = write_road_citygml(tmp_path, built, CRS(6677).to_wkt(), delivery)
    (name, count), = written.items()
    assert name.endswith("_tran_6697_op.gml") and count == len(built.pieces) == 6
    path = tmp_path / "udx" / "tran" / name
    roads = Xml.parse(path).getroot().findall(f".//{TRAN}Road")
    assert {road.findtext(f"{TRAN}class") for road in roads} == {"1040"}
    assert {road.findtext(f"{TRAN}function") for road in roads} == {"4"}
    kinds = [road.findtext(f".//{URO}sectionType") for road in roads]
    assert sorted(kinds) == ["1", "1", "1", "1", "3", "4"]
    for road, kind in zip(roads, kinds):
        width = road.find(f".//{URO}width")
        assert (width is None) == (kind == "4")
        assert road.findtext(f".//{URO}geometrySrcDescLod1") == "000"
        assert road.findtext(f".//{URO}srcScaleLod1") == "1"
        assert road.findtext(f".//{URO}publicSurveySrcDescLod1") == "023"
        numbers = road.find(f".//{TRAN}lod1MultiSurface").findtext(".//{http://www.opengis.net/gml}posList").split()
        assert {float(height) for height in numbers[2::3]} == {0.0}
    lists = {path.stem for path in (tmp_path / "codelists").iterdir()}
    assert {"Road_function", "TransportationComplex_class", "RoadStructureAttribute_sectionType"} <= lists


def test_checks_of_city_models_find_nothing(built, tmp_path):
    write_road_citygml(tmp_path, built, CRS(6677).to_wkt(), RoadDelivery(created="2026-04-01"))
    found = check_city([tmp_path], check_solid)
    assert found.objects == 6 and not [(fault.rule, fault.text) for fault in found.faults]


def test_outside_of_japan_one_file_keeps_its_system(built, tmp_path):
    assert list(write_road_citygml(tmp_path, built, CRS(32633).to_wkt())) == ["roads.gml"]
    assert "EPSG/0/32633" in (tmp_path / "roads.gml").read_text(encoding="utf-8")


def test_function_must_be_in_the_list():
    check_function("9020")
    with pytest.raises(InputError, match="77 is no code"):
        check_function("77")
