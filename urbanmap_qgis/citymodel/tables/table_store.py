"""Rows of buildings while they are collected: faces in temporary files, the rest in memory."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import shapely

from .building_table import BuildingRow


class TableStore:
    """Columns and geometries of `BuildingRow`s; use as a context manager, its files vanish with it.

    Attributes
    ----------
    columns : values by name, one a building; None where a building lacks one.
    outlines : one a building.
    modelled : rows that have a solid.
    models : their solids.
    surfaces, surface_columns : faces of the models.
    """

    def __init__(self, models: bool, surfaces: bool):
        self.columns: dict[str, list] = {}
        self.outlines: list[shapely.Geometry | None] = []
        self.modelled: list[int] = []
        self.models = SpooledGeometries() if models else None
        self.surfaces = SpooledGeometries() if surfaces else None
        self.surface_columns: dict[str, list] = {"building_id": [], "roof_id": [], "surface_type": []}

    def __enter__(self) -> TableStore:
        return self

    def __exit__(self, *_exception: object) -> None:
        for spool in (self.models, self.surfaces):
            if spool is not None:
                spool.close()

    def add(self, row: BuildingRow) -> None:
        """Take in a building."""
        number = len(self.outlines)
        for name, value in row.values.items():
            column = self.columns.get(name)
            if column is None:
                column = self.columns[name] = [None] * number
            column.append(value)
        for column in self.columns.values():
            if len(column) == number:
                column.append(None)
        self.outlines.append(row.outline)
        if self.models is not None and row.solid is not None:
            self.modelled.append(number)
            self.models.add([row.solid])
        if self.surfaces is not None:
            self.surfaces.add(row.faces)
            self.surface_columns["building_id"] += [row.values["building_id"]] * len(row.faces)
            self.surface_columns["roof_id"] += row.roofs
            self.surface_columns["surface_type"] += row.kinds

    def more_fields(self, known: Iterable[str]) -> list[tuple[str, str]]:
        """Name and kind ("int", "real", "text", "bool") of each further column; those with mixed values become text.

        A name that is there already but for its letters' case, or is a database's own, gets an underscore.
        """
        taken = {name.lower() for name in known} | {"fid", "geom"}
        added = []
        for name in [name for name in self.columns if name not in taken]:
            field = name
            while field.lower() in taken:
                field += "_"
            taken.add(field.lower())
            values = self.columns.pop(name) if field != name else self.columns[name]
            kind = _kind_of_values(values)
            self.columns[field] = [None if value is None else str(value) for value in values] if (
                kind == "text") else values
            added.append((field, kind))
        return added


def _kind_of_values(values: list[Any]) -> str:
    kinds = {type(value) for value in values if value is not None}
    if kinds == {bool}:
        return "bool"
    if kinds == {int} and all(abs(value) < 2**63 for value in values if value is not None):
        return "int"
    return "real" if kinds <= {int, float} and kinds else "text"


class SpooledGeometries(Sequence):
    """Geometries in a temporary file; a slice is an (n,) array of shapely's."""

    def __init__(self) -> None:
        self._file = tempfile.TemporaryFile(prefix=".urbanmap-")  # noqa: SIM115
        self._ends = [0]

    def add(self, geometries: Iterable[shapely.Geometry]) -> None:
        """Put geometries at the end."""
        for geometry in geometries:
            piece = shapely.to_wkb(geometry, output_dimension=3)
            self._file.write(piece)
            self._ends.append(self._ends[-1] + len(piece))

    def __len__(self) -> int:
        return len(self._ends) - 1

    def __getitem__(self, which: int | slice) -> shapely.Geometry | np.ndarray:
        if not isinstance(which, slice):
            return self[which:which + 1 or None][0]
        rows = range(*which.indices(len(self)))
        return np.array([shapely.from_wkb(self._piece(row)) for row in rows], dtype=object)

    def _piece(self, row: int) -> bytes:
        self._file.seek(self._ends[row])
        return self._file.read(self._ends[row + 1] - self._ends[row])

    def close(self) -> None:
        """Remove the file."""
        self._file.close()
