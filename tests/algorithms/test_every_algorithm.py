"""Every algorithm runs on small real input: into files, temporary ones, as an exported model, never over its input.

The runs are those of every_algorithm.py.
"""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("every_algorithm.py")
_SPEC = importlib.util.spec_from_file_location("urbanmap_every_algorithm", SCRIPT)
every = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(every)

LONG = {"samplecity", "georeferencemms", "adjustsurveys", "calibratescanner"}
"""More than four seconds: run into files and temporary places, but not once more as a model of one step."""
TIMED = ("tiledrun", "runjob")
"""Results that say when and how long they were worked on: not compared byte by byte."""
FILES = ("fileDestination", "rasterDestination", "folderDestination")


def run_into(folder, city, workers, **environment):
    """All of them in a process of its own."""
    folder.mkdir()
    done = subprocess.run([sys.executable, str(SCRIPT), str(city), str(folder), str(workers)], text=True,
                          capture_output=True, env={**os.environ, **environment}, timeout=900, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


@pytest.fixture(scope="module")
def made(qgis_app, small_city, tmp_path_factory):
    """Folder of the results of all, made by one thread each."""
    place = tmp_path_factory.mktemp("every")
    run_into(place / "results", small_city, 1, OPENBLAS_NUM_THREADS="1", PYTHONHASHSEED="1")
    return place / "results"


@pytest.fixture(scope="module")
def inputs(made, small_city):
    """`inputs(name)`: the inputs of a recipe, from the city and from the results of those before it."""
    results = json.loads((made / "results.json").read_text(encoding="utf-8"))
    workers = {name for name, item in every.algorithms().items() if item.parameterDefinition("WORKERS")}
    return lambda name: {**every.given(name, small_city, made, results),
                         **({"WORKERS": 1} if name.split()[0] in workers else {})}


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


def algorithm_of(name):
    return every.algorithms()[name.split()[0]]


def wanted(name, given):
    """Temporary places for all outputs that the recipe does not leave out."""
    return {item.name(): "TEMPORARY_OUTPUT" for item in algorithm_of(name).destinationParameterDefinitions()
            if item.name() not in given}


def assert_all_there(definitions, results, asked):
    """Every file that was asked for is there, every layer holds what it says."""
    for item in definitions:
        name = item.name().rpartition(":")[2]
        value = next((results[key] for key in results if key.rpartition(":")[2] == name), None)
        if item.name() in asked:
            assert value is not None, f"{item.name()}: {results}"
            if item.type() in FILES:
                assert Path(value).exists(), value
                assert ".urbanmap-" not in value


def test_each_algorithm_has_a_run(qgis_app):
    assert {name.split()[0] for name in every.RECIPES} == set(every.algorithms())


@pytest.mark.parametrize("name", every.RECIPES)
def test_into_temporary_places(run, inputs, name):
    given = inputs(name)
    asked = wanted(name, given)
    results = run(f"urbanmap:{name.split()[0]}", {**given, **asked})
    assert_all_there(algorithm_of(name).destinationParameterDefinitions(), results, asked)
    assert not [word for word in run.feedback.warnings if ".urbanmap-" in word]


@pytest.mark.parametrize("name", [name for name in every.RECIPES if name not in LONG])
def test_as_an_exported_model(run, inputs, name):
    """A model of this one step, exported as Python by QGIS, into temporary places."""
    exported, given = exported_model(name, inputs(name))
    asked = {item.name(): "TEMPORARY_OUTPUT" for item in exported.parameterDefinitions() if item.isDestination()}
    results = run(exported, {**given, **asked})
    assert_all_there([item for item in exported.parameterDefinitions() if item.isDestination()], results, asked)


def exported_model(name, given):
    """The algorithm that QGIS writes for a model of one step with fixed inputs, and what it needs."""
    from qgis.core import (
        QgsProcessing,
        QgsProcessingAlgorithm,
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
        QgsProcessingModelOutput,
    )

    model, algorithm = QgsProcessingModelAlgorithm(name.replace(" ", ""), "trials"), algorithm_of(name)
    child = QgsProcessingModelChildAlgorithm(algorithm.id())
    child.setChildId("step")
    for key, value in given.items():
        child.addParameterSources(key, [QgsProcessingModelChildParameterSource.fromStaticValue(value)])
    outputs = {}
    for key in wanted(name, given):
        output = QgsProcessingModelOutput(key, key)
        output.setChildId("step")
        output.setChildOutputName(key)
        outputs[key] = output
    child.setModelOutputs(outputs)
    model.addChildAlgorithm(child)
    model.updateDestinationParameters()
    code = "\n".join(model.asPythonCode(QgsProcessing.PythonOutputType.PythonQgsProcessingAlgorithmSubclass, 4))
    scope: dict = {}
    exec(compile(code, "exported", "exec"), scope)
    exported = next(item for item in scope.values() if isinstance(item, type)
                    and issubclass(item, QgsProcessingAlgorithm) and item is not QgsProcessingAlgorithm)()
    exported.initAlgorithm()
    return exported, {}


@pytest.mark.parametrize("name", every.RECIPES)
def test_over_its_own_inputs(run, inputs, made, tmp_path, name):
    """Each output at the place of each input that is a file: refused, and the input is as it was."""
    from qgis.core import QgsProcessingException

    given, tried = inputs(name), 0
    for key, value in given.items():
        single = value[0] if isinstance(value, list) else value
        path = Path(str(single).split("|")[0])
        if not (isinstance(single, str) and path.is_absolute() and path.is_file()):
            continue
        copy = Path(shutil.copy(path, tmp_path))
        moved = str(single).replace(str(path), str(copy))
        before = copy.read_bytes()
        for output in algorithm_of(name).destinationParameterDefinitions():
            if output.type() == "folderDestination" or output.name() in given:
                continue
            with pytest.raises(QgsProcessingException, match="would take the place of"):
                run(f"urbanmap:{name.split()[0]}", {**given, **wanted(name, given), output.name(): str(copy),
                                                    key: [moved] if isinstance(value, list) else moved})
            assert copy.read_bytes()[100:] == before[100:]  # the header of a database counts who opened it
            tried += 1
    assert tried or name == "samplecity"


def test_the_same_bytes_on_any_number_of_threads_and_workers(made, small_city):
    """Again with two workers, other threads of the libraries, and another order of sets and hashes."""
    place = made.parent
    made.rename(place / "first")
    try:
        again = run_into(place / "results", small_city, 2, OPENBLAS_NUM_THREADS="2", PYTHONHASHSEED="2")
        contents = [{str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
                    for folder in (place / "first", again)]
        contents = [{name: data for name, data in found.items() if not name.startswith(TIMED)} for found in contents]
        assert contents[0].keys() == contents[1].keys() and len(contents[0]) > 100
        assert [name for name in contents[0] if contents[0][name] != contents[1][name]] == []
    finally:
        shutil.rmtree(place / "first")
