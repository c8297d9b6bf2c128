"""Load city models through Processing: CityGML and CityJSON, what later steps take of them, bad files."""

from __future__ import annotations

import json
import zipfile

import pytest

ALGORITHM = "urbanmap:loadcitymodel"
SOUTH, WEST, SIDE = 35.69, 139.76, 0.0001
HEAD = ('<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" '
        'xmlns:bldg="http://www.opengis.net/citygml/building/2.0" '
        'xmlns:gen="http://www.opengis.net/citygml/generics/2.0" '
        'xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:uro="https://www.geospatial.jp/iur/uro/2.0">'
        '<gml:boundedBy><gml:Envelope srsName="{srs}" srsDimension="3"><gml:lowerCorner>0 0 0</gml:lowerCorner>'
        '<gml:upperCorner>1 1 1</gml:upperCorner></gml:Envelope></gml:boundedBy>')
SRS = "http://www.opengis.net/def/crs/EPSG/0/6697"
BOX = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def polygon(corners):
    text = " ".join(f"{south:.9f} {west:.9f} {height}" for south, west, height in (*corners, corners[0]))
    return (f"<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>{text}</gml:posList>"
            "</gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>")


def building(name, shift=0.0, low=10.0, high=16.0, faces=BOX, more=""):
    """A box of about 9 x 11 m, level of detail 0 and 1."""
    plan = [(SOUTH, WEST + shift), (SOUTH, WEST + shift + SIDE), (SOUTH + SIDE, WEST + shift + SIDE),
            (SOUTH + SIDE, WEST + shift)]
    corners = [(*place, low) for place in plan] + [(*place, high) for place in plan]
    shell = "".join(polygon([corners[number] for number in face]) for face in faces)
    return (f'<core:cityObjectMember><bldg:Building gml:id="{name}">'
            f'<bldg:usage codeSpace="../../codelists/Building_usage.xml">411</bldg:usage>'
            '<bldg:measuredHeight uom="m">6.1</bldg:measuredHeight><bldg:lod0RoofEdge>'
            f"<gml:MultiSurface>{polygon(corners[4:])}</gml:MultiSurface></bldg:lod0RoofEdge><bldg:lod1Solid><gml:Solid>"
            f"<gml:exterior><gml:CompositeSurface>{shell}</gml:CompositeSurface></gml:exterior></gml:Solid>"
            f"</bldg:lod1Solid>{more}</bldg:Building></core:cityObjectMember>")


def city(*members, srs=SRS):
    return '<?xml version="1.0" encoding="UTF-8"?>' + HEAD.format(srs=srs) + "".join(members) + "</core:CityModel>"


@pytest.fixture
def plateau(tmp_path):
    """A data set as PLATEAU lays it out: buildings, roads beside them, lists of codes."""
    folder = tmp_path / "都市"
    for place in ("udx/bldg", "udx/tran", "codelists"):
        (folder / place).mkdir(parents=True)
    (folder / "udx/bldg/53394611_bldg_6697_op.gml").write_text(city(building("b1"), building("b2", 0.001)), "utf-8")
    (folder / "udx/tran/53394611_tran_6697_op.gml").write_text("no CityGML at all", "utf-8")
    entry = "<gml:Definition><gml:description>住宅</gml:description><gml:name>411</gml:name></gml:Definition>"
    (folder / "codelists/Building_usage.xml").write_text(
        '<gml:Dictionary xmlns:gml="http://www.opengis.net/gml"><gml:dictionaryEntry>'
        f"{entry}</gml:dictionaryEntry></gml:Dictionary>", "utf-8")
    return folder


