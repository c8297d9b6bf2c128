"""CityGML 2.0 (also 1.0) read building by building: PLATEAU files, folders, zips.

Source: OGC 12-019 (CityGML 2.0); the standard product specification of 3D city models (Project PLATEAU).
"""

from __future__ import annotations

import re
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

import numpy as np

from ...errors import InputError
from ...io.files.guard import reads
from ...io.files.named_files import CODE_LIST, IMAGE
from ...io.files.packed import unpacked_name
from ...io.official.gsi_sources import PathLike, Wanted, XmlSource, list_sources, opened
from ...io.official.xml_stream import root_children
from ...progress import SILENT, Progress
from ...wording import say
from ..model import ADDRESS, ROAD_AREAS, CityModel, CityObject, CityReference
from ..named_reference import NamedReference, named_reference
from ..reading_notes import ReadingNotes
from .schema import (
    ADDRESS_PROPERTY,
    BOUNDARY_PROPERTY,
    CITYGML_SPACE,
    EXTENSIONS,
    FITTING_ELEMENTS,
    FITTING_PROPERTIES,
    MEMBERS,
    MODULE_OBJECTS,
    PART_PROPERTY,
    ROAD_PARTS,
)
from .shape_reader import GmlTextures, ShapeReader
from .value_reader import add_value, addresses, extension_value, generic_value, id_of, leaf_value, split_tag

MAKER = "a city model"
LARGEST_BUILDING = 2**28
_THEME = re.compile(r"^[0-9]{6,10}_([a-z]{3,5})_", re.IGNORECASE)
ROADS, STREET_THINGS = frozenset({"tran"}), frozenset({"frn", "veg"})
"""Modules that are read beside the buildings where they are asked for."""

STREET_SPACE_MODULES = ROADS | STREET_THINGS
_LARGEST_LIST = 100_000
_KINDS = {**FITTING_ELEMENTS, **dict(zip(ROAD_AREAS, ROAD_AREAS)),
          **{name: kind for objects in MODULE_OBJECTS.values() for name, kind in objects.items()}}
"""Kinds of objects of the record by their elements, of all modules."""

_VERSION_3 = f"{{{CITYGML_SPACE}3."


@dataclass
class _File:
    """What holds for one file."""

    source: XmlSource
    reference: NamedReference
    notes: ReadingNotes
    textures: GmlTextures = field(default_factory=GmlTextures)
    fittings: bool = False
    lists: dict[str, dict[str, str]] = field(default_factory=dict)
    prototypes: dict = field(default_factory=dict)

    def meaning(self, space: str, code: str) -> str:
        """What a list of codes beside the file says of a code."""
        if space not in self.lists:
            found = self.source.beside(space, CODE_LIST) if space.lower().endswith(".xml") else None
            if found is None:
                self.notes.missing_lists.add(space)
            try:
                self.lists[space] = _code_list(found) if found is not None else {}
            except InputError:
                # A damaged list costs meanings only; the codes stay, and the list is named among those missing.
                self.notes.missing_lists.add(space)
                self.lists[space] = {}
        return self.lists[space].get(code, "")


def open_citygml(path: PathLike | Sequence[PathLike], stack: ExitStack, notes: ReadingNotes,
                 given: CityReference | None = None, progress: Progress = SILENT, more: Collection[str] = (),
                 fittings: bool = False) -> CityModel:
    """Open CityGML files: a .gml, a .zip or a folder of them.

    The buildings are read while they are walked through, once; `stack` must stay open until then.

    Parameters
    ----------
    notes : filled while the buildings are walked through.
    given : reference of files that name none, or one that is not known.
    more : modules whose objects come among the buildings, too (`ROADS`, `STREET_THINGS`); else they are passed over.
    fittings : whether installations and rooms of buildings are read, and areas of roads as objects of their own; else
        those of buildings are counted among what is left out, and areas are surfaces of their road.

    Raises
    ------
    InputError : nothing is there to read, or the first file names no known reference system. While the buildings are
        walked through, too: a file is damaged, or in another reference system than the first.
    """
    modules = frozenset({"bldg", *more})
    listing = list_sources(path, stack, _wanted(modules))
    sources = listing.sources
    reference = _reference_of(sources[0], given)
    images = _Images({}, _unpacking(stack))

    @reads("CityGML")
    def buildings(_path) -> Iterator[CityObject]:
        seen: Counter = Counter()
        total = max(sum(source.size for source in sources), 1)
        done = 0
        for source in sources:
            of_file = _reference_of(source, given)
            if of_file.reference != reference.reference:
                raise InputError(say("{source} is in another reference system than {sources}: load them in separate "
                                     "runs.", source=source.name, sources=sources[0].name))
            part = progress.part(done / total, (done + source.size) / total)
            for building in _buildings_of(source, of_file, notes, images, part, modules, fittings):
                yield _once(building, seen, notes)
            done += source.size
            notes.files.append(source.name)

    return CityModel(reference.reference, buildings(path), images.places, title=unpacked_name(sources[0].name).stem)


