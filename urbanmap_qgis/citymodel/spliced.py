"""An updated city model: what changed is put into the old one, all else stays as it is."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterable, Sequence
from pathlib import Path
from xml.etree import ElementTree  # nosec B405 # members alone, of files without a document type declaration

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.guard import read_json
from ..wording import say
from .spliced_gml import member_bytes, write_spliced
from .spliced_json import spliced_cityjson

_GEOMETRY = re.compile(r"\}(lod\d\w*|boundedBy)$")
_HEIGHT = re.compile(r"\}measuredHeight$")
_ID = "{http://www.opengis.net/gml}id"
_DAMAGED = (ElementTree.ParseError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What a file that is no whole city model raises while it is spliced."""


def write_updated(old: str | os.PathLike | None, changed: str | os.PathLike | None, target: str | os.PathLike,
                  gone: Sequence[str]) -> None:
    """Write a city model with what changed in the place of what it was.

    Parameters
    ----------
    old : CityJSON or CityGML file; None where the changed model is the whole one.
    changed : CityJSON file or folder of CityGML with changed and new buildings; None where there are none.
    target : CityJSON file, or folder of CityGML.
    gone : ids of buildings that are there no more.

    Raises
    ------
    InputError : the old model is damaged, or of the other format than what is to be written.
    """
    into_json = (changed is not None and Path(changed).is_file()) or Path(target).suffix == ".json"
    if old is None:
        (shutil.copyfile if into_json else _copy_folder)(str(changed), str(target))
        return
    if (Path(old).suffix.lower() == ".gml") == into_json:
        raise InputError(say("{path} is of another format than the output: choose CityJSON for CityJSON, and a folder "
                             "of CityGML for CityGML; “Export city model” converts.", path=Path(old).name))
    try:
        (_write_json if into_json else _write_gml)(Path(old), changed, Path(target), gone)
    except _DAMAGED as error:
        raise InputError(say("{path} cannot be updated: it is damaged, or no city model of this format.",
                             path=Path(old).name)) from error


def _copy_folder(source: str, target: str) -> None:
    shutil.copytree(source, target, dirs_exist_ok=True)


def _write_json(old: Path, changed: str | os.PathLike | None, target: Path, gone: Sequence[str]) -> None:
    model, new = read_json(old, "CityJSON"), read_json(changed, "CityJSON") if changed else {}
    with written_beside(target) as temporary:
        temporary.write_text(json.dumps(spliced_cityjson(model, new, gone), ensure_ascii=False), encoding="utf-8")


def _write_gml(old: Path, changed: str | os.PathLike | None, target: Path, gone: Sequence[str]) -> None:
    new: dict[str, bytes] = {}
    for path in sorted(Path(changed).rglob("*.gml")) if changed else ():
        new.update(member_bytes(path))
    before = member_bytes(old)
    replaced, removed = {}, set()
    for name in before.keys() & new.keys():
        replaced[name], lost = with_geometry_of(before[name], new[name])
        removed |= lost
    for name in gone:
        removed |= _ids(before.get(name, b""))
    target.mkdir(parents=True, exist_ok=True)
    write_spliced(target / old.name, old, frozenset(gone), replaced,
                  [new[name] + b"\n" for name in sorted(new.keys() - before.keys())])
    _without_targets(target / old.name, removed)
    for folder in (old.parent, old.parent.parent.parent):  # beside the file, or beside udx as PLATEAU has it
        if (folder / "codelists").is_dir():
            shutil.copytree(folder / "codelists", target / "codelists", dirs_exist_ok=True)


def with_geometry_of(old: bytes, new: bytes) -> tuple[bytes, set[str]]:
    """An old member with the geometry and measured height of a new one, all other attributes its own.

    Returns the member, and the ids of its old geometry.

    Parameters
    ----------
    old, new : members with their namespaces declared.
    """
    for prefix, uri in re.findall(rb'xmlns:([\w.-]+)="([^"]+)"', old[:old.index(b">")] + new[:new.index(b">")]):
        ElementTree.register_namespace(prefix.decode(), uri.decode())
    member, other = (ElementTree.fromstring(each) for each in (old, new))  # nosec B314 # see the import
    building, source = member[0], other[0]
    geometry = [child for child in source if _GEOMETRY.search(str(child.tag))]
    places = [place for place, child in enumerate(building) if _GEOMETRY.search(str(child.tag))]
    lost = {item.get(_ID, "") for place in places for item in building[place].iter()}
    first = places[0] if places else len(building)
    for child in [building[place] for place in places]:
        building.remove(child)
    for place, child in enumerate(geometry):
        building.insert(first + place, child)
    heights = [next((child for child in each if _HEIGHT.search(str(child.tag))), None) for each in (building, source)]
    if heights[0] is not None and heights[1] is not None:
        heights[0].text = heights[1].text
    return ElementTree.tostring(member, encoding="utf-8"), lost - {""}


def _ids(member: bytes) -> set[str]:
    """Ids of all elements of a member."""
    return {value.decode() for value in re.findall(rb'gml:id="([^"]+)"', member)}


def _without_targets(path: Path, removed: Iterable[str]) -> None:
    """Take the textures of polygons that are there no more out of a file."""
    wanted = set(removed)
    if not wanted:
        return
    data = path.read_bytes()

    def kept(match: re.Match[bytes]) -> bytes:
        return b"" if match.group(1).decode() in wanted else match.group(0)

    less = re.sub(rb'<app:target uri="#([^"]+)">.*?</app:target>', kept, data, flags=re.DOTALL)
    if less != data:
        path.write_bytes(less)

