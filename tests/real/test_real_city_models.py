"""City models by outside judges: the schemas of CityJSON and of CityGML as PLATEAU has it, val3dity, cjio."""

import importlib.util
import itertools
import json
import shutil
import subprocess
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.city_models import town
from tests.solid_files import read_solids
from urbanmap_qgis.buildings.city_export import export_buildings
from urbanmap_qgis.citymodel.city_files import write_city_files
from urbanmap_qgis.citymodel.citygml.plateau import PlateauDelivery
from urbanmap_qgis.citymodel.citygml.reader import open_citygml
from urbanmap_qgis.citymodel.citygml.writer import write_citygml
from urbanmap_qgis.citymodel.model import CityModel, CityReference
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

SHARED = Path(__file__).resolve().parents[3] / "shared"
TOOLS = SHARED / "tools"
PEER = SHARED / "data" / "als" / "delft_west" / "peer_3dfier_lod1.city.json"

pytestmark = pytest.mark.skipif(not TOOLS.is_dir(), reason="the outside judges are not here")


@pytest.fixture(scope="module")
def delft():
    """Another program's block models of 92 real houses, as a layer of ours would hold them."""
    if not PEER.exists():
        pytest.skip("the shared real data are not here")
    from urbanmap_qgis.buildings.merging.model_files import models_from_cityjson

    _, faces, names = models_from_cityjson(PEER)
    made = export_buildings(names, faces, [{"名前": name} for name in names], ["1.3"] * len(names))
    assert not any(item.problems for item in made.objects)
    return CityModel(CityReference("", 28992, False, "EPSG:5709"), made.objects, title="Delft")


def models(delft, tmp_path):
    image = tmp_path / "wall.jpg"
    image.write_bytes(b"\xff\xd8\xff")
    return {"delft": delft, "town": town(images={"t/wall.jpg": image}), "new": town(heights="JGD2024")}


def test_cityjson_is_valid_by_its_schema(delft, tmp_path):
    validator = pytest.importorskip("jsonschema").Draft7Validator(
        json.loads((TOOLS / "cityjson-2.0.2.schema.json").read_text()))
    for name, model in models(delft, tmp_path).items():
        path = tmp_path / f"{name}.city.json"
        write_city_files(model, cityjson=path, cityjsonseq=tmp_path / f"{name}.city.jsonl")
        validator.validate(json.loads(path.read_text(encoding="utf-8")))


SCHEMAS = {"2.0": "plateau.xsd", "3.1": "plateau-3.1.xsd", "3.2": "plateau-3.2.xsd"}


def schema_of(version):
    etree = pytest.importorskip("lxml.etree")
    return etree, etree.XMLSchema(etree.parse(str(TOOLS / "citygml" / SCHEMAS[version]),
                                              etree.XMLParser(no_network=True)))


@pytest.mark.parametrize(("version", "level"), [("3.2", 0), ("3.2", 2500), ("3.1", 500), ("2.0", 0)])
def test_citygml_is_valid_by_the_schemas_of_plateau(delft, tmp_path, version, level):
    etree, schema = schema_of(version)
    for name, model in models(delft, tmp_path).items():
        write_city_files(model, citygml=tmp_path / name, delivery=PlateauDelivery(version, "13101", map_level=level))
        (path,) = (tmp_path / name).rglob("*.gml")
        schema.validate(etree.parse(str(path)))
        assert not list(schema.error_log), name


