"""CityJSON (1.0 to 2.0) and CityJSONSeq as the neutral record, all levels of detail, semantics and attributes.

Source: CityJSON specifications 2.0.1, https://www.cityjson.org/specs/2.0.1/; a sequence is one object a line.
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from io import TextIOWrapper
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError
from ...geometry.solid import FaceTexture
from ...io.files.guard import first_not_finite, read_json, reading_part, reads
from ...io.files.named_files import IMAGE, named_file
from ...io.files.packed import open_unpacked, unpacked_suffix
from ...io.reference.height_systems import JAPANESE
from ...progress import SILENT, Progress
from ...wording import say
from ..model import (
    ADDRESS,
    BUILDING,
    BUILDING_PART,
    BUILDING_ROOM,
    FITTINGS,
    FOOTPRINT,
    INNER_INSTALLATION,
    INSTALLATION,
    MULTI_SURFACE,
    ROOF_EDGE,
    SOLID,
    SURFACE_KINDS,
    UNKNOWN_HEIGHTS,
    AttributeGroup,
    CityModel,
    CityObject,
    CityReference,
    CityShape,
    CitySurface,
)
from ..named_reference import named_reference
from ..objects import unmatched_edges
from ..reading_notes import ReadingNotes

_TITLE_HEIGHTS = re.compile(r"heights: (\w+)$")
_SOLIDS = {"Solid": 1, "MultiSolid": 2, "CompositeSolid": 2}
_INSTANCE = "GeometryInstance"
_KINDS = (BUILDING, BUILDING_PART)
_INNER = "interior"
"""Attribute of an installation within a building, which CityJSON has no type for."""
_STRUCTURE = ("type", "id", "children", "parent")
_DEEPEST = 8
_OTHER = re.compile(r"[^\w.\-]")
_LONGEST_LINE = 2**28


@reads("CityJSON")
def open_cityjson(path: str | os.PathLike, notes: ReadingNotes, given: CityReference | None = None,
                  progress: Progress = SILENT, fittings: bool = False) -> CityModel:
    """Open a CityJSON file or a sequence (.jsonl); the buildings are read while they are walked through, once.

    Parameters
    ----------
    notes : filled while the buildings are walked through.
    given : reference of files that name none, or one that is not known.
    fittings : whether installations and rooms of buildings are read; else they are counted among what is left out.

    Raises
    ------
    InputError : it is no CityJSON, is damaged, or names no reference system and none was given.
    """
    path = Path(path)
    head, pieces = _opened(path, progress)
    metadata = head.get("metadata") or {}
    reference = _reference(metadata, path, given)
    images: dict[str, Path] = {}

    @reads("CityJSON")
    def buildings(_path) -> Iterator[CityObject]:
        seen: set[str] = set()
        for piece in pieces:
            yield from _Piece(piece, head, path, notes, images, reference, fittings).buildings(seen)
        notes.files.append(path.name)

    return CityModel(reference, buildings(path), images, str(metadata.get("title") or ""),
                     str(metadata.get("referenceDate") or ""))


@reads("CityJSON")
def read_cityjson(path: str | os.PathLike, notes: ReadingNotes | None = None) -> CityModel:
    """All buildings of a CityJSON file or sequence at once, with coordinates as they stand: its reference is not asked.

    Raises
    ------
    InputError : it is no CityJSON, or is damaged.
    """
    path, notes, images = Path(path), notes or ReadingNotes(), {}
    head, pieces = _opened(path, SILENT)
    seen: set[str] = set()
    buildings = [building for piece in pieces
                 for building in _Piece(piece, head, path, notes, images, CityReference()).buildings(seen)]
    return CityModel(CityReference(), buildings, images)


def _opened(path: Path, progress: Progress) -> tuple[Mapping, Iterator[Mapping]]:
    """The head of a file, and the objects or features that hold its buildings."""
    head = _first_line(path)
    if head is not None:
        pieces: Iterator[Mapping] = _features(path, head, progress)
    else:
        head = read_json(path, "CityJSON")
        pieces = iter((head,))
    if not isinstance(head, Mapping) or head.get("type") != "CityJSON":
        raise InputError(say("{path} is not a CityJSON file: its type is not 'CityJSON'.", path=path.name))
    return head, pieces


def _first_line(path: Path) -> dict | None:
    """The head of a sequence; None where the file is one CityJSON object."""
    if unpacked_suffix(path) not in (".jsonl", ".ndjson"):
        return None
    with TextIOWrapper(open_unpacked(path), "utf-8-sig") as file:
        return _line(file.readline(_LONGEST_LINE), path, 1)


def _line(text: str, path: Path, number: int) -> dict:
    try:
        found = json.loads(text, parse_constant=lambda name: float("nan"))
    except (ValueError, RecursionError) as error:
        raise InputError(say("{path} is damaged: its line {number} is no JSON; export it again.", path=path.name,
                             number=number)) from error
    if not isinstance(found, dict):
        raise InputError(say("{path} is damaged: its line {number} is no object; export it again.", path=path.name,
                             number=number))
    return found


def _features(path: Path, head: Mapping, progress: Progress) -> Iterator[Mapping]:
    """Pieces of a sequence, one a line."""
    size, done = max(path.stat().st_size, 1), 0
    if head.get("CityObjects"):
        yield head
    with TextIOWrapper(open_unpacked(path), "utf-8-sig") as file:
        for number, text in enumerate(iter(lambda: file.readline(_LONGEST_LINE), ""), 1):
            done += len(text)
            if number > 1 and text.strip():
                yield _line(text, path, number)
                progress.step(min(done / size, 1.0))


def _reference(metadata: Mapping, path: Path, given: CityReference | None) -> CityReference:
    name = metadata.get("referenceSystem")
    if not name:
        if given is None:
            raise InputError(say("{path} names no coordinate reference system: give the one that it is in.",
                                 path=path.name))
        return given
    found = named_reference(str(name), path.name, given).reference
    stated = _TITLE_HEIGHTS.search(str(metadata.get("title") or ""))
    if found.heights == UNKNOWN_HEIGHTS and stated and stated.group(1) in JAPANESE:
        return CityReference(found.wkt, found.epsg, found.geographic, stated.group(1))
    return found


class _Piece:
    """One CityJSON object or feature: its vertices, appearance and city objects."""

    def __init__(self, content: Mapping, head: Mapping, path: Path, notes: ReadingNotes, images: dict[str, Path],
                 reference: CityReference, fittings: bool = False):
        self.path, self.notes, self.geographic = path, notes, reference.geographic
        self.kept = FITTINGS if fittings else ()
        self.reading = ""  # the object that is read, for messages
        self.objects = content.get("CityObjects")
        if not isinstance(self.objects, Mapping) or not isinstance(content.get("vertices"), list):
            raise InputError(say("{path} is damaged: it has no city objects or no vertices; export it again.",
                                 path=path.name))
        vertices = _vertices(content["vertices"], head.get("transform") or content.get("transform"), path)
        # Latitude first, as the codes of geographic systems have it, or longitude first: Japan and most of Asia lie
        # east of 90 degrees, where only one of the two can be a latitude.
        if reference.geographic and len(vertices) and np.abs(vertices[:, 0]).max() <= 90 < np.abs(vertices[:, 1]).max():
            vertices = vertices[:, [1, 0, 2]]
        self.vertices, self.turn = vertices, slice(None)
        with reading_part(path, "geometry-templates"):
            templates = head.get("geometry-templates") or {}
            self.templates = templates.get("templates") or ()
            self.template_vertices = _vertices(templates.get("vertices-templates") or [], None, path)
        with reading_part(path, "appearance"):
            appearance = content.get("appearance") or head.get("appearance") or {}
            self.images = [str(item.get("image") or "") for item in appearance.get("textures") or ()]
            self.places = np.asarray(appearance.get("vertices-texture") or [], dtype=float).reshape(-1, 2)
        for image in self.images:
            found = named_file(path, image, IMAGE)
            if found is not None:
                images[image] = found
            else:
                notes.missing_images.add(image)

    def buildings(self, seen: set[str]) -> Iterator[CityObject]:
        """Buildings with their parts; parts whose building is not there stand as buildings."""
        for key, item in self.objects.items():
            with reading_part(self.path, key):
                kind = item.get("type")
                parents = [name for name in item.get("parents") or () if name in self.objects]
                found = self._object(key, item, seen) if kind in _KINDS and not parents else None
            if kind not in _KINDS and not (kind in self.kept and parents):
                self.notes.others[str(kind)] += 1
            elif found is not None:
                yield found

    def _object(self, key: str, item: Mapping, seen: set[str], depth: int = 0) -> CityObject:
        problems: list[str] = []
        self.reading = key
        shapes = [shape for geometry in item.get("geometry") or () for shape in self._shapes(geometry, problems)]
        parts, fittings = [], []
        for child in item.get("children") or ():
            found = self.objects.get(child)
            if found is None:
                problems.append(say("its part {child} is not there", child=child))
            elif found.get("type") in self.kept and depth < _DEEPEST:
                fittings.append(self._object(child, found, seen, depth + 1))
            elif found.get("type") == BUILDING_PART and child != key and not found.get("children"):
                parts.append(self._object(child, found, seen))
            elif found.get("type") == BUILDING_PART:
                problems.append(say("its part {child} has parts of its own, which were left out", child=child))
        if key in seen:
            self.notes.repeated.append(key)
            problems.append("its id is there more than once")
            key = next(f"{key}-{number}" for number in range(2, 10**9) if f"{key}-{number}" not in seen)
        seen.add(key)
        attributes = {name: _value(value) for name, value in (item.get("attributes") or {}).items()}
        if any(isinstance(value, float) and not math.isfinite(value) for value in attributes.values()):
            raise InputError(say("{path} is damaged: an attribute of {key} is no finite number.", path=self.path.name,
                                 key=key))
        postal = [_value({name: value for name, value in address.items() if name != "location"})
                  for address in item.get("address") or ()]
        if postal:
            attributes[ADDRESS] = postal if len(postal) > 1 else postal[0]
        kind, attributes = self._kind(item, attributes)
        return CityObject(key, attributes, tuple(_two_outlines(shapes)), kind, tuple(parts),
                          tuple(dict.fromkeys(problems)), tuple(fittings))

    def _kind(self, item: Mapping, attributes: dict[str, Any]) -> tuple[str, dict[str, Any]]:
        """Kind of an object, and its attributes without what only says the kind."""
        kind = item.get("type")
        if kind == INSTALLATION:
            of_room = any(self.objects.get(name, {}).get("type") == BUILDING_ROOM for name in item["parents"])
            inner = attributes.get(_INNER) is True
            plain = {name: value for name, value in attributes.items() if name != _INNER or not inner}
            return (INNER_INSTALLATION if inner or of_room else INSTALLATION), plain
        if kind in FITTINGS:
            return str(kind), attributes
        return (BUILDING_PART if kind == BUILDING_PART and item.get("parents") else BUILDING), attributes

    def _shapes(self, geometry: Mapping, problems: list[str]) -> list[CityShape]:
        kind, lod = geometry.get("type"), str(geometry.get("lod", ""))
        boundaries = geometry.get("boundaries") or []
        semantics = geometry.get("semantics") or {}
        values = semantics.get("values")
        theme = next(iter((geometry.get("texture") or {}).values()), None) or {}
        textures = theme.get("values")
        if kind in ("MultiSurface", "CompositeSurface"):
            surfaces = self._shell(boundaries, values, semantics, textures, problems)
            outline = FOOTPRINT if lod.startswith("0") else MULTI_SURFACE
            return [CityShape("0" if outline == FOOTPRINT else lod, outline, (surfaces,))] if surfaces else []
        if kind == _INSTANCE:
            return self._instance(geometry, problems)
        if kind not in _SOLIDS:
            self.notes.unread[str(kind)] += 1
            return []
        solids = [(boundaries, values, textures)] if _SOLIDS[kind] == 1 else [
            (solid, _item_at(values, place), _item_at(textures, place)) for place, solid in enumerate(boundaries)]
        shapes = []
        for shells, codes, covers in solids:
            read = tuple(self._shell(shell, _item_at(codes, place), semantics, _item_at(covers, place), problems)
                         for place, shell in enumerate(shells))
            if read and read[0]:
                shapes.append(CityShape(lod, SOLID, read))
                gaps = sum(unmatched_edges(shell, 9 if self.geographic else 3) for shell in read)
                if gaps:
                    problems.append(say("its solid of level {lod} is not closed ({gaps} edges without a neighbour)",
                                        lod=lod, gaps=gaps))
        return shapes

    def _instance(self, geometry: Mapping, problems: list[str]) -> list[CityShape]:
        """A template at its place: corners times the matrix, then moved to the vertex that the instance names."""
        template = self.templates[_index(geometry["template"])]
        if template.get("type") == _INSTANCE or self.geographic:  # templates are in metres
            self.notes.unread[_INSTANCE] += 1
            return []
        matrix = np.asarray(geometry["transformationMatrix"], float).reshape(4, 4)
        own = self.vertices
        place = own[_index(geometry["boundaries"][0])]
        try:
            self.vertices = self.template_vertices @ matrix[:3, :3].T + matrix[:3, 3] + place
            # A mirror turns faces inside out.
            self.turn = slice(None, None, -1 if np.linalg.det(matrix[:3, :3]) < 0 else 1)
            return self._shapes(template, problems)
        finally:
            self.vertices, self.turn = own, slice(None)

    def _shell(self, faces: list, values: list | None, semantics: Mapping, textures: list | None,
               problems: list[str]) -> tuple[CitySurface, ...]:
        surfaces = []
        entries = semantics.get("surfaces") or []
        for place, face in enumerate(faces):
            rings = [self._ring(ring) for ring in face]
            if not rings or rings[0] is None:
                problems.append(say("a face has fewer than three corners"))
                continue
            number = _item_at(values, place)
            entry = entries[number] if isinstance(number, int) and 0 <= number < len(entries) else {}
            kind = str(entry.get("type") or "")
            attributes = {name: _value(value) for name, value in entry.items() if name not in _STRUCTURE}
            surfaces.append(CitySurface(
                tuple(ring for ring in rings if ring is not None), kind if kind in SURFACE_KINDS else "", attributes,
                "", self._group(entries, number), self._texture(_item_at(textures, place), len(rings)),
                self._group(entries, entry.get("parent"))))
        return tuple(surfaces)

    def _group(self, entries: list, number: Any) -> str:
        """Id of a semantic surface; one of our own where it has none and openings tie it to another."""
        if not isinstance(number, int) or not 0 <= number < len(entries):
            return ""
        tied = "parent" in entries[number] or entries[number].get("children")
        return str(entries[number].get("id") or (f"s_{_OTHER.sub('_', self.reading)}_{number}" if tied else ""))

    def _ring(self, ring: list) -> np.ndarray | None:
        numbers = np.asarray(ring)
        if numbers.dtype.kind not in "iu" or numbers.ndim != 1:
            raise InputError(say("{path} is damaged: a ring of {key} is no list of vertices; export it again.",
                                 path=self.path.name, key=self.reading))
        if len(numbers) and (numbers.min() < 0 or numbers.max() >= len(self.vertices)):
            raise InputError(say("{path} is damaged: {key} names a vertex that is not there; export it again.",
                                 path=self.path.name, key=self.reading))
        return self.vertices[numbers[self.turn]] if len(numbers) >= 3 else None

    def _texture(self, rings: list | None, count: int) -> FaceTexture | None:
        if not rings or len(rings) != count or any(not ring or ring[0] is None for ring in rings):
            return None
        image = rings[0][0]
        if not 0 <= image < len(self.images) or any(max(ring[1:], default=0) >= len(self.places) for ring in rings):
            return None
        return FaceTexture(self.images[image], tuple(self.places[ring[1:]][self.turn] for ring in rings))


def _vertices(listed: list, transform: Mapping | None, path: Path) -> np.ndarray:
    """Vertices (n, 3) of a list, moved as the file says.

    Raises
    ------
    InputError : one is no list of three finite numbers, or the transform is none.
    """
    try:
        vertices = np.asarray(listed, dtype=np.float64).reshape(len(listed), 3)
    except (ArithmeticError, TypeError, ValueError) as error:
        raise InputError(say("{path} is damaged: its vertex {bad} is no list of three numbers; export it again.",
                             path=path.name, bad=_first_no_corner(listed))) from error
    with reading_part(path, "transform"):
        if transform and not np.asarray(transform["scale"], float).all():
            raise InputError(say("{path} is damaged: the scale of its “transform” is 0, so that all corners lie at one "
                                 "place; export it again.", path=path.name))
        if transform:
            vertices = vertices * np.asarray(transform["scale"], float).reshape(3) + np.asarray(
                transform["translate"], float).reshape(3)
    bad = first_not_finite(vertices)
    if bad is not None:
        raise InputError(say("{path} is damaged: its vertex {bad} has no finite coordinates.", path=path.name, bad=bad))
    return vertices


def _first_no_corner(listed: list) -> int:
    """Number, from 0, of the first vertex that is no list of three numbers."""
    for number, vertex in enumerate(listed):
        try:
            np.asarray(vertex, dtype=np.float64).reshape(3)
        except (ArithmeticError, TypeError, ValueError):
            return number
    return 0


def _two_outlines(shapes: list[CityShape]) -> list[CityShape]:
    """Of two outlines at level 0 the upper one is that of the roof."""
    flat = [place for place, shape in enumerate(shapes) if shape.kind == FOOTPRINT]
    if len(flat) == 2:
        upper = max(flat, key=lambda place: max(float(ring[:, 2].max()) for surface in shapes[place].surfaces
                                                for ring in surface.rings))
        shapes[upper] = CityShape("0", ROOF_EDGE, shapes[upper].shells)
    return shapes


def _value(value: Any) -> Any:
    """A value of JSON as the record has it."""
    if isinstance(value, Mapping):
        return AttributeGroup(str(value.get("type") or ""),
                              {name: _value(item) for name, item in value.items() if name != "type"})
    if isinstance(value, list):
        return [_value(item) for item in value]
    return value


def _index(value: Any) -> int:
    """A place in a list.

    Raises
    ------
    ValueError : it is none.
    """
    if not isinstance(value, int) or value < 0:
        raise ValueError(value)
    return value


def _item_at(values: list | None, place: int) -> Any:
    return values[place] if values is not None and place < len(values) else None
