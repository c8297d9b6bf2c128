"""Tables of other programs made into the project's own trajectories and exterior orientations, as the user tells.

What he tells (encoding, delimiter, lines before the names, which column is which, units and the way angles are counted)
is kept under a name. The readers of the project check what comes out.
"""

from __future__ import annotations

import csv
import io
import json
import os
import tempfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np

from ..aerial.frames.exterior_files import COLUMNS as EXTERIOR_COLUMNS
from ..aerial.frames.exterior_files import EXTERIOR, read_exterior
from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.columns import aliases_of
from ..io.files.guard import read_json, reads
from ..io.files.named_table import DELIMITERS, WRITTEN_NUMBER, meanings
from ..mobile.trajectory_files import COLUMNS as TRAJECTORY_COLUMNS
from ..mobile.trajectory_files import TRAJECTORY, read_trajectory, write_trajectory
from ..mobile.trajectory_reading import ANGLES, TrajectoryReading
from ..wording import say

TARGETS = {"trajectory": TRAJECTORY_COLUMNS, "exterior": EXTERIOR_COLUMNS}
"""What a table is made into, with the columns that it needs."""

ENCODINGS = ("utf-8-sig", "cp932", "utf-16")
LENGTHS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}
"""Metres of one unit of coordinates and heights."""

ANGLE_WAYS = {"trajectory": ANGLES, "exterior": tuple(f"{unit} {order}" for order in ("papers", "usual")
                                                      for unit in ("degrees", "gon", "radians"))}
"""Ways in which angles are counted, the first the project's own; of frames with the order of the rotations."""

_ALIASES = {"trajectory": aliases_of(TRAJECTORY), "exterior": aliases_of(EXTERIOR)}
_MOST_BEFORE = 200


@dataclass(frozen=True)
class TableImport:
    """How a table is read.

    Attributes
    ----------
    target : a key of `TARGETS`.
    encoding, delimiter : of the file; a blank stands for any number of them.
    skip : lines before the one with the names.
    columns : number of the file's column, from 0, by the name needed.
    angles : one of `ANGLE_WAYS` of the target. length : a key of `LENGTHS`.
    """

    target: str
    encoding: str = ENCODINGS[0]
    delimiter: str = ","
    skip: int = 0
    columns: Mapping[str, int] = field(default_factory=dict)
    angles: str = ""
    length: str = "m"


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
    cells = [line.split() for line in lines] if how.delimiter == " " else \
        list(csv.reader(lines, delimiter=how.delimiter, skipinitialspace=True))
    if any(WRITTEN_NUMBER.match(cell.strip()) for cell in cells[0]):
        return [str(number) for number in range(1, len(cells[0]) + 1)], cells
    return [cell.strip() for cell in cells[0]], cells[1:]


def guessed_import(path: str | os.PathLike, target: str) -> TableImport:
    """How a table may be read, by its bytes and the names of its columns; what is not found is left out."""
    data = Path(path).read_bytes()
    encoding = next((name for name in ENCODINGS if _decodes(data, name)), ENCODINGS[0])
    best = TableImport(target, encoding, angles=ANGLE_WAYS[target][0])
    lines = [line for line in data.decode(encoding, "replace").splitlines() if line.strip()][:_MOST_BEFORE]
    for skip, line in enumerate(lines):
        for delimiter in DELIMITERS:
            cells = line.split() if delimiter == " " else next(csv.reader([line], delimiter=delimiter), [])
            known = meanings([cell.strip() for cell in cells], TARGETS[target], _ALIASES[target])
            names = [cell.strip() for cell in cells]
            found = {meant: names.index(key) for key, meant in known.items()}
            if len(found) > len(best.columns):
                best = TableImport(target, encoding, delimiter, skip, found, ANGLE_WAYS[target][0])
    return best


def _decodes(data: bytes, encoding: str) -> bool:
    if encoding == "utf-16" and not data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return False
    try:
        data.decode(encoding)
    except UnicodeError:
        return False
    return True


def import_table(path: str | os.PathLike, how: TableImport, output: str | os.PathLike) -> tuple[str, ...]:
    """Write a table as the project's own file; notes of the reader come back.

    Raises
    ------
    InputError : a column is not chosen, a value is no number, or the readers refuse what comes out.
    """
    missing = [name for name in TARGETS[how.target] if name not in how.columns]
    if missing:
        raise InputError(say("No column is chosen for {missing}: choose one.", missing=", ".join(missing)))
    _, rows = split_table(path, how)
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / f"{Path(path).stem}.csv"
        plain.write_text(_plain_text(rows, how, Path(path).name), encoding="utf-8")
        if how.target == "trajectory":
            file = read_trajectory(plain, reading=TrajectoryReading(how.angles))
            write_trajectory(output, replace(file, reading=TrajectoryReading()), file.trajectory)
            return file.notes
        unit, order = how.angles.split(" ")
        poses = read_exterior(plain, unit, order)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(EXTERIOR_COLUMNS)
    writer.writerows([pose.image, *(f"{value:.4f}" for value in (pose.x, pose.y, pose.z)),
                      *(f"{value:.6f}" for value in (pose.omega, pose.phi, pose.kappa))] for pose in poses)
    with written_beside(output) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")
    return ()


def _plain_text(rows: list[list[str]], how: TableImport, name: str) -> str:
    """The chosen columns as a table with the project's names, lengths in metres; a line of units is passed over."""
    numeric = [key for key in TARGETS[how.target] if key != "image"]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(TARGETS[how.target])
    begun = False
    for number, row in enumerate(rows, how.skip + 2):
        if max(how.columns.values()) >= len(row):
            raise InputError(say("{name}: row {number} has {count} values, fewer than the columns chosen: the "
                                 "delimiter may be another one, or the file is cut off.", name=name, number=number,
                                 count=len(row)))
        values = {key: row[column].strip() for key, column in how.columns.items()}
        if not begun and not all(WRITTEN_NUMBER.match(values[key]) for key in numeric):
            continue  # a line of units, or a rule under the names
        begun = True
        for key in ("x", "y", "z"):
            if how.length != "m" and WRITTEN_NUMBER.match(values[key]):
                values[key] = repr(float(np.float64(values[key]) * LENGTHS[how.length]))
        writer.writerow([values[key] for key in TARGETS[how.target]])
    if not begun:
        raise InputError(say("{name} has no row with numbers in the columns chosen: choose other columns, or another "
                             "delimiter.", name=name))
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
    kept = {**remembered_imports(path), name: how}
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with written_beside(path) as temporary:
        temporary.write_text(json.dumps({key: asdict(value) for key, value in kept.items()}, indent=1,
                                        ensure_ascii=False), encoding="utf-8")

