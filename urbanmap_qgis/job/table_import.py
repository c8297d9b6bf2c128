"""Tables of other programs made into the project's own: trajectories, orientations, poses, points, as the user tells.

What he tells (encoding, delimiter, lines before the names, which column is which, units and the way angles are counted)
is kept under a name. The readers of the project check what comes out.
"""

from __future__ import annotations

import csv
import io
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.conversion.geoid import read_geoid
from ..io.files.atomic import written_beside
from ..io.files.columns import needed_of
from ..io.files.guard import read_json, reads
from ..io.files.named_table import WRITTEN_NUMBER, plain_name, split_blanks
from ..wording import say
from .table_places import LATITUDE, LONGITUDE, POLAR, POLAR_ALIASES, degrees_of, placed_in, suggested_crs
from .table_targets import TABLES, TARGETS, write_checked

ENCODINGS = ("utf-8-sig", "cp932", "utf-16")
LENGTHS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}
"""Metres of one unit of coordinates and heights."""

HEIGHTS = ("", "ellipsoidal", "sea level")
"""What heights count from; "": not said."""

NORTHS = ("true", "grid")
"""From which north headings and kappas count where places are latitudes and longitudes."""

_TEXTS = ("image", "id", "set", "point", "role")
MOST_BEFORE = 200
"""Lines looked through for names and first numbers."""


@dataclass(frozen=True)
class TableImport:
    """How a table is read.

    Attributes
    ----------
    target : a key of `TARGETS`.
    encoding, delimiter : of the file; a blank stands for any number of them.
    skip : lines before the one with the names.
    columns : number of the file's column, from 0, by the name needed.
        Places as latitude and longitude have the columns of `POLAR` in place of x and y.
    angles : one of `ANGLE_WAYS` of the target.
    length : a key of `LENGTHS`.
    crs : plane system (a code) into which latitudes and longitudes go; "" that of their place (`suggested_crs`).
    heights : one of `HEIGHTS`.
    geoid : file of a geoid model by which ellipsoidal heights become those above sea
        level; "" leaves them as they are.
    north : one of `NORTHS`.
    """

    target: str
    encoding: str = ENCODINGS[0]
    delimiter: str = ","
    skip: int = 0
    columns: Mapping[str, int] = field(default_factory=dict)
    angles: str = ""
    length: str = "m"
    crs: str = ""
    heights: str = ""
    geoid: str = ""
    north: str = NORTHS[0]

    @property
    def polar(self) -> bool:
        """Whether places are latitudes and longitudes."""
        return ({"x", "y"} <= set(TARGETS[self.target]) and not {"x", "y"} <= set(self.columns)
                and bool(set(self.columns) & {"latitude", "longitude"}))

    @property
    def needed(self) -> tuple[str, ...]:
        """Columns that must be chosen."""
        places = {"x": "longitude", "y": "latitude"} if self.polar else {}
        return tuple(places.get(name, name) for name in needed_of(TABLES[self.target]))

    @property
    def written(self) -> tuple[str, ...]:
        """Columns that the project's table gets: the needed ones, and of the others those that were chosen."""
        needed = needed_of(TABLES[self.target])
        return tuple(name for name in TARGETS[self.target] if name in needed or name in self.columns
                     or (self.polar and name in "xy"))


@reads("a table")
def split_table(path: str | os.PathLike, how: TableImport,
                limit: int | None = None) -> tuple[list[str], list[list[str]]]:
    """Names of the columns and the rows behind them (`limit` at most); names are numbers where a row of numbers stands.

    Raises
    ------
    InputError : the file is no text in this encoding, or too short.
    """
    lines = [line for line in Path(path).read_bytes().decode(how.encoding).splitlines() if line.strip()]
    lines = lines[how.skip:how.skip + limit + 1 if limit is not None else None]
    if not lines:
        raise InputError(say("{name} has no more than {skip} lines: leave fewer out.", name=Path(path).name,
                             skip=how.skip))
    cells = split_blanks(lines) if how.delimiter == " " else \
        list(csv.reader(lines, delimiter=how.delimiter, skipinitialspace=True))
    if len(cells[0]) == 1 < max(map(len, cells[1:4]), default=0):
        cells[0] = next(csv.reader(lines[:1], skipinitialspace=True))  # names with commas over values with tabs
    cells[0] = each_named(cells[0], max(map(len, cells[1:4]), default=0))
    if any(WRITTEN_NUMBER.match(cell.strip()) for cell in cells[0]):
        return [str(number) for number in range(1, len(cells[0]) + 1)], cells
    return [cell.strip() for cell in cells[0]], cells[1:]


