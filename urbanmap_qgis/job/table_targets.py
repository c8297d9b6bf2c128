"""What tables of other programs are made into: the project's tables, by their columns and readers."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..aerial.frames.camera import ExteriorOrientation
from ..aerial.frames.exterior_files import COLUMNS as EXTERIOR_COLUMNS
from ..aerial.frames.exterior_files import EXTERIOR, read_exterior
from ..aerial.orientation.cloud_points import CLOUD_POINTS, read_cloud_points
from ..aerial.orientation.image_points import IMAGE_POINTS, read_image_points
from ..io.files.atomic import written_beside
from ..io.files.columns import Column, aliases_of, names_of
from ..mobile.control import read_control
from ..mobile.image_poses import read_image_poses, write_image_poses
from ..mobile.lines.tie_points import read_tie_points
from ..mobile.survey_columns import CONTROL, IMAGE_POSES, TIE_POINTS
from ..mobile.trajectory_files import TRAJECTORY, read_trajectory, write_trajectory
from ..mobile.trajectory_reading import ANGLES, TrajectoryReading
from .table_places import POLAR_ALIASES

_ROLE = Column("role", "", ("use", "役割", "区分"), needed=False)
TABLES: Mapping[str, tuple[Column, ...]] = {
    "trajectory": TRAJECTORY, "exterior": EXTERIOR, "poses": IMAGE_POSES, "control": (*CONTROL, _ROLE),
    "als_control": CLOUD_POINTS, "frame_control": IMAGE_POINTS, "ties": TIE_POINTS}
"""What a table is made into, with its columns."""

TARGETS = {target: names_of(table) for target, table in TABLES.items()}
"""The names of these columns."""

ANGLE_WAYS: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(TARGETS, ("",)), "trajectory": ANGLES, "poses": ANGLES,
    "exterior": tuple(f"{unit} {order}" for order in ("papers", "usual") for unit in ("degrees", "gon", "radians"))}
"""Ways in which angles are counted, the first the project's own; with the order of rotations of frames; "": none."""

ALIASES = {target: {**aliases_of(table), **POLAR_ALIASES} for target, table in TABLES.items()}
"""What other programs call the columns."""

_READERS = {"control": read_control, "als_control": read_cloud_points, "frame_control": read_image_points,
            "ties": read_tie_points}


def _write_exterior(output: str | os.PathLike, poses: Sequence[ExteriorOrientation]) -> None:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(EXTERIOR_COLUMNS)
    writer.writerows([pose.image, *(f"{value:.4f}" for value in (pose.x, pose.y, pose.z)),
                      *(f"{value:.6f}" for value in (pose.omega, pose.phi, pose.kappa))] for pose in poses)
    with written_beside(output) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")


def write_checked(plain: Path, target: str, angles: str, turn: np.ndarray,
                  output: str | os.PathLike) -> tuple[str, ...]:
    """Let the project's reader check a table of its own names, and write it; notes of the reader come back.

    Parameters
    ----------
    target : a key of `TABLES`.
    angles : one of its `ANGLE_WAYS`.
    turn : (n,) degrees, by which kappas count on.

    Raises
    ------
    InputError : the reader refuses it.
    """
    if target == "trajectory":
        file = read_trajectory(plain, reading=TrajectoryReading(angles))
        write_trajectory(output, replace(file, reading=TrajectoryReading()), file.trajectory)
        return file.notes
    if target == "poses":
        write_image_poses(output, replace(read_image_poses(plain, angles), counted=ANGLES[0]))
    elif target == "exterior":
        unit, order = angles.split(" ")
        _write_exterior(output, [replace(pose, kappa=(pose.kappa + float(more) + 180.0) % 360.0 - 180.0)
                                 for pose, more in zip(read_exterior(plain, unit, order), turn)])
    else:
        _READERS[target](plain)
        with written_beside(output) as temporary:
            temporary.write_bytes(plain.read_bytes())
    return ()
