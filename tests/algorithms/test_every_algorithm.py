"""Every algorithm runs on small real input: its layers have words, its inputs stay, the bytes are the same again.

The runs are those of every_algorithm.py; their results are shared with test_every_algorithm_chained.py.
"""

from __future__ import annotations

import importlib.util
import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

_SPEC = importlib.util.spec_from_file_location("urbanmap_every_results", Path(__file__).with_name("every_results.py"))
shared = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(shared)
every, place, made, inputs = shared.every, shared.place, shared.made, shared.inputs

WITHOUT_FILES = {"samplecity", "checkcitymodel"}
"""Their runs have no input, or a folder."""
TIMED = ("tiledrun", "runjob")
"""Results that say when and how long they were worked on: not compared byte by byte."""


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


def test_each_algorithm_has_a_run(qgis_app):
    assert {name.split()[0] for name in every.RECIPES} == set(every.algorithms())


@pytest.mark.once
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
        for output in shared.algorithm_of(name).destinationParameterDefinitions():
            if output.type() == "folderDestination" or output.name() in given:
                continue
            with pytest.raises(QgsProcessingException, match="would take the place of"):
                run(f"urbanmap:{name.split()[0]}", {**given, **shared.wanted(name, given), output.name(): str(copy),
                                                    key: [moved] if isinstance(value, list) else moved})
            assert copy.read_bytes()[100:] == before[100:]  # the header of a database counts who opened it
            tried += 1
    assert tried or name in WITHOUT_FILES


@pytest.mark.once
def test_the_same_bytes_on_any_number_of_threads_and_workers(made, small_city):
    """Again with two workers, other threads of the libraries, and another order of sets and hashes."""
    again = shared.run_into(made.with_name("results"), small_city, 2, OPENBLAS_NUM_THREADS="2", PYTHONHASHSEED="2")
    contents = [{str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
                for folder in (made, again)]
    contents = [{name: data for name, data in found.items() if not name.startswith(TIMED)} for found in contents]
    said = [{name: texts for name, texts in json.loads(found.pop("messages.json")).items()
             if name not in (*TIMED, "samplecity")} for found in contents]  # the city names what is begun, at one time
    assert said[0] == said[1]
    assert contents[0].keys() == contents[1].keys() and len(contents[0]) > 100
    assert [name for name in contents[0] if contents[0][name] != contents[1][name]] == []
