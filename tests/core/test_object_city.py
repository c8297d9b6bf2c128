"""Street objects as city furniture and trees: what PLATEAU asks for, judged by its schema and the checks of models."""

from __future__ import annotations

import xml.etree.ElementTree as Xml
from types import SimpleNamespace

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import check_city
from urbanmap_qgis.citymodel.model import CITY_FURNITURE, SINGLE_TREE, SOLID
from urbanmap_qgis.citymodel.solids import indexed_shell
from urbanmap_qgis.roadmap.objects.object_city import furniture_objects, write_object_citygml
from urbanmap_qgis.roadmap.objects.object_records import (
    DOUBTFUL,
    LAMP,
    MEASURED,
    POLE,
    SIGN,
    SIGNAL,
    TREE,
    Board,
    StreetObject,
)

PLACE = np.array([-5000.0, -35000.0, 10.0])  # zone IX: in Tokyo
FRN = "{http://www.opengis.net/citygml/cityfurniture/2.0}"
VEG = "{http://www.opengis.net/citygml/vegetation/2.0}"
URO = "{https://www.geospatial.jp/iur/uro/3.2}"
GML = "{http://www.opengis.net/gml}"


def thing(kind, along, height=4.0, **more):
    given = {"azimuth": None, "crown": None, "arm": None, "board": None, "status": MEASURED, "reason": "", **more}
    return StreetObject(kind, 0.8, PLACE + np.array([along, 0.0, 0.0]), height, 0.2, 0.0, given["azimuth"],
                        given["crown"], given["arm"], given["board"], 0.021, 150, 1, given["status"], given["reason"])


@pytest.fixture(scope="module")
def things():
    board = Board(PLACE + np.array([10.0, -0.06, 2.4]), 180.0, 0.9, 0.6)
    return [thing(POLE, 0.0, status=DOUBTFUL, reason="its foot is hidden"),
            thing(SIGN, 10.0, 2.7, azimuth=180.0, board=board),
            thing(LAMP, 20.0, 8.0, azimuth=90.0, arm=(1.5, 7.9)), thing(SIGNAL, 30.0, 6.0, azimuth=0.0, arm=(3.0, 5.4)),
            thing(TREE, 40.0, 6.0, crown=3.2)]


def test_furniture_and_trees_have_what_plateau_asks_for(things, tmp_path):
    written = write_object_citygml(tmp_path, things, CRS(6677).to_wkt(), "2026-04-01")
    assert sorted(written.values()) == [1, 4] and all(name.endswith("_6697_op.gml") for name in written)
    furniture, = (tmp_path / "udx" / "frn").glob("*.gml")
    posts = Xml.parse(furniture).getroot().findall(f".//{FRN}CityFurniture")
    assert [post.findtext(f"{FRN}function") for post in posts] == ["4800", "3000", "4200", "4900"]
    assert {post.findtext(f"{FRN}class") for post in posts} == {"1000"}
    for post in posts:
        assert post.findtext(f".//{URO}geometrySrcDescLod1") == "111"
        assert post.find(f"{FRN}lod1Geometry/{GML}Solid") is not None
        assert post.find(f"{FRN}lod2Geometry/{GML}MultiSurface") is not None
    tree = Xml.parse(next((tmp_path / "udx" / "veg").glob("*.gml"))).getroot().find(f".//{VEG}SolitaryVegetationObject")
    sizes = [tree.findtext(f"{VEG}{name}") for name in ("height", "trunkDiameter", "crownDiameter")]
    assert [float(size) for size in sizes] == [6.0, 0.2, 3.2] and tree.find(f"{VEG}height").get("uom") == "m"
    lists = {path.stem for path in (tmp_path / "codelists").iterdir()}
    assert {"CityFurniture_class", "CityFurniture_function"} <= lists


def test_they_are_valid_by_plateaus_schema(things, tmp_path, real_data):
    from lxml import etree

    schema = real_data.parent / "tools" / "citygml" / "plateau-3.2.xsd"
    if not schema.is_file():
        pytest.skip("the schemas of PLATEAU are not there")
    judge = etree.XMLSchema(etree.parse(schema))
    write_object_citygml(tmp_path, things, CRS(6677).to_wkt(), "2026-04-01")
    for path in tmp_path.glob("udx/*/*.gml"):
        assert judge.validate(etree.parse(path)), judge.error_log.filter_from_errors()[:3]


def test_solids_are_closed(things):
    for item in furniture_objects(things):
        solid, = item.shapes_at("1", SOLID)
        assert not check_solid(SimpleNamespace(**dict(zip(("vertices", "faces"), indexed_shell(solid.shells[0])))))
    kinds = [item.type for item in furniture_objects(things)]
    assert kinds == [CITY_FURNITURE] * 4 + [SINGLE_TREE] and len({item.id for item in furniture_objects(things)}) == 5


def test_parts_stand_where_they_were_measured(things):
    items = list(furniture_objects(things))
    corners = [np.concatenate([face.rings[0] for face in item.shapes[-1].surfaces]) - PLACE for item in items]
    assert corners[1][:, 0].min() == pytest.approx(9.55) and corners[1][:, 0].max() == pytest.approx(10.45)
    assert corners[2][:, 0].max() == pytest.approx(21.5) and corners[2][:, 2].max() == pytest.approx(8.0)
    assert corners[3][:, 1].max() == pytest.approx(3.0)
    assert corners[4][:, 2].max() == pytest.approx(6.0) and np.ptp(corners[4][:, 0]) == pytest.approx(3.2)
    assert items[0].attributes["gen:reason"] == "its foot is hidden"


def test_checks_of_city_models_find_nothing(things, tmp_path):
    write_object_citygml(tmp_path, things, CRS(6677).to_wkt(), "2026-04-01")
    assert not [(fault.rule, fault.text) for fault in check_city([tmp_path], check_solid).faults]


def test_outside_of_japan_one_file_a_kind_keeps_its_system(things, tmp_path):
    assert set(write_object_citygml(tmp_path, things, CRS(32633).to_wkt())) == {"furniture.gml", "trees.gml"}
