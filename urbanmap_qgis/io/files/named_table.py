"""Tables of numbers in text files of other programs: where the names of the columns stand, and what each one means.

Before the names there may be lines of another kind (the head of a report), after them a line of units. Names are
compared without case, blanks, marks and the unit in brackets, full-width letters as plain ones.
"""

from __future__ import annotations

import csv
import math
import os
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from ...errors import InputError, PreviewNeeded
from ...wording import say
from .columns import LATITUDE, LONGITUDE
from .guard import read_text
from .plan_axes import NamedAxis, named_axes, order_of_numbers, stated_order

DELIMITERS = ",;\t "
WRITTEN_NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")
"""A decimal number as tables have it."""

_WITH_COMMA = re.compile(r"^\s*[-+]?\d*,\d+([eE][-+]?\d+)?\s*$")

_HEAD_LINES = 200
_BRACKETS = re.compile(r"[(\[（［<][^(\[（［<)\]）］>]*[)\]）］>]")
"""What stands in brackets, without others in it: from one that is never closed nothing is looked through twice."""

_OTHER_UNITS = {"rad": "radians", "radian": "radians", "radians": "radians", "ラジアン": "radians", "ft": "feet",
                "feet": "feet", "foot": "feet", "usft": "feet", "gon": "gon", "grad": "gon", "dms": "degrees, minutes, "
                "seconds", "mm": "millimetres", "cm": "centimetres", "km": "kilometres"}
_COMMENT = re.compile(r"^\ufeff?\s*#+\s*")


def plain_name(name: object) -> str:
    """A column's name as names are compared: "ELLIPSOID HEIGHT (m)" is "ellipsoidheight"."""
    text = _BRACKETS.sub("", unicodedata.normalize("NFKC", str(name)))
    return re.sub(r"[\s_\-.:]+", "", text).lower()


def known_columns(columns: Mapping[str, Sequence], needed: Sequence[str], aliases: Mapping[str, str], name: str,
                  judge: Callable[[Mapping[bool, Mapping[str, str]]], bool | None] | None = None) -> dict[str, str]:
    """The file's column (its key) of each needed one that is there; one of just that name goes before another name.

    Parameters
    ----------
    aliases : the needed name by another one, written as `plain_name` gives it.
    name : of the file, for messages.
    judge : says whether X counts north, where names and numbers do not, of the known columns if it does (True) and if
        it does not (False); None where it cannot say.

    Raises
    ------
    InputError : several columns could be meant and differ.
    PreviewNeeded : X and Y are named as in the Japanese plane rectangular system, where X counts north, and nothing
        tells whether they are meant so; or places are latitudes and longitudes.
    """
    axes = named_axes(columns)
    found: dict[str, list[str]] = {}
    for key, meant in meanings([key for key in columns if key not in axes], needed, aliases).items():
        found.setdefault(meant, []).append(key)
    for meant, keys in found.items():
        if any(list(columns[key]) != list(columns[keys[0]]) for key in keys[1:]):
            raise InputError(say("{name} has several columns that could be {meant} ({keys}): keep the right one, or "
                                 "call it {meant}.", name=name, meant=meant, keys=", ".join(map(str, keys))))
    known = {meant: keys[0] for meant, keys in found.items()}
    lacking = {key for key in needed if key[0] in "xy"} - set(known)
    by_order = {x_north: _meant_axes(axes, aliases, lacking, x_north) for x_north in (True, False)}
    if any(by_order.values()):
        return {**known, **by_order[_x_north(columns, known, axes, by_order, aliases, name, judge)]}
    _require_plane(columns, lacking, name)
    return known


def _meant_axes(axes: Mapping[str, NamedAxis], aliases: Mapping[str, str], lacking: Collection[str],
                x_north: bool) -> dict[str, str]:
    """The columns of X and Y by what they are, of those that are `lacking`."""
    meant = {aliases.get(axis.counts(x_north)): key for key, axis in axes.items()}
    return {name: key for name, key in meant.items() if name in lacking}


