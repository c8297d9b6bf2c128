"""The lists of codes that models of this program refer to, in the form that PLATEAU has them (gml:Dictionary)."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from xml.sax.saxutils import escape  # nosec B406 # writes, reads nothing

from ...errors import OutputError
from ...io.files.atomic import written_beside
from ...wording import say
from ..model import CodeValue
from .iur import code_lists

FOLDER = "../../codelists/"
"""Where a file in udx/bldg finds the lists."""

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


def write_codelists(folder: str | os.PathLike, version: str,
                    more: Mapping[str, Mapping[str, str]] | None = None) -> None:
    """Write all lists that a version refers to into a folder.

    Parameters
    ----------
    more : other lists likewise, codes and their meaning by list.

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
    for name, codes in {**lists_of(version), **(more or {})}.items():
        entries = "".join(
            f'<gml:dictionaryEntry><gml:Definition gml:id="id{code}"><gml:description>{escape(meaning)}'
            f"</gml:description><gml:name>{code}</gml:name></gml:Definition></gml:dictionaryEntry>\n"
            for code, meaning in codes.items())
        text = ('<?xml version="1.0" encoding="UTF-8"?>\n<gml:Dictionary xmlns:gml="http://www.opengis.net/gml" '
                f'gml:id="{name}"><gml:name>{name}</gml:name>\n{entries}</gml:Dictionary>\n')
        with written_beside(place / f"{name}.xml") as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
