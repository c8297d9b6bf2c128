"""How a table of another program may be read: by its bytes, the names of its columns and its first numbers."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..aerial.frames.exterior_files import COLUMNS as EXTERIOR_COLUMNS
from ..aerial.frames.exterior_files import UNITS, angle_unit, stated_rotations
from ..io.files.named_table import DELIMITERS, WRITTEN_NUMBER, meanings, plain_name, split_blanks
from ..io.files.plan_axes import NamedAxis, named_axes, order_of_numbers, stated_order
from ..wording import say
from .table_import import ENCODINGS, HEIGHTS, MOST_BEFORE, TableImport, each_named, split_table
from .table_places import POLAR
from .table_targets import ALIASES, ANGLE_WAYS, TARGETS

_ELLIPSOIDAL, _SEA_LEVEL = re.compile(r"ell|hae|楕円体"), re.compile(r"ortho|msl|geoid|標高")


def guessed_import(path: str | os.PathLike, target: str) -> TableImport:
    """How a table may be read, by its bytes and the names of its columns; what is not found is left out."""
    return _guessed(path, target, *_headers(path))


def _headers(path: str | os.PathLike) -> tuple[str, list[tuple[int, str, list[str]]]]:
    """The encoding of a table, and what may be the names of its columns: lines before them, delimiter, names."""
    data = Path(path).read_bytes()
    encoding = next((name for name in ENCODINGS if _decodes(data, name)), ENCODINGS[0])
    lines = [line for line in data.decode(encoding, "replace").splitlines() if line.strip()][:MOST_BEFORE]
    headers = []
    for skip, line in enumerate(lines):
        for delimiter in DELIMITERS:
            cells = line.split(None if delimiter == " " else delimiter)
            if len(cells) < 2 or 2 * sum(bool(WRITTEN_NUMBER.match(cell.strip())) for cell in cells) > len(cells):
                continue
            few = lines[skip:skip + 4]
            rows = split_blanks(few) if delimiter == " " else [
                next(csv.reader([row], delimiter=delimiter), []) for row in few]
            if delimiter == "," and max(map(len, rows[1:]), default=0) == 1 < len(few[-1].split("\t")):
                delimiter = "\t"  # Metashape writes names with commas over values with tabs
                rows = [rows[0], *(row.split(delimiter) for row in few[1:])]
            headers.append((skip, delimiter, [cell.strip() for cell in each_named(
                rows[0], max(map(len, rows[1:]), default=0))]))
    return encoding, headers


def _guessed(path: str | os.PathLike, target: str, encoding: str,
             headers: Sequence[tuple[int, str, list[str]]]) -> TableImport:
    """How a table may be read as a target: by the names of which the most are known."""
    best = TableImport(target, encoding, angles=ANGLE_WAYS[target][0])
    for skip, delimiter, names in headers:
        known = meanings(names, (*TARGETS[target], *POLAR), ALIASES[target],
                         stated_order(named_axes(names)) is not False)
        found = {meant: names.index(key) for key, meant in known.items()}
        if len(found) > len(best.columns):
            best = TableImport(target, encoding, delimiter, skip, found, ANGLE_WAYS[target][0],
                               heights=_heights_in(names[found["z"]]) if "z" in found else "")
    best = _in_order(path, _with_one_place(best))
    return replace(best, angles=_frame_angles(path, best)) if target == "exterior" and not missing_columns(best) \
        else best


def _frame_angles(path: str | os.PathLike, how: TableImport) -> str:
    """Unit of the angles of frames by their looks, and the order that the table's names or matrices say."""
    names, rows = split_table(path, how, MOST_BEFORE)
    rows = [row for row in rows if len(row) == len(names) and all(
        WRITTEN_NUMBER.match(row[how.columns[name]].strip()) for name in EXTERIOR_COLUMNS[1:] if name in how.columns)]
    places = [name for name in EXTERIOR_COLUMNS[1:4] if name in how.columns]
    if not rows:
        return how.angles
    angles = np.array([[float(row[how.columns[name]]) for name in EXTERIOR_COLUMNS[4:]] for row in rows])
    unit = angle_unit(angles)
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    known = {name: names[how.columns[name]] for name in ("image", *places)}
    numbers = np.hstack([np.zeros((len(rows), 3)), angles * UNITS[unit]])
    return f"{unit} {stated_rotations(columns, {'x': '', **known}, numbers) or how.angles.split(' ')[1]}"


