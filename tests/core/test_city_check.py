"""Rules of city models: one fault each in a small sound model, told under its code and nothing else."""

from __future__ import annotations

import re
import time
import zipfile
from concurrent.futures import ProcessPoolExecutor

import pytest

from scripts.make_rule_page import CITY_PAGE, city_rules_page
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import SOLID_RULES, CityInspection, check_city
from urbanmap_qgis.citymodel.checks.city_rule_table import CITY_RULES
from urbanmap_qgis.citymodel.checks.quality_forms import quality_report, write_counts, write_results
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.mesh_code import mesh_bounds, third_mesh_code
from urbanmap_qgis.io.files.rule_table import SEVERITIES

SPACES = " ".join(f'xmlns:{prefix}="http://www.opengis.net/citygml/{name}2.0"' for prefix, name in (
    ("core", ""), ("bldg", "building/"), ("tran", "transportation/"), ("frn", "cityfurniture/"),
    ("veg", "vegetation/"))) + (' xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" '
                                'xmlns:uro="https://www.geospatial.jp/iur/uro/3.2"')
HEAD = (f'<core:CityModel {SPACES}><gml:boundedBy><gml:Envelope srsName="http://www.opengis.net/def/crs/EPSG/0/6697" '
        'srsDimension="3"><gml:lowerCorner>35.0 139.0 0</gml:lowerCorner><gml:upperCorner>36.0 140.0 100'
        "</gml:upperCorner></gml:Envelope></gml:boundedBy>")
UUID = "00000000-0000-4000-8000-{:012d}"
SIDE = 1e-4
"""Degrees: 11 m northwards, 9 m eastwards."""
MIDDLE = (35.655, 139.76)
MESH = third_mesh_code(MIDDLE[1], MIDDLE[0])


def place(north: float, east: float, height: float) -> str:
    return f"{MIDDLE[0] + north * SIDE:.9f} {MIDDLE[1] + east * SIDE:.9f} {height}"


def polygon(*corners, holes=(), identifier="") -> str:
    """A polygon by its corners (north, east, height), closed."""
    def ring(places) -> str:
        text = " ".join(place(*corner) for corner in (*places, places[0]))
        return f"<gml:LinearRing><gml:posList>{text}</gml:posList></gml:LinearRing>"

    named = f' gml:id="{identifier}"' if identifier else ""
    inner = "".join(f"<gml:interior>{ring(hole)}</gml:interior>" for hole in holes)
    return f"<gml:Polygon{named}><gml:exterior>{ring(corners)}</gml:exterior>{inner}</gml:Polygon>"


def box(east: float = 0.0, top: float = 10.0) -> list[str]:
    """Faces of a box, counterclockwise from outside."""
    corners = ((0, east), (0, east + 1), (1, east + 1), (1, east))
    walls = [polygon((*a, 0), (*b, 0), (*b, top), (*a, top)) for a, b in zip(corners, (*corners[1:], corners[0]))]
    return [polygon(*((*corner, 0) for corner in corners[::-1])), polygon(*((*corner, top) for corner in corners)),
            *walls]


def members(faces) -> str:
    return "".join(f"<gml:surfaceMember>{face}</gml:surfaceMember>" for face in faces)


def solid(faces) -> str:
    return (f"<gml:Solid><gml:exterior><gml:CompositeSurface>{members(faces)}</gml:CompositeSurface></gml:exterior>"
            "</gml:Solid>")


def surfaces(*faces) -> str:
    return f"<gml:MultiSurface>{members(faces)}</gml:MultiSurface>"


