"""Trajectories in files: CSV, Applanix SBET and point layers; written back in the format they came in."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.columns import aliases_of, names_of
from ..io.files.guard import read_text, reads
from ..io.files.named_table import known_columns, meanings, named_rows, number_table
from ..io.files.plan_axes import order_note, x_counts_north
from ..io.files.read_once import once
from ..io.points.decoded_points import file_state
from ..wording import say
from .sbet import SBET_SUFFIXES, read_sbet, sbet_poses, sbet_records
from .survey_columns import TRAJECTORY
from .trajectory import Trajectory, gaps, jumps, unwrapped
from .trajectory_accuracy import (
    place_sigma_of_columns,
    rms_file_of,
    sigma_of_columns,
    sigma_of_rms_file,
    stated_accuracy,
    stated_place_accuracy,
)
from .trajectory_glitches import require_drivable
from .trajectory_reading import (
    USUAL,
    TrajectoryReading,
    axes_of_travel,
    from_file_angles,
    judged_headings,
    to_file_angles,
)

COLUMNS = names_of(TRAJECTORY)

_ALIASES = aliases_of(TRAJECTORY)
_DECIMALS = {"time": 6, "x": 4, "y": 4, "z": 4, "roll": 6, "pitch": 6, "heading": 6}
_SHOWN = 3
_ROUNDED_SHARE = 0.25  # of the epochs; more of them with the time of another pose come of rounded times


@dataclass(frozen=True)
class TrajectoryFile:
    """A trajectory and what is needed to write another one in its format.

    Attributes
    ----------
    trajectory : the poses.
    format : "csv", "sbet" or "layer".
    notes : sentences on what was put right or looks wrong in it.
    columns : further columns of the same length by name, in the file's order; written back as they are.
    header : the CSV's column names as the file spells them.
    delimiter : of the CSV.
    crs_wkt : of the map coordinates, where it was needed (SBET).
    reading : how its angles and heights were read, and are written.
    applied : sentences on what was done to its heights and what it states on its accuracy, "" for nothing.
    x_north : whether its X counts north, where its columns are named so that it may (`plan_axes`); else None.
    """

    trajectory: Trajectory
    format: str
    notes: tuple[str, ...] = ()
    columns: Mapping[str, Sequence] = field(default_factory=dict)
    header: tuple[str, ...] = COLUMNS
    delimiter: str = ","
    crs_wkt: str | None = None
    reading: TrajectoryReading = USUAL
    applied: str = ""
    x_north: bool | None = None


@reads("a trajectory")
def read_trajectory(path: str | os.PathLike, crs_wkt: str | None = None,
                    reading: TrajectoryReading = USUAL) -> TrajectoryFile:
    """Read a trajectory: CSV with `time,x,y,z,roll,pitch,heading`, or Applanix SBET (`.out`, `.sbet`).

    Where it states the accuracy of its angles or places (see `trajectory_accuracy`), the trajectory carries it.

    Parameters
    ----------
    crs_wkt : map coordinates into which SBET's latitudes and longitudes go.
    reading : how angles are counted, and the geoid for SBET's ellipsoidal heights; without one they stay so.

    Raises
    ------
    InputError : it cannot be read, a column is missing, its epochs contradict each other, or its headings go with the
        direction of travel only when they are counted in another way.
    """
    path = Path(path)
    if path.suffix.lower() in SBET_SUFFIXES:
        return _read_sbet(path, crs_wkt, reading)
    if reading.geoid is not None or not path.is_file():
        return _read_csv(path, crs_wkt, reading)
    return once((file_state(path), crs_wkt, reading), lambda: _read_csv(path, crs_wkt, reading))


def _read_csv(path: Path, crs_wkt: str | None, reading: TrajectoryReading) -> TrajectoryFile:
    text = read_text(path, "a trajectory (CSV)")
    header, rows, delimiter = named_rows(text, COLUMNS, _ALIASES, path.name,
                                         ("radians",) if reading.angles.startswith("radians") else ())
    header = _each_once(header)
    ragged = next((number for number, row in enumerate(rows, 2) if len(row) != len(header)), None)
    if ragged:
        raise InputError(say("{path}: row {ragged} has {rows_count} values, the header names {header_count}: the "
                             "file may be cut off; export it again.", path=path.name, ragged=ragged,
                             rows_count=len(rows[ragged - 2]), header_count=len(header)))
    columns = dict(zip(header, zip(*rows))) if rows else dict.fromkeys(header, ())
    file = trajectory_from_columns(columns, path.name, reading)
    return replace(file, format="csv", header=header, delimiter=delimiter, crs_wkt=crs_wkt)


def _each_once(header: tuple[str, ...]) -> tuple[str, ...]:
    """Names of columns, those that came before with blanks behind, so that each keeps its values."""
    return tuple(name + " " * header[:number].count(name) for number, name in enumerate(header))


def trajectory_from_columns(columns: Mapping[str, Sequence], name: str = "The trajectory",
                            reading: TrajectoryReading = USUAL) -> TrajectoryFile:
    """A trajectory from named columns of equal length, as a layer or a table has them (`COLUMNS`, in any case).

    Rows out of order are sorted and repeated epochs taken once; both are noted, as are gaps and jumps.

    Raises
    ------
    InputError : a column is missing or holds something else than numbers, fewer than two epochs, or one time with two
        different poses; or headings counted in another way.
    """
    known = known_columns(columns, COLUMNS, _ALIASES, name,
                          lambda orders: _axes_of_travel(columns, orders, reading, name))
    missing = [column for column in COLUMNS if column not in known]
    if missing:
        raise InputError(say("{name} has no column {missing}: a trajectory needs {columns}.", name=name,
                             missing=", ".join(missing), columns=",".join(COLUMNS)))
    table = number_table(columns, known, COLUMNS, name)
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(bad):
        raise InputError(say("{name} has no number in row {bad}: correct or remove it.", name=name, bad=bad[0] + 2))
    if len(table) < 2:
        raise InputError(say("{name} has {table_count} epochs: give a trajectory of at least two.", name=name,
                             table_count=len(table)))
    order, notes = _order(table, name)
    x_north = x_counts_north(columns, known)
    notes += [] if x_north is None else [order_note(known, name)]
    used = {known[column] for column in COLUMNS}
    others = {key: [values[row] for row in order] for key, values in columns.items() if key not in used}
    if reading.geoid is not None:
        notes.append(say("{name}: a geoid is applied to the ellipsoidal heights of SBET only; these heights stay as "
                         "they are.", name=name))
    require_drivable(table, order, name, "row", 2)
    trajectory = replace(_checked(table[order], name, notes, others, reading), x_north=x_north)
    return _with_sigma(trajectory, sigma_of_columns(others, reading.angles, name),
                       place_sigma_of_columns(others, name), name)


def _axes_of_travel(columns: Mapping[str, Sequence], orders: Mapping[bool, Mapping[str, str]],
                    reading: TrajectoryReading, name: str) -> bool | None:
    """Whether X counts north by the headings; None where they do not tell or the table is no trajectory."""
    if any(set(COLUMNS) - set(known) for known in orders.values()):
        return None
    found = {}
    for x_north, known in orders.items():
        table = number_table(columns, known, COLUMNS, name)
        table = table[np.isfinite(table).all(axis=1)]
        table = table[np.unique(table[:, 0], return_index=True)[1]]
        if len(table) < 2:
            return None
        found[x_north] = Trajectory(table[:, 0], table[:, 1:4], unwrapped(from_file_angles(table[:, 4:7],
                                                                                          reading.angles)))
    return axes_of_travel(found)


def _with_sigma(file: TrajectoryFile, angles: np.ndarray | None, places: np.ndarray | None,
                name: str) -> TrajectoryFile:
    """The same with standard deviations of the angles (n, 3), degrees, and of places (n, 2), m, which `name` states."""
    notes = [file.applied, "" if angles is None else stated_accuracy(angles, name),
             "" if places is None else stated_place_accuracy(places, name)]
    return replace(file, trajectory=replace(file.trajectory, angle_sigma=angles, place_sigma=places),
                   applied=" ".join(part for part in notes if part))


def _order(table: np.ndarray, name: str) -> tuple[np.ndarray, list[str]]:
    """Rows (n,) to take, by time and each epoch once, and notes on what was put right."""
    time, notes = table[:, 0], []
    order = np.arange(len(time))
    if (np.diff(time) < 0).any():
        order = np.argsort(time, kind="stable")
        notes.append(say("{name}: {count} epochs are out of order; they were sorted by time.", name=name,
                         count=np.count_nonzero(np.diff(time) < 0)))
    same = np.flatnonzero(np.diff(time[order]) == 0)
    if len(same):
        difference = np.abs(table[order[same]] - table[order[same + 1]])
        difference[:, 4:] = np.abs((difference[:, 4:] + 180.0) % 360.0 - 180.0)
        worst = int(np.argmax(difference[:, 1:4].max(axis=1)))
        different = (difference[:, 1:4].max(axis=1) > 0.01) | (difference[:, 4:].max(axis=1) > 0.1)
        if different.sum() > _ROUNDED_SHARE * len(time) and not notes:
            raise InputError(say("The times of {name} are rounded to {step:g} s: {count} epochs of different poses "
                                 "share their time with another. Export it with more decimals of the time.", name=name,
                                 step=np.diff(np.unique(time)).min(initial=np.inf), count=different.sum()))
        if different.any():
            raise InputError(say("{name} gives two different poses for the time {time:.4f} s: remove the wrong one.",
                                 name=name, time=time[order[same[worst]]]))
        notes.append(say("{name}: {same_count} epochs are repeated; each was taken once.", name=name,
                         same_count=len(same)))
        order = np.delete(order, same + 1)
    return order, notes


def _checked(table: np.ndarray, name: str, notes: list[str], columns: Mapping[str, Sequence],
             reading: TrajectoryReading) -> TrajectoryFile:
    """The trajectory of a table in order, with notes on gaps, jumps and strange headings."""
    if len(table) < 2:
        raise InputError(say("{name} has one epoch only: give a trajectory of at least two.", name=name))
    angles = unwrapped(from_file_angles(table[:, 4:7], reading.angles))
    trajectory = Trajectory(table[:, 0].copy(), table[:, 1:4].copy(), angles)
    notes = [*notes, *judged_headings(trajectory, table[:, 4:7], reading.angles, name)]
    for spans, what in ((gaps(trajectory), say("has no epochs for more than a second")),
                        (jumps(trajectory), say("jumps"))):
        if len(spans):
            places = ", ".join(f"{start:.2f} to {end:.2f} s" for start, end in spans[:_SHOWN])
            more = say(" and {count} more", count=len(spans) - _SHOWN) if len(spans) > _SHOWN else ""
            notes.append(say("{name} {what} at {places}{more}: what was measured there is not to be trusted.",
                             name=name, what=what, places=places, more=more))
    return TrajectoryFile(trajectory, "layer", tuple(notes), columns, reading=reading)


def _read_sbet(path: Path, crs_wkt: str | None, reading: TrajectoryReading) -> TrajectoryFile:
    records = read_sbet(path, crs_wkt)
    table, applied = sbet_poses(records, crs_wkt, reading.geoid, path.name)
    order, notes = _order(table, path.name)
    require_drivable(table, order, path.name, "record", 1)
    read = TrajectoryReading(geoid=reading.geoid)
    file = _checked(table[order], path.name, notes, {name: records[name][order] for name in records.dtype.names}, read)
    file = replace(file, format="sbet", header=(), delimiter="", crs_wkt=crs_wkt, applied=applied)
    beside = rms_file_of(path)
    if beside is None:
        return file
    return _with_sigma(file, *sigma_of_rms_file(beside, file.trajectory.time), beside.name)


def write_trajectory(path: str | os.PathLike, like: TrajectoryFile, trajectory: Trajectory) -> None:
    """Write a trajectory of the same epochs in the format of `like` (CSV or SBET); it appears when it is whole.

    Of an SBET the positions and angles change, and velocities and accelerations stay as they were.

    Raises
    ------
    InputError : `like` is a layer, which the caller writes.
    """
    if like.format == "sbet":
        data = sbet_records(trajectory, like.columns, like.crs_wkt, like.reading.geoid).tobytes()
    elif like.format == "csv":
        data = _csv_text(like, trajectory).encode()
    else:
        raise InputError(say("A trajectory that came as a layer is written as a layer."))
    with written_beside(path) as temporary:
        temporary.write_bytes(data)


def columns_of(trajectory: Trajectory) -> dict[str, np.ndarray]:
    """The trajectory as columns named as in `COLUMNS`; headings 0 to 360, other angles -180 to 180."""
    roll, pitch, heading = trajectory.angles.T
    return dict(zip(COLUMNS, (trajectory.time, *trajectory.place.T, (roll + 180.0) % 360.0 - 180.0,
                              (pitch + 180.0) % 360.0 - 180.0, heading % 360.0)))


def columns_in_file(like: TrajectoryFile, trajectory: Trajectory) -> dict[str, np.ndarray]:
    """The same with angles counted as the file given does."""
    values = columns_of(trajectory)
    if like.reading.angles != "degrees":
        angles = np.column_stack([values[name] for name in COLUMNS[4:]])
        values.update(zip(COLUMNS[4:], to_file_angles(angles, like.reading.angles).T))
    return values


def _csv_text(like: TrajectoryFile, trajectory: Trajectory) -> str:
    values = columns_in_file(like, trajectory)
    finer = 2 if like.reading.angles.startswith("radians") else 0
    digits = {name: count + finer * (name in COLUMNS[4:]) for name, count in _DECIMALS.items()}
    text = {name: [f"{value:.{digits[name]}f}" for value in values[name]] for name in COLUMNS}
    # A column that the file has twice (a height, say) is written twice.
    meant = meanings(like.header, COLUMNS, _ALIASES, like.x_north)
    columns = [text[meant[name]] if name in meant else like.columns[name] for name in like.header]
    out = io.StringIO()
    writer = csv.writer(out, delimiter=like.delimiter, lineterminator="\n")
    writer.writerow(like.header)
    writer.writerows(zip(*columns))
    return out.getvalue()