def _wanted(modules: frozenset[str]) -> Wanted:
    """Which files are looked at: not those whose names, as PLATEAU has them, are of another module."""
    def other(name: str) -> bool:
        found = _THEME.match(name)
        return found is not None and found.group(1).lower() not in modules

    folders = ", ".join(f"udx/{module}" for module in MODULE_OBJECTS if module in modules)
    return Wanted("city models (CityGML)", say("give the files of what is asked for ({folders} of PLATEAU)",
                                               folders=folders), other, (".gml", ".citygml"))


@dataclass
class _Images:
    """Images of all files: places on the disk by name, and which source each name stands for."""

    places: dict[str, Path]
    unpacked: Callable[[XmlSource], Path]
    sources: dict[str, str] = field(default_factory=dict)

    def named(self, image: str, found: XmlSource) -> str:
        """The name of an image, another one where an image of another folder has it already."""
        plain, number, name = PurePosixPath(image.replace("\\", "/")), 1, image
        while self.sources.get(name, found.name) != found.name:
            number += 1
            name = str(plain.with_name(f"{plain.stem}-{number}{plain.suffix}"))
        if name not in self.sources:
            self.sources[name] = found.name
            self.places[name] = found.path or self.unpacked(found)
        return name


def _unpacking(stack: ExitStack) -> Callable[[XmlSource], Path]:
    """What gives a file of a zip a place on the disk, under a name of our own, until `stack` is closed."""
    places: list[Path] = []

    def unpacked(source: XmlSource) -> Path:
        if not places:
            places.append(Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="urbanmap-"))))
        place = places[0] / f"{len(places)}{Path(source.short_name).suffix.lower()}"
        places.append(place)
        with opened(source) as packed, place.open("wb") as file:
            shutil.copyfileobj(packed, file)
        return place

    return unpacked


def _once(item: CityObject, seen: Counter, notes: ReadingNotes) -> CityObject:
    """An object, its parts and fittings under ids that no others have."""
    identifier = item.id or "building"
    seen[identifier] += 1
    if item.parts or item.fittings:
        item = replace(item, parts=tuple(_once(part, seen, notes) for part in item.parts),
                       fittings=tuple(_once(fitting, seen, notes) for fitting in item.fittings))
    if seen[identifier] == 1 and item.id:
        return item
    if item.id:
        notes.repeated.append(identifier)
        why = "its id is there more than once"
    else:
        why = say("it has no id")
    return replace(item, id=f"{identifier}-{seen[identifier]}", problems=(*item.problems, why))


def _reference_of(source: XmlSource, given: CityReference | None) -> NamedReference:
    """The reference system that a file names, at its head or on its first geometry."""
    for root, element in root_children(source, MAKER, LARGEST_BUILDING):
        if split_tag(root.tag)[1] != "CityModel":
            raise InputError(say("{source} is no CityGML (its root is {split_tag}): give a city model.",
                                 source=source.name, split_tag=split_tag(root.tag)[1]))
        if root.tag.startswith(_VERSION_3):
            raise InputError(say("{source} is CityGML 3.0, whose buildings are not read yet: give CityGML 2.0 or 1.0.",
                                 source=source.name))
        for item in (root, *element.iter()):
            if item.get("srsName"):
                return named_reference(item.get("srsName"), source.name, given)
        if split_tag(element.tag)[0] == "gml":  # names and descriptions may stand before the envelope
            continue
        break
    if given is None:
        raise InputError(say("{source} names no coordinate reference system: give the one that it is in.",
                             source=source.name))
    return NamedReference(given, False)


def _buildings_of(source: XmlSource, reference: NamedReference, notes: ReadingNotes, images: _Images,
                  progress: Progress, modules: frozenset[str], fittings: bool) -> Iterator[CityObject]:
    textures = _textures(source)
    names = {}
    for image in sorted(set(textures.images.values())):
        found = source.beside(image, IMAGE)
        if found is None:
            notes.missing_images.add(image)
        else:
            names[image] = images.named(image, found)
    covered = {polygon: names.get(image, image) for polygon, image in textures.images.items()}
    file = _File(source, reference, notes, GmlTextures(covered, textures.places), fittings)
    for _, member in root_children(source, MAKER, LARGEST_BUILDING, progress):
        if split_tag(member.tag)[1] not in MEMBERS:
            continue
        for element in member:
            prefix, name = split_tag(element.tag)
            if prefix in modules and name in MODULE_OBJECTS[prefix]:
                yield _object(element, file)
            else:
                notes.others[name] += 1