FLOOR = polygon((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
OUTLINE = polygon((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0))
"""Looking up: east, then north."""


def quality(levels: str = "01", source: str = "112", more: str = "") -> str:
    space = "../../codelists/DataQualityAttribute_geometrySrcDesc.xml"
    texts = "".join(f'<uro:geometrySrcDescLod{level} codeSpace="{space}">{source}</uro:geometrySrcDescLod{level}>'
                    for level in levels)
    return ("<uro:bldgDataQualityAttribute><uro:DataQualityAttribute>" + texts + more
            + "</uro:DataQualityAttribute></uro:bldgDataQualityAttribute>")


def named(number: int = 1, city: str = "13101", identifier: str | None = None) -> str:
    return ("<uro:buildingIDAttribute><uro:BuildingIDAttribute><uro:buildingID>"
            + (identifier or f"{city}-bldg-{number}") + "</uro:buildingID>"
            f'<uro:city codeSpace="../../codelists/Common_localPublicAuthorities.xml">{city}</uro:city>'
            "</uro:BuildingIDAttribute></uro:buildingIDAttribute>")


def building(number: int = 1, east: float = 0.0, *, own: str = "", geometry: str | None = None, ids: str | None = None,
             about: str | None = None, date: str = "<core:creationDate>2026-04-01</core:creationDate>",
             identifier: str = "") -> str:
    """A sound building, or one with something else in place of a part of it."""
    shape = geometry if geometry is not None else (
        f"<bldg:lod0RoofEdge>{surfaces(OUTLINE)}</bldg:lod0RoofEdge><bldg:lod1Solid>{solid(box(east))}"
        "</bldg:lod1Solid>")
    return (f'<bldg:Building gml:id="{identifier or "bldg_" + UUID.format(number)}">{date}{own}{shape}'
            f"{named(number) if ids is None else ids}{quality() if about is None else about}</bldg:Building>")


def written(folder, *objects: str, name: str = f"{MESH}_bldg_6697_op.gml", head: str = HEAD, theme: str = "bldg"):
    path = folder / "udx" / theme / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(head + "".join(f"<core:cityObjectMember>{one}</core:cityObjectMember>" for one in objects)
                    + "</core:CityModel>", encoding="utf-8")
    return path


def rules_of(path, excluded=()) -> list[str]:
    return sorted(fault.rule for fault in check_city(path, check_solid, excluded).faults)


def test_sound_model_breaks_no_rule(tmp_path):
    written(tmp_path, building(), building(2, 2.0))
    found = check_city(tmp_path, check_solid)
    assert found.faults == [] and found.objects == 2 and found.files == [f"{MESH}_bldg_6697_op.gml"]
    assert found.counts[found.files[0]] == {"bldg:Building": 2}


def lod1(faces) -> str:
    return f"<bldg:lod0RoofEdge>{surfaces(OUTLINE)}</bldg:lod0RoofEdge><bldg:lod1Solid>{solid(faces)}</bldg:lod1Solid>"


def lod0(face: str) -> str:
    return f"<bldg:lod0RoofEdge>{surfaces(face)}</bldg:lod0RoofEdge>"


PIT = ((0.2, 0.2, 0), (0.4, 0.2, 0), (0.4, 0.4, 0), (0.2, 0.4, 0))
BOX = box()
FAULTY = {
    "C05": building(date=""),
    "C07": building(about=quality("0")),
    "C08": building(about=quality(source="000", more="<uro:publicSurveyDataQualityAttribute>"
                                  "<uro:PublicSurveyDataQualityAttribute><uro:srcScaleLod0>1</uro:srcScaleLod0>"
                                  "<uro:publicSurveySrcDescLod0>003</uro:publicSurveySrcDescLod0>"
                                  "</uro:PublicSurveyDataQualityAttribute></uro:publicSurveyDataQualityAttribute>")),
    "L02.value": building(own='<bldg:measuredHeight uom="m">abc</bldg:measuredHeight>'),
    "L02.coordinates": building(geometry=lod1([BOX[0].replace(" 0 ", " x ", 1), *BOX[1:]])),
    "L04": building(own='<bldg:class codeSpace="../../codelists/Building_class.xml">100</bldg:class>'),
    "L04.list": building(own='<bldg:class codeSpace="../../codelists/nowhere.xml">3001</bldg:class>'),
    "L07": building(geometry=lod0(polygon((0, 0, 0), (0, 1, 0), (1e-5, 1, 0), (1, 1, 0), (1, 0, 0)))),
    "L09": building(geometry=lod0(polygon((0, 0, 0), (0, 1, 0), (1, 0.2, 0), (1, 0.8, 0)))),
    "L10": building(geometry=lod0(FLOOR)),
    "L13": building(geometry=lod0(polygon((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0),
                                          holes=[[(a, b + 0.7, c) for a, b, c in PIT]]))),
    "L14.closed": building(geometry=lod1(BOX[:-1])),
    "L14.boundary": building(geometry=lod1([*BOX[:-1], polygon((1, 0, 0), (1, 0, 10), (0, 0, 10), (0, 0, 0))])),
    "L-bldg-04": building(own="<uro:buildingDetailAttribute><uro:BuildingDetailAttribute><uro:majorUsage2>1"
                          "</uro:majorUsage2></uro:BuildingDetailAttribute></uro:buildingDetailAttribute>"),
    "L-bldg-05": building(own="<uro:buildingDetailAttribute><uro:BuildingDetailAttribute><uro:detailedUsage2>1"
                          "</uro:detailedUsage2></uro:BuildingDetailAttribute></uro:buildingDetailAttribute>"),
    "T03.missing": building(own='<bldg:consistsOfBuildingPart xlink:href="#nothing"/>'),
    "D-gml-id": building(identifier="building1"),
    "D-building-id": building(ids=named(identifier="1310-bldg-1")),
    "D-city-code": building(ids=named(city="99999", identifier="13101-bldg-1")),
}


@pytest.mark.parametrize("rule", sorted(FAULTY))
def test_one_fault_is_told_under_its_code_alone(tmp_path, rule):
    path = written(tmp_path, FAULTY[rule], building(2, 2.0))
    assert rules_of(path, ["C07"] if rule in ("L07", "L09", "L10", "L13") else ()) == [rule]


def test_designated_city_is_told_by_its_ward(tmp_path):
    (fault,) = check_city(written(tmp_path, building(ids=named(city="01100"))), check_solid).faults
    assert fault.rule == "D-city-code" and "ward" in fault.text


def test_planes_of_lod1_and_of_lod2_have_their_own_limits(tmp_path):
    bent = polygon((0, 0, 10), (0, 1, 10.05), (1, 1, 10), (1, 0, 10.05))
    slightly = bent.replace("10.05", "10.03")
    assert "L11" in rules_of(written(tmp_path, building(geometry=lod1([BOX[0], slightly, *BOX[2:]]))))
    roof = '<bldg:boundedBy><bldg:RoofSurface gml:id="r"><bldg:lod2MultiSurface>{}</bldg:lod2MultiSurface>' \
           "</bldg:RoofSurface></bldg:boundedBy>"
    for face, rules in ((bent, ["L12"]), (slightly, [])):
        path = written(tmp_path, building(geometry=roof.format(surfaces(face)), about=quality("2")))
        assert rules_of(path) == rules


def test_places_off_the_earth_and_outside_of_the_envelope(tmp_path):
    far = OUTLINE.replace(place(1, 1, 0), "35.655 100000000000 0")
    path = written(tmp_path, building(geometry=lod0(far), about=quality("0")))
    assert {"L06", "L06.earth"} <= set(rules_of(path))


@pytest.mark.parametrize("height", ["1e308", "-1e250"])
def test_places_whose_products_overflow_are_told_as_unreadable(tmp_path, height):
    far = OUTLINE.replace(place(1, 1, 0), f"35.655 139.7 {height}")
    path = written(tmp_path, building(geometry=lod0(far), about=quality("0")))
    assert rules_of(path) == ["L02.coordinates"]


def test_solid_turned_inside_out_is_told(tmp_path):
    inside_out = [polygon(*reversed(corners)) for corners in (
        ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)), ((0, 0, 9), (0, 1, 9), (1, 1, 9), (1, 0, 9)),
        ((0, 0, 0), (0, 1, 0), (0, 1, 9), (0, 0, 9)), ((0, 1, 0), (1, 1, 0), (1, 1, 9), (0, 1, 9)),
        ((1, 1, 0), (1, 0, 0), (1, 0, 9), (1, 1, 9)), ((1, 0, 0), (0, 0, 0), (0, 0, 9), (1, 0, 9)))]
    assert rules_of(written(tmp_path, building(geometry=lod1(inside_out)))) == ["L14.boundary"]


