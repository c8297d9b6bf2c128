"""Poses of images of a mobile survey: CSV `id,time,x,y,z,roll,pitch,heading`."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.guard import first_not_finite, read_text, reads
from ..wording import say
from .trajectory import Trajectory, attitude_angles, interpolate, rotations, unwrapped

COLUMNS = ("id", "time", "x", "y", "z", "roll", "pitch", "heading")


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
    """

    id: tuple[str, ...]
    time: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    others: dict[str, tuple[str, ...]]


@reads("image poses")
def read_image_poses(path: str | os.PathLike) -> ImagePoses:
    """Read image poses.

    Raises
    ------
    InputError : a column is missing, or a value is no number.
    """
    name = Path(path).name
    rows = list(csv.DictReader(io.StringIO(read_text(path, "image poses (CSV)"))))
    missing = [column for column in COLUMNS if not rows or column not in rows[0]]
    if missing:
        raise InputError(say("{name} has no column {missing} or no row: image poses need {columns}.", name=name,
                             missing=", ".join(missing), columns=",".join(COLUMNS)))
    try:
        table = np.array([[float(row[column]) for column in COLUMNS[1:]] for row in rows])
    except (TypeError, ValueError) as error:
        raise InputError(say("{name} holds a value that is no number ({error}): correct it.", name=name,
                             error=error)) from error
    bad = first_not_finite(table)
    if bad is not None:
        raise InputError(say("{name} has no number in row {bad}: correct or remove it.", name=name, bad=bad + 2))
    others = {key: tuple(row[key] for row in rows) for key in rows[0] if key and key not in COLUMNS}
    return ImagePoses(tuple(row["id"] for row in rows), table[:, 0], table[:, 1:4], unwrapped(table[:, 4:7]), others)


def write_image_poses(path: str | os.PathLike, poses: ImagePoses) -> None:
    """Write image poses; the file appears when it is whole."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*COLUMNS, *poses.others])
    angles = np.column_stack([(poses.angles[:, :2] + 180.0) % 360.0 - 180.0, poses.angles[:, 2] % 360.0])
    for row, name in enumerate(poses.id):
        writer.writerow([name, f"{poses.time[row]:.4f}", *(f"{value:.4f}" for value in poses.place[row]),
                         *(f"{value:.6f}" for value in angles[row]),
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
    return ImagePoses(poses.id, poses.time, place, angles, poses.others)
