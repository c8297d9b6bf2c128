"""Control points: where points of a survey truly lie, and how far the survey is off (J 3.3.5, eq. 12 there)."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..acceptance.check_points import ROLE_NAMES, are_check_points, no_check_point
from ..errors import InputError, InsufficientDataError
from ..io.files.columns import aliases_of, names_of, needed_of
from ..io.files.guard import reads
from ..io.files.named_table import known_columns, numbers_of, plain_name, table_columns
from ..wording import say
from .gps_time import shift_between
from .pose_correction import PoseCorrection
from .survey_columns import CONTROL
from .trajectory import Trajectory

COLUMNS = names_of(CONTROL)

_HEIGHTS = ("z", "z_mms")
_ALIASES, _NEEDED = aliases_of(CONTROL), needed_of(CONTROL)
_FAR = 100.0


@dataclass(frozen=True)
class ControlPoints:
    """n points, known on the ground and found in a survey.

    Attributes
    ----------
    id : (n,) names.
    true : (n, 3) m; a height that is not known is NaN.
    time : (n,) s, when the survey measured each.
    surveyed : (n, 3) where it lies in the survey, m; heights may be NaN.
    """

    id: tuple[str, ...]
    true: np.ndarray
    time: np.ndarray
    surveyed: np.ndarray

    def __len__(self) -> int:
        return len(self.id)

    def select(self, rows: np.ndarray) -> ControlPoints:
        """Some of them, by a mask (n,) or row numbers."""
        numbers = np.arange(len(self))[rows]
        return ControlPoints(tuple(self.id[k] for k in numbers), self.true[numbers], self.time[numbers],
                             self.surveyed[numbers])


@dataclass(frozen=True)
class Accuracy:
    """Mean, maximum and standard deviation of errors in plan and in space, m (J tables 3-3 and 4-1); NaN where none.

    `bias` (3,) is the mean error east, north, up; `points` and `points_3d` say how many errors went in.
    """

    points: int
    points_3d: int
    mean_2d: float
    max_2d: float
    std_2d: float
    mean_3d: float
    max_3d: float
    std_3d: float
    bias: np.ndarray


@reads("control points")
def read_control(path: str | os.PathLike) -> ControlPoints:
    """Read control points from CSV with the columns `COLUMNS`; heights may be missing.

    Raises
    ------
    InputError : it cannot be read, a column is missing, or a value is no number.
    """
    return control_from_columns(control_columns(path), Path(path).name)


def control_columns(path: str | os.PathLike) -> dict[str, list[str | None]]:
    """The columns of a table of control points (CSV), by the names that they have there.

    Raises
    ------
    InputError : it is no text.
    """
    return table_columns(path, _NEEDED, _ALIASES, "control points (CSV)")


def control_from_columns(columns: Mapping[str, Sequence], name: str = "The control points") -> ControlPoints:
    """Control points from named columns (`COLUMNS`, in any case), as a layer or table has them.

    Raises
    ------
    InputError : a column is missing, a value is no number, or there is no row.
    """
    known = known_columns(columns, COLUMNS, _ALIASES, name)
    missing = [column for column in COLUMNS if column not in known and column not in ("id", *_HEIGHTS)]
    if missing:
        raise InputError(say("{name} has no column {missing}: control points need {columns} (heights may be left "
                             "out).", name=name, missing=", ".join(missing), columns=",".join(COLUMNS)))
    count = len(columns[known["x"]])
    if not count:
        raise InputError(say("{name} holds no control point.", name=name))
    table = {column: _numbers(columns[known[column]], column, name) if column in known else np.full(count, np.nan)
             for column in COLUMNS[1:]}
    ids = columns[known["id"]] if "id" in known else range(1, count + 1)
    return ControlPoints(tuple(str(value) for value in ids), np.column_stack([table[key] for key in "xyz"]),
                         table["time"], np.column_stack([table[f"{key}_mms"] for key in "xyz"]))


def check_points_of(control: ControlPoints, columns: Mapping[str, Sequence], name: str) -> tuple[ControlPoints, int]:
    """The control points that check a survey, by the column “role” where there is one, and how many it was adjusted to.

    Raises
    ------
    InputError : a role is not known, or none is a check point.
    """
    field = next((key for key in columns if plain_name(key) in ROLE_NAMES), None)
    if field is None:
        return control, 0
    checks = are_check_points(columns[field], name)
    if not checks.any():
        raise no_check_point(name)
    return control.select(checks), int(np.count_nonzero(~checks))


def _numbers(values: Sequence, column: str, name: str) -> np.ndarray:
    """A column as numbers; heights may be empty."""
    numbers = numbers_of(values, column, name, first=1, may_lack=True)
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if len(wrong) and column not in _HEIGHTS:
        raise InputError(say("{name}: row {wrong} has no number in the column {column}.", name=name, wrong=wrong[0] + 1,
                             column=column))
    return numbers


def in_survey_time(control: ControlPoints, trajectory: Trajectory) -> tuple[ControlPoints, int]:
    """The control points that were measured during a trajectory, in its time, and how many others there are.

    Raises
    ------
    InputError : none, or less than half of them, was.
    """
    span = (float(control.time.min()), float(control.time.max()))
    shift = shift_between(span, (float(trajectory.time[0]), float(trajectory.time[-1])), "The control points")
    moved = ControlPoints(control.id, control.true, control.time + shift, control.surveyed)
    within = trajectory.within(moved.time)
    return moved.select(within), int(np.count_nonzero(~within))


def residuals(control: ControlPoints, movement: PoseCorrection | None = None) -> np.ndarray:
    """Errors (n, 3) of the survey, m: where it has a point less where it is; corrected by a movement if one is given.

    Raises
    ------
    InputError : a control point lies more than 100 m from its place in the survey, so the two do not belong together.
    """
    away = np.hypot(*(control.surveyed - control.true)[:, :2].T)
    if (away > _FAR).any():
        worst = int(np.argmax(away))
        raise InputError(say("Control point {id} lies {away:.0f} m from its place in the survey: check that both are "
                             "in the same coordinate reference system.", id=control.id[worst], away=away[worst]))
    surveyed = control.surveyed
    if movement is not None:
        places = np.where(np.isfinite(surveyed), surveyed, movement.centre)  # heights not known turn like the vehicle
        surveyed = surveyed + movement.translations(places, control.time)
    return surveyed - control.true


def accuracy(errors: np.ndarray) -> Accuracy:
    """Figures of errors (n, 3), m; those without a height count in plan only.

    Raises
    ------
    InsufficientDataError : there are none.
    """
    if not len(errors):
        raise InsufficientDataError(say("No control point lies in the survey's time: there is nothing to measure."))
    plan = np.hypot(errors[:, 0], errors[:, 1])
    space = np.linalg.norm(errors, axis=1)
    space = space[np.isfinite(space)]
    bias = np.append(errors[:, :2].mean(axis=0), errors[np.isfinite(errors[:, 2]), 2].mean() if len(space) else np.nan)
    return Accuracy(len(plan), len(space), *_figures(plan), *_figures(space), bias)


def _figures(lengths: np.ndarray) -> tuple[float, float, float]:
    """Mean, maximum and standard deviation; one value alone has none."""
    if not len(lengths):
        return np.nan, np.nan, np.nan
    return float(lengths.mean()), float(lengths.max()), float(lengths.std(ddof=1)) if len(lengths) > 1 else np.nan
