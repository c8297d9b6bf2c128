"""Exterior orientations in files: the project's own tables, and those that Metashape, Pix4D and others write."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.columns import EAST, IMAGE_NAMES, NORTH, UP, Column, aliases_of, names_of
from ...io.files.guard import first_not_finite, read_text, reads
from ...io.files.named_table import known_columns, named_rows, plain_name
from ...wording import say
from .camera import ExteriorOrientation, angles_from_usual_order

EXTERIOR = (
    Column("image", "", ("name", "frame", "event", "eventname", "station", "stationname", "feature", *IMAGE_NAMES)),
    Column("x", "m", (*EAST.others, "x/easting", "x/east")), Column("y", "m", (*NORTH.others, "y/northing", "y/north")),
    Column("z", "m", (*UP.others, "z/altitude", "z/height")),
    Column("omega", "degrees", ("ω", "omegadeg", "オメガ")), Column("phi", "degrees", ("φ", "phideg", "ファイ")),
    Column("kappa", "degrees", ("κ", "kappadeg", "カッパ")))
"""Metashape calls the image PhotoID, or Label and the place X/Easting and so on; Pix4D imageName."""

COLUMNS, _ALIASES = names_of(EXTERIOR), aliases_of(EXTERIOR)

UNITS = {"automatic": 1.0, "degrees": 1.0, "gon": 0.9, "radians": math.degrees(1.0)}
"""Degrees of one unit of the angles."""

_PROGRAMS = ("photoid", "imagename", "x/easting", "x/east")
"""Columns of files of programs (Metashape, Pix4D) whose order of the angles is the usual one."""

_MATRIX = tuple(f"r{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))
"""Columns of the rotation from world to camera, which Metashape writes beside the angles."""

_SAME = 1e-3  # of an element of a rotation that is written with some digits


@reads("an exterior orientation")
def read_exterior(path: str | os.PathLike, unit: str = "automatic", order: str = "papers") -> list[ExteriorOrientation]:
    """Poses of a table with the columns of `EXTERIOR`, in any order and with what other programs call them.

    Parameters
    ----------
    unit : of the angles: "degrees", "gon", "radians", or "automatic": degrees, and an error where they look otherwise.
    order : "papers" for R_omega R_phi R_kappa (J eq. 1), "usual" for R_kappa R_phi R_omega, which is converted. What a
        file says itself goes before it (`stated_rotations`).

    Raises
    ------
    InputError : a column is missing or could be several ones, a value is no number, an image comes twice, the angles
        are not degrees, or a rotation matrix in the file contradicts them.
    """
    path = Path(path)
    if unit not in UNITS or order not in ("papers", "usual"):
        raise InputError(say("The angles are in degrees, gon or radians and in the order papers or usual, not {unit} "
                             "and {order}.", unit=unit, order=order))
    columns, known = _columns(path, unit)
    names, numbers = _exterior_rows(columns, known, path)
    if unit == "automatic":
        _require_degrees(numbers[:, 3:], path)
    numbers[:, 3:] *= UNITS[unit]
    poses = _poses(names, numbers, stated_rotations(columns, known, numbers) or order)
    _compare_matrices(columns, poses, path)
    return poses


def _poses(names: Sequence[str], numbers: np.ndarray, order: str) -> list[ExteriorOrientation]:
    """Poses of rows (n, 6) x, y, z, omega, phi, kappa in degrees of one of the orders."""
    return [ExteriorOrientation(name, *row[:3], *(angles_from_usual_order(*row[3:]) if order == "usual" else row[3:]))
            for name, row in zip(names, numbers.tolist())]


def stated_rotations(columns: Mapping[str, Sequence[str]], known: Mapping[str, str], numbers: np.ndarray) -> str:
    """Order of the rotations that a table says itself, "" where it says none.

    The names of Metashape's and Pix4D's columns say the usual one, by what these programs document; of other tables
    rotation matrices beside the angles say it, if one order fits them better.

    Parameters
    ----------
    columns : the file's columns by name.
    known : which of them is which of `COLUMNS`.
    numbers : (n, 6) x, y, z and the angles in degrees.
    """
    if any(plain_name(known[name]) in _PROGRAMS for name in ("image", "x")):
        return "usual"
    matrices = _matrices(columns)
    if matrices is None:
        return ""
    images = [str(number) for number in range(len(numbers))]
    off = {order: _off_matrices(matrices, _poses(images, numbers, order)).max() for order in ("papers", "usual")}
    best = min(off, key=lambda order: off[order])
    return best if off[best] < _SAME and off[best] < 0.5 * max(off.values()) else ""


def _columns(path: Path, unit: str) -> tuple[Mapping[str, Sequence[str]], Mapping[str, str]]:
    """The file's columns, and which of them stands for which of `COLUMNS`."""
    stated_units = (unit,) if unit in ("gon", "radians") else ()
    header, rows, _ = named_rows(read_text(path, "an exterior orientation (CSV)"), COLUMNS, _ALIASES, path.name,
                                 stated_units)
    columns = {name: [row[place].strip() if place < len(row) else "" for row in rows]
               for place, name in enumerate(header) if name}
    known = known_columns(columns, COLUMNS, _ALIASES, path.name)
    missing = [name for name in COLUMNS if name not in known]
    if missing:
        raise InputError(say("{path} has no column {missing}: an exterior orientation needs {columns}.",
                             path=path.name, missing=", ".join(missing), columns=",".join(COLUMNS)))
    return columns, known


