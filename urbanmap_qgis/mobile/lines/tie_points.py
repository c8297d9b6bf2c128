"""Tie points: places that the survey and a reference both show (Z 3.2).

A set is two or more places near each other, measured within some seconds: `set,time,x_mms,y_mms,x_ref,y_ref`. The time
is when the survey measured the place; with it the place moves with the trajectory.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from ...errors import InputError
from ...io.files.columns import aliases_of, names_of
from ...io.files.guard import read_text, reads
from ...io.files.named_table import known_columns, named_rows, number_table, table_columns
from ...progress import SILENT, Progress
from ...wording import say
from ..gps_time import shift_between
from ..survey_columns import TIE_POINTS
from ..trajectory import Trajectory, gaps

COLUMNS, _ALIASES = names_of(TIE_POINTS), aliases_of(TIE_POINTS)

MAX_GAP = 1.0
"""s: tie points between epochs farther apart are not used."""

_MAX_SEPARATION = 200.0


@dataclass(frozen=True)
class TiePoints:
    """Pairs of places, (n,) in the order of time.

    Attributes
    ----------
    sets : (n,) names of the sets, str.
    time : (n,) s.
    measured, reference : (n, 2) easting and northing in the survey and in the reference, m.
    """

    sets: np.ndarray
    time: np.ndarray
    measured: np.ndarray
    reference: np.ndarray

    def __len__(self) -> int:
        return len(self.time)

    def of(self, keep: np.ndarray) -> TiePoints:
        """The pairs that a mask (n,) marks."""
        return TiePoints(self.sets[keep], self.time[keep], self.measured[keep], self.reference[keep])

    def numbers(self) -> tuple[list[str], np.ndarray]:
        """Names of the sets in the order of time, and of every pair the number of its set (n,)."""
        names, first, number = np.unique(self.sets, return_index=True, return_inverse=True)
        order = np.argsort(first)
        rank = np.empty(len(names), int)
        rank[order] = np.arange(len(names))
        return [str(name) for name in names[order]], rank[number.ravel()]


@reads("tie points")
def read_tie_points(path: str | os.PathLike) -> TiePoints:
    """Tie points of a table with the columns `COLUMNS`, or what other programs call them (`TIE_POINTS`).

    Raises
    ------
    InputError : it cannot be read, a column is missing, or a value is no number.
    """
    path = Path(path)
    header, rows, _ = named_rows(read_text(path, "tie points (CSV)"), COLUMNS, _ALIASES, path.name)
    if not header or any(len(row) != len(header) for row in rows):
        raise InputError(say("{path}: not every row has as many values as the header; the file may be cut off.",
                             path=path.name))
    return tie_points_from_columns(dict(zip(header, zip(*rows))) if rows else dict.fromkeys(header, ()), path.name)


def tie_point_columns(path: str | os.PathLike) -> dict[str, list[str | None]]:
    """The columns of a table of tie points (CSV), by the names that they have there.

    Raises
    ------
    InputError : it is no text.
    """
    return table_columns(path, COLUMNS, _ALIASES, "tie points (CSV)")


def tie_points_from_columns(columns: Mapping[str, Sequence], name: str = "The tie points") -> TiePoints:
    """Tie points of named columns (`COLUMNS`, or other names of `TIE_POINTS`, in any case).

    Raises
    ------
    InputError : a column is missing, a value is no number, there are none, or a pair is more than 200 m apart.
    """
    known = known_columns(columns, COLUMNS, _ALIASES, name)
    missing = [column for column in COLUMNS if column not in known]
    if missing:
        raise InputError(say("{name} has no column {missing}: tie points need {columns}.", name=name,
                             missing=", ".join(missing), columns=",".join(COLUMNS)))
    table = number_table(columns, known, COLUMNS[1:], name)
    if not len(table):
        raise InputError(say("{name} holds no tie points: give at least one set of two pairs.", name=name))
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(bad):
        raise InputError(say("{name} has no number in row {bad}: correct or remove it.", name=name, bad=bad[0] + 2))
    order = np.argsort(table[:, 0], kind="stable")
    sets = np.array([str(columns[known["set"]][row]).strip() for row in order])
    time, measured, reference = table[order, 0], table[order, 1:3], table[order, 3:5]
    distance = np.hypot(*(reference - measured).T)
    if distance.max() > _MAX_SEPARATION:
        worst = int(distance.argmax())
        raise InputError(say("{name}: in set {sets} survey and reference are {apart:,.0f} m apart; both must be in "
                             "the survey's coordinate reference system.", name=name, sets=sets[worst],
                             apart=distance[worst]))
    return TiePoints(sets, time, measured, reference)


def ends_of(lines: Sequence[shapely.Geometry | None]) -> dict[str, np.ndarray]:
    """Columns x_mms, y_mms, x_ref, y_ref of lines that run from the survey to the reference; NaN without a line."""
    shapes = np.array(lines, dtype=object)
    shapes = np.array([shapely.get_parts(shape)[0] if shape is not None else None for shape in shapes], dtype=object)
    start, end = shapely.get_point(shapes, 0), shapely.get_point(shapes, -1)
    return {"x_mms": shapely.get_x(start), "y_mms": shapely.get_y(start), "x_ref": shapely.get_x(end),
            "y_ref": shapely.get_y(end)}


def pairs_within(ties: TiePoints, trajectory: Trajectory, progress: Progress = SILENT) -> TiePoints:
    """The pairs within the trajectory's time and outside its gaps; the others are told as a warning.

    Times of the week and adjusted standard times are brought to the trajectory's.

    Raises
    ------
    InputError : no pair lies within the trajectory's time.
    """
    inside = trajectory.within(ties.time)
    if not inside.any():
        span, wanted = ((float(time[0]), float(time[-1])) for time in (ties.time, trajectory.time))
        shift = shift_between(span, wanted, "The tie points")
        progress.warn(say("{shift:.0f} s were added to the times of the tie points, which are counted otherwise than "
                          "those of the trajectory: make sure that both are of one survey.", shift=shift))
        ties = TiePoints(ties.sets, ties.time + shift, ties.measured, ties.reference)
        inside = trajectory.within(ties.time)
    if not inside.all():
        progress.warn(say("{inside_count} tie points lie outside the trajectory's time and are left out (set {some}).",
                          inside_count=np.count_nonzero(~inside), some=_some(ties.sets[~inside])))
    for start, end in gaps(trajectory, MAX_GAP):
        hole = inside & (ties.time > start) & (ties.time < end)
        if hole.any():
            inside &= ~hole
            progress.warn(say("The tie points of set {some} lie in a gap of the trajectory and are left out.",
                              some=_some(ties.sets[hole])))
    if not inside.any():
        raise InputError(say("All tie points lie in gaps of the trajectory: choose others."))
    return ties.of(inside)


def _some(sets: np.ndarray) -> str:
    names = list(dict.fromkeys(sets.tolist()))
    return ", ".join(names[:5]) + (say(" and {count} more", count=len(names) - 5) if len(names) > 5 else "")
