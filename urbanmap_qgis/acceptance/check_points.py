"""Check points: where points truly lie and where the product has them, read from columns of a table."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..errors import InputError
from ..io.files.columns import EAST, NORTH, UP, Column, aliases_of, names_of, needed_of
from ..io.files.named_table import known_columns, numbers_of, table_columns
from ..wording import say

ROLE_NAMES = ("role", "use", "役割", "区分")
CHECK_POINTS = (
    Column("id", "", ("name", "point", "点名", "点番号", "測点名", "名称", "番号", "点"), needed=False),
    EAST, NORTH, UP.optional(),
    Column("x_product", "m", ("計測東", "製品東", "eastproduct")),
    Column("y_product", "m", ("計測北", "製品北", "northproduct")),
    Column("z_product", "m", ("計測標高", "計測高さ", "製品標高", "heightproduct"), needed=False),
    Column("role", "", ROLE_NAMES[1:], needed=False))
"""Check points with where they truly lie and where the product has them."""

TRUE = ("x", "y", "z")
IN_PRODUCT = ("x_product", "y_product", "z_product")
ERRORS = ("east", "north", "up")
STATES = ("after", "before")
"""Endings of the fields of errors in a layer of residuals, the best state first."""

CHECK, ADJUSTED = "check", "adjusted"
ROLES = {"check": CHECK, "検証点": CHECK, "点検測量": CHECK, "": CHECK,
         "adjusted": ADJUSTED, "adjust": ADJUSTED, "control": ADJUSTED, "tie": ADJUSTED, "調整点": ADJUSTED,
         "標定点": ADJUSTED}
"""Words of the column “role”: only check points judge a product, not those that it was adjusted to."""


@dataclass(frozen=True)
class CheckPoints:
    """n check points.

    Attributes
    ----------
    id : (n,) names.
    true : (n, 3) where they lie, m; NaN where that is not known.
    errors : (n, 3) product less truth, east, north, up, m; the height's is NaN where it was not checked.
    unit : (n,) the unit of inspection of each (a mesh, a drive); "" where there is only one.
    state : which errors of a layer of residuals these are ("after", "before"), "" for a table of coordinates.
    adjusted : number of points left out because the product was adjusted to them.
    edge : (n,) the edge of a building that each point is an end of; () where points are of no edges.
    """

    id: tuple[str, ...]
    true: np.ndarray
    errors: np.ndarray
    unit: tuple[str, ...]
    state: str = ""
    adjusted: int = 0
    edge: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.id)

    def of_unit(self, unit: str) -> CheckPoints:
        """The points of one unit of inspection."""
        return self._select(np.array([item == unit for item in self.unit], bool))

    def _select(self, rows: np.ndarray) -> CheckPoints:
        numbers = np.flatnonzero(rows)
        return CheckPoints(tuple(self.id[k] for k in numbers), self.true[numbers], self.errors[numbers],
                           tuple(self.unit[k] for k in numbers), self.state, self.adjusted,
                           tuple(self.edge[k] for k in numbers) if self.edge else ())


def check_points_from_columns(columns: Mapping[str, Sequence], places: np.ndarray | None = None, unit_field: str = "",
                              name: str = "") -> CheckPoints:
    """Check points from named columns.

    Parameters
    ----------
    columns : of a layer of residuals (east_after, north_after, up_after, or ..._before, as an acceptance
        report with a trajectory writes them), or of a table with x, y, z (true) and x_product, y_product, z_product,
        m; id and role (check, adjusted) where there are such, and edge, which names the edge of a building that a
        point is an end of.
    places : (n, 3) of the layer's points, m, where x and y are no columns.
    unit_field : column that names each point's unit of inspection.
    name : of the table, for messages.

    Raises
    ------
    InputError : columns are missing, a value is no number, or no check point is left.
    """
    lower = {key.strip().lower(): key for key in columns}
    if not any(f"{ERRORS[0]}_{state}" in lower for state in STATES):
        lower.update(known_columns(columns, names_of(CHECK_POINTS), aliases_of(CHECK_POINTS), name))
    true, errors, state = _errors(columns, lower, places, name)
    count = len(errors)
    ids = [str(value) for value in columns[lower["id"]]] if "id" in lower else [str(k + 1) for k in range(count)]
    if unit_field and unit_field not in columns:
        raise InputError(say("{name} has no field {field}: choose the field that names the units of inspection.",
                             name=name, field=unit_field))
    units = [_text(value) for value in columns[unit_field]] if unit_field else [""] * count
    checks = are_check_points(columns[lower["role"]], name) if "role" in lower else np.ones(count, bool)
    checked = np.isfinite(errors[:, :2]).all(axis=1)
    edges = tuple(_text(value) for value in columns[lower["edge"]]) if "edge" in lower else ()
    points = CheckPoints(tuple(ids), true, errors, tuple(units), state, int(np.count_nonzero(~checks)), edges)
    points = points._select(checks & checked)
    if not len(points):
        raise no_check_point(name)
    return points


def check_point_columns(path: str | os.PathLike) -> dict[str, list[str | None]]:
    """The columns of a table of check points (CSV), by the names that they have there.

    Raises
    ------
    InputError : it is no text.
    """
    return table_columns(path, needed_of(CHECK_POINTS), aliases_of(CHECK_POINTS), "check points (CSV)")


def no_check_point(name: str) -> InputError:
    """The refusal of a table without check points."""
    return InputError(say("{name} holds no check point: give points that were measured independently and to which "
                          "the product was not adjusted.", name=name))


def point_places(geometries: Sequence[shapely.Geometry | None]) -> np.ndarray:
    """Places (n, 3) of points, m; NaN where there is no point, or no height."""
    places = np.full((len(geometries), 3), np.nan)
    for row, geometry in enumerate(geometries):
        if geometry is not None and geometry.geom_type == "Point" and not geometry.is_empty:
            places[row] = geometry.x, geometry.y, geometry.z if geometry.has_z else np.nan
    return places


def _errors(columns: Mapping[str, Sequence], lower: Mapping[str, str], places: np.ndarray | None,
            name: str) -> tuple[np.ndarray, np.ndarray, str]:
    """True places (n, 3), errors (n, 3), and which state of the product they are of."""
    for state in STATES:
        fields = [f"{axis}_{state}" for axis in ERRORS]
        if all(field in lower for field in fields):
            errors = np.column_stack([_numbers(columns[lower[field]], field, name) for field in fields])
            if np.isfinite(errors[:, :2]).all(axis=1).any():
                true = places if places is not None else np.full(errors.shape, np.nan)
                return np.asarray(true, float), errors, state
    missing = [field for field in (*TRUE[:2], *IN_PRODUCT[:2]) if field not in lower]
    if missing:
        raise InputError(say("{name} has no column {missing}: give control points with a trajectory, the "
                             "residuals of such a run, or a table with x, y, z (true) and x_product, y_product, "
                             "z_product.", name=name, missing=", ".join(missing)))
    true, product = (np.column_stack([
        _numbers(columns[lower[field]], field, name) if field in lower else np.full(len(columns[lower["x"]]), np.nan)
        for field in fields]) for fields in (TRUE, IN_PRODUCT))
    return true, product - true, ""


def _numbers(values: Sequence, field: str, name: str) -> np.ndarray:
    """A column as numbers, NaN where it is empty."""
    return numbers_of(values, field, name, first=1, may_lack=True)


def are_check_points(roles: Sequence, name: str) -> np.ndarray:
    """Which points (mask) are check points, by their role.

    Raises
    ------
    InputError : a role is not known.
    """
    words = [_text(role).strip().lower() for role in roles]
    unknown = sorted({word for word in words if word not in ROLES})
    if unknown:
        raise InputError(say("{name}: the role “{role}” is not known: check points are “check” (検証点), points that "
                             "the product was adjusted to “adjusted” (調整点).", name=name, role=unknown[0]))
    return np.array([ROLES[word] == CHECK for word in words], bool)


def _text(value: object) -> str:
    return "" if value is None else str(value)
