"""Every algorithm runs on small real input, in Japanese: its layers have words, its reports are translated, the bytes
are the same again.

The runs are those of every_algorithm.py.
"""

from __future__ import annotations

import html
import importlib.util
import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from tests.japanese import english

SCRIPT = Path(__file__).with_name("every_algorithm.py")
_SPEC = importlib.util.spec_from_file_location("urbanmap_every_algorithm", SCRIPT)
every = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(every)

CHAINS = ("aerialmarkings", "buildingsfromals", "georeferencemms", "roadspace", "tiledrun", "runjob")
"""Their steps are run by themselves too: they are not run again."""

FILES = ("fileDestination", "rasterDestination", "folderDestination")

CHAINED = ("orthorectifyframes", "filtervehicles", "adjustframes", "convertheights", "tiledrun", "registermms")
"""Few algorithms with inputs and outputs of every kind, to be steps of models."""


def run_into(folder, city, workers, *names, **environment):
    """All of them, or those named, in a process of its own; Qt writes the fonts of a PDF in the order of its hashes."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    language = {"LANG": "ja_JP.UTF-8", "LC_ALL": "", "LC_CTYPE": "C.UTF-8"}
    done = subprocess.run([sys.executable, str(SCRIPT), str(city), str(folder), str(workers), *names], text=True,
                          capture_output=True, env={**os.environ, "QT_HASH_SEED": "0", **language, **environment},
                          timeout=900, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


@pytest.fixture(scope="module")
def made(qgis_app, small_city, tmp_path_factory):
    """Folder of the results of all, made by one thread each in `results` and moved: others are made there again."""
    place = tmp_path_factory.mktemp("every")
    return run_into(place / "results", small_city, 1, OPENBLAS_NUM_THREADS="1", PYTHONHASHSEED="1").rename(
        place / "first")


def layers_of(path):
    """Fields of the layers of a GeoPackage without keys and geometries, and the style that it keeps."""
    with closing(sqlite3.connect(path)) as database:
        tables = [name for name, in database.execute(
            "SELECT table_name FROM gpkg_contents WHERE table_name <> 'layer_styles'")]
        shapes = {name for name, in database.execute("SELECT column_name FROM gpkg_geometry_columns")}
        fields = {row[1] for table in tables for row in database.execute(f'PRAGMA table_info("{table}")')}
        styled = database.execute("SELECT 1 FROM sqlite_master WHERE name = 'layer_styles'").fetchone()
        style = database.execute("SELECT styleName FROM layer_styles").fetchone()[0] if styled else ""
    return fields - shapes - {"fid"}, style


def test_every_field_of_every_layer_has_words(made, small_city, plugin):
    """All but those that the user's own outlines and city models have."""
    words_of = plugin("algorithms.framework.layers.field_words").words_of
    models = json.loads((small_city / "models" / "buildings.geojson").read_text(encoding="utf-8"))
    users = layers_of(small_city / "footprints" / "gsi_buildings.gpkg")[0] | set(models["features"][0]["properties"])
    missing = {}
    for path in made.glob("*-OUTPUT*.gpkg"):
        fields, style = layers_of(path)
        missing |= {(path.name, name): style for name in fields - users if words_of(name, style) is None}
    assert missing == {}


def test_no_algorithm_and_no_chain_loses_a_building(made, small_city):
    """Layers with rows of buildings have all of them, modelled or not; those of walls only what was measured."""
    with closing(sqlite3.connect(small_city / "footprints" / "gsi_buildings.gpkg")) as database:
        outlines = database.execute("SELECT count(*) FROM BldA").fetchone()[0]
    counts = {}
    for path in (*made.glob("*-OUTPUT*.gpkg"), *made.glob("tiledrun-*/merged/output.gpkg")):
        with closing(sqlite3.connect(path)) as database:
            if {"building_id"} <= {row[1] for row in database.execute(f'PRAGMA table_info("{path.stem}")')}:
                counts[path.name] = database.execute(
                    f'SELECT count(DISTINCT building_id) FROM "{path.stem}"').fetchone()[0]
    of_walls = {"wallsfrommms-OUTPUT.gpkg", "mergebuildingmodels-OUTPUT_WALLS.gpkg"}
    assert len(counts) > 15 and of_walls < set(counts) and "output.gpkg" in counts
    assert counts.pop("updatebuildings-OUTPUT.gpkg") >= outlines and counts.pop("buildingoutlines-OUTPUT.gpkg") > 5
    assert {name: count for name, count in counts.items() if count != outlines and name not in of_walls} == {}


def test_each_algorithm_has_a_run(qgis_app):
    assert {name.split()[0] for name in every.RECIPES} == set(every.algorithms())


CITY_NAMES = {"building", "survey", "trajectory", "way", "node", "File", "Height", "SpeedLimit", "routing", "graph",
              "status", "reason", "ele", "pass", "mms", "regulatory", "element", "creationDate", "id", "omega", "phi",
              "kappa", "survey_"}