def each_named(names: list[str], width: int) -> list[str]:
    """Names with minutes and seconds behind latitude and longitude, where rows have just so many values more."""
    names = [names[0].lstrip("# "), *names[1:]] if names else names  # "#Label", as Metashape comments its names
    polar = [POLAR_ALIASES.get(plain_name(name), plain_name(name)) for name in names]
    if width != len(names) + 4 or polar.count("latitude") != 1 or polar.count("longitude") != 1:
        return names
    columns = []
    for name, meant in zip(names, polar):
        columns += [name, f"{meant}_minutes", f"{meant}_seconds"] if meant in ("latitude", "longitude") else [name]
    return columns


def table_place(path: str | os.PathLike, how: TableImport) -> tuple[str, float, float] | None:
    """The plane system into which the first latitude and longitude go, and x and y (m) there; None for a table without.

    Of plane coordinates the system is "", and x and y are those of the first row.

    Raises
    ------
    InputError : no row holds them, or the system does not fit.
    """
    if {"x", "y"} <= set(how.columns):
        return _first_plane(path, how)
    if not how.polar or not {"latitude", "longitude"} <= set(how.columns):
        return None
    for row in split_table(path, how, MOST_BEFORE)[1]:
        found = _polar_of(row, how.columns)
        if None not in found:
            crs = how.crs or suggested_crs(*found)
            x, y, _ = placed_in(crs, *(np.array([value]) for value in found))
            return crs, float(x[0]), float(y[0])
    raise InputError(say("{name} has no latitude and longitude in the columns chosen: choose other columns.",
                         name=Path(path).name))


def _first_plane(path: str | os.PathLike, how: TableImport) -> tuple[str, float, float] | None:
    """"", x and y (m) of the first row that has both."""
    for row in split_table(path, how, MOST_BEFORE)[1]:
        cells = [row[how.columns[name]].strip() for name in "xy" if how.columns[name] < len(row)]
        if len(cells) == 2 and all(map(WRITTEN_NUMBER.match, cells)):
            x, y = (float(cell) * LENGTHS[how.length] for cell in cells)
            return "", x, y
    return None


def _polar_of(row: Sequence[str], columns: Mapping[str, int]) -> tuple[float | None, float | None]:
    """Longitude and latitude of a row, degrees; None where it has none."""
    longitude, latitude = (
        degrees_of([row[columns[name]] for name in names if name in columns and columns[name] < len(row)])
        for names in (LONGITUDE, LATITUDE))
    return longitude, latitude


def import_table(path: str | os.PathLike, how: TableImport, output: str | os.PathLike) -> tuple[str, ...]:
    """Write a table as the project's own file; notes of the reader come back.

    Raises
    ------
    InputError : a column is not chosen, a value is no number, or the readers refuse what comes out.
    """
    missing = [name for name in how.needed if name not in how.columns]
    if missing:
        raise InputError(say("No column is chosen for {missing}: choose one.", missing=", ".join(missing)))
    if how.polar and "z" in how.columns and not how.heights:
        raise InputError(say("Say what the heights count from: the ellipsoid, as GNSS measures them, or sea level."))
    name = Path(path).name
    rows = _chosen_values(split_table(path, how)[1], how, name)
    turn, notes = _placed_values(rows, how, name)
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / f"{Path(path).stem}.csv"
        plain.write_text(_plain_text(rows, how), encoding="utf-8")
        notes += write_checked(plain, how.target, how.angles, turn, output)
    return tuple(notes)


def _chosen_values(rows: list[list[str]], how: TableImport, name: str) -> list[dict[str, str]]:
    """The cells of the chosen columns by name, lengths in metres; a line of units is passed over."""
    numeric = [key for key in how.needed if key not in (*_TEXTS, *POLAR)]
    lengths = {column.name for column in TABLES[how.target] if column.unit == "m"}
    optional = how.polar and "latitude" not in how.needed
    chosen: list[dict[str, str]] = []
    for number, row in enumerate(rows, how.skip + 2):
        if max(how.columns.values()) >= len(row):
            raise InputError(say("{name}: row {number} has {count} values, fewer than the columns chosen: the "
                                 "delimiter may be another one, or the file is cut off.", name=name, number=number,
                                 count=len(row)))
        values = {key: row[column].strip() for key, column in how.columns.items()}
        polar: tuple = _polar_of(row, how.columns) if how.polar else ()
        if optional and not any(values[key] for key in POLAR if key in values):
            polar = ("", "")  # a point whose place is not known
        if not chosen and (None in polar or not all(WRITTEN_NUMBER.match(values[key]) for key in numeric)):
            continue  # a line of units, or a rule under the names
        if None in polar:
            raise InputError(say("{name}: row {number} has no latitude and longitude: correct or remove it.",
                                 name=name, number=number))
        values.update(zip(("x", "y"), (value and repr(value) for value in polar)))
        for key in (lengths & set(values)) - ({"x", "y"} if polar else set()):
            if how.length != "m" and WRITTEN_NUMBER.match(values[key]):
                values[key] = repr(float(np.float64(values[key]) * LENGTHS[how.length]))
        chosen.append(values)
    if not chosen:
        raise InputError(say("{name} has no row with numbers in the columns chosen: choose other columns, or another "
                             "delimiter.", name=name))
    return chosen


