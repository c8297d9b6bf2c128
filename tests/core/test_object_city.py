"""Street objects as city furniture and trees: what PLATEAU asks for, judged by its schema and the checks of models."""

from __future__ import annotations

import json
import xml.etree.ElementTree as Xml
from collections import Counter
from contextlib import ExitStack
from types import SimpleNamespace

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import check_city
from urbanmap_qgis.citymodel.city_sources import open_city_model, placed_model
from urbanmap_qgis.citymodel.citygml.reader import STREET_THINGS
from urbanmap_qgis.citymodel.model import CITY_FURNITURE, SINGLE_TREE, SOLID
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.solids import indexed_shell
from urbanmap_qgis.citymodel.tables.street_table import StreetTable
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


def test_boards_that_cross_the_outline_of_their_post_leave_no_short_side(tmp_path):
    """Boards at 60 places about a post: the corners of some lie within 1 cm of where they cross its outline."""
    boards = [thing(SIGN, 3.0 * k, 2.7, azimuth=6.0 * k, board=Board(
        PLACE + np.array([3.0 * k + 0.002 * k, 0.003 * k, 2.4]), 6.0 * k, 0.6, 0.6)) for k in range(60)]
    write_object_citygml(tmp_path, boards, CRS(6677).to_wkt(), "2026-04-01")
    assert not [(fault.rule, fault.text) for fault in check_city([tmp_path], check_solid).faults]


def test_outside_of_japan_one_file_a_kind_keeps_its_system(things, tmp_path):
    assert set(write_object_citygml(tmp_path, things, CRS(32633).to_wkt())) == {"furniture.gml", "trees.gml"}


def loaded(path, more=STREET_THINGS):
    """Street objects of a folder as a table, and what is no street object, as ids."""
    notes = ReadingNotes()
    with ExitStack() as stack:
        _, objects, places = placed_model(open_city_model(path, stack, notes, more=more), None, [])
        table = StreetTable(places, Counter())
        return table, [item.id for item in table.without_street_objects(objects)], notes


def test_what_was_written_is_read_again(things, tmp_path):
    write_object_citygml(tmp_path, things, CRS(6677).to_wkt(), "2026-04-01")
    table, others, notes = loaded(tmp_path)
    columns = table.columns
    assert not others and not notes.unread and not notes.others and not any(columns["note"])
    assert columns["kind"] == ["furniture"] * 4 + ["tree"] and columns["lod"] == ["1,2"] * 4 + ["1"]
    assert columns["function"] == ["4800", "3000", "4200", "4900", ""] and columns["class"] == ["1000"] * 4 + [""]
    assert np.allclose(columns["ground"], 10.0, atol=1e-3)
    assert np.allclose(columns["height"], [thing.height for thing in things], atol=1e-3)
    for thing, model in zip(things, table.models):
        west, south, east, north = model.bounds
        assert west - 1e-3 <= thing.foot[0] <= east + 1e-3 and south - 1e-3 <= thing.foot[1] <= north + 1e-3
    post, tree = table.models[0], table.models[4]
    assert post.bounds == pytest.approx((-5000.1, -35000.1, -4999.9, -34999.9), abs=2e-3)
    assert tree.bounds[2] - tree.bounds[0] == pytest.approx(3.2, abs=2e-3)
    told = json.loads(columns["attributes"][0])
    assert told["gen:kind"] == "pole" and told["gen:reason"] == "its foot is hidden"
    assert told["uro:frnDataQualityAttribute"]["uro:geometrySrcDescLod1_code"] == "111"


def test_files_of_things_that_are_not_asked_for_are_passed_over(things, tmp_path):
    write_object_citygml(tmp_path, things, CRS(6677).to_wkt())
    table, _, _ = loaded(tmp_path, {"veg"})
    assert table.columns["kind"] == ["tree"]


@pytest.mark.parametrize(("case", "count", "lods"), [
    ("Z-01-INSTANCE_COUNTS", 2, {"3"}), ("Z-02-SURFACE_ERROR", 2, {"3"}), ("Z-03-SOLID_ERROR", 2, {"1"})])
def test_files_of_the_public_checker_are_read(real_data, case, count, lods):
    folder = real_data / "rules" / "plateau4" / "04-frn-veg" / case / "udx"
    if not folder.is_dir():
        pytest.skip("the cases of the public checker are not there")
    table, others, _ = loaded(folder)
    assert (len(table.models), not others, set(table.columns["lod"])) == (count, True, lods)
    for model, ground, top in zip(table.models, table.columns["ground"], table.columns["top"]):
        assert model is not None and top > ground


CITY = """<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
 xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0" xmlns:xlink="http://www.w3.org/1999/xlink"><gml:boundedBy>
 <gml:Envelope srsName="EPSG:25833"><gml:lowerCorner>0 0 0</gml:lowerCorner><gml:upperCorner>1 1 1</gml:upperCorner>
 </gml:Envelope></gml:boundedBy>{members}</core:CityModel>"""
PROTOTYPE = ("<gml:MultiSurface gml:id='crown'><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing>"
             "<gml:posList>0 0 0 1 0 0 1 0 3 0 0 3 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
             "</gml:surfaceMember></gml:MultiSurface>")


def tree(name, inside, matrix, point="500 600 30"):
    """A tree of a prototype: given inline, or by what `inside` says of it."""
    matrix = f"<core:transformationMatrix>{matrix}</core:transformationMatrix>" if matrix else ""
    return (f"<core:cityObjectMember><veg:SolitaryVegetationObject gml:id='{name}'><veg:species>1060</veg:species>"
            f"<veg:height uom='m'>7.5</veg:height><veg:lod2ImplicitRepresentation><core:ImplicitGeometry>{matrix}"
            f"{inside}<core:referencePoint><gml:Point><gml:pos>{point}</gml:pos></gml:Point></core:referencePoint>"
            "</core:ImplicitGeometry></veg:lod2ImplicitRepresentation></veg:SolitaryVegetationObject>"
            "</core:cityObjectMember>")


def test_prototypes_stand_where_matrix_and_point_put_them(tmp_path):
    inline = f"<core:relativeGMLGeometry>{PROTOTYPE}</core:relativeGMLGeometry>"
    quarter = "0 -2 0 0.5 2 0 0 0 0 0 2 0 0 0 0 1"  # turned left by 90 degrees, twice as large, half a metre east
    trees = [tree("a", inline, ""), tree("b", "<core:relativeGMLGeometry xlink:href='#crown'/>", quarter),
             tree("c", "<core:libraryObject>tree.3ds</core:libraryObject>", quarter), tree("d", inline, "1 0 0")]
    path = tmp_path / "trees.gml"
    path.write_text(CITY.format(members="".join(trees)), encoding="utf-8")
    table, _, notes = loaded(path)
    assert table.columns["object_id"] == ["a", "b", "c", "d"] and table.columns["height"] == [7.5] * 4
    assert table.columns["species"] == ["1060"] * 4 and table.columns["lod"] == ["2", "2", "", ""]
    first, second, *others = table.models
    assert first.bounds == (500.0, 600.0, 501.0, 600.0) and second.bounds == (500.5, 600.0, 500.5, 602.0)
    assert table.columns["ground"][:2] == [30.0, 30.0] and table.columns["top"][:2] == [33.0, 36.0]
    assert others == [None, None] and notes.unread["lod2ImplicitRepresentation"] == 2
    assert table.columns["note"] == ["", "", *["it has no surface that could be read"] * 2]
