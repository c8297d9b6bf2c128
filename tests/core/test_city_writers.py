"""City models as CityJSON, CityJSONSeq and CityGML: what is written is what is there."""

import json
import re
from contextlib import ExitStack
from dataclasses import replace
from datetime import date
from xml.etree import ElementTree

import numpy as np
import pyproj
import pytest

from tests.city_models import PLACE, town
from tests.solid_files import read_solids
from urbanmap_qgis.citymodel.citygml.reader import open_citygml
from urbanmap_qgis.citymodel.citygml.writer import WRITTEN_BY, gml_folder_trouble, write_citygml
from urbanmap_qgis.citymodel.cityjson.writer import plain_attributes, write_model_cityjson, write_model_cityjsonseq
from urbanmap_qgis.citymodel.model import AttributeGroup, CityReference, CitySurface, CodeValue, Measure
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.reference import compound_epsg
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.mesh_code import third_mesh_code
from urbanmap_qgis.progress import Progress

SPACES = {"core": "http://www.opengis.net/citygml/2.0", "bldg": "http://www.opengis.net/citygml/building/2.0",
          "gen": "http://www.opengis.net/citygml/generics/2.0", "app": "http://www.opengis.net/citygml/appearance/2.0",
          "gml": "http://www.opengis.net/gml", "uro": "https://www.geospatial.jp/iur/uro/3.2"}
ID = f"{{{SPACES['gml']}}}id"
HREF = "{http://www.w3.org/1999/xlink}href"


@pytest.fixture
def image(tmp_path):
    path = tmp_path / "wall.jpg"
    path.write_bytes(b"\xff\xd8\xff\xe0 not looked at")
    return {"textures/wall.jpg": path}


def test_cityjson_has_all_levels_parts_and_attributes(tmp_path):
    path = tmp_path / "town.city.json"
    assert write_model_cityjson(path, town()) == 4
    content = json.loads(path.read_text(encoding="utf-8"))
    objects = content["CityObjects"]
    house, pair, none = objects["家 1"], objects["b2"], objects["b3"]
    assert [(item["type"], item["lod"]) for item in house["geometry"]] == [
        ("MultiSurface", "0"), ("MultiSurface", "0"), ("Solid", "1.2"), ("Solid", "1.3"), ("Solid", "2.2")]
    assert house["attributes"]["points"] == 7 and house["attributes"]["bad"] is None
    assert house["attributes"]["roof_max"] == 7.0 and house["attributes"]["note"] == 'a < b & "c"'
    assert pair["children"] == ["b2-part-1", "b2-part-2"] and objects["b2-part-1"]["parents"] == ["b2"]
    assert none["geometry"] == [] and none["attributes"]["status"] == "not modelled"
    solid = house["geometry"][-1]
    entry = solid["semantics"]["surfaces"][solid["semantics"]["values"][0][5]]
    assert entry["type"] == "RoofSurface" and entry["azimuth"] == 90.0 and entry["area"] == 50.0
    assert content["metadata"]["referenceSystem"].endswith("/10170")  # zone IX with JGD2011 heights
    assert content["metadata"]["referenceDate"] == "2026-04-01" and content["metadata"]["title"] == "Town"
    corners = np.array(content["vertices"]) * content["transform"]["scale"] + content["transform"]["translate"]
    assert corners.min(axis=0) == pytest.approx(PLACE) and corners[:, 2].max() == pytest.approx(PLACE[2] + 7)