def test_ids_are_compared_over_all_files(tmp_path):
    written(tmp_path, building(1))
    written(tmp_path, building(1, 2.0), name=f"{MESH}_bldg_6697_2_op.gml")
    found = check_city(tmp_path, check_solid)
    assert sorted(fault.rule for fault in found.faults) == ["C-bldg-01", "C-bldg-01", "C01", "C01"]
    assert len({fault.path for fault in found.faults}) == 2


def test_files_looked_at_together_are_told_as_one_after_another(tmp_path):
    """Ids, building ids, references and overlaps over files, roads among them; whatever a worker hands back."""
    written(tmp_path, building(1), building(2, 2.0, own='<bldg:consistsOfBuildingPart xlink:href="#nothing"/>'))
    written(tmp_path, building(1, 0.5), name=f"{MESH}_bldg_6697_2_op.gml")
    written(tmp_path, road(1, area(1, 0.0), area(2, 0.5), own=referring(1, 2)), name="input.gml", theme="tran")
    alone = check_city(tmp_path, check_solid)
    with ProcessPoolExecutor(2) as executor:
        together = check_city(tmp_path, check_solid, executor=executor)
    assert {"C01", "C-bldg-01", "L-bldg-01", "T03.missing", "L-tran-02"} <= {fault.rule for fault in alone.faults}
    assert repr(together) == repr(alone)


