"""No reader is left out by scripts/fuzz.py: what opens files in the core is entered when the sound files are read."""

from __future__ import annotations

import ast
import sys
import threading
from functools import cache

import pytest

from scripts.fuzz_formats import FORMATS
from scripts.source_tree import CORE, ROOT, modules, parsed

READING = {"read_bytes", "read_text", "read_json", "fromfile", "memmap", "loadtxt", "genfromtxt", "ZipFile", "connect"}
"""Functions and methods that read a file, whoever they belong to."""
MODE_FIRST = ("gzip", "laspy", "rasterio")
"""Modules whose `open` has the path before the mode."""

NOT_OF_USERS = {
    "aerial/markings/marking_report.py:_pictures": "result of the run",
    "aerial/worker_resources.py:SentPolygons._polygons": "written by the run for its workers",
    "aerial/markings/paint_model.py:PaintModel.read": "model of the program",
    "citymodel/citygml/iur.py:_rows": "table of the program",
    "citymodel/citygml/writer.py:_append": "written by the run",
    "citymodel/checks/standard_lists.py:standard_lists": "table of the program",
    "citymodel/images.py:web_image": "bytes of an image, copied as they are; a TIFF that is none is left out",
    "citymodel/tiles/tile_scratch.py:stored_buildings": "written by the run",
    "io/files/rule_table.py:RuleTable.rules": "table of the program",
    "citymodel/citygml/codelists.py:lists_of_module": "table of the program",
    "io/points/pointcloud.py:_true_box": "the points of a file whose header is wrong, read as all points are",
    "io/files/staging.py:_leased_elsewhere": "locks a file, reads none",
    "io/files/staging.py:_locked": "locks a file, reads none",
    "io/files/staging.py:clear_leftovers": "locks a file, reads none",
    "io/pages/report.py:Report.picture": "picture of the program",
    "io/points/point_buckets.py:PointBuckets.read": "written by the run",
    "job/job_progress.py:_digest": "sums bytes up, whatever they are",
    "mobile/boresight/stage.py:write_calibration": "read before by read_calibration, which refuses what is damaged",
    "sources.py:sources_mark": "sources of the program",
    "terrain/surface_canvas.py:Canvas._blank": "written by the run",
    "tiling/journal.py:_to_disk": "written by the run",
    "tiling/mosaic_tiles.py:_extent": "result of a tile, whose checksum was compared",
    "tiling/mosaic_tiles.py:_write_core": "result of a tile, whose checksum was compared",
    "tiling/mosaic_tiles.py:mosaic_tiles": "result of a tile, whose checksum was compared",
    "wording.py:read_catalogue": "translation of the program",
}
"""Functions that open files which no user gives, each with what they are instead."""


def reads_file(call: ast.Call) -> bool:
    """Whether a call opens a file for reading."""
    function = call.func
    name = function.id if isinstance(function, ast.Name) else getattr(function, "attr", "")
    base = getattr(getattr(function, "value", None), "id", "")
    if name == "load":
        return base in ("json", "np", "numpy")
    if name == "open":
        place = 1 if isinstance(function, ast.Name) or base in MODE_FIRST else 0
        given = [item.value for item in call.keywords if item.arg == "mode"] or call.args[place:place + 1]
        mode = given[0].value if given and isinstance(given[0], ast.Constant) else "r"
        return str(mode).startswith("r") and base != "os"
    return name in READING


def is_reader(function: ast.FunctionDef) -> bool:
    """Whether a function is decorated as the reader of a file."""
    return any(isinstance(item, ast.Call) and getattr(item.func, "id", "") == "reads"
               for item in function.decorator_list)


@cache
def readers() -> dict[str, set[int]]:
    """Functions of the core that open a file for reading: place, and the lines at which their code may begin."""
    found: dict[str, set[int]] = {}

    def visit(node, place, name, lines):
        for child in ast.iter_child_nodes(node):
            inner, first = name, lines
            if isinstance(child, (ast.FunctionDef, ast.ClassDef)):
                inner = f"{name}.{child.name}".lstrip(".")
                first = {child.lineno, *(mark.lineno for mark in child.decorator_list)}
                if isinstance(child, ast.FunctionDef) and is_reader(child):
                    found[f"{place}:{inner}"] = first
            if isinstance(child, ast.Call) and reads_file(child) and inner:
                found[f"{place}:{inner}"] = first
            visit(child, place, inner, first)

    for path in modules().values():
        if "samplecity" not in path.parts:
            visit(parsed(path), path.relative_to(ROOT / CORE).as_posix(), "", set())
    return found


@pytest.fixture(scope="module")
def entered(small_city, tmp_path_factory):
    """Functions of the core that are entered when the sound file of every format is read: file and line."""
    core, calls = f"{ROOT / CORE}/", set()

    def on_call(frame, event, argument):
        if event == "call" and frame.f_code.co_filename.startswith(core):
            calls.add((frame.f_code.co_filename[len(core):], frame.f_code.co_firstlineno))

    for number, (name, make, read) in enumerate(FORMATS.values()):
        folder = tmp_path_factory.mktemp(f"format{number}")
        path = make(folder / name, small_city)
        threading.setprofile(on_call)
        sys.setprofile(on_call)
        try:
            read(path)
        finally:
            sys.setprofile(None)
            threading.setprofile(None)
    return calls


def test_there_are_readers():
    assert len(readers()) > 60 and {"io/osm.py:read_osm", "tiling/journal.py:read_record"} <= set(readers())


@pytest.mark.slow
def test_every_reader_of_a_users_file_is_fuzzed(entered):
    missing = [name for name, lines in readers().items() if name not in NOT_OF_USERS
               and not any((name.partition(":")[0], line) in entered for line in lines)]
    assert not missing, "give them a format in scripts/fuzz_formats.py, or a reason here"


def test_what_is_said_to_be_no_users_file_is_a_reader():
    assert set(NOT_OF_USERS) <= set(readers())