def _exterior_rows(columns: Mapping[str, Sequence[str]], known: Mapping[str, str],
                   path: Path) -> tuple[list[str], np.ndarray]:
    """Image names and (n, 6) x, y, z, omega, phi, kappa as they stand in the file."""
    names, numbers = list(columns[known["image"]]), []
    for number, name in enumerate(names):
        if not name or name in names[:number]:
            raise InputError(say("Row {row} of {path} names no image or one that came before: each image needs one "
                                 "row.", row=number + 1, path=path.name))
        try:
            numbers.append([float(columns[known[column]][number]) for column in COLUMNS[1:]])
        except ValueError as error:
            raise InputError(say("Row {row} of {path} ({name}) must hold numbers in x, y, z, omega, phi, kappa.",
                                 row=number + 1, path=path.name, name=name)) from error
    if not names:
        raise InputError(say("{path} lists no image.", path=path.name))
    table = np.array(numbers)
    bad = first_not_finite(table)
    if bad is not None:
        raise InputError(say("{path} holds a value that is not a number for {names}: correct it.", path=path.name,
                             names=names[bad]))
    return names, table


def _matrices(columns: Mapping[str, Sequence[str]]) -> np.ndarray | None:
    """Rotations (n, 3, 3) that a table has beside the angles, None where it has none."""
    given = {plain_name(name): values for name, values in columns.items()}
    if not all(name in given for name in _MATRIX):
        return None
    return np.array([[float(value) for value in given[name]] for name in _MATRIX]).T.reshape(-1, 3, 3)


def _off_matrices(matrices: np.ndarray, poses: Sequence[ExteriorOrientation]) -> np.ndarray:
    """Largest difference (n,) of an element between matrices, either way round, and the rotations of poses."""
    rotations = np.array([pose.rotation for pose in poses])
    return np.minimum(*(np.abs(given - rotations).max(axis=(1, 2))
                        for given in (matrices, matrices.transpose(0, 2, 1))))


def _compare_matrices(columns: Mapping[str, Sequence[str]], poses: Sequence[ExteriorOrientation], path: Path) -> None:
    """Hold the rotations of the angles against those that the file has beside them."""
    matrices = _matrices(columns)
    if matrices is None:
        return
    for pose, off in zip(poses, _off_matrices(matrices, poses)):
        if off > _SAME:
            raise InputError(say("{path}: the rotation matrix of {image} contradicts its omega, phi and kappa: export "
                                 "it again, or say the order and the unit of the angles.", path=path.name,
                                 image=pose.image))


def angle_unit(angles: np.ndarray) -> str:
    """Unit that angles (n, 3) omega, phi, kappa are in by their looks: a key of `UNITS`."""
    return _looks_like(angles) or "degrees"


def _require_degrees(angles: np.ndarray, path: Path) -> None:
    """Refuse angles (n, 3) that are gon or radians by their looks."""
    guess = _looks_like(angles)
    if guess:
        raise InputError(say("The angles in {path} look like {guess}: convert them to degrees, or say their unit if "
                             "you know it.", path=path.name, guess=guess))


def _looks_like(angles: np.ndarray) -> str:
    """"gon", "radians" or "" (degrees), from the habits of flights: level, in strips to and fro or crosswise.

    Gon: beyond 360, or headings at the whole hundreds of at least two directions. Radians: all within one turn of
    2 pi, and either almost no tilt at all with a large heading, or headings at whole right angles of at least two
    directions in three frames or more.
    """
    tilt, kappa = np.abs(angles[:, :2]), angles[:, 2]
    if np.abs(angles).max() > 360:
        return "gon"
    if _in_steps(kappa, 100, 5) and np.ptp(np.abs(kappa)) > 50 and not _in_steps(kappa, 90, 5):
        return "gon"
    if np.abs(angles).max() <= 2 * math.pi and np.abs(kappa).max() > 1:
        if 0 < tilt.max() < 0.15:
            return "radians"
        steps = np.unique(np.round(kappa / (math.pi / 2)))
        if len(kappa) >= 3 and len(steps) >= 2 and _in_steps(kappa, math.pi / 2, 0.15):
            return "radians"
    return ""


def _in_steps(angles: np.ndarray, step: float, tolerance: float) -> bool:
    """Whether every angle lies within the tolerance of a multiple of the step."""
    return bool((np.abs(angles - step * np.round(angles / step)) <= tolerance).all())