def test_folder_to_outlines_models_and_surfaces(run, read_layer, plugin, plateau, tmp_path):
    outputs = {name: str(tmp_path / f"{name}.gpkg") for name in ("OUTPUT", "OUTPUT_MODELS", "OUTPUT_SURFACES")}
    result = run(ALGORITHM, {"INPUT": str(plateau), **outputs})
    assert (result["BUILDINGS"], result["PROBLEMS"], result["HEIGHTS"]) == (2, 0, "JGD2011")
    first = read_layer(result["OUTPUT"])[0]
    values = first.attributes
    assert (values["building_id"], values["lod"], values["usage"]) == ("b1", "0, 1", "住宅")
    assert (values["ground"], values["top"], values["height"]) == (10.0, 16.0, 6.1)
    assert first.geometry.area() == pytest.approx(9.05 * 11.1, rel=0.01)
    assert json.loads(values["attributes"])["usage_code"] == "411"
    assert len(read_layer(result["OUTPUT_MODELS"])) == 2
    faces = read_layer(result["OUTPUT_SURFACES"])
    assert [face.attributes["surface_type"] for face in faces[:6]] == ["ground", "roof", *["outer wall"] * 4]
    from qgis.core import QgsVectorLayer

    crs = plugin("algorithms.framework.layers.crs")
    layer = QgsVectorLayer(outputs["OUTPUT_MODELS"], "models", "ogr")
    assert crs.horizontal(layer.crs()).authid() == "EPSG:6677"
    assert crs.heights(layer.crs()).kind == "JGD2011"


def test_zip_reads_lists_in_it(run, read_layer, plateau, tmp_path):
    with zipfile.ZipFile(tmp_path / "city.zip", "w") as archive:
        for path in plateau.rglob("*.*"):
            archive.write(path, path.relative_to(plateau))
    result = run(ALGORITHM, {"INPUT": str(tmp_path / "city.zip"), "OUTPUT": str(tmp_path / "b.gpkg")})
    assert [item.attributes["usage"] for item in read_layer(result["OUTPUT"])] == ["住宅", "住宅"]


def test_open_solid_and_repeated_id_keep_their_rows_with_a_note(run, read_layer, feedback, tmp_path):
    path = tmp_path / "a.gml"
    path.write_text(city(building("b1"), building("b1", 0.001), building("b3", 0.002, faces=BOX[:-1])), "utf-8")
    result = run(ALGORITHM, {"INPUT": str(path), "OUTPUT": str(tmp_path / "b.gpkg")})
    notes = {item.attributes["building_id"]: item.attributes["note"] or "" for item in read_layer(result["OUTPUT"])}
    assert set(notes) == {"b1", "b1-2", "b3"} and notes["b1"] == ""
    assert "more than once" in notes["b1-2"]
    assert "level 1 is not closed (4 edges" in notes["b3"]
    assert any("2 of 3 buildings" in text for text in feedback.warnings)
    assert any("1 lists of codes are not there or damaged" in text for text in feedback.warnings)


def cityjson(**changes):
    corners = [[x, y, z] for z in (0, 6000) for x, y in ((0, 0), (9000, 0), (9000, 11000), (0, 11000))]
    return {"type": "CityJSON", "version": "2.0", "transform": {"scale": [0.001] * 3, "translate": [-6950, -34100, 10]},
            "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/6677"}, "vertices": corners,
            "CityObjects": {"家": {"type": "Building", "attributes": {"storeys": 2, "tags": ["a"]}, "geometry": [
                {"type": "Solid", "lod": "1.2", "boundaries": [[[list(face)] for face in BOX]]}]}}, **changes}


@pytest.mark.parametrize("kind", ["json", "jsonl"])
def test_cityjson_and_sequence(run, read_layer, tmp_path, kind):
    content = cityjson()
    path = tmp_path / f"a.city.{kind}"
    if kind == "json":
        path.write_text(json.dumps(content), "utf-8")
    else:
        feature = {"type": "CityJSONFeature", "id": "家", "CityObjects": content.pop("CityObjects"),
                   "vertices": content.pop("vertices")}
        head = {**content, "CityObjects": {}, "vertices": []}
        path.write_text("\n".join(map(json.dumps, (head, feature))) + "\n", "utf-8")
    result = run(ALGORITHM, {"INPUT": str(path), "OUTPUT": str(tmp_path / "b.gpkg")})
    item, = read_layer(result["OUTPUT"])
    assert (item.attributes["building_id"], item.attributes["lod"], item.attributes["storeys"]) == ("家", "1.2", 2)
    assert item.attributes["height"] == pytest.approx(6.0) and item.attributes["ground"] == pytest.approx(10.0)
    assert item.geometry.area() == pytest.approx(99.0)
    assert result["HEIGHTS"] == "unknown" and not item.attributes["note"]