def test_sequence_says_the_same_line_by_line(tmp_path, image):
    whole, lines = tmp_path / "town.city.json", tmp_path / "town.city.jsonl"
    write_model_cityjson(whole, town(images=image))
    assert write_model_cityjsonseq(lines, town(images=image)) == 4
    head, *features = map(json.loads, lines.read_text(encoding="utf-8").splitlines())
    assert head["type"] == "CityJSON" and not head["CityObjects"] and not head["vertices"]
    assert [feature["id"] for feature in features] == ["家 1", "b2", "b3", "b4"]
    content = json.loads(whole.read_text(encoding="utf-8"))

    def corners(store, transform, geometry):
        rings = json.dumps(geometry["boundaries"]).replace("[", " ").replace("]", " ").replace(",", " ").split()
        return np.array(store)[list(map(int, rings))] * transform["scale"] + transform["translate"]

    for feature in features:
        for name, item in feature["CityObjects"].items():
            assert item["attributes" if "attributes" in item else "type"] == content["CityObjects"][name][
                "attributes" if "attributes" in item else "type"]
            for one, other in zip(item["geometry"], content["CityObjects"][name]["geometry"]):
                assert corners(feature["vertices"], head["transform"], one) == pytest.approx(
                    corners(content["vertices"], content["transform"], other))
    assert features[0]["appearance"] == content["appearance"]
    assert write_model_cityjsonseq(lines, replace(town(), buildings=())) == 0
    assert json.loads(lines.read_text())["type"] == "CityJSON"


def test_values_with_codes_and_units_lose_nothing():
    made = plain_attributes({
        "usage": CodeValue("411", "u.xml", "住宅"), "class": CodeValue("3001", "c.xml"), "measuredHeight":
        Measure(6.5, "m"), "gen:area": Measure(42.0, "m2"), "creationDate": date(2024, 3, 1),
        "uro:buildingIDAttribute": [AttributeGroup("uro:BuildingIDAttribute", {"buildingID": "1-bldg-2"})]})
    assert made == {
        "usage": "住宅", "usage_code": "411", "usage_codeSpace": "u.xml", "class": "3001", "class_codeSpace": "c.xml",
        "measuredHeight": 6.5, "gen:area": 42.0, "gen:area_uom": "m2", "creationDate": "2024-03-01",
        "uro:buildingIDAttribute": [{"type": "uro:BuildingIDAttribute", "buildingID": "1-bldg-2"}]}


def test_ids_that_are_there_twice_are_refused(tmp_path):
    model = town()
    with pytest.raises(InputError, match="b2"):
        write_model_cityjson(tmp_path / "a.city.json", replace(model, buildings=[*model.buildings, model.buildings[1]]))
    assert not list(tmp_path.iterdir())


def test_degrees_are_refused_as_cityjson(tmp_path):
    for write in (write_model_cityjson, write_model_cityjsonseq):
        with pytest.raises(InputError, match="degrees"):
            write(tmp_path / "a.city.json", replace(town(), reference=CityReference("", 6668, True)))


def test_codes_of_plane_and_heights():
    assert compound_epsg(CityReference("", 6669, False, "JGD2011")) == 10162
    assert compound_epsg(CityReference("", 6681, False, "JGD2011")) == 10174
    assert compound_epsg(CityReference("", 6682, False, "JGD2011")) == 6682
    assert compound_epsg(CityReference("", 6677, False, "unknown")) == 6677
    assert compound_epsg(CityReference("", 6668, True, "JGD2024")) == 11318
    assert compound_epsg(CityReference("", None)) is None
    for code in (10162, 10170, 10174):
        assert pyproj.CRS(code).sub_crs_list[0].to_epsg() == 6669 + code - 10162


def test_mesh_codes():
    assert third_mesh_code(139.767, 35.681) == "53394611"  # Tokyo station
    assert third_mesh_code(139.8107, 35.7101) == "53394654"  # Skytree
    assert third_mesh_code(141.4396, 42.9400) == "64413325" and third_mesh_code(139.739, 35.26) == "52397519"
    with pytest.raises(InputError, match="not in Japan"):
        third_mesh_code(4.3, 52.0)


def parsed(folder):
    (path,) = folder.rglob("*.gml")
    return path, ElementTree.parse(path).getroot()


