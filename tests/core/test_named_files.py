"""Files that input files name: only of the model's own folder, only of the kind that is wanted."""

import json
import re
import zipfile
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.city_models import gable_house, town, wall_texture
from tests.solid_files import write_solids
from urbanmap_qgis.citymodel.city_files import write_city_files
from urbanmap_qgis.citymodel.city_sources import open_city_model
from urbanmap_qgis.citymodel.citygml.writer import write_citygml
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.io.files.named_files import CODE_LIST, IMAGE, named_file

JPEG = b"\xff\xd8\xff\xe0 an image"
SECRET = b"-----BEGIN OPENSSH PRIVATE KEY-----"


@pytest.fixture
def model(tmp_path):
    """A textured CityGML in a folder of its own, with a secret beside that folder."""
    image = tmp_path / "a.jpg"
    image.write_bytes(JPEG)
    write_citygml(tmp_path / "made", town(epsg=25832, images={"a.jpg": image}))
    (gml,) = (tmp_path / "made").rglob("*.gml")
    (tmp_path / "secret").mkdir()
    (tmp_path / "secret" / "id_rsa").write_bytes(SECRET)
    (tmp_path / "secret" / "photo.jpg").write_bytes(JPEG + SECRET)
    (named,) = gml.parent.rglob("*.jpg")
    return gml, named.relative_to(gml.parent).as_posix()


def name_image(model, name):
    gml, named = model
    gml.write_text(gml.read_text(encoding="utf-8").replace(f">{named}<", f">{name}<"), encoding="utf-8")
    return gml


def export(path, folder):
    """All files that a city model is written to, and what was warned of."""
    notes = ReadingNotes()
    with ExitStack() as stack:
        opened = open_city_model(path, stack, notes)
        whole = replace(opened, buildings=tuple(opened.buildings))
        folder.mkdir()
        write_city_files(whole, folder / "m.city.json", folder / "m.city.jsonl", folder / "gml", folder / "tiles")
    return [file.read_bytes() for file in folder.rglob("*") if file.is_file()], notes


@pytest.mark.parametrize("name", ["../secret/id_rsa", "../secret/photo.jpg", "..\\secret\\photo.jpg",
                                  "x/../../secret/photo.jpg", "link/photo.jpg", "photo.jpg", "key.jpg",
                                  "/etc/passwd", "file:///etc/passwd", "C:\\secret.jpg", "n" * 300, "a\0b", "."])
def test_an_export_holds_no_file_from_outside_of_the_model(model, tmp_path, name):
    gml = name_image(model, name.replace("\0", ""))
    (gml.parent / "link").symlink_to(tmp_path / "secret")
    (gml.parent / "photo.jpg").symlink_to(tmp_path / "secret" / "photo.jpg")
    (gml.parent / "key.jpg").write_bytes(SECRET)  # in the folder, but no image
    files, notes = export(gml, tmp_path / "out")
    assert files and not any(SECRET in content or b"root:" in content for content in files)
    assert len(notes.missing_images) == 1 and "images of textures are not there" in " ".join(notes.sentences())
    assert named_file(gml, name, IMAGE) is None


def test_what_is_in_the_folder_goes_along_from_a_folder_and_from_a_zip(model, tmp_path):
    gml, _ = model
    assert any(content == JPEG for content in export(gml, tmp_path / "one")[0])
    assert any(content == JPEG for content in export(gml.parent, tmp_path / "two")[0])
    with zipfile.ZipFile(tmp_path / "m.zip", "w") as archive:
        for file in sorted(path for path in gml.parent.rglob("*") if path.is_file()):
            archive.write(file, f"town/{file.relative_to(gml.parent).as_posix()}")
    files, notes = export(tmp_path / "m.zip", tmp_path / "three")
    assert any(content == JPEG for content in files) and not notes.missing_images


def test_a_zip_names_nothing_outside_of_it_and_nothing_else(model, tmp_path):
    gml, named = model
    for number, name in enumerate(("../../../secret/photo.jpg", "../other.txt", "gone.jpg")):
        with zipfile.ZipFile(tmp_path / f"{number}.zip", "w") as archive:
            archive.writestr("town/m.gml", gml.read_text(encoding="utf-8").replace(f">{named}<", f">{name}<"))
            archive.writestr("other.txt", SECRET)
        files, notes = export(tmp_path / f"{number}.zip", tmp_path / f"out{number}")
        assert notes.missing_images == {name} and not any(SECRET in content for content in files)


