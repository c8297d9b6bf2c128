"""A city model as CityJSON 2.0: one file, or a sequence of features (CityJSONSeq) written building by building.

Source: CityJSON specifications 2.0.1 and CityJSONSeq, https://www.cityjson.org/
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from datetime import date
from typing import IO, Any

import numpy as np

from ...errors import InputError
from ...geometry.tolerances import UNITS
from ...io.files.atomic import written_beside
from ...progress import SILENT, Progress
from ...wording import say
from ..model import (
    ADDRESS,
    FOOTPRINT,
    INNER_INSTALLATION,
    INSTALLATION,
    MULTI_SURFACE,
    ROOF_EDGE,
    SOLID,
    UNKNOWN_HEIGHTS,
    AttributeGroup,
    CityModel,
    CityObject,
    CityReference,
    CityShape,
    CitySurface,
)
from ..objects import unique_objects, with_area_surfaces
from ..plain_values import plain_attributes
from ..reference import compound_epsg
from ..unknown_values import known_attributes
from .vertices import VertexList, json_text, write_end

THEME = "facades"
"""Name of the textures' theme."""

_LEVELS = {"4": "3.3"}
"""CityJSON has no level 4, that of interiors: it is the finest of level 3 there."""

_SURFACES = (FOOTPRINT, ROOF_EDGE, MULTI_SURFACE)


def write_model_cityjson(path: str | os.PathLike, model: CityModel, progress: Progress = SILENT) -> int:
    """Write a city model to a CityJSON 2.0 file, building by building; return how many buildings it holds.

    Images are named as the textures name them; putting them there is for the caller (`texture_images`).

    Raises
    ------
    InputError : two objects have the same id, or coordinates are degrees.
    OutputError : the file cannot be written.
    """
    _require_metres(model.reference)
    vertices, appearance, count = VertexList(), _Appearance(), 0
    with written_beside(path) as temporary, open(temporary, "w", encoding="utf-8", newline="\n") as file:
        file.write('{"type":"CityJSON","version":"2.0","CityObjects":{')
        written = False
        for building in unique_objects(model.buildings):
            progress.check()
            count += 1
            for identifier, item in _entries(with_area_surfaces(building), vertices, appearance):
                file.write((",\n" if written else "\n") + f"{json_text(identifier)}:{json_text(item)}")
                written = True
        file.write("\n}")
        if appearance.images:
            file.write(f',"appearance":{json_text(appearance.entry())}')
        write_end(file, vertices, compound_epsg(model.reference), _title(model), _day(model.date))
    return count


def write_model_cityjsonseq(path: str | os.PathLike, model: CityModel, progress: Progress = SILENT) -> int:
    """Write a city model as CityJSONSeq, a line a building; return how many. Memory does not grow with their number.

    Raises
    ------
    InputError : two objects have the same id, or coordinates are degrees.
    OutputError : the file cannot be written.
    """
    _require_metres(model.reference)
    count, origin = 0, None
    with written_beside(path) as temporary, open(temporary, "w", encoding="utf-8", newline="\n") as file:
        for building in map(with_area_surfaces, unique_objects(model.buildings)):
            progress.check()
            if origin is None:
                origin = _write_head(file, model, _corner(building))
            vertices, appearance = VertexList(), _Appearance()
            feature: dict[str, Any] = {"type": "CityJSONFeature", "id": building.id,
                                       "CityObjects": dict(_entries(building, vertices, appearance))}
            if appearance.images:
                feature["appearance"] = appearance.entry()
            points = np.frombuffer(vertices.coordinates, dtype=np.int64).reshape(-1, 3)
            feature["vertices"] = (points - origin).tolist()
            file.write(json_text(feature) + "\n")
            count += 1
        if origin is None:
            _write_head(file, model, np.zeros(3))
    return count


def _require_metres(reference: CityReference) -> None:
    """Vertices are whole tenths of a millimetre, which degrees would lose."""
    if reference.geographic:
        raise InputError(say("CityJSON is written in metres, but the model counts in degrees: take it into a plane "
                             "reference system first."))


def _entries(item: CityObject, vertices: VertexList, appearance: _Appearance,
             owner: str = "") -> Iterator[tuple[str, dict]]:
    """Ids and entries of a building, its parts and fittings in CityObjects; `owner` : id of what an object belongs
    to."""
    inner = item.type == INNER_INSTALLATION
    entry: dict[str, Any] = {"type": INSTALLATION if inner else item.type}
    belonging = (*item.parts, *item.fittings)
    if owner:
        entry["parents"] = [owner]
    if belonging:
        entry["children"] = [one.id for one in belonging]
    postal = _addresses(item)
    attributes = known_attributes(plain_attributes({name: value for name, value in item.attributes.items()
                                                    if name != ADDRESS or not postal}))
    if inner:
        attributes["interior"] = True
    if item.problems:
        attributes["problems"] = "; ".join(item.problems)
    if attributes or not owner:
        entry["attributes"] = attributes
    if postal:
        entry["address"] = postal
    entry["geometry"] = [_geometry(shapes, vertices, appearance) for shapes in _side_by_side(item.shapes)]
    yield item.id, entry
    for one in belonging:
        yield from _entries(one, vertices, appearance, item.id)


def _addresses(item: CityObject) -> list[dict[str, Any]]:
    """Postal addresses of an object as CityJSON has them; empty where its address is a plain attribute."""
    found = item.attributes.get(ADDRESS)
    groups = [group for group in (found if isinstance(found, (list, tuple)) else [found])
              if isinstance(group, AttributeGroup)]
    return [plain_attributes({"address": group})["address"] for group in groups]


