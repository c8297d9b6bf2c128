"""3D Tiles: buildings in their places on the earth, each with its attributes."""

import json
import struct
from dataclasses import replace

import numpy as np
import pyproj
import pytest

from tests.city_models import PLACE, town
from urbanmap_qgis.citymodel.model import CityReference
from urbanmap_qgis.citymodel.tiles.tiles_writer import earth_centred, tiles_folder_trouble, write_tiles
from urbanmap_qgis.errors import InputError, OutputError


def read_glb(path):
    """Document and buffer of a file."""
    data = path.read_bytes()
    assert data[:4] == b"glTF" and struct.unpack("<I", data[8:12])[0] == len(data)
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def values(document, buffer, accessor):
    entry = document["accessors"][accessor]
    start = document["bufferViews"][entry["bufferView"]]["byteOffset"]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[entry["type"]]
    return np.frombuffer(buffer, "<f4", entry["count"] * width, start).reshape(-1, width)


def column(document, buffer, name):
    """Values of an attribute by the property table."""
    metadata = document["extensions"]["EXT_structural_metadata"]
    properties = metadata["schema"]["classes"]["building"]["properties"]
    key = next(key for key, entry in properties.items() if entry["name"] == name)
    table = metadata["propertyTables"][0]
    place = table["properties"][key]

    def view(number):
        entry = document["bufferViews"][number]
        assert entry["byteOffset"] % 8 == 0
        return buffer[entry["byteOffset"]:entry["byteOffset"] + entry["byteLength"]]

    if properties[key]["type"] == "STRING":
        offsets = np.frombuffer(view(place["stringOffsets"]), "<u4")
        text = view(place["values"])
        return [text[a:b].decode("utf-8") for a, b in zip(offsets[:-1], offsets[1:])]
    kind = {"INT32": "<i4", "FLOAT64": "<f8"}[properties[key]["componentType"]]
    no_data = properties[key].get("noData")
    return [None if value == no_data else value for value in np.frombuffer(view(place["values"]), kind).tolist()]


def tiles_with_content(tile, found=None):
    found = [] if found is None else found
    found += [tile] if "content" in tile else []
    for child in tile.get("children", ()):
        tiles_with_content(child, found)
    return found


def test_corners_lie_where_the_projection_puts_them(tmp_path):
    assert write_tiles(tmp_path, town()) == 3
    document = json.loads((tmp_path / "tileset.json").read_text())
    assert document["asset"]["version"] == "1.1" and document["geometricError"] > document["root"]["geometricError"]
    blocks, details = tiles_with_content(document["root"])
    assert blocks["geometricError"] > details["geometricError"] == 0 and blocks["refine"] == "REPLACE"
    glb, buffer = read_glb(tmp_path / details["content"]["uri"])
    matrix = np.array(blocks["transform"]).reshape(4, 4).T
    places = np.vstack([values(glb, buffer, primitive["attributes"]["POSITION"])
                        for primitive in glb["meshes"][0]["primitives"]])
    local = np.column_stack([places[:, 0], -places[:, 2], places[:, 1], np.ones(len(places))])
    back = pyproj.Transformer.from_crs(4978, 4979, always_xy=True).transform(*(local @ matrix.T)[:, :3].T)
    east, north = pyproj.Transformer.from_crs(4326, 6677, always_xy=True).transform(back[0], back[1])
    off = np.column_stack([east, north, back[2]]) - PLACE
    assert np.abs(off - np.rint(off)).max() < 2e-3  # all corners of the town are whole metres
    assert off.min(axis=0) == pytest.approx([0, 0, 0], abs=2e-3) and off[:, 2].max() == pytest.approx(7, abs=2e-3)
    west, _south, east, north, low, high = document["root"]["boundingVolume"]["region"]
    assert west <= np.radians(back[0]).min() + 1e-9 and north >= np.radians(back[1]).max() - 1e-9
    assert (low, high) == pytest.approx((20, 27), abs=1e-3)


def test_every_corner_knows_its_building_and_that_its_attributes(tmp_path):
    write_tiles(tmp_path, town())
    (path,) = (tmp_path / "tiles").glob("*details.glb")
    document, buffer = read_glb(path)
    assert column(document, buffer, "id") == ["家 1", "b2", "b4"]
    assert column(document, buffer, "points") == [7, None, None]
    assert column(document, buffer, "rmse") == [0.25, None, None]
    assert column(document, buffer, "roof_max") == [7.0, 7.0, 6.0]
    assert column(document, buffer, "note")[0] == 'a < b & "c"'
    counts = np.zeros(3, int)
    for primitive in document["meshes"][0]["primitives"]:
        assert primitive["extensions"]["EXT_mesh_features"]["featureIds"][0]["featureCount"] == 3
        numbers = values(document, buffer, primitive["attributes"]["_FEATURE_ID_0"]).ravel().astype(int)
        counts += np.bincount(numbers, minlength=3) // 3
        normals = values(document, buffer, primitive["attributes"]["NORMAL"])
        assert np.linalg.norm(normals, axis=1) == pytest.approx(1, abs=1e-5)
    assert counts.tolist() == [16, 32, 2 * 8 + 2 * 8]  # a court's ring of 8 corners and one hole: 8 triangles