def _x_north(columns: Mapping[str, Sequence], known: Mapping[str, str], axes: Mapping[str, NamedAxis],
             by_order: Mapping[bool, Mapping[str, str]], aliases: Mapping[str, str], name: str,
             judge: Callable | None) -> bool:
    """Whether X counts north: by the names, by the numbers, by what the reader knows besides."""
    sure = {other: columns[known[meant]] for other, meant in aliases.items() if other[-1] in "東北" and meant in known}
    order = stated_order(axes)
    if order is None and len({axis.x_north for axis in axes.values()} - {None}) < 2:
        order = order_of_numbers(axes, columns, sure)
        if order is None and judge is not None:
            order = judge({x_north: {**known, **meant} for x_north, meant in by_order.items()})
    if order is None:
        raise PreviewNeeded(say(
            "{name}: {columns} may count north or east (in the Japanese plane rectangular system X counts north): "
            "read it by “Import table…” in the menu UrbanMap, which shows the columns, or call the one that counts "
            "east “東” or “east”, and the one that counts north “北” or “north”.", name=name,
            columns=", ".join(map(str, axes))))
    return order


def _require_plane(columns: Collection[str], lacking: Collection[str], name: str) -> None:
    """Refuse places in degrees where plane coordinates are lacking."""
    degrees = [str(key) for key in columns if plain_name(key) in (*LATITUDE, *LONGITUDE)]
    if degrees and {"x", "y"} <= set(lacking):
        raise PreviewNeeded(say(
            "{name} has its places in latitude and longitude ({columns}): read it by “Import table…” in the menu "
            "UrbanMap, which lays them into the plane reference system of the survey.", name=name,
            columns=", ".join(degrees)))


def number_table(columns: Mapping[str, Sequence], known: Mapping[str, str], wanted: Sequence[str],
                 name: str) -> np.ndarray:
    """Numbers (rows, columns) of some columns, in the order wanted; `known` is what `known_columns` gave.

    Raises
    ------
    InputError : a value is no number.
    """
    return np.array([numbers_of(columns[known[column]], known[column], name) for column in wanted]).T


def numbers_of(values: Sequence, column: str, name: str, first: int = 2, may_lack: bool = False) -> np.ndarray:
    """Values (n,) of a column as numbers; NaN where it is empty and may be so (`may_lack`).

    `first` : what the first row is called, 2 below the names of a file's columns.

    Raises
    ------
    InputError : a value is no number; it names row and column.
    """
    given = [_if_there(value) for value in values] if may_lack else values
    try:
        return np.asarray(given, float)
    except (OverflowError, TypeError, ValueError) as error:
        row = next((row for row, value in enumerate(given) if not _is_number(value)), 0)
        raise InputError(say("{name}: “{text}” in row {row} of the column {column} is no number: correct or remove it.",
                             name=name, text=str(values[row])[:40], row=row + first, column=column)) from error


def _if_there(value: object) -> object:
    """The value, NaN where it is empty."""
    empty = value is None or (isinstance(value, str) and not value.strip())
    return math.nan if empty or str(value) == "NULL" else value


def meanings(keys: Iterable[str], needed: Iterable[str], aliases: Mapping[str, str],
             x_north: bool | None = None) -> dict[str, str]:
    """The needed column that each key stands for, where it stands for one; other names give way to the name itself.

    X and Y of Japanese tables (`plan_axes`) count where it is said whether X is the one that counts north.
    """
    keys = list(keys)
    axes = named_axes(keys) if x_north is not None else {}
    wanted = {plain_name(key): key for key in needed}
    exact = {meant: key for key in keys if key not in axes and (meant := str(key).strip().lower()) in wanted.values()}
    found = {}
    for key in keys:
        plain = axes[key].counts(x_north) if key in axes else plain_name(key)
        meant = wanted.get(plain) or aliases.get(plain)
        if meant and exact.get(meant, key) == key:
            found[key] = meant
    return found


def named_rows(text: str, needed: Sequence[str], aliases: Mapping[str, str], name: str,
               stated_units: Collection[str] = ()) -> tuple[tuple[str, ...], list[list[str]], str]:
    """Names of the columns, rows and delimiter of the names in a table with the columns `needed`.

    Names may stand behind a "#", further lines of that kind are passed over; rows may have another delimiter. Where
    no line names them all, the first line is taken for the names.

    Parameters
    ----------
    told : other units that the user said the file has, such as "radians", so that they are right.

    Raises
    ------
    InputError : a unit is stated that is not metres, seconds or degrees.
    """
    lines = [line for line in text.splitlines() if line.strip()]
    at, delimiter = _head(lines, needed, aliases)
    header = tuple(item.strip() for item in _cells([_COMMENT.sub("", lines[at]), *lines[at + 1:at + 4]], delimiter)[0]
                   ) if lines else ()
    lines = [*lines[:at + 1], *(line for line in lines[at + 1:] if not _COMMENT.match(line))]
    rows = _with_points(_rows(lines[at + 1:], delimiter, len(header)))
    units = 0
    while units < min(len(rows), 3) and not any(_is_number(cell) for cell in rows[units]):
        units += 1
    units = units if units < len(rows) else 0
    cells = (cell for line in lines[at + 1:at + 1 + units] for cell in line.split())
    _check_units([*header, *cells], name, stated_units)
    return header, rows[units:], delimiter


