"""Poses of images of a mobile survey: tables `id,time,x,y,z,roll,pitch,heading`."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.columns import aliases_of, names_of
from ..io.files.guard import first_not_finite, read_text, reads
from ..io.files.named_table import known_columns, named_rows, number_table
from ..wording import say
from .survey_columns import IMAGE_POSES
from .trajectory import Trajectory, attitude_angles, interpolate, rotations, unwrapped
from .trajectory_reading import from_file_angles, to_file_angles

COLUMNS, _ALIASES = names_of(IMAGE_POSES), aliases_of(IMAGE_POSES)

_TURN = 2.0 * np.pi + 0.01  # radians; no angle is more
_STEP = 1.0  # m between images from which they tell the direction of travel
_TURNED = 45.0  # degrees that a vehicle turns with headings that change as much


@dataclass(frozen=True)
class ImagePoses:
    """Poses of n images; a row may have further columns, which are kept.

    Attributes
    ----------
    id : (n,) names.
    time : (n,) s.
    place : (n, 3) of the camera, m.
    angles : (n, 3) roll, pitch, heading, degrees.
    others : further columns by name.
    counted : how the file counts the angles, one of `trajectory_reading.ANGLES`; they are written so again.
    """

    id: tuple[str, ...]
    time: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    others: dict[str, tuple[str, ...]]
    counted: str = "degrees"


@reads("image poses")
def read_image_poses(path: str | os.PathLike, counted: str = "degrees") -> ImagePoses:
    """Read image poses: a table with the columns `COLUMNS`, or what other programs call them (`IMAGE_POSES`).

    Parameters
    ----------
    counted : how the angles are counted, one of `trajectory_reading.ANGLES`.

    Raises
    ------
    InputError : a column is missing or could be several ones, a value is no number, or degrees look like radians.
    """
    name = Path(path).name
    stated_units = ("radians",) if counted.startswith("radians") else ()
    header, rows, _ = named_rows(read_text(path, "image poses (CSV)"), COLUMNS, _ALIASES, name, stated_units)
    ragged = next((number for number, row in enumerate(rows, 2) if len(row) != len(header)), None)
    if ragged:
        raise InputError(say("{path}: row {ragged} has {rows_count} values, the header names {header_count}: the "
                             "file may be cut off; export it again.", path=name, ragged=ragged,
                             rows_count=len(rows[ragged - 2]), header_count=len(header)))
    columns = dict(zip(header, zip(*rows)))
    known = known_columns(columns, COLUMNS, _ALIASES, name)
    missing = [column for column in COLUMNS if column not in known]
    if missing:
        raise InputError(say("{name} has no column {missing} or no row: image poses need {columns}.", name=name,
                             missing=", ".join(missing), columns=",".join(COLUMNS)))
    table = number_table(columns, known, COLUMNS[1:], name)
    bad = first_not_finite(table)
    if bad is not None:
        raise InputError(say("{name} has no number in row {bad}: correct or remove it.", name=name, bad=bad + 2))
    _refuse_radians(table, counted, name)
    others = {key: values for key, values in columns.items() if key and key not in known.values()}
    return ImagePoses(tuple(columns[known["id"]]), table[:, 0], table[:, 1:4],
                      unwrapped(from_file_angles(table[:, 4:7], counted)), others, counted)


def _refuse_radians(table: np.ndarray, counted: str, name: str) -> None:
    """Refuse angles said to be in degrees that all lie within a turn in radians while the vehicle turned far more."""
    if counted.startswith("radians") or np.abs(table[:, 4:7]).max() > _TURN:
        return
    x, y = table[np.argsort(table[:, 0], kind="stable"), 1:3].T
    far = np.hypot(np.diff(x), np.diff(y)) > _STEP
    course = np.unwrap(np.arctan2(np.diff(x)[far], np.diff(y)[far]))
    if len(course) > 1 and np.degrees(np.ptp(course)) > _TURNED:
        raise InputError(say("{name}: all angles are below {turn:.1f} although the images look in many directions: "
                             "they are radians; say that the angles are counted so, or export degrees.", name=name,
                             turn=_TURN))


def write_image_poses(path: str | os.PathLike, poses: ImagePoses) -> None:
    """Write image poses; the file appears when it is whole."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*COLUMNS, *poses.others])
    angles = np.column_stack([(poses.angles[:, :2] + 180.0) % 360.0 - 180.0, poses.angles[:, 2] % 360.0])
    if poses.counted != "degrees":
        angles = to_file_angles(angles, poses.counted)
    digits = 8 if poses.counted.startswith("radians") else 6
    for row, name in enumerate(poses.id):
        writer.writerow([name, f"{poses.time[row]:.4f}", *(f"{value:.4f}" for value in poses.place[row]),
                         *(f"{value:.{digits}f}" for value in angles[row]),
                         *(values[row] for values in poses.others.values())])
    with written_beside(path) as temporary:
        temporary.write_text(out.getvalue(), encoding="utf-8")


def move_images(poses: ImagePoses, reported: Trajectory, corrected: Trajectory) -> ImagePoses:
    """The poses as the corrected trajectory gives them: T_corrected T_reported^-1 at each image's time.

    Raises
    ------
    InputError : an image was taken outside a trajectory's time.
    """
    before, after = interpolate(reported, poses.time), interpolate(corrected, poses.time)
    rotation = rotations(after.angles) @ np.swapaxes(rotations(before.angles), 1, 2)
    place = after.place + np.einsum("nij,nj->ni", rotation, poses.place - before.place)
    angles = attitude_angles(rotation @ rotations(poses.angles))
    return replace(poses, place=place, angles=angles)