def _side_by_side(shapes: tuple[CityShape, ...]) -> list[list[CityShape]]:
    """Shapes that make one geometry: solids of one level of detail, else each its own."""
    groups: list[list[CityShape]] = []
    for shape in shapes:
        if groups and shape.kind == SOLID == groups[-1][0].kind and shape.lod == groups[-1][0].lod:
            groups[-1].append(shape)
        else:
            groups.append([shape])
    return groups


def _geometry(shapes: list[CityShape], vertices: VertexList, appearance: _Appearance) -> dict[str, Any]:
    """One geometry: MultiSurface, Solid or MultiSolid."""
    surfaces = _Semantics()
    flat = shapes[0].kind in _SURFACES
    shells = [[_shell(shell, vertices, surfaces, appearance) for shell in shape.shells] for shape in shapes]
    kind = "MultiSurface" if flat else "Solid" if len(shapes) == 1 else "MultiSolid"

    def column(place: int) -> list:
        solids = [[shell[place] for shell in solid] for solid in shells]
        return solids[0][0] if flat and solids[0] else [] if flat else solids[0] if len(shapes) == 1 else solids

    level = _LEVELS.get(shapes[0].lod, shapes[0].lod)
    geometry: dict[str, object] = {"type": kind, "lod": level, "boundaries": column(0)}
    if surfaces.entries:
        geometry["semantics"] = {"surfaces": surfaces.linked(), "values": column(1)}
    if any(surface.texture for shape in shapes for surface in shape.surfaces):
        geometry["texture"] = {THEME: {"values": column(2)}}
    return geometry


def _shell(shell: tuple[CitySurface, ...], vertices: VertexList, surfaces: _Semantics,
           appearance: _Appearance) -> tuple[list, list, list]:
    """Boundary, numbers of semantics and textures of one shell."""
    boundary = [[vertices.numbers(ring) for ring in surface.rings] for surface in shell]
    return boundary, [surfaces.number(surface) for surface in shell], [appearance.rings(surface) for surface in shell]


class _Semantics:
    """Semantic surfaces of one geometry: polygons of one group share theirs."""

    def __init__(self) -> None:
        self.entries: list[dict[str, Any]] = []
        self._groups: dict[str, int] = {}
        self._parents: dict[int, str] = {}

    def number(self, surface: CitySurface) -> int | None:
        if not surface.kind:
            return None
        if surface.group in self._groups:
            return self._groups[surface.group]
        entry = {"type": surface.kind, **plain_attributes(surface.attributes)}
        if surface.group:
            entry["id"] = surface.group
            self._groups[surface.group] = len(self.entries)
        if surface.parent:
            self._parents[len(self.entries)] = surface.parent
        self.entries.append(entry)
        return len(self.entries) - 1

    def linked(self) -> list[dict[str, Any]]:
        """The entries, openings with the wall that they are in where this geometry has it."""
        for number, group in self._parents.items():
            if group in self._groups:
                self.entries[number]["parent"] = self._groups[group]
                self.entries[self._groups[group]].setdefault("children", []).append(number)
        return self.entries


class _Appearance:
    """Textures: images by name, and the places of vertices in them."""

    def __init__(self) -> None:
        self.images: dict[str, int] = {}
        self.places: list[tuple[float, float]] = []

    def rings(self, surface: CitySurface) -> list:
        """Number of the image and of the places of each ring; [None] a ring without."""
        texture = surface.texture
        if texture is None:
            return [[None]] * len(surface.rings)
        textured = []
        for uv in texture.uv:
            first = len(self.places)
            self.places.extend((round(u, 6), round(v, 6)) for u, v in np.asarray(uv).tolist())
            textured.append([self.images.setdefault(texture.image, len(self.images)), *range(first, len(self.places))])
        return textured

    def entry(self) -> dict[str, Any]:
        textures = [{"type": "PNG" if name.lower().endswith(".png") else "JPG", "image": name} for name in self.images]
        return {"default-theme-texture": THEME, "textures": textures, "vertices-texture": self.places}


def _write_head(file: IO[str], model: CityModel, corner: np.ndarray) -> np.ndarray:
    """Write the first line of a sequence; the origin that its vertices count from, in whole units."""
    metadata: dict[str, Any] = {"title": _title(model)} if _title(model) else {}
    if _day(model.date):
        metadata["referenceDate"] = _day(model.date)
    code = compound_epsg(model.reference)
    if code is not None:
        metadata["referenceSystem"] = f"https://www.opengis.net/def/crs/EPSG/0/{code}"
    head = {"type": "CityJSON", "version": "2.0", "transform": {"scale": [1 / UNITS] * 3, "translate": corner.tolist()},
            "metadata": metadata, "CityObjects": {}, "vertices": []}
    file.write(json_text(head) + "\n")
    return np.rint(corner * UNITS).astype(np.int64)


def _corner(building: CityObject) -> np.ndarray:
    """Lowest corner (3,) of a building in whole metres."""
    corners = [ring.min(axis=0) for item in building.objects() for shape in item.shapes
               for surface in shape.surfaces for ring in surface.rings]
    return np.floor(np.min(corners, axis=0)) if corners else np.zeros(3)


def _title(model: CityModel) -> str:
    """Title, with the height system where the code of the reference does not say it."""
    reference: CityReference = model.reference
    if reference.heights == UNKNOWN_HEIGHTS or compound_epsg(reference) != reference.epsg:
        return model.title
    return f"{model.title}; heights: {reference.heights}".lstrip("; ")


def _day(text: str) -> str:
    """The day of an ISO 8601 text, empty where it names none."""
    try:
        return date.fromisoformat(text[:10]).isoformat()
    except ValueError:
        return ""
