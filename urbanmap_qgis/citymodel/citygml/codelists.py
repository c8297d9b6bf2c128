"""The lists of codes that models of this program refer to, in the form that PLATEAU has them (gml:Dictionary)."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from xml.sax.saxutils import escape  # nosec B406 # writes, reads nothing

from ...errors import OutputError
from ...io.files.atomic import written_beside
from ...wording import say
from ..model import AttributeGroup, CityObject, CodeValue
from .iur import code_lists

FOLDER = "../../codelists/"
"""Where a file in udx/bldg finds the lists."""

_NO_ID = re.compile(r"[^\w.-]")

_OLD_LISTS: dict[str, dict[str, str]] = {
    "BuildingDataQualityAttribute_lod1HeightType": {"2": "点群から取得_中央値"},
    "UrbanMap_geometrySrcDesc": {"1": "airborne laser scanning", "2": "airborne laser scanning and mobile mapping"},
}
"""Lists that models with i-UR 2.0 refer to; those of `UrbanMap_` are the program's own."""


def lists_of(version: str) -> Mapping[str, Mapping[str, str]]:
    """Codes and their meaning by list, of the lists that a version of i-UR refers to."""
    return _OLD_LISTS if version == "2.0" else code_lists()


@cache
def lists_of_module(module: str) -> Mapping[str, Mapping[str, str]]:
    """Codes and their meaning by list, of the lists of a module ("tran", "frn")."""
    lists: dict[str, dict[str, str]] = {}
    with open(Path(__file__).with_name(f"codelists_{module}.csv"), encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            lists.setdefault(row["list"], {})[row["code"]] = row["meaning"]
    return lists


def module_code(module: str, name: str, code: str) -> CodeValue:
    """A code of one of the lists of a module."""
    return CodeValue(code, f"{FOLDER}{name}.xml", lists_of_module(module)[name].get(code, ""))


def code_value(name: str, code: str) -> CodeValue:
    """A code of one of the lists, which says where the list lies."""
    return CodeValue(code, f"{FOLDER}{name}.xml", (_OLD_LISTS.get(name) or code_lists()[name])[code])


class UsedCodes:
    """Codes that the objects of a model use, with their meaning, by list: the specification (7.2) wants all lists that
    are referred to beside the model.

    Attributes
    ----------
    named : lists that the written elements refer to.
    """

    def __init__(self) -> None:
        self.named: set[str] = set()
        self._meanings: dict[str, dict[str, str]] = {}

    def add(self, item: CityObject, written: str) -> None:
        """Note the codes of an object and of all that it holds, and the lists that its elements, as text, name."""
        self.named.update(_NAMED.findall(written))
        for part in item.everything():
            for code in _codes(list(part.attributes.values())):
                if (found := _PLACE.match(code.space)) is not None:
                    self._meanings.setdefault(found[1], {})[code.value] = code.meaning

    def with_lists(self, lists: Mapping[str, Mapping[str, str]]) -> dict[str, dict[str, str]]:
        """Lists with the used codes besides their own whose meaning is known, and such lists that are none of them."""
        used = {name: {code: meaning for code, meaning in codes.items() if meaning}
                for name, codes in self._meanings.items() if name in self.named}
        more = {name: codes for name, codes in used.items() if codes and name not in lists}
        return {**{name: {**used.get(name, {}), **codes} for name, codes in lists.items()}, **more}


_PLACE = re.compile(re.escape(FOLDER) + r"([\w.-]+)\.xml\Z")
_NAMED = re.compile(f'codeSpace="{re.escape(FOLDER)}' + r'([\w.-]+)\.xml"')


def _codes(values: Sequence) -> Iterator[CodeValue]:
    for value in values:
        if isinstance(value, CodeValue):
            yield value
        elif isinstance(value, AttributeGroup):
            yield from _codes(list(value.values.values()))
        elif isinstance(value, (list, tuple)):
            yield from _codes(value)


def write_codelists(folder: str | os.PathLike, lists: Mapping[str, Mapping[str, str]]) -> None:
    """Write lists, codes and their meaning by list, into a folder.

    Raises
    ------
    OutputError : it cannot be written.
    """
    place = Path(folder)
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(say("The folder {place} cannot be made ({strerror}): choose another output.", place=place,
                              strerror=error.strerror)) from error
    for name, codes in lists.items():
        entries = "".join(
            f'<gml:dictionaryEntry><gml:Definition gml:id="id{_NO_ID.sub("_", code)}"><gml:description>'
            f"{escape(meaning)}</gml:description><gml:name>{escape(code)}</gml:name></gml:Definition>"
            "</gml:dictionaryEntry>\n"
            for code, meaning in codes.items())
        text = ('<?xml version="1.0" encoding="UTF-8"?>\n<gml:Dictionary xmlns:gml="http://www.opengis.net/gml" '
                f'gml:id="{name}"><gml:name>{name}</gml:name>\n{entries}</gml:Dictionary>\n')
        with written_beside(place / f"{name}.xml") as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