@pytest.mark.parametrize(("source", "heights"), [("EPSG:7415", "EPSG:5709"), ("EPSG:28992", "unknown")])
def test_heights_of_a_given_compound_system_are_kept(run, tmp_path, source, heights):
    """QGIS 3.22 keeps only the plane of such a code."""
    path = tmp_path / "a.city.json"
    path.write_text(json.dumps(cityjson(metadata={})), "utf-8")
    result = run(ALGORITHM, {"INPUT": str(path), "SOURCE_CRS": source, "OUTPUT": str(tmp_path / "b.gpkg")})
    assert result["HEIGHTS"] == heights and result["BUILDINGS"] == 1


ENTITY = '<!DOCTYPE a SYSTEM "file:///etc/passwd"><core:CityModel'
BOMB = '<!DOCTYPE a [<!ENTITY b "x"><!ENTITY c "&b;&b;&b;">]>'


@pytest.mark.parametrize(("name", "text", "says"), [
    ("a.gml", city(building("b"))[:-40], "not whole, valid XML"),
    ("a.gml", city(building("b")).replace("<core:CityModel", BOMB + "<core:CityModel", 1), "document type"),
    ("a.gml", city(building("b")).replace("<core:CityModel", ENTITY, 1), "document type"),
    ("a.gml", city(building("b"), srs="urn:ogc:def:crs:EPSG::99999"), "EPSG:99999 is not known"),
    ("a.gml", city(building("b"), srs="local"), "local is not known"),
    ("a.gml", city(), "holds no building"),
    ("a.gml", "<a><b/></a>", "no CityGML"),
    ("a.zip", "no zip", "not a zip"),
    ("a.json", "{", "not JSON"),
    ("a.json", '{"type": "FeatureCollection"}', "not a CityJSON file"),
    ("a.json", json.dumps(cityjson(metadata={})), "names no coordinate reference system"),
    ("a.json", json.dumps(cityjson(vertices=[[0, 0, 0]])), "names a vertex that is not there"),
    ("a.json", json.dumps(cityjson(CityObjects=[])), "no city objects"),
    ("a.jsonl", "{}\n", "not a CityJSON file"),
    ("a.jsonl", json.dumps(cityjson(CityObjects={})) + "\n{\n", "its line 2 is no JSON"),
])
def test_bad_file_is_one_sentence_and_writes_nothing(run, tmp_path, name, text, says):
    from qgis.core import QgsProcessingException

    (tmp_path / name).write_text(text, "utf-8")
    with pytest.raises(QgsProcessingException, match=says) as caught:
        run(ALGORITHM, {"INPUT": str(tmp_path / name), "OUTPUT": str(tmp_path / "b.gpkg")})
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "b.gpkg").exists()


def test_paths_that_climb_out_of_a_zip_are_not_followed(run, read_layer, tmp_path):
    (tmp_path / "codelists").mkdir()
    (tmp_path / "codelists" / "Building_usage.xml").write_text(
        "<a><e><name>411</name><description>outside</description></e></a>", "utf-8")
    with zipfile.ZipFile(tmp_path / "city.zip", "w") as archive:
        archive.writestr("x.gml", city(building("b1")))
        archive.writestr("../../climbing.gml", city(building("b2", 0.001)))
    result = run(ALGORITHM, {"INPUT": str(tmp_path / "city.zip"), "OUTPUT": str(tmp_path / "b.gpkg")})
    assert {item.attributes["usage"] for item in read_layer(result["OUTPUT"])} == {"411"}
    assert not list(tmp_path.parent.rglob("climbing.gml"))