def table_columns(path: str | os.PathLike, needed: Sequence[str], aliases: Mapping[str, str],
                  what: str) -> dict[str, list[str | None]]:
    """The columns of a table of text by name, as `named_rows` finds them; None where a row is too short.

    Raises
    ------
    InputError : it is no text, or a unit is stated that is not read; `what` it was read as.
    """
    name = Path(path).name
    header, rows, _ = named_rows(read_text(path, what), needed, aliases, name)
    return {key: [row[place] if place < len(row) else None for row in rows] for place, key in enumerate(header) if key}


def _rows(lines: Sequence[str], delimiter: str, width: int) -> list[list[str]]:
    """The rows by the delimiter of the names, or by another one where only that gives as many values."""
    for other in (delimiter, *DELIMITERS[::-1]) if delimiter != " " else (" ", *DELIMITERS):
        rows = [row for row in _cells(lines, other) if any(cell.strip() for cell in row)]
        if any(len(row) == width for row in rows[:3]):
            return rows
    return [row for row in _cells(lines, delimiter) if any(cell.strip() for cell in row)]


def _with_points(rows: list[list[str]]) -> list[list[str]]:
    """Rows with decimal points, where all decimal numbers have commas ("361400,25"), as much of Europe writes them."""
    cells = {cell for row in rows for cell in row}
    if not any(map(_WITH_COMMA.match, cells)) or any("." in cell and WRITTEN_NUMBER.match(cell) for cell in cells):
        return rows
    return [[cell.replace(",", ".") if _WITH_COMMA.match(cell) else cell for cell in row] for row in rows]


def _head(lines: Sequence[str], needed: Sequence[str], aliases: Mapping[str, str]) -> tuple[int, str]:
    """Number of the line with the names, and their delimiter; that of the first line where none has all."""
    wanted = {plain_name(key) for key in needed}
    for number, line in enumerate(lines[:_HEAD_LINES]):
        for delimiter in DELIMITERS:
            cells = _cells([_COMMENT.sub("", line), *lines[number + 1:number + 4]], delimiter)[0]
            axes = named_axes(cells)
            plain = [axes[cell].counts(True) if cell in axes else plain_name(cell) for cell in cells]
            if {plain_name(aliases.get(cell, cell)) for cell in plain} >= wanted:
                return number, delimiter
    first = lines[0] if lines else ""
    delimiter = max(DELIMITERS, key=first.count)
    if delimiter == " " or first.count(delimiter) < len(needed) - 1:
        delimiter = "," if first.count(",") else delimiter
    return 0, delimiter


def _cells(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    if delimiter == " ":
        return split_blanks(lines)
    return list(csv.reader(lines, delimiter=delimiter, skipinitialspace=True))


def split_blanks(lines: Sequence[str]) -> list[list[str]]:
    """Cells between blanks; in the first line names with a blank of their own ("ELLIPSOID HEIGHT") stay whole.

    They do where the lines behind it have as many cells as there are names with more than one blank between them, or
    four more: minutes and seconds of latitude and longitude.
    """
    rows = [line.split() for line in lines]
    if not rows:
        return rows
    wide = [cell for cell in re.split(r"\s{2,}|\t", lines[0].strip()) if cell]
    widths = {len(row) - more for row in rows[1:4] for more in (0, 4)}
    if len(wide) < len(rows[0]) and len(wide) in widths and len(rows[0]) not in widths:
        rows[0] = wide
    return rows


def _is_number(cell: object) -> bool:
    try:
        float(cell)
    except (OverflowError, TypeError, ValueError):
        return False
    return True


def _check_units(cells: Iterable[str], name: str, stated_units: Collection[str]) -> None:
    """Refuse units in brackets, or alone in a cell, that are others than the ones read."""
    for cell in cells:
        text = unicodedata.normalize("NFKC", cell)
        for part in [*(found.group()[1:-1] for found in _BRACKETS.finditer(text)), text]:
            other = _OTHER_UNITS.get(re.sub(r"[\s\-_.,()]+", "", part).lower())
            if other and other not in stated_units:
                raise InputError(say("{name} states the unit {unit}: metres, seconds and decimal degrees are read; "
                                     "export it in these.", name=name, unit=part.strip(" ,()")))