"""Names in the sample city's data, parts of codes and of lane maps, and fields to which a message points."""


@pytest.mark.once
def test_reports_and_messages_are_in_japanese(made):
    texts = [text for said in json.loads((made / "messages.json").read_text(encoding="utf-8")).values()
             for text in said if not text.startswith("Results:")]  # QGIS's own
    pages = list(made.glob("*.html"))
    assert len(pages) >= 12
    for page in pages:
        text = re.sub(r"<style.*?</style>|data:image[^\"']*", "", page.read_text(encoding="utf-8"), flags=re.S)
        assert '<html lang="ja">' in text
        texts += [html.unescape(part) for part in re.findall(r">([^<]+)<", text)]
    left = {text.strip(): words for text in texts if (words := english(text, CITY_NAMES | set(every.RECIPES)))}
    assert left == {}


@pytest.mark.once
def test_the_same_bytes_on_any_number_of_threads_and_workers(made, small_city):
    """Again with two workers, other threads of the libraries, and another order of sets and hashes."""
    again = run_into(made.with_name("results"), small_city, 2, *(name for name in every.RECIPES if name not in CHAINS),
                     OPENBLAS_NUM_THREADS="2", PYTHONHASHSEED="2")
    contents = [{name: path.read_bytes() for path in folder.rglob("*") if path.is_file() and not (
        name := str(path.relative_to(folder))).startswith(("results.json", *CHAINS))} for folder in (made, again)]
    said = [{name: texts for name, texts in json.loads(found.pop("messages.json")).items()
             if name not in (*CHAINS, "samplecity")} for found in contents]  # the city names what is begun, at one time
    assert said[0] == said[1]
    assert contents[0].keys() == contents[1].keys() and len(contents[0]) > 100
    assert [name for name in contents[0] if contents[0][name] != contents[1][name]] == []


@pytest.fixture(scope="module")
def inputs(made, small_city):
    """`inputs(name)`: the inputs of a recipe, from the city and from the results of those before it."""
    text = (made / "results.json").read_text(encoding="utf-8")
    results = json.loads(text.replace(str(made.with_name("results")), str(made)))
    workers = {name for name, item in every.algorithms().items() if item.parameterDefinition("WORKERS")}
    return lambda name: {**every.given(name, small_city, made, results), **({"WORKERS": 1} if name in workers else {})}


def outputs_of(name, given):
    """Definitions of the outputs that a recipe does not leave out."""
    return [item for item in every.algorithms()[name].destinationParameterDefinitions() if item.name() not in given]


def test_the_steps_of_models_have_inputs_and_outputs_of_every_kind(qgis_app):
    def kinds(names):
        return {(item.isDestination(), item.type(), item.layerType() if item.type() == "multilayer" else "")
                for name in names for item in every.algorithms()[name.split()[0]].parameterDefinitions()
                if item.isDestination() or item.name() in every.RECIPES[name]}

    assert kinds(CHAINED) == kinds(every.RECIPES)


@pytest.mark.parametrize("name", CHAINED)
def test_as_an_exported_model_into_temporary_places(run, inputs, name):
    """A model of this one step, exported as Python by QGIS, hands the places that it is given on to the step."""
    exported = exported_model(name, inputs(name))
    asked = {item.name(): item for item in exported.parameterDefinitions() if item.isDestination()}
    results = run(exported, dict.fromkeys(asked, "TEMPORARY_OUTPUT"))
    for key, item in asked.items():
        assert results[key] is not None, f"{key}: {results}"
        if item.type() in FILES:
            assert Path(results[key]).exists() and ".urbanmap-" not in results[key]
    assert not [word for word in run.feedback.warnings if ".urbanmap-" in word]


def exported_model(name, given):
    """The algorithm that QGIS writes for a model of one step with fixed inputs."""
    from qgis.core import (
        QgsProcessing,
        QgsProcessingAlgorithm,
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
        QgsProcessingModelOutput,
    )

    model = QgsProcessingModelAlgorithm(name, "trials")
    child = QgsProcessingModelChildAlgorithm(every.algorithms()[name].id())
    child.setChildId("step")
    for key, value in given.items():
        child.addParameterSources(key, [QgsProcessingModelChildParameterSource.fromStaticValue(value)])
    outputs = {}
    for item in outputs_of(name, given):
        output = outputs[item.name()] = QgsProcessingModelOutput(item.name(), item.name())
        output.setChildId("step")
        output.setChildOutputName(item.name())
    child.setModelOutputs(outputs)
    model.addChildAlgorithm(child)
    model.updateDestinationParameters()
    code = "\n".join(model.asPythonCode(QgsProcessing.PythonOutputType.PythonQgsProcessingAlgorithmSubclass, 4))
    scope: dict = {}
    exec(compile(code, "exported", "exec"), scope)
    exported = next(item for item in scope.values() if isinstance(item, type)
                    and issubclass(item, QgsProcessingAlgorithm) and item is not QgsProcessingAlgorithm)()
    exported.initAlgorithm()
    return exported