def test_solids_that_overlap_are_told_and_neighbours_are_not(tmp_path):
    assert rules_of(written(tmp_path, building(1), building(2, 1.0))) == []
    assert rules_of(written(tmp_path, building(1), building(2, 0.5))) == ["L-bldg-01"]


def test_references_lead_to_the_right_kind(tmp_path):
    other = "bldg_" + UUID.format(2)
    geometry = ('<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface><gml:surfaceMember '
                f'xlink:href="#{other}"/></gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>')
    path = written(tmp_path, building(1, geometry=lod0(OUTLINE) + geometry), building(2, 2.0))
    assert rules_of(path) == ["T03"]


def test_faces_of_a_lod2_solid_are_those_of_its_surfaces(tmp_path):
    faces = [face.replace("<gml:Polygon>", f'<gml:Polygon gml:id="f{k}">') for k, face in enumerate(BOX)]
    held = "".join(f'<bldg:boundedBy><bldg:WallSurface gml:id="s{k}"><bldg:lod2MultiSurface>{surfaces(face)}'
                   "</bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy>" for k, face in enumerate(faces))
    referred = "".join(f'<gml:surfaceMember xlink:href="#f{k}"/>' for k in range(len(faces)))
    shell = ("<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>{}</gml:CompositeSurface></gml:exterior>"
             "</gml:Solid></bldg:lod2Solid>")
    assert rules_of(written(tmp_path, building(geometry=shell.format(referred) + held, about=quality("2")))) == []
    own = shell.format(members(BOX))
    assert rules_of(written(tmp_path, building(geometry=own, about=quality("2")))) == ["L-bldg-06"] * 6


def test_parts_have_no_lod1_and_hang_together(tmp_path):
    def part(number: int, east: float, level: int) -> str:
        return (f'<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id="p{number}"><bldg:lod{level}Solid>'
                f"{solid(box(east))}</bldg:lod{level}Solid></bldg:BuildingPart></bldg:consistsOfBuildingPart>")

    assert rules_of(written(tmp_path, building(own=part(1, 3.0, 1)))) == ["C04"]
    about = quality("012")
    for east, told in ((1.0, []), (2.0, ["L-bldg-02"])):
        path = written(tmp_path, building(own=part(1, 0.0, 2) + part(2, east, 2), about=about))
        assert [rule for rule in rules_of(path) if rule != "L-bldg-06"] == told


