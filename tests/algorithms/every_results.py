"""The results of every algorithm's run, made once for the test files that need them, also at one time."""

from __future__ import annotations

import fcntl
import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("every_algorithm.py")
_SPEC = importlib.util.spec_from_file_location("urbanmap_every_algorithm", SCRIPT)
every = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(every)

FILES = ("fileDestination", "rasterDestination", "folderDestination")


def run_into(folder, city, workers, **environment):
    """All of them in a process of its own; Qt writes the fonts of a PDF in the order of its hashes."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    done = subprocess.run([sys.executable, str(SCRIPT), str(city), str(folder), str(workers)], text=True,
                          capture_output=True, env={**os.environ, "QT_HASH_SEED": "0", **environment}, timeout=900,
                          check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


@pytest.fixture(scope="session")
def place(tmp_path_factory):
    """Folder that the processes of a test run share."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "every_algorithm"
    folder.mkdir(exist_ok=True)
    return folder


@pytest.fixture(scope="module")
def made(qgis_app, small_city, place):
    """Folder of the results of all, made by one thread each in `results` and moved: others are made there again."""
    with (place / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (place / "first").exists():
            run_into(place / "results", small_city, 1, OPENBLAS_NUM_THREADS="1", PYTHONHASHSEED="1")
            (place / "results").rename(place / "first")
    return place / "first"


@pytest.fixture(scope="module")
def inputs(made, small_city):
    """`inputs(name)`: the inputs of a recipe, from the city and from the results of those before it."""
    text = (made / "results.json").read_text(encoding="utf-8")
    results = json.loads(text.replace(str(made.with_name("results")), str(made)))
    workers = {name for name, item in every.algorithms().items() if item.parameterDefinition("WORKERS")}
    return lambda name: {**every.given(name, small_city, made, results),
                         **({"WORKERS": 1} if name.split()[0] in workers else {})}


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
