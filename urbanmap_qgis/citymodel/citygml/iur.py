"""What i-UR lets objects say: tables of elements, types and numbers, one a version, and values fitted to them.

Source: the XML schemas of i-UR 2.0, 3.1 and 3.2 (Cabinet Office, Regional Revitalization), from which
`scripts/make_iur_tables.py` makes the tables.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from ..model import BUILDING, BUILDING_PART, CITY_FURNITURE, ROAD, SINGLE_TREE, AttributeGroup, CodeValue, Measure

VERSIONS = ("3.2", "3.1", "2.0")
"""Versions that can be written, the one in force first."""

PREFIX = "uro:"
_OWNERS = {BUILDING: "Building", BUILDING_PART: "Building", ROAD: "Road",
           CITY_FURNITURE: "CityFurniture", SINGLE_TREE: "Vegetation"}
_NAMESPACE = "https://www.geospatial.jp/iur/uro/"
_MANY = "unbounded"
_TYPES: dict[str, tuple[type, ...]] = {
    "code": (CodeValue, str, int, float), "text": (str, CodeValue, int, float), "whole": (int,), "number": (int, float),
    "measure": (Measure,), "date": (date, str), "year": (int, str), "truth": (bool, str)}
_FORMS = {"date": r"\d{4}-\d\d-\d\d", "year": r"-?\d{4,}", "truth": "true|false|0|1"}


@dataclass(frozen=True)
class IurField:
    """One element of a building, a road or a data type.

    Attributes
    ----------
    kind : of its value, or the data types that it can be, parted by "|"; empty where it cannot be written here.
    least, most : how many there may be; None for no limit.
    choice : number of the group of elements of which there is exactly one; empty for none.
    """

    name: str
    kind: str
    least: int
    most: int | None
    choice: str = ""


@dataclass(frozen=True)
class IurTable:
    """One version: the fields of a building, of a road and of each data type, in the schema's order.

    Attributes
    ----------
    older : names of today by names of earlier versions.
    """

    version: str
    fields: Mapping[str, tuple[IurField, ...]]
    older: Mapping[str, str]

    @property
    def namespace(self) -> str:
        """Namespace of the version's elements."""
        return _NAMESPACE + self.version

    def fitted(self, name: str, value: Any, kind: str = BUILDING) -> tuple[str, Any] | None:
        """An attribute of an object under the name of this version, its values in the schema's order.

        None where the version has no such attribute, or it lacks values that the version asks for.

        Parameters
        ----------
        name : with its prefix, of any version.
        value : a group, a simple value or a list of these.
        kind : of the object.
        """
        wanted = self._today(name.removeprefix(PREFIX))
        fields = self.fields.get(_OWNERS.get(kind, ""), ())
        field = next((item for item in fields if self._today(item.name) == wanted), None)
        values = None if field is None else self._values(field, value)
        return None if not values else (PREFIX + field.name, values)

    def _today(self, name: str) -> str:
        return self.older.get(name, name)

    def _values(self, field: IurField, value: Any) -> list[Any] | None:
        """Values of one field, None where one does not fit or there are too few or too many."""
        given = [item for item in (value if isinstance(value, (list, tuple)) else (value,)) if item is not None]
        if len(given) < field.least or (field.most is not None and len(given) > field.most):
            return None
        values = [self._value(field.kind, item) for item in given]
        return None if any(item is None for item in values) else values

    def _value(self, kind: str, value: Any) -> Any:
        if isinstance(value, AttributeGroup):
            wanted = self._today(value.type.removeprefix(PREFIX))
            type_name = next((name for name in kind.split("|") if self._today(name) == wanted), None)
            return self._group(type_name, value) if type_name in self.fields else None
        if not isinstance(value, _TYPES.get(kind, ())) or (isinstance(value, bool) and kind != "truth"):
            return None
        if kind in _FORMS and not isinstance(value, (date, bool)) and not re.fullmatch(_FORMS[kind], str(value)):
            return None
        return value

    def _group(self, type_name: str, group: AttributeGroup) -> AttributeGroup | None:
        """A data type with its values in order; None where it has a value that the version does not know."""
        values = {name.removeprefix(PREFIX): value for name, value in group.values.items()}
        known = self.fields[type_name]
        if set(values) - {field.name for field in known}:
            return None
        members = {}
        for field in known:
            found = self._values(field, values.get(field.name))
            if found is None:
                return None
            if found:
                members[field.name] = found if len(found) > 1 else found[0]
        chosen = Counter(field.choice for field in known if field.choice and field.name in members)
        one_each = all(chosen[field.choice] == 1 for field in known if field.choice)
        return AttributeGroup(PREFIX + type_name, members) if one_each else None


@cache
def iur_table(version: str) -> IurTable:
    """The table of a version, one of `VERSIONS`."""
    fields: dict[str, list[IurField]] = {}
    for row in _rows(f"iur_{version}.csv"):
        of_owner = fields.setdefault(row["owner"], [])
        if row["name"]:
            most = None if row["most"] == _MANY else int(row["most"])
            of_owner.append(IurField(row["name"], row["kind"], int(row["least"]), most, row["choice"]))
    older = {row["older"]: row["name"] if row["owner"] in _OWNERS.values() else row["owner"]
             for row in _rows(f"iur_{VERSIONS[0]}.csv") if row["older"]}
    return IurTable(version, {owner: tuple(items) for owner, items in fields.items()}, older)


@lru_cache(maxsize=4096)
def kinds_of(tag: str) -> Mapping[str, str]:
    """Kinds of the values of a data type by their tags; empty where no table has the type.

    Parameters
    ----------
    tag : of the data type, "{namespace}name": the namespace tells the version.
    """
    space, _, name = tag.removeprefix("{").rpartition("}")
    version = space.removeprefix(_NAMESPACE)
    fields = iur_table(version).fields.get(name, ()) if version in VERSIONS else ()
    return {f"{{{space}}}{field.name}": field.kind for field in fields}


@cache
def code_lists() -> Mapping[str, Mapping[str, str]]:
    """Codes and their meaning by list, as the standard product specification 5.0 has them."""
    lists: dict[str, dict[str, str]] = {}
    for row in _rows("codelists.csv"):
        lists.setdefault(row["list"], {})[row["code"]] = row["meaning"]
    return lists


def _rows(name: str) -> Iterator[dict[str, str]]:
    with open(Path(__file__).with_name(name), encoding="utf-8", newline="") as file:
        yield from csv.DictReader(file)