def test_building_lies_in_the_file_of_its_mesh(tmp_path):
    assert rules_of(written(tmp_path, building(), name="53394602_bldg_6697_op.gml")) == ["D-7.2.2.1"]
    assert rules_of(written(tmp_path, building(), name="input.gml")) == []


def test_bounds_of_meshes_hold_the_place_that_has_the_code():
    for code in (MESH, MESH[:6], MESH[:4]):
        west, south, east, north = mesh_bounds(code)
        assert west <= MIDDLE[1] < east and south <= MIDDLE[0] < north
    assert mesh_bounds("1234") == pytest.approx((134.0, 8.0, 135.0, 8.0 + 2 / 3))
    assert mesh_bounds("53394682")[2] - mesh_bounds("53394682")[0] == pytest.approx(45 / 3600)
    assert mesh_bounds("533946824")[1] - mesh_bounds("53394682")[1] == pytest.approx(15 / 3600)
    assert mesh_bounds("5339968") is None and mesh_bounds("53399682") is None and mesh_bounds("input") is None


def road(number: int, *areas: str, own: str = "") -> str:
    return (f'<tran:Road gml:id="tran_{UUID.format(number)}"><core:creationDate>2026-04-01</core:creationDate>'
            + "".join(areas) + own + "<uro:tranDataQualityAttribute><uro:DataQualityAttribute>"
            "<uro:geometrySrcDescLod3>112</uro:geometrySrcDescLod3></uro:DataQualityAttribute></uro:tranDataQualityAttribute></tran:Road>")


def square(south: float, west: float, side: float, height: float = 0.0) -> list:
    return [(south, west, height), (south, west + side, height), (south + side, west + side, height),
            (south + side, west, height)]


def area(number: int, east: float, code: str = "1000", height: float = 0.0) -> str:
    return area_of(number, square(0.0, east, 1.0, height), code)


def area_of(number: int, corners: list, code: str = "1000", holes: tuple = ()) -> str:
    face = polygon(*corners, holes=holes, identifier=f"a{number}")
    return (f'<tran:trafficArea><tran:TrafficArea gml:id="t{number}"><tran:function>{code}</tran:function>'
            f"<tran:lod3MultiSurface>{surfaces(face)}</tran:lod3MultiSurface></tran:TrafficArea></tran:trafficArea>")


def referring(*numbers: int) -> str:
    links = "".join(f'<gml:surfaceMember xlink:href="#a{number}"/>' for number in numbers)
    return f"<tran:lod3MultiSurface><gml:MultiSurface>{links}</gml:MultiSurface></tran:lod3MultiSurface>"


@pytest.mark.parametrize(("east", "codes", "height", "told"), [
    (1.0, ("1000", "1000"), 0.0, []), (0.5, ("1000", "1000"), 0.0, ["L-tran-02"] * 2),
    (0.5, ("1080", "3020"), 0.0, []), (0.5, ("1000", "1000"), 6.0, [])])
def test_areas_of_roads_share_borders_only(tmp_path, east, codes, height, told):
    one = road(1, area(1, 0.0, codes[0]), area(2, east, codes[1], height), own=referring(1, 2))
    assert rules_of(written(tmp_path, one, name="input.gml", theme="tran")) == told


@pytest.mark.parametrize(("west", "told"), [(0.4, []), (0.3, ["L-tran-02"] * 2)])
def test_an_island_lies_in_the_hole_of_its_carriageway(tmp_path, west, told):
    whole = area_of(1, square(0.0, 0.0, 1.0), holes=(square(0.4, 0.4, 0.2)[::-1],))
    one = road(1, whole, area_of(2, square(0.4, west, 0.2)), own=referring(1, 2))
    assert rules_of(written(tmp_path, one, name="input.gml", theme="tran")) == told