def test_images_of_cityjson_lie_in_its_folder_too(tmp_path):
    (tmp_path / "secret.jpg").write_bytes(JPEG + SECRET)
    (tmp_path / "m" / "tex").mkdir(parents=True)
    (tmp_path / "m" / "tex" / "a.jpg").write_bytes(JPEG)
    house = gable_house()
    for name, missing in (("../secret.jpg", True), ("tex/../../secret.jpg", True), ("tex/a.jpg", False)):
        path = tmp_path / "m" / "m.city.json"
        write_solids(path, [solid_object("x", {}, [house], [wall_texture(house, 2, name)])], epsg=25832)
        files, notes = export(path, tmp_path / f"out{len(list(tmp_path.iterdir()))}")
        assert (notes.missing_images == {name}) is missing
        assert any(content == JPEG for content in files) is not missing
        assert not any(SECRET in content for content in files)


def test_an_image_that_goes_while_the_model_is_open_costs_its_texture_only(model, tmp_path):
    gml, named = model
    with ExitStack() as stack:
        opened = open_city_model(gml, stack, ReadingNotes())
        whole = replace(opened, buildings=tuple(opened.buildings))
        (gml.parent / named).unlink()
        write_city_files(whole, tmp_path / "m.city.json")
    content = json.loads((tmp_path / "m.city.json").read_text(encoding="utf-8"))
    assert content["CityObjects"] and "appearance" not in content


def test_lists_of_codes_lie_where_the_specification_has_them(tmp_path):
    gml = tmp_path / "city" / "udx" / "bldg" / "m.gml"
    gml.parent.mkdir(parents=True)
    (tmp_path / "city" / "codelists").mkdir()
    for place in ("city/codelists/u.xml", "city/v.xml", "w.xml"):
        (tmp_path / place).write_text("<Dictionary/>")
    (tmp_path / "city" / "codelists" / "x.xml").symlink_to(tmp_path / "w.xml")
    assert named_file(gml, "../../codelists/u.xml", CODE_LIST) == (tmp_path / "city/codelists/u.xml").resolve()
    assert named_file(gml, "../../v.xml", CODE_LIST) is not None  # the data set around udx is the model's own
    assert named_file(gml, "../../../w.xml", CODE_LIST) is None
    assert named_file(gml, "../../codelists/x.xml", CODE_LIST) is None
    loose = tmp_path / "a" / "b" / "m.gml"
    loose.parent.mkdir(parents=True)
    (tmp_path / "codelists").mkdir()
    (tmp_path / "codelists" / "u.xml").write_text("<Dictionary/>")
    assert named_file(loose, "../../codelists/u.xml", CODE_LIST) is not None
    assert named_file(loose, "../../w.xml", CODE_LIST) is None
    assert named_file(loose, "../../codelists/u.xml", IMAGE) is None


def test_images_of_one_name_in_two_folders_stay_apart(model, tmp_path):
    gml, named = model
    other = tmp_path / "set" / "b"
    first = tmp_path / "set" / "a"
    for folder, content in ((first, JPEG + b"first"), (other, JPEG + b"second")):
        (folder / named).parent.mkdir(parents=True)
        (folder / named).write_bytes(content)
        text = gml.read_text(encoding="utf-8")  # the same buildings under ids of their own
        (folder / "m.gml").write_text(re.sub("(id=\"|#)(?=[^\"]*\")", rf"\1{folder.name}_", text), encoding="utf-8")
    files, notes = export(tmp_path / "set", tmp_path / "out")
    assert not notes.missing_images
    for content in (JPEG + b"first", JPEG + b"second"):  # beside CityJSON and its sequence, and beside CityGML
        assert sum(one == content for one in files) == 2
    tiles = b"".join(file.read_bytes() for file in (tmp_path / "out" / "tiles").rglob("*.glb"))
    assert b"first" in tiles and b"second" in tiles


def test_tiff_becomes_png_where_formats_take_no_tiff(model, tmp_path):
    gml, named = model
    pixels = np.zeros((4, 6, 3), np.uint8)
    pixels[:, :3] = (10, 200, 30)
    tiff = str(Path(named).with_suffix(".tif"))
    (gml.parent / tiff).write_bytes(cv2.imencode(".tif", pixels)[1].tobytes())
    gml.write_text(gml.read_text(encoding="utf-8").replace(f">{named}<", f">{tiff}<"), encoding="utf-8")
    export(gml, tmp_path / "out")
    out = tmp_path / "out"
    tile = next((out / "tiles").rglob("*.glb")).read_bytes()
    assert b"image/png" in tile and b"\x89PNG" in tile and b"image/jpeg" not in tile
    assert '"type": "PNG"' in (out / "m.city.json").read_text().replace('"type":"PNG"', '"type": "PNG"')
    (image,) = (out / "m_textures").iterdir()
    assert image.suffix == ".png" and np.array_equal(cv2.imread(str(image)), pixels)
    assert "image/tiff" in next((out / "gml").rglob("*.gml")).read_text(encoding="utf-8")


def test_tiff_that_is_none_is_left_out(model, tmp_path):
    gml, named = model
    (gml.parent / named).write_bytes(b"II*\0" + b"\1" * 40)
    files, _ = export(gml, tmp_path / "out")
    assert files and not any(content.startswith(b"II*\0") for content in files)