def test_citygml_lies_as_plateau_lays_it_out(tmp_path, image):
    files = write_citygml(tmp_path / "out", town(images=image, usage=CodeValue("411", "../../codelists/u.xml"),
                                                 measuredHeight=7.0, **{"uro:buildingIDAttribute": AttributeGroup(
                                                     "uro:BuildingIDAttribute", {"buildingID": "1", "city": "13101"})}))
    assert files == {"53394630_bldg_6697_op.gml": 3}  # a building without geometry has no place in a mesh
    path, root = parsed(tmp_path / "out")
    assert path.parent == tmp_path / "out" / "udx" / "bldg"
    house = root.find("core:cityObjectMember/bldg:Building", SPACES)
    order = [child.tag.partition("}")[2] for child in house]
    assert order.index("usage") < order.index("measuredHeight") < order.index("lod0FootPrint") < order.index(
        "lod0RoofEdge") < order.index("lod1Solid") < order.index("lod2Solid") < order.index("boundedBy") < order.index(
            "buildingIDAttribute")
    assert house.find("bldg:measuredHeight", SPACES).get("uom") == "m"
    generic = {item.get("name"): item[0].text for item in house if item.tag.startswith(f"{{{SPACES['gen']}}}")}
    assert generic["note"] == 'a < b & "c"' and generic["source_id"] == "家 1" and "bad" not in generic
    members = root.findall("core:cityObjectMember/bldg:Building", SPACES)
    assert len(members[1].findall("bldg:consistsOfBuildingPart/bldg:BuildingPart/bldg:lod2Solid", SPACES)) == 2
    assert members[2].find("bldg:lod2Solid", SPACES) is None and members[2].find("bldg:lod1Solid", SPACES) is not None
    assert len(members[2].findall(".//bldg:lod0FootPrint//gml:interior", SPACES)) == 1


def test_citygml_refers_to_what_is_there_and_to_each_once(tmp_path, image):
    write_citygml(tmp_path / "out", town(images=image))
    path, root = parsed(tmp_path / "out")
    ids = [item.get(ID) for item in root.iter() if item.get(ID)]
    assert len(ids) == len(set(ids))
    for item in root.iter():
        for reference in (item.get(HREF), item.get("uri"), item.get("ring")):
            assert not reference or reference.removeprefix("#") in ids
    texture = root.find(".//app:ParameterizedTexture", SPACES)
    name = texture.find("app:imageURI", SPACES).text
    assert name == "53394630_bldg_6697_appearance/wall.jpg"
    assert (path.parent / name).read_bytes() == next(iter(image.values())).read_bytes()
    places = texture.find(".//app:textureCoordinates", SPACES).text.split()
    assert list(map(float, places)) == [0, 0, 1, 0, 1, 1, 0, 1, 0, 0]
    with pytest.raises(InputError, match="was not given"):
        write_citygml(tmp_path / "again", replace(town(images=image), images={}))


def test_textures_of_citygml_come_back_on_their_faces(tmp_path, image):
    write_citygml(tmp_path / "out", town(images=image))
    path, _ = parsed(tmp_path / "out")
    with ExitStack() as stack:
        faces = [surface for building in open_citygml(path, stack, ReadingNotes()).buildings
                 for shape in building.shapes for surface in shape.surfaces if surface.texture is not None]
    assert faces and {face.texture.image.rpartition("/")[2] for face in faces} == {"wall.jpg"}
    assert all(len(places) in (len(ring), len(ring) + 1) and 0 <= places.min() <= places.max() <= 1
               for face in faces for ring, places in zip(face.rings, face.texture.uv))


@pytest.mark.parametrize("text", ["[[[[[[", "0 0 1 nan", "0 0 1"])
def test_a_texture_whose_places_are_no_numbers_is_told_and_left_out(tmp_path, image, text):
    write_citygml(tmp_path / "out", town(images=image))
    path, _ = parsed(tmp_path / "out")
    content = re.sub(r"(<app:textureCoordinates[^>]*>)[^<]*", rf"\g<1>{text}", path.read_text(encoding="utf-8"))
    path.write_text(content, encoding="utf-8")
    with ExitStack() as stack:
        objects = list(open_citygml(path, stack, ReadingNotes()).buildings)
    assert len(objects) == 3
    assert any("does not fit its corners and was left out" in problem for one in objects for problem in one.problems)