def test_roads_refer_to_their_areas_and_look_up(tmp_path):
    path = written(tmp_path, road(1, area(1, 0.0), area(2, 1.0), own=referring(1)), name="input.gml", theme="tran")
    assert rules_of(path) == ["L-tran-03"]
    down = area(1, 0.0).replace(place(0, 0, 0.0), "*").replace(place(1, 1, 0.0), place(0, 0, 0.0)).replace(
        "*", place(1, 1, 0.0))
    assert rules_of(written(tmp_path, road(1, down, own=referring(1)), name="input.gml", theme="tran")) == ["L10"]


def furniture(level: int, body: str, quality: bool = True, name: str = "Geometry") -> str:
    source = (f"<uro:frnDataQualityAttribute><uro:DataQualityAttribute><uro:geometrySrcDescLod{level}>112"
              f"</uro:geometrySrcDescLod{level}></uro:DataQualityAttribute></uro:frnDataQualityAttribute>")
    return (f'<frn:CityFurniture gml:id="frn_{UUID.format(1)}"><core:creationDate>2026-04-01</core:creationDate>'
            f"<frn:lod{level}{name}>{body}</frn:lod{level}{name}>" + source * quality + "</frn:CityFurniture>")


def test_geometries_that_roads_and_furniture_may_have(tmp_path):
    face = surfaces(polygon((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)))
    told = [rules_of(written(tmp_path / f"frn{level}", furniture(level, face), name="input.gml", theme="frn"))
            for level in (1, 3, 4)]
    assert told == [[], [], ["C04"]]
    network = "<tran:lod0Network><gml:GeometricComplex/></tran:lod0Network>"
    other = "<tran:lod4MultiSurface>{}</tran:lod4MultiSurface>"
    roads = [road(1, area(1, 0.0), own=referring(1) + more).replace("<uro:geometrySrcDescLod3>", "".join(
        f"<uro:geometrySrcDescLod{k}>112</uro:geometrySrcDescLod{k}>" for k in (0, 1, 4)) + "<uro:geometrySrcDescLod3>")
        for more in (network, other.format(face))]
    assert [rules_of(written(tmp_path / f"road{n}", one, name="input.gml", theme="tran"))
            for n, one in enumerate(roads)] == [[], ["C04"]]


def test_furniture_has_a_quality_attribute(tmp_path):
    face = surfaces(polygon((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)))
    path = written(tmp_path, furniture(1, face, quality=False), name="input.gml", theme="frn")
    assert sorted(rules_of(path)) == ["C05", "C07"]


def test_kinds_of_geometry_and_of_city_objects(tmp_path):
    furniture = (f'<frn:CityFurniture gml:id="frn_{UUID.format(1)}"><core:creationDate>2026-04-01</core:creationDate>'
                 f"<frn:lod1Geometry>{OUTLINE}</frn:lod1Geometry>"
                 "<uro:frnDataQualityAttribute><uro:DataQualityAttribute><uro:geometrySrcDescLod1>112"
                 "</uro:geometrySrcDescLod1></uro:DataQualityAttribute></uro:frnDataQualityAttribute></frn:CityFurniture>")
    assert rules_of(written(tmp_path, furniture, name="input.gml", theme="frn")) == ["L-frn-01"]
    assert rules_of(written(tmp_path / "b", furniture.replace("lod1Geometry", "lod1Geometry"), name="input.gml")) == [
        "L-frn-01", "L03"]


def test_file_that_is_broken_off_is_one_fault_of_many(tmp_path):
    path = written(tmp_path, building(), building(2, 2.0))
    path.write_text(path.read_text(encoding="utf-8")[:-40], encoding="utf-8")
    assert "L01" in rules_of(path)
    other = written(tmp_path / "b", building(), head=HEAD.replace("6697", "4326"))
    assert rules_of(other) == ["L05"]


def test_a_list_of_a_name_without_end_takes_no_time(tmp_path):
    path = written(tmp_path, building(own=f'<bldg:class codeSpace="{"n" * 60_000}">3001</bldg:class>'))
    start = time.process_time()
    assert rules_of(path) == ["L04.list"]
    assert time.process_time() - start < 5  # it grew by the square of the length


