"""Textured models in files: glTF, OBJ and CityJSON read back with the same places in the same images."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest
import shapely

from tests.solid_files import read_solids, write_solids
from urbanmap_qgis.citymodel.gltf.glb_writer import write_glb
from urbanmap_qgis.citymodel.obj import write_obj
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.solid import OUTER_WALL, FaceTexture
from urbanmap_qgis.geometry.solid_faces import solids_of
from urbanmap_qgis.imagery.textures.texture_files import write_textured
from urbanmap_qgis.imagery.textures.texture_stage import Textured

CORNER = np.array([-7000.0, -34000.0, 10.0])
SIZE = np.array([8.0, 5.0, 3.0])
PICTURE = b"\xff\xd8\xff" + bytes(range(200)) + b"\xff\xd9"


def box():
    steps = np.array([[i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)]) * SIZE
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return solids_of(shapely.MultiPolygon([shapely.Polygon((CORNER + steps)[list(ring)]) for ring in rings]))


@pytest.fixture
def building():
    """A box whose south wall has a texture: u runs with x, v with z."""
    solid, = box()
    textures = []
    for face, kind in zip(solid.faces, solid.surface_type):
        corners = solid.vertices[list(face[0])]
        south = kind == OUTER_WALL and np.allclose(corners[:, 1], CORNER[1])
        uv = ((corners - CORNER) / SIZE)[:, [0, 2]]
        textures.append(FaceTexture("textures/b.jpg", (uv,)) if south else None)
    return solid_object("家 1", {"a": 1}, [solid], [textures])


def read_glb(path):
    """The JSON and the binary part of a glTF file."""
    data = Path(path).read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data)) and length % 4 == 0
    size, kind = struct.unpack_from("<II", data, 12)
    assert kind == 0x4E4F534A and size % 4 == 0
    document = json.loads(data[20:20 + size])
    if len(data) == 20 + size:
        return document, b""
    length, kind = struct.unpack_from("<II", data, 20 + size)
    assert kind == 0x004E4942 and length == document["buffers"][0]["byteLength"]
    return document, data[28 + size:]


def values_of(document, binary, accessor):
    entry = document["accessors"][accessor]
    view = document["bufferViews"][entry["bufferView"]]
    width = int(entry["type"][3:])
    assert view["byteOffset"] % 4 == 0
    return np.frombuffer(binary, "<f4", entry["count"] * width, view["byteOffset"]).reshape(-1, width)


def test_gltf_holds_the_building_and_its_image(tmp_path, building):
    (tmp_path / "b.jpg").write_bytes(PICTURE)
    assert write_glb(tmp_path / "m.glb", [building], {"textures/b.jpg": tmp_path / "b.jpg"}, crs="EPSG:6677") == 1
    document, binary = read_glb(tmp_path / "m.glb")
    origin = np.array(document["asset"]["extras"]["origin"])
    assert document["nodes"][0]["name"] == "家 1" and document["asset"]["extras"]["crs"] == "EPSG:6677"
    places, shown = [], None
    for primitive in document["meshes"][0]["primitives"]:
        x, y, z = values_of(document, binary, primitive["attributes"]["POSITION"]).T
        at = np.column_stack([x, -z, y]) + origin
        a, b, c = at.reshape(-1, 3, 3).transpose(1, 0, 2)
        told = values_of(document, binary, primitive["attributes"]["NORMAL"])[::3]
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        assert np.allclose(np.column_stack([told[:, 0], -told[:, 2], told[:, 1]]), normal, atol=1e-5)
        outwards = np.einsum("ni,ni->n", normal, (a + b + c) / 3 - (CORNER + SIZE / 2))
        assert (outwards > 0).all(), "triangles turn as glTF wants them"
        places.append(at)
        if "TEXCOORD_0" in primitive["attributes"]:
            u, v = values_of(document, binary, primitive["attributes"]["TEXCOORD_0"]).T
            expected = (at - CORNER) / SIZE
            assert np.allclose(u, expected[:, 0], atol=1e-5) and np.allclose(v, 1 - expected[:, 2], atol=1e-5)
            shown = document["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorTexture"]["index"]
    assert np.allclose(np.unique(np.round(np.vstack(places), 4), axis=0), np.unique(box()[0].vertices, axis=0))
    image = document["images"][document["textures"][shown]["source"]]
    view = document["bufferViews"][image["bufferView"]]
    assert image["mimeType"] == "image/jpeg"
    assert binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]] == PICTURE


def test_gltf_without_buildings_or_textures(tmp_path, building):
    assert write_glb(tmp_path / "none.glb", []) == 0
    assert "nodes" not in read_glb(tmp_path / "none.glb")[0]
    plain = solid_object("b", {}, box())
    write_glb(tmp_path / "plain.glb", [plain])
    assert "images" not in read_glb(tmp_path / "plain.glb")[0]


def test_gltf_refuses_an_image_that_was_not_given(tmp_path, building):
    with pytest.raises(InputError, match="b.jpg of a texture was not given"):
        write_glb(tmp_path / "m.glb", [building])
    assert not list(tmp_path.iterdir())
    with pytest.raises(InputError, match=r"ends in \.glb"):
        write_glb(tmp_path / "m.gltf", [building])


def test_obj_names_the_image_and_the_places_in_it(tmp_path, building):
    write_obj(tmp_path / "m.obj", [solid_object("plain", {}, box()), building], origin=tuple(CORNER))
    lines = (tmp_path / "m.obj").read_text().splitlines()
    vertices = np.array([line.split()[1:] for line in lines if line.startswith("v ")], float)
    places = np.array([line.split()[1:] for line in lines if line.startswith("vt ")], float)
    pairs = [tuple(map(int, part.split("/"))) for line in lines if line.startswith("f ") and "/" in line
             for part in line.split()[1:]]
    assert len(pairs) == 6 and len(vertices) == 16
    for vertex, place in pairs:
        assert np.allclose(places[place - 1], (vertices[vertex - 1] / SIZE)[[0, 2]], atol=1e-4)
    materials = (tmp_path / "m.mtl").read_text()
    assert "newmtl texture_0" in materials and "map_Kd textures/b.jpg" in materials
    assert "usemtl texture_0" in lines


def test_cityjson_names_the_image_and_the_places_in_it(tmp_path, building):
    write_solids(tmp_path / "m.city.json", [solid_object("plain", {}, box()), building], epsg=6677)
    content = json.loads((tmp_path / "m.city.json").read_text(encoding="utf-8"))
    appearance = content["appearance"]
    assert appearance["textures"] == [{"type": "JPG", "image": "textures/b.jpg"}]
    assert "texture" not in content["CityObjects"]["plain"]["geometry"][0]
    geometry = content["CityObjects"]["家 1"]["geometry"][0]
    shell, = geometry["texture"][appearance["default-theme-texture"]]["values"]
    vertices = np.array(content["vertices"]) * content["transform"]["scale"] + content["transform"]["translate"]
    shown = 0
    for face, cover in zip(geometry["boundaries"][0], shell):
        assert len(face) == len(cover)
        if cover[0] != [None]:
            image, *places = cover[0]
            assert image == 0 and len(places) == len(face[0])
            uv = np.array(appearance["vertices-texture"])[places]
            assert np.allclose(uv, ((vertices[face[0]] - CORNER) / SIZE)[:, [0, 2]], atol=1e-4)
            shown += 1
    assert shown == 1
    assert len(read_solids(tmp_path / "m.city.json")) == 2


@pytest.mark.parametrize("name", ["model.glb", "町.obj", "model.city.json"])
def test_a_model_file_has_its_images_beside_it(tmp_path, building, name):
    write_textured([Textured(building, {"textures/b.jpg": PICTURE}, ())], tmp_path / name, tmp_path / "all")
    for file in ("model.glb", "model.obj", "model.mtl", "model.city.json", "textures/b.jpg"):
        assert (tmp_path / "all" / file).is_file()
    if name.endswith(".glb"):
        assert not (tmp_path / "model_textures").exists()
    else:
        folder = f"{name.split('.')[0]}_textures"
        assert (tmp_path / folder / "b.jpg").read_bytes() == PICTURE
        text = (tmp_path / name.replace(".obj", ".mtl")).read_text(encoding="utf-8")
        assert f"{folder}/b.jpg" in text


def test_other_endings_are_refused_before_anything_is_written(tmp_path, building):
    with pytest.raises(InputError, match=r"must end in \.glb, \.obj or \.city\.json"):
        write_textured([], tmp_path / "m.dae", None)
    assert not list(tmp_path.iterdir())