ROAD = ('<core:cityObjectMember><tran:Road xmlns:tran="http://www.opengis.net/citygml/transportation/2.0" '
        'gml:id="{name}">'
        '<tran:class codeSpace="../../codelists/TransportationComplex_class.xml">1040</tran:class>'
        '<tran:function codeSpace="../../codelists/Road_function.xml">4</tran:function>'
        "<tran:lod1MultiSurface><gml:MultiSurface>{surface}</gml:MultiSurface></tran:lod1MultiSurface>"
        "<uro:roadStructureAttribute><uro:RoadStructureAttribute>"
        '<uro:width uom="m">5.5</uro:width><uro:sectionType codeSpace="x.xml">4</uro:sectionType>'
        "</uro:RoadStructureAttribute></uro:roadStructureAttribute></tran:Road></core:cityObjectMember>")


def road(name="tran_1"):
    corners = [(SOUTH, WEST, 0), (SOUTH, WEST + SIDE, 0), (SOUTH + SIDE, WEST + SIDE, 0), (SOUTH + SIDE, WEST, 0)]
    return ROAD.format(name=name, surface=polygon(corners))


@pytest.mark.parametrize("others", ["", building("b1")])
def test_roads_are_loaded_where_they_are_asked_for(run, read_layer, tmp_path, others):
    path = tmp_path / "53394611_tran_6697_op.gml"
    path.write_text(HEAD.format(srs=SRS) + others + road() + "</core:CityModel>", encoding="utf-8")
    results = run(ALGORITHM, {"INPUT_FOLDER": str(tmp_path), "OUTPUT": str(tmp_path / "buildings.gpkg"),
                              "OUTPUT_ROADS": str(tmp_path / "roads.gpkg")})
    row, = read_layer(results["OUTPUT_ROADS"])
    assert {name: row.attributes[name] for name in ("road_id", "lod", "class", "function", "section", "width")} == {
        "road_id": "tran_1", "lod": "1", "class": "1040", "function": "4", "section": "4", "width": 5.5}
    assert row.geometry.area() == pytest.approx(100.4, rel=0.01)
    assert results["BUILDINGS"] == len(read_layer(results["OUTPUT"])) == bool(others)


POST = ('<core:cityObjectMember><frn:CityFurniture xmlns:frn="http://www.opengis.net/citygml/cityfurniture/2.0" '
        'gml:id="frn_1"><frn:class codeSpace="../../codelists/CityFurniture_class.xml">1000</frn:class>'
        '<frn:function codeSpace="../../codelists/CityFurniture_function.xml">4800</frn:function>'
        "<frn:lod2Geometry><gml:MultiSurface>{faces}</gml:MultiSurface></frn:lod2Geometry></frn:CityFurniture>"
        "</core:cityObjectMember>")


@pytest.mark.parametrize("others", ["", building("b1")])
def test_furniture_is_loaded_where_it_is_asked_for(run, read_layer, tmp_path, others):
    high = [(SOUTH, WEST, 10), (SOUTH, WEST + SIDE, 10), (SOUTH, WEST + SIDE, 14.5), (SOUTH, WEST, 14.5)]
    path = tmp_path / "53394611_frn_6697_op.gml"
    path.write_text(HEAD.format(srs=SRS) + others + POST.format(faces=polygon(high)) + "</core:CityModel>", "utf-8")
    results = run(ALGORITHM, {"INPUT_FOLDER": str(tmp_path), "OUTPUT": str(tmp_path / "buildings.gpkg"),
                              "OUTPUT_OBJECTS": str(tmp_path / "things.gpkg")})
    row, = read_layer(results["OUTPUT_OBJECTS"])
    assert {name: row.attributes[name] for name in ("object_id", "kind", "lod", "class", "function", "note")} == {
        "object_id": "frn_1", "kind": "furniture", "lod": "2", "class": "1000", "function": "4800", "note": ""}
    assert [row.attributes[name] for name in ("ground", "top", "height")] == pytest.approx([10.0, 14.5, 4.5])
    assert results["BUILDINGS"] == len(read_layer(results["OUTPUT"])) == bool(others)