def _in_order(path: str | os.PathLike, how: TableImport) -> TableImport:
    """X and Y named in Japanese turned round where the numbers say that X counts east."""
    if how.polar or not how.columns or _order_in(path, how)[1] is not False:
        return how
    names = split_table(path, how, 1)[0]
    known = meanings(names, TARGETS[how.target], ALIASES[how.target], x_north=False)
    return replace(how, columns={**how.columns, **{meant: names.index(key) for key, meant in known.items()
                                                   if meant[0] in "xy"}})


def _order_in(path: str | os.PathLike, how: TableImport) -> tuple[dict[object, NamedAxis], bool | None]:
    """The columns named X and Y in Japanese, and whether X counts north by their names or the first rows."""
    names, rows = split_table(path, how, MOST_BEFORE)
    axes = named_axes(names)
    if not axes or stated_order(axes) is not None:
        return axes, stated_order(axes)
    values = {name: [row[place] if place < len(row) else "" for row in rows] for place, name in enumerate(names)}
    plain = {plain_name(name): name for name in names if name not in axes}
    sure = {other: values[plain[other]] for other in plain if other[-1:] in ("東", "北")}
    sure.update({other: values[plain[meant.replace("_", "")]] for other, meant in ALIASES[how.target].items()
                 if other[-1] in "東北" and meant.replace("_", "") in plain})
    return axes, order_of_numbers(axes, values, sure)


def told_order(path: str | os.PathLike, how: TableImport) -> str:
    """A sentence on columns that nothing but a habit says to count north or east; "" where there are none."""
    axes, order = _order_in(path, how)
    if order is not None or how.polar or len({axis.letter for axis in axes.values()}) < 2:
        return ""
    names = split_table(path, how, 1)[0]
    chosen: dict[object, str] = {names[column]: name for name, column in how.columns.items() if column < len(names)}
    north, east = ([key for key in axes if chosen.get(key, " ")[0] == letter] for letter in "yx")
    if not north or not east:
        return ""
    return say("{north} is taken as counting north and {east} as counting east; the table does not say it. In the "
               "Japanese plane rectangular system X counts north; where X counts east, swap the two above the columns.",
               north=", ".join(map(str, north)), east=", ".join(map(str, east)))


def guessed_target(path: str | os.PathLike) -> TableImport:
    """How a table may be read as what it most likely is: the most of the needed columns found, the fewest missing."""
    encoding, headers = _headers(path)
    ways = [_guessed(path, target, encoding, headers) for target in TARGETS]
    return max(ways, key=lambda how: (len(how.needed) - 3 * len(missing_columns(how)), len(how.columns)))


def missing_columns(how: TableImport) -> set[str]:
    """Needed columns for which none is chosen."""
    return set(how.needed) - set(how.columns)


def _heights_in(name: str) -> str:
    """What heights count from by the name of their column."""
    plain = plain_name(name)
    return HEIGHTS[1] if _ELLIPSOIDAL.search(plain) else HEIGHTS[2] if _SEA_LEVEL.search(plain) else ""


def _with_one_place(how: TableImport) -> TableImport:
    """Map coordinates where a table has them, else latitudes and longitudes."""
    left = POLAR if {"x", "y"} <= set(how.columns) else ("x", "y") if how.polar else ()
    return replace(how, columns={name: column for name, column in how.columns.items() if name not in left})


def _decodes(data: bytes, encoding: str) -> bool:
    if encoding == "utf-16" and not data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return False
    try:
        data.decode(encoding)
    except UnicodeError:
        return False
    return True