def test_textures_are_in_the_file(tmp_path):
    image = tmp_path / "wall.png"
    image.write_bytes(b"\x89PNG not looked at")
    model = town(images={"t/wall.png": image})
    write_tiles(tmp_path / "out", model)
    (path,) = (tmp_path / "out" / "tiles").glob("*details.glb")
    document, buffer = read_glb(path)
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    assert buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]] == image.read_bytes()
    material = next(number for number, item in enumerate(document["materials"])
                    if "baseColorTexture" in item["pbrMetallicRoughness"])
    primitive = next(item for item in document["meshes"][0]["primitives"] if item["material"] == material)
    assert len(values(document, buffer, primitive["attributes"]["TEXCOORD_0"])) == 6
    assert len(set(values(document, buffer, primitive["attributes"]["_FEATURE_ID_0"]).ravel())) == 1
    with pytest.raises(InputError, match="was not given"):
        write_tiles(tmp_path / "other", replace(model, images={}))


def test_many_cells_make_a_tree(tmp_path):
    single = town()
    copies = []
    for number, shift in enumerate([(0, 0), (900, 0), (0, 1300), (4000, 4000)]):
        def surface_there(surface, shift=shift):
            return replace(surface, rings=tuple(np.add(ring, (*shift, 0)) for ring in surface.rings))

        def moved(item, number=number, there=surface_there):
            shapes = tuple(replace(shape, shells=tuple(tuple(map(there, shell)) for shell in shape.shells))
                           for shape in item.shapes)
            return replace(item, id=f"{item.id}-{number}", parts=tuple(map(moved, item.parts)), shapes=shapes)

        copies += map(moved, single.buildings)
    assert write_tiles(tmp_path, replace(single, buildings=copies)) == 12
    root = json.loads((tmp_path / "tileset.json").read_text())["root"]
    assert len(tiles_with_content(root)) == 2 * len(list((tmp_path / "tiles").glob("*details.glb"))) >= 8

    def check(tile):
        for child in tile.get("children", ()):
            assert child["geometricError"] < tile["geometricError"]
            inner, outer = child["boundingVolume"]["region"], tile["boundingVolume"]["region"]
            assert all(a >= b - 1e-12 for a, b in zip(inner[:2], outer[:2]))
            assert all(a <= b + 1e-12 for a, b in zip(inner[2:4], outer[2:4]))
            assert "content" in tile or len(tile["children"]) > 1
            check(child)

    check(root)


def test_the_geoid_is_added(tmp_path):
    write_tiles(tmp_path, town(), geoid=lambda longitude, latitude: np.full(len(longitude), 36.5))
    document = json.loads((tmp_path / "tileset.json").read_text())
    assert document["root"]["boundingVolume"]["region"][4:] == pytest.approx([56.5, 63.5], abs=1e-3)
    assert "geoid" in document["asset"]["extras"]["heights"]


def test_earth_centred_agrees_with_proj():
    places = np.array([(139.7, 35.7, 40.0), (4.3, 52.0, -3.0), (-70.0, -33.0, 2000.0)])
    expected = np.column_stack(pyproj.Transformer.from_crs(4979, 4978, always_xy=True).transform(*places.T))
    assert earth_centred(places) == pytest.approx(expected, abs=1e-6)


def test_a_tileset_of_another_program_is_left_alone(tmp_path):
    assert not tiles_folder_trouble(tmp_path)
    write_tiles(tmp_path, town())
    write_tiles(tmp_path, town())  # its own may be replaced
    for text in ('{"asset": {"version": "1.0"}}', "no JSON", "[]"):
        (tmp_path / "tileset.json").write_text(text)
        with pytest.raises(OutputError, match="another program"):
            write_tiles(tmp_path, town())
        assert (tmp_path / "tileset.json").read_text() == text


def test_models_without_a_place_are_refused_and_an_empty_city_is_a_tileset(tmp_path):
    with pytest.raises(InputError, match="place on the earth"):
        write_tiles(tmp_path / "a", replace(town(), reference=CityReference()))
    assert write_tiles(tmp_path / "b", replace(town(), buildings=())) == 0
    assert "content" not in json.loads((tmp_path / "b" / "tileset.json").read_text())["root"]
