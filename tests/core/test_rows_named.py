"""A value that is no number is refused with its row, in every table that the core reads."""

from __future__ import annotations

import json
import random
from xml.etree import ElementTree

import numpy as np
import pytest

from scripts.fuzz import _is_unnamed
from scripts.fuzz_damage import damaged
from scripts.fuzz_formats import FORMATS
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.files.guard import reads

ROWS = {"trajectory CSV": ("row {line} ", range(7)), "table to import": ("row {line} ", range(7)),
        "image poses": ("row {line} ", range(1, 8)), "tie points": ("row {line} ", range(1, 6)),
        "control points": ("row {row} ", range(1, 8)), "check points": ("row {row} ", range(1, 7)),
        "control points of a Japanese spreadsheet": ("row {row}:", range(1, 4)),
        "times of columns": ("row {line} ", range(2)), "range scans CSV": (" line {line} ", range(5)),
        "exterior orientation": ("Row {row} ", range(1, 7)), "image points": ("row {line}:", range(2, 7)),
        "laser control points": ("row {line}:", range(1, 7))}
"""How the sentence names a row by the line of the file or its number below the head, and the columns of numbers."""


@pytest.mark.parametrize("name", ROWS)
def test_a_value_that_is_no_number_is_refused_with_its_row(small_city, tmp_path, name):
    file, make, read = FORMATS[name]
    words, columns = ROWS[name]
    path = make(tmp_path / file, small_city)
    data = path.read_bytes()
    encoding = "cp932" if "Japanese" in name else "utf-8"
    lines = data.decode(encoding).splitlines()
    at = len(lines) // 2
    for column in columns:
        cells = lines[at].split(",")
        cells[column] = "x7"
        path.write_bytes("\n".join([*lines[:at], ",".join(cells), *lines[at + 1:], ""]).encode(encoding))
        with pytest.raises(InputError) as told:
            read(path)
        assert words.format(line=at + 1, row=at) in str(told.value), column
        assert "could not convert" not in str(told.value) or name == "range scans CSV"


@pytest.mark.parametrize("name", ["tie points", "image poses", "control points", "calibration", "camera", "CityJSON",
                                  "GSI XML", "CityGML", "Lanelet2 map", "SP3", "geoid grid", "job"])
def test_no_damaged_file_is_refused_by_the_net_alone(small_city, tmp_path, name):
    file, make, read = FORMATS[name]
    path = make(tmp_path / file, small_city)
    data, refused = path.read_bytes(), 0
    for number in range(40):
        path.write_bytes(damaged(data, random.Random(f"{name}-rows-{number}")))
        try:
            read(path)
        except InputError as error:
            refused += 1
            assert not _is_unnamed(error, name), f"file {number}: {error}"
    assert refused > 5


def test_the_trial_sees_a_sentence_of_the_net():
    @reads("a table")
    def read(path):
        return [][3]

    with pytest.raises(InputError) as told:
        read("a.csv")
    assert _is_unnamed(told.value, "tie points") and not _is_unnamed(told.value, "LAS 1.4")
    assert _is_unnamed(InputError("a.csv: could not convert string to float: 'x'"), "tie points")


@pytest.mark.parametrize(("raised", "told"), [
    (lambda: {}["transform"], "“transform” is missing in it"), (lambda: float("12,5"), "“12,5” is no number"),
    (lambda: int("x7"), "“x7” is no number"), (lambda: np.array(["a1"]).astype(float), "“a1” is no number"),
    (lambda: json.loads('{"a":\n1 2}'), "line 2 is no JSON"),
    (lambda: ElementTree.fromstring("<a>\n<b>\n</a>"), "line 3 is no XML")])
def test_what_only_the_net_catches_is_named_as_far_as_python_says_it(raised, told):
    @reads("a thing")
    def read(path):
        raised()

    with pytest.raises(InputError, match=rf"a\.txt cannot be read as a thing \({told}\): it is damaged"):
        read("folder/a.txt")