def _placed_values(rows: list[dict[str, str]], how: TableImport, name: str) -> tuple[np.ndarray, list[str]]:
    """Lay latitudes and longitudes in `rows` into the plane system, in place.

    Returns
    -------
    By how many degrees (n,) kappas count on (headings are turned here), and notes on what was done.
    """
    if not how.polar:
        return np.zeros(len(rows)), []
    turn = np.zeros(len(rows))
    known = np.array([bool(values["x"]) for values in rows])
    placed = [values for values in rows if values["x"]]
    if not placed:
        return turn, []
    longitude, latitude = (np.array([float(values[key]) for values in placed]) for key in ("x", "y"))
    crs = how.crs or suggested_crs(float(np.median(longitude)), float(np.median(latitude)))
    x, y, convergence = placed_in(crs, longitude, latitude)
    for values, *place in zip(placed, x.tolist(), y.tolist()):
        values.update(zip(("x", "y"), map(repr, place)))
    notes = [say("{name}: latitudes and longitudes were laid into {crs}.", name=name, crs=crs)]
    if how.heights == "ellipsoidal":
        notes.append(_lowered(placed, how, longitude, latitude, name))
    if how.north == "true":
        turn[known] = convergence
    if how.target in ("trajectory", "poses"):
        _turned(rows, how, turn)
    return turn, notes


def _lowered(rows: list[dict[str, str]], how: TableImport, longitude: np.ndarray, latitude: np.ndarray,
             name: str) -> str:
    """Lower ellipsoidal heights in `rows` by the geoid model where one is given; a sentence on the heights."""
    if not how.geoid:
        return say("{name}: heights stay above the ellipsoid: points and reference must have such heights too; "
                   "otherwise give a geoid model.", name=name)
    geoid = read_geoid(how.geoid)
    above = geoid.interpolate(longitude, latitude)
    for number, (values, more) in enumerate(zip(rows, above.tolist()), 1):
        if not values.get("z") and "z" not in how.needed:
            continue
        if not WRITTEN_NUMBER.match(values["z"]):
            raise InputError(say("{name}: the height of line {number} of the values is no number: correct or remove "
                                 "it.", name=name, number=number))
        values["z"] = repr(float(values["z"]) - more)
    return say("{name}: ellipsoidal heights were lowered by {min:.3f} to {max:.3f} m to heights above the geoid "
               "({geoid}).", name=name, min=above.min(), max=above.max(), geoid=geoid.name)


def _turned(rows: list[dict[str, str]], how: TableImport, turn: np.ndarray) -> None:
    """Let headings in `rows` count from grid north, in the file's own way of counting; `turn` (n,) in degrees."""
    steps = np.radians(turn) if how.angles.startswith("radians") else turn
    sign = 1.0 if how.angles.endswith("from_east") else -1.0
    for values, step in zip(rows, steps.tolist()):
        if WRITTEN_NUMBER.match(values["heading"]):  # the reader tells which is no number
            values["heading"] = repr(float(values["heading"]) + sign * step)


def _plain_text(rows: list[dict[str, str]], how: TableImport) -> str:
    """A table with the project's names."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(how.written)
    writer.writerows([values[key] for key in how.written] for values in rows)
    return text.getvalue()


def remembered_imports(path: str | os.PathLike) -> dict[str, TableImport]:
    """Ways of reading by the names under which they were kept; none where there is no file yet."""
    if not Path(path).is_file():
        return {}
    content = read_json(path, "ways of reading tables")
    fields = set(TableImport.__dataclass_fields__)
    try:
        return {str(name): TableImport(**{key: value for key, value in how.items() if key in fields})
                for name, how in content.items()}
    except (AttributeError, TypeError) as error:
        raise InputError(say("{name} holds no ways of reading tables: delete it.", name=Path(path).name)) from error


def remember_import(path: str | os.PathLike, name: str, how: TableImport) -> None:
    """Keep a way of reading under a name, beside those kept before."""
    imports = {**remembered_imports(path), name: how}
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with written_beside(path) as temporary:
        temporary.write_text(json.dumps({key: asdict(value) for key, value in imports.items()}, indent=1,
                                        ensure_ascii=False), encoding="utf-8")