def _object(element: Element, file: _File, identifier: str | None = None) -> CityObject:
    """A building, a part, a road, a street object or a fitting with its attributes, shapes, parts and fittings.

    `identifier` : what it is called; its own id where none is given.
    """
    identifier = id_of(element) if identifier is None else identifier
    reader = ShapeReader(file.reference.swapped, file.textures, file.meaning,
                         9 if file.reference.reference.geographic else 3, identifier or "building", file.prototypes)
    attributes: dict = {}
    parts, areas, fittings = [], [], []
    for child in element:
        prefix, name = split_tag(child.tag)
        if prefix == "gen":
            add_value(attributes, f"gen:{child.get('name') or ''}", generic_value(child, file.meaning))
        elif prefix in EXTENSIONS:
            add_value(attributes, f"{prefix}:{name}", extension_value(child, file.meaning))
        elif name == PART_PROPERTY:
            parts += [_object(part, file) for part in child]
        elif prefix == "bldg" and file.fittings and name in FITTING_PROPERTIES.values():
            fittings += [_object(item, file, id_of(item) or f"{identifier}_{name}{number}")
                         for number, item in enumerate(child, len(fittings) + 1)
                         if split_tag(item.tag)[1] in FITTING_ELEMENTS]
        elif (prefix, name) == ("bldg", ADDRESS_PROPERTY):
            found, unread = addresses(child)
            for address in found:
                add_value(attributes, ADDRESS, address)
            reader.unread.update(unread)
        elif name == BOUNDARY_PROPERTY or (prefix in MODULE_OBJECTS and name.startswith("lod")):
            continue
        elif prefix in ("gml", "core", *MODULE_OBJECTS) and not len(child):
            add_value(attributes, name, leaf_value(child, file.meaning))
        elif prefix == "tran" and name in ROAD_PARTS:
            areas += list(child)
            if file.fittings:
                fittings += [_object(area, file, id_of(area) or f"{identifier}_{name}{len(areas)}") for area in child]
        elif prefix != "app":
            reader.unread[name] += 1
    reader.elsewhere.update(id_of(item) for area in areas for item in area.iter() if id_of(item))
    shapes = [shape for holder in (element, *(() if file.fittings else areas)) for shape in reader.shapes(holder)]
    file.notes.unread.update(reader.unread)
    kind = _KINDS[split_tag(element.tag)[1]]
    return CityObject(identifier, attributes, tuple(shapes), kind, tuple(parts),
                      tuple(dict.fromkeys(reader.problems)), tuple(fittings))


def _textures(source: XmlSource) -> GmlTextures:
    """What the appearances of a file say of its polygons; they may stand behind the buildings."""
    if not _mentions(source, b"ParameterizedTexture"):
        return GmlTextures()
    images: dict[str, str] = {}
    places: dict[tuple[str, str], np.ndarray] = {}
    for _, member in root_children(source, MAKER, LARGEST_BUILDING):
        for texture in member.iter():
            if split_tag(texture.tag)[1] != "ParameterizedTexture":
                continue
            image = next((item.text or "" for item in texture if split_tag(item.tag)[1] == "imageURI"), "").strip()
            for target in (item for item in texture if split_tag(item.tag)[1] == "target"):
                polygon = (target.get("uri") or "").lstrip("#")
                images[polygon] = image
                for item in target.iter():
                    if split_tag(item.tag)[1] == "textureCoordinates":
                        pairs = _pairs(item.text or "")
                        if pairs is not None:
                            places[polygon, (item.get("ring") or "").lstrip("#")] = pairs
    return GmlTextures(images, places)


def _pairs(text: str) -> np.ndarray | None:
    """Pairs (n, 2) of finite numbers; None where a text is none: its polygon tells that its texture is left out."""
    try:
        numbers = np.array(text.split(), dtype=float)
    except ValueError:
        return None
    return numbers.reshape(-1, 2) if len(numbers) % 2 == 0 and np.isfinite(numbers).all() else None


def _mentions(source: XmlSource, word: bytes) -> bool:
    """Whether a word is anywhere in a file, read in pieces."""
    with source.open() as stream:
        tail = b""
        while piece := stream.read(2**20):
            if word in tail + piece:
                return True
            tail = piece[-len(word):]
    return False


def _code_list(source: XmlSource) -> dict[str, str]:
    """What a list of codes (gml:Dictionary) says: description by code."""
    found = {}
    for _, entry in root_children(source, say("a list of codes"), LARGEST_BUILDING):
        texts = {split_tag(item.tag)[1]: (item.text or "").strip() for item in entry.iter() if not len(item)}
        if "name" in texts and "description" in texts and len(found) < _LARGEST_LIST:
            found[texts["name"]] = texts["description"]
    return found