def test_lists_of_the_data_set_are_asked_before_those_of_the_specification(tmp_path):
    path = written(tmp_path, building(own='<bldg:class codeSpace="../../codelists/Building_class.xml">7</bldg:class>'))
    assert rules_of(path) == ["L04"]
    lists = tmp_path / "codelists"
    lists.mkdir()
    (lists / "Building_class.xml").write_text(
        '<gml:Dictionary xmlns:gml="http://www.opengis.net/gml"><gml:name>Building_class</gml:name><gml:dictionaryEntry>'
        "<gml:Definition><gml:description>seven</gml:description><gml:name>7</gml:name></gml:Definition>"
        "</gml:dictionaryEntry></gml:Dictionary>", encoding="utf-8")
    assert set(rules_of(tmp_path)) == {"L04.list"}, "the other lists are missing in a data set that brings its own"


def test_rules_left_out_and_zips(tmp_path):
    path = written(tmp_path, FAULTY["C05"], FAULTY["D-gml-id"].replace(UUID.format(1), UUID.format(3)))
    assert rules_of(path, ["C", "L-bldg", "D-"]) == []
    with pytest.raises(InputError, match="begins with Nothing"):
        rules_of(path, ["Nothing"])
    with zipfile.ZipFile(tmp_path / "set.zip", "w") as archive:
        archive.write(path, f"udx/bldg/{path.name}")
    assert "C05" in rules_of(tmp_path / "set.zip")


def test_forms_hold_every_file_and_rule(tmp_path):
    written(tmp_path, FAULTY["C05"])
    found = check_city(tmp_path, check_solid)
    write_results(tmp_path / "r.csv", found)
    write_counts(tmp_path / "c.csv", found)
    head, row = (tmp_path / "r.csv").read_text(encoding="utf-8-sig").splitlines()
    values = dict(zip(head.split(","), row.split(",")))
    assert values["C05"] == "1" and set(CITY_RULES.rules) <= set(values) and values["C01"] == "0"
    assert (tmp_path / "c.csv").read_text(encoding="utf-8-sig").splitlines()[1].endswith(",1")
    quality_report(found).write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "core:creationDate" in page and "met in part" in page
    assert verdict_of_line(page, "C05") == "not met" and verdict_of_line(page, "C01") == "met"
    assert verdict_of_line(page, "L-tran-01") == verdict_of_line(page, "L-frn-02") == "nothing to check"


def verdict_of_line(page: str, code: str) -> str:
    """Last cell of a requirement's first line in the report."""
    return re.findall(r"<td[^>]*>([^<]*)</td>", page[page.index(f">{code}<"):])[2]


def test_what_was_left_out_is_not_called_met(tmp_path):
    written(tmp_path, FAULTY["C05"])
    found = check_city(tmp_path, check_solid, ["C05"])
    write_results(tmp_path / "r.csv", found)
    head, row = (line.split(",") for line in (tmp_path / "r.csv").read_text(encoding="utf-8-sig").splitlines())
    assert dict(zip(head, row))["C05"] == ""
    quality_report(found).write(tmp_path / "r.html")
    assert verdict_of_line((tmp_path / "r.html").read_text(encoding="utf-8"), "C05") == "left out"


def test_nothing_is_not_called_good(tmp_path):
    found = CityInspection(files=["a.gml"], counts={"a.gml": {}}, checked=tuple(CITY_RULES.rules))
    quality_report(found).write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "nothing to check but the files" in page and 'class="verdict look"' in page
    assert verdict_of_line(page, "L01") == "met" and verdict_of_line(page, "C01") == "nothing to check"


def test_every_rule_has_a_function_a_place_in_the_page_and_two_texts():
    assert set(CITY_RULES.functions) | set(SOLID_RULES) == set(CITY_RULES.rules)
    assert CITY_PAGE.read_text(encoding="utf-8") == city_rules_page(), "run scripts/make_rule_page.py"
    for rule in CITY_RULES.rules.values():
        assert rule.severity in SEVERITIES and rule.text and rule.japanese and rule.source