def test_every_geometry_is_valid_by_val3dity(delft, tmp_path):
    judge = TOOLS / "val3dity"
    try:
        subprocess.run([str(judge), "--version"], capture_output=True, timeout=20, check=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("val3dity cannot run here")
    for name, model in models(delft, tmp_path).items():
        path, report = tmp_path / f"{name}.city.json", tmp_path / f"{name}.report.json"
        write_city_files(model, cityjson=path)
        subprocess.run([str(judge), str(path), "--report", str(report)], check=True, capture_output=True, timeout=300)
        found = json.loads(report.read_text())
        assert found["validity"] is True, (name, found["all_errors"])
        if name == "delft":
            assert {row["type"]: row["valid"] for row in found["primitives_overview"]} == {
                "Solid": 184, "MultiSurface": 184}
            assert len(read_solids(path)) == 92


def test_cjio_reads_it(delft, tmp_path):
    if importlib.util.find_spec("cjio") is None and shutil.which("cjio") is None:
        pytest.skip("cjio is not installed")
    program = [shutil.which("cjio")] if shutil.which("cjio") else ["python3", "-m", "cjio.cjio"]
    write_city_files(delft, cityjson=tmp_path / "delft.city.json")
    done = subprocess.run([*program, str(tmp_path / "delft.city.json"), "info"], capture_output=True, text=True,
                          timeout=120)
    assert "Building (92)" in done.stdout and "EPSG = 28992" in done.stdout


PLATEAU = sorted((SHARED / "data" / "als" / "plateau").rglob("*.gml"))


@pytest.mark.parametrize("path", PLATEAU, ids=lambda path: path.stem)
def test_a_file_of_plateau_read_and_written_again_loses_nothing(path, tmp_path):
    etree, schema = schema_of("2.0")
    with ExitStack() as stack:
        notes = ReadingNotes()
        model = open_citygml(path, stack, notes)
        before = list(model.buildings)
        files = write_citygml(tmp_path, replace(model, buildings=before), version="2.0")
    assert files == {path.name: len(before)} and not notes.unread and not notes.others
    written = tmp_path / "udx" / "bldg" / path.name
    schema.validate(etree.parse(str(written)))
    assert not list(schema.error_log)
    shutil.rmtree(tmp_path / "codelists")  # their meanings are not in the source
    with ExitStack() as stack:
        after = list(open_citygml(written, stack, ReadingNotes()).buildings)
    assert [described(item) for item in after] == [described(item) for item in before]
    assert len(list((tmp_path / "udx" / "bldg").rglob("*.jpg"))) == len(model.images)


@pytest.mark.parametrize("version", ["3.1", "3.2"])
@pytest.mark.parametrize("path", PLATEAU[:1], ids=lambda path: path.stem)
def test_a_file_of_an_older_version_becomes_one_of_today(path, version, tmp_path):
    """What today's version has under another name is renamed; what it does not have stays as generic attributes."""
    etree, schema = schema_of(version)
    with ExitStack() as stack:
        model = open_citygml(path, stack, ReadingNotes())
        before = [replace(item, shapes=item.shapes[:1]) for item in itertools.islice(model.buildings, 200)]
    write_city_files(replace(model, buildings=before), citygml=tmp_path,
                     delivery=PlateauDelivery(version, measured=False))
    (written,) = tmp_path.rglob("*.gml")
    schema.validate(etree.parse(str(written)))
    assert not list(schema.error_log)
    with ExitStack() as stack:
        after = list(open_citygml(written, stack, ReadingNotes()).buildings)
    assert [item.id for item in after] == [item.id for item in before]
    for old, new in zip(before, after):
        assert new.attributes["uro:buildingIDAttribute"] == old.attributes["uro:buildingIDAttribute"]
        quality = new.attributes["uro:bldgDataQualityAttribute"].values
        assert quality["uro:geometrySrcDescLod1"].value in ("700", "999")
        assert "uro:thematicSrcDesc" not in quality, "where the model comes from is not known"


def described(item):
    """All that an object holds, in a form that can be compared; coordinates to the last digit."""
    shapes = [(shape.lod, shape.kind, [[(
        surface.kind, [ring.tolist() for ring in surface.rings],
        None if surface.texture is None else (Path(surface.texture.image).name,
                                              [np.asarray(uv).tolist() for uv in surface.texture.uv]))
        for surface in shell] for shell in shape.shells]) for shape in item.shapes]
    return item.id, item.type, dict(item.attributes), shapes, [described(part) for part in item.parts], item.problems