def test_citygml_counts_in_latitude_longitude_and_height(tmp_path):
    write_citygml(tmp_path / "out", town())
    _, root = parsed(tmp_path / "out")
    transformer = pyproj.Transformer.from_crs(6677, 6668)  # x is north there, and latitude comes first
    text = root.find(".//bldg:lod2Solid/../bldg:boundedBy/bldg:GroundSurface//gml:posList", SPACES).text
    rows = np.array(text.split(), float).reshape(-1, 3)
    north, east = transformer.transform(rows[:, 0], rows[:, 1], direction="INVERSE")
    expected = {(0, 0), (8, 0), (8, 10), (0, 10)}
    assert {(round(x - PLACE[0]), round(y - PLACE[1])) for x, y in zip(east, north)} == expected
    assert np.abs((east - PLACE[0]) - np.rint(east - PLACE[0])).max() < 1e-4
    assert set(rows[:, 2]) == {20.0} and (rows[0] == rows[-1]).all()
    system = root.find(".//gml:Envelope", SPACES).get("srsName")
    assert system.endswith("/6697")
    write_citygml(tmp_path / "new", town(heights="JGD2024"))
    assert next((tmp_path / "new").rglob("*.gml")).name == "53394630_bldg_11318_op.gml"


def test_citygml_elsewhere_is_one_file_in_its_own_system(tmp_path):
    assert write_citygml(tmp_path / "out", town(epsg=28992, heights="EPSG:5709")) == {"buildings.gml": 4}
    path, root = parsed(tmp_path / "out")
    assert root.find(".//gml:Envelope", SPACES).get("srsName").endswith("/28992")
    assert path.parent == tmp_path / "out" and not (tmp_path / "out" / "codelists").exists()


def test_folders_of_others_are_known(tmp_path):
    assert not gml_folder_trouble(tmp_path / "none") and not gml_folder_trouble(tmp_path)
    write_citygml(tmp_path, town())
    assert not gml_folder_trouble(tmp_path)
    path, _ = parsed(tmp_path)
    path.write_text(path.read_text(encoding="utf-8").replace(WRITTEN_BY, ""), encoding="utf-8")
    assert "another program" in gml_folder_trouble(tmp_path)


def test_files_of_an_earlier_run_stay_and_are_told(tmp_path):
    said = []
    progress = Progress(warn=lambda text: said.append(text))
    write_citygml(tmp_path, town(), progress)
    write_citygml(tmp_path, town(), progress)
    assert not [text for text in said if "earlier run" in text]  # its own are replaced
    write_citygml(tmp_path, town(heights="JGD2024"), progress)
    write_citygml(tmp_path, town(epsg=28992, heights="EPSG:5709"), progress)
    mine, both = [text for text in said if "earlier run" in text]
    assert "1 files: 53394630_bldg_6697_op.gml" in mine and "2 files" in both
    assert len(list(tmp_path.rglob("*.gml"))) == 3


def test_the_reader_of_solids_takes_one_level_of_detail_and_puts_parts_together(tmp_path):
    write_model_cityjson(tmp_path / "town.city.json", town())
    solids = {item.id: len(item.solids) for item in read_solids(tmp_path / "town.city.json")}
    assert solids == {"家 1": 1, "b2": 2, "b3": 0, "b4": 1}


def test_no_writer_is_given_a_coordinate_that_is_no_number():
    ring = np.array([[0.0, 0.0, 1.0], [5.0, 0.0, np.nan], [5.0, 5.0, 1.0]])
    with pytest.raises(InputError, match="no numbers"):
        CitySurface((ring,))
