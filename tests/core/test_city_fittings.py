"""Addresses, openings, installations and rooms of CityGML: read, written as CityGML and CityJSON, nothing lost."""

import json
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from urbanmap_qgis.citymodel.city_files import write_city_files
from urbanmap_qgis.citymodel.city_sources import open_city_model, placed_model
from urbanmap_qgis.citymodel.citygml.writer import write_citygml
from urbanmap_qgis.citymodel.model import ADDRESS, CityModel, CityReference
from urbanmap_qgis.citymodel.objects import unique_objects
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.tables.building_table import TableNotes, building_rows
from urbanmap_qgis.errors import InputError

TOOLS = Path(__file__).resolve().parents[3] / "shared" / "tools"
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
 xmlns:gml="http://www.opengis.net/gml" xmlns:gen="http://www.opengis.net/citygml/generics/2.0"
 xmlns:xAL="urn:oasis:names:tc:ciq:xsdschema:xAL:2.0" xmlns:xlink="http://www.w3.org/1999/xlink">
<gml:boundedBy><gml:Envelope srsName="http://www.opengis.net/def/crs/EPSG/0/6697" srsDimension="3">
<gml:lowerCorner>35 139 0</gml:lowerCorner><gml:upperCorner>36 140 9</gml:upperCorner></gml:Envelope></gml:boundedBy>
"""
STEP = 1e-5
"""Degrees that stand for a metre in the box below."""


def polygon(corners, name="", hole=()):
    """A polygon of corners (metres in the box's own axes) in degrees."""
    def ring(places):
        return " ".join(f"{35.5 + STEP * y:.7f} {139.5 + STEP * x:.7f} {z:g}" for x, y, z in [*places, places[0]])

    inner = "".join(f"<gml:interior><gml:LinearRing><gml:posList>{ring(corners)}</gml:posList></gml:LinearRing>"
                    "</gml:interior>" for corners in hole)
    named = f' gml:id="{name}"' if name else ""
    return (f"<gml:Polygon{named}><gml:exterior><gml:LinearRing><gml:posList>{ring(corners)}</gml:posList>"
            f"</gml:LinearRing></gml:exterior>{inner}</gml:Polygon>")


def surfaces(lod, *polygons):
    members = "".join(f"<gml:surfaceMember>{text}</gml:surfaceMember>" for text in polygons)
    return f"<bldg:lod{lod}MultiSurface><gml:MultiSurface>{members}</gml:MultiSurface></bldg:lod{lod}MultiSurface>"


HOLE = [(4, 0, 1), (4, 0, 3), (6, 0, 3), (6, 0, 1)]
FACES = {
    "ground": ("GroundSurface", [(0, 10, 0), (10, 10, 0), (10, 0, 0), (0, 0, 0)]),
    "roof": ("RoofSurface", [(0, 0, 5), (10, 0, 5), (10, 10, 5), (0, 10, 5)]),
    "south": ("WallSurface", [(0, 0, 0), (10, 0, 0), (10, 0, 5), (0, 0, 5)]),
    "east": ("WallSurface", [(10, 0, 0), (10, 10, 0), (10, 10, 5), (10, 0, 5)]),
    "north": ("WallSurface", [(10, 10, 0), (0, 10, 0), (0, 10, 5), (10, 10, 5)]),
    "west": ("WallSurface", [(0, 10, 0), (0, 0, 0), (0, 0, 5), (0, 10, 5)])}
WINDOW = ('<bldg:opening><bldg:Window gml:id="win"><gml:name>window 1</gml:name>'
          f"{surfaces(3, polygon(HOLE[::-1], 'p_win'))}</bldg:Window></bldg:opening>")
ADDRESSED = ("<bldg:address><core:Address><core:xalAddress><xAL:AddressDetails><xAL:Country>"
             "<xAL:CountryName>日本</xAL:CountryName><xAL:Locality>"
             '<xAL:LocalityName Type="Town">東京都千代田区</xAL:LocalityName>'
             "</xAL:Locality></xAL:Country></xAL:AddressDetails></core:xalAddress></core:Address></bldg:address>")


def building(wall_id="south_w", name="house"):
    """A box of level 3 with a window in its south wall, a balcony, a room with a table, a stair, an address."""
    bounds = ""
    for key, (kind, corners) in FACES.items():
        south = key == "south"
        inner = surfaces(3, polygon(corners, f"p_{key}", [HOLE] if south else ())) + (WINDOW if south else "")
        label = wall_id if south else f"{key}_w"
        named = f' gml:id="{label}"' if label else ""
        bounds += f"<bldg:boundedBy><bldg:{kind}{named}>{inner}</bldg:{kind}></bldg:boundedBy>"
    links = "".join(f'<gml:surfaceMember xlink:href="#p_{key}"/>' for key in (*FACES, "win"))
    slab = polygon([(3, -1, 1), (7, -1, 1), (7, 0, 1), (3, 0, 1)])
    table = surfaces(4, polygon([(2, 2, 1), (3, 2, 1), (3, 3, 1), (2, 3, 1)]))
    room = "".join(surfaces(4, polygon(corners)) for corners in ([(1, 1, 0), (9, 1, 0), (9, 9, 0), (1, 9, 0)],))
    return (f'<core:cityObjectMember><bldg:Building gml:id="{name}">'
            '<bldg:measuredHeight uom="m">5</bldg:measuredHeight>'
            '<bldg:outerBuildingInstallation><bldg:BuildingInstallation gml:id="balcony"><bldg:function>1000'
            f"</bldg:function><bldg:lod3Geometry><gml:MultiSurface><gml:surfaceMember>{slab}</gml:surfaceMember>"
            "</gml:MultiSurface></bldg:lod3Geometry></bldg:BuildingInstallation></bldg:outerBuildingInstallation>"
            '<bldg:interiorBuildingInstallation><bldg:IntBuildingInstallation gml:id="stair"><gml:name>stair</gml:name>'
            f"<bldg:lod4Geometry><gml:MultiSurface><gml:surfaceMember>{slab}</gml:surfaceMember></gml:MultiSurface>"
            "</bldg:lod4Geometry></bldg:IntBuildingInstallation></bldg:interiorBuildingInstallation>"
            f"{bounds}<bldg:lod3Solid><gml:Solid><gml:exterior><gml:CompositeSurface>{links}</gml:CompositeSurface>"
            "</gml:exterior></gml:Solid></bldg:lod3Solid>"
            '<bldg:interiorRoom><bldg:Room gml:id="room"><bldg:boundedBy><bldg:FloorSurface gml:id="floor">'
            f"{room}</bldg:FloorSurface></bldg:boundedBy><bldg:interiorFurniture>"
            '<bldg:BuildingFurniture gml:id="table"><bldg:lod4Geometry>'
            f"{table.removeprefix('<bldg:lod4MultiSurface>').removesuffix('</bldg:lod4MultiSurface>')}"
            "</bldg:lod4Geometry></bldg:BuildingFurniture></bldg:interiorFurniture></bldg:Room></bldg:interiorRoom>"
            f"{ADDRESSED}</bldg:Building></core:cityObjectMember>\n")


def write(folder, *members):
    path = folder / "53394601_bldg_6697_op.gml"
    path.write_text(HEAD + "".join(members) + "</core:CityModel>\n", encoding="utf-8")
    return path


def read(path, fittings=True):
    notes = ReadingNotes()
    with ExitStack() as stack:
        model = open_city_model(path, stack, notes, fittings=fittings)
        return replace(model, buildings=list(model.buildings)), notes


def described(item, digits=1e7, levels=MappingProxyType({})):
    """All of an object that a file tells, without the ids of surfaces."""
    names = {}
    for shape in item.shapes:
        for surface in shape.surfaces:
            names.setdefault(surface.group, surface.kind)
    shapes = sorted((levels.get(shape.lod, shape.lod), shape.kind, sorted(
        (surface.kind, names.get(surface.parent, ""), len(surface.rings),
         tuple(map(tuple, np.rint(np.vstack(surface.rings) * [digits, digits, 1e3]).tolist())))
        for surface in shape.surfaces)) for shape in item.shapes)
    return (item.id, item.type, dict(item.attributes).get(ADDRESS), shapes, item.problems,
            sorted((described(one, digits, levels) for one in (*item.parts, *item.fittings)),
                   key=lambda found: found[0]))


def test_a_solid_with_a_window_in_its_wall_is_closed(tmp_path):
    model, notes = read(write(tmp_path, building()))
    (house,) = model.buildings
    (solid,) = (shape for shape in house.shapes if shape.kind == "solid")
    assert not house.problems and not notes.unread and len(solid.surfaces) == 7
    window = next(surface for surface in solid.surfaces if surface.kind == "Window")
    assert (window.parent, window.attributes) == ("south_w", {"name": "window 1"})
    assert {item.id: item.type for item in house.everything()} == {
        "house": "Building", "balcony": "BuildingInstallation", "stair": "IntBuildingInstallation",
        "room": "BuildingRoom", "table": "BuildingFurniture"}
    assert house.attributes[ADDRESS].values["Country"].values["Locality"].values["LocalityName"].values == {
        "@Type": "Town", "#text": "東京都千代田区"}


@pytest.mark.parametrize("wall_id", ["south_w", ""])
def test_citygml_written_and_read_again_is_the_same(tmp_path, wall_id):
    model, _ = read(write(tmp_path, building(wall_id)))
    write_citygml(tmp_path / "set", model)
    (path,) = (tmp_path / "set").rglob("*.gml")
    again, notes = read(path)
    assert [described(item) for item in again.buildings] == [described(item) for item in model.buildings]
    assert not notes.unread and not notes.others


def test_cityjson_written_and_read_again_is_the_same(tmp_path):
    model, _ = read(write(tmp_path, building()))
    plane = replace(model, reference=CityReference("", 6677, False, "JGD2011"), buildings=list(model.buildings))
    from urbanmap_qgis.citymodel.objects import placed

    plane = replace(plane, buildings=[placed(item, lambda corners: (corners - [139.5, 35.5, 0]) / [STEP, STEP, 1])
                                      for item in plane.buildings])
    write_city_files(plane, cityjson=tmp_path / "a.city.json", cityjsonseq=tmp_path / "a.city.jsonl")
    for name in ("a.city.json", "a.city.jsonl"):
        again, notes = read(tmp_path / name)
        assert [described(item, 1e3) for item in again.buildings] == [
            described(item, 1e3, {"4": "3.3"}) for item in plane.buildings]
        assert not notes.others and not notes.repeated
    entries = json.loads((tmp_path / "a.city.json").read_text(encoding="utf-8"))["CityObjects"]
    assert entries["house"]["children"] == ["balcony", "stair", "room"] and entries["table"]["parents"] == ["room"]
    assert entries["stair"] == {**entries["stair"], "type": "BuildingInstallation",
                                "attributes": {"name": "stair", "interior": True}}
    said = entries["house"]["geometry"][0]["semantics"]["surfaces"]
    (window,) = (entry for entry in said if entry["type"] == "Window")
    assert said[window["parent"]] == {"type": "WallSurface", "id": "south_w", "children": [said.index(window)]}


def test_both_are_valid_by_their_schemas(tmp_path):
    if not TOOLS.is_dir():
        pytest.skip("the outside judges are not here")
    etree, jsonschema = pytest.importorskip("lxml.etree"), pytest.importorskip("jsonschema")
    model, _ = read(write(tmp_path, building(), building("", "house2").replace('"balcony"', '"b2"').replace(
        '"stair"', '"s2"').replace('"room"', '"r2"').replace('"table"', '"t2"').replace("_w", "_x").replace(
        "p_", "q_").replace('"win"', '"w2"').replace('"floor"', '"f2"')))
    write_citygml(tmp_path / "set", model, version="3.2")
    write_city_files(model, cityjson=tmp_path / "a.city.json")
    schema = etree.XMLSchema(etree.parse(str(TOOLS / "citygml" / "plateau-3.2.xsd"), etree.XMLParser(no_network=True)))
    (path,) = (tmp_path / "set").rglob("*.gml")
    schema.validate(etree.parse(str(path)))
    assert not list(schema.error_log)
    judge = jsonschema.Draft7Validator(json.loads((TOOLS / "cityjson-2.0.2.schema.json").read_text()))
    judge.validate(json.loads((tmp_path / "a.city.json").read_text(encoding="utf-8")))


def test_ids_that_are_there_twice_do_not_end_the_export(tmp_path):
    model, notes = read(write(tmp_path, building(), building(name="other")))
    assert sorted(notes.repeated) == ["balcony", "room", "stair", "table"]
    assert len({item.id for house in unique_objects(model.buildings) for item in house.everything()}) == 10


def test_layers_count_what_they_leave_out(tmp_path):
    model, notes = read(write(tmp_path, building()), fittings=False)
    assert sorted(notes.unread) == ["interiorBuildingInstallation", "interiorRoom", "outerBuildingInstallation"]
    (row,) = building_rows(iter(model.buildings), lambda corners: corners, TableNotes())
    assert row.values["address_Country_CountryName"] == "日本" and row.kinds.count("outer wall") == 5
    assert not [name for name in row.values if "@" in name]


@pytest.mark.filterwarnings("error")
def test_a_corner_far_outside_is_refused_by_the_id_of_its_building(tmp_path):
    """A corner at 1e11 degrees: neither a warning of a number that no integer holds, nor a sentence without a name."""
    text = building()
    at = text.index("<gml:posList>") + len("<gml:posList>")
    path = write(tmp_path, f"{text[:at]}1e11 {text[at:].split(maxsplit=1)[1]}")
    model, _ = read(path)
    _, buildings, places = placed_model(model, None, [])
    with pytest.raises(InputError, match="'house' has corners"):
        list(building_rows(buildings, places, TableNotes()))


def test_an_address_of_cityjson_becomes_lines_of_an_address(tmp_path):
    model, _ = read(write(tmp_path, building()))
    write_city_files(model, cityjson=tmp_path / "a.city.json")
    content = json.loads((tmp_path / "a.city.json").read_text(encoding="utf-8"))
    content["CityObjects"]["house"]["address"] = [{"Country": "日本", "Locality": "那覇市 <1>", "location": {}}]
    (tmp_path / "b.city.json").write_text(json.dumps(content), encoding="utf-8")
    other, _ = read(tmp_path / "b.city.json")
    write_citygml(tmp_path / "set", other)
    (path,) = (tmp_path / "set").rglob("*.gml")
    assert ('<xAL:AddressLine Type="Country">日本</xAL:AddressLine><xAL:AddressLine Type="Locality">那覇市 &lt;1&gt;'
            in path.read_text(encoding="utf-8"))


def test_an_opening_without_its_wall_is_kept(tmp_path):
    model, _ = read(write(tmp_path, building()))
    house = model.buildings[0]
    window = next(surface for shape in house.shapes for surface in shape.surfaces if surface.kind == "Window")
    alone = replace(house, shapes=(replace(house.shapes[0], kind="multi surface", shells=((window,),)),), fittings=())
    write_citygml(tmp_path / "set", CityModel(model.reference, [alone]))
    (path,) = (tmp_path / "set").rglob("*.gml")
    (again,) = read(path)[0].buildings
    assert [surface.kind for shape in again.shapes for surface in shape.surfaces] == ["Window"]
