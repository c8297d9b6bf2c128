"""CityJSON 2.0: buildings as solids with semantics, and solids read back from any CityJSON file.

Source: CityJSON specifications 2.0.1, https://www.cityjson.org/specs/2.0.1/
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import IO, Any

import numpy as np

from ...errors import InputError
from ...geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF, FaceTexture, Solid
from ...geometry.solid_faces import face_normal
from ...progress import SILENT, Progress
from ...wording import say
from ..files.atomic import written_beside
from ..files.guard import first_not_finite, read_json, reads
from .cityjson_parts import VertexList, json_text, json_value, write_end

_SEMANTICS = {
    ROOF: {"type": "RoofSurface"},
    OUTER_WALL: {"type": "WallSurface", "wall": "outer"},
    INNER_WALL: {"type": "WallSurface", "wall": "inner"},
    GROUND: {"type": "GroundSurface"},
    OVERHANG: {"type": "OuterCeilingSurface"},
}

_SOLIDS = ("Solid", "MultiSolid", "CompositeSolid")

_THEME = "facades"
"""Name of the textures' theme."""


@dataclass(frozen=True)
class CityBuilding:
    """A building to write: its id, attributes (numbers, texts, None) and solids, none if it has no model.

    `textures` has, for each solid, one entry a face: its texture or None; it may be left empty. `lod` is its level of
    detail, where it is not the file's.
    """

    id: str
    attributes: Mapping[str, Any] = field(default_factory=dict)
    solids: Sequence[Solid] = ()
    textures: Sequence[Sequence[FaceTexture | None]] = ()
    lod: str = ""


@dataclass(frozen=True, eq=False)
class ReadSolid:
    """Outer shell of a solid as read: vertices (V, 3), m, faces as rings of vertex indices, type of each face."""

    vertices: np.ndarray
    faces: tuple[tuple[tuple[int, ...], ...], ...]
    surface_type: tuple[str | None, ...]


@dataclass(frozen=True)
class ReadObject:
    """A city object as read, with its solids."""

    id: str
    type: str
    attributes: Mapping[str, Any]
    solids: tuple[ReadSolid, ...]


def write_cityjson(path: str | os.PathLike, buildings: Iterable[CityBuilding], *, epsg: int | None = None,
                   title: str = "", lod: str = "1.3", progress: Progress = SILENT) -> int:
    """Write buildings, one by one as they come, to a CityJSON 2.0 file; return how many.

    A building of one solid has a Solid, of several a MultiSolid, without a model an empty geometry list.
    The same buildings in the same order give the same bytes.

    Parameters
    ----------
    epsg : code of the coordinate reference system, if it has one.
    title : title of the data set in the metadata.

    Raises
    ------
    InputError : two buildings have the same id.
    OutputError : the file cannot be written.
    """
    vertices, appearance = VertexList(), _Appearance()
    seen: set[str] = set()
    with written_beside(path) as temporary, open(temporary, "w", encoding="utf-8", newline="\n") as file:
        file.write('{"type":"CityJSON","version":"2.0","CityObjects":{')
        for number, building in enumerate(buildings):
            progress.check()
            if building.id in seen:
                raise InputError(say("Two buildings have the id '{id}': give each building its own.", id=building.id))
            seen.add(building.id)
            file.write(",\n" if number else "\n")
            file.write(f"{json_text(building.id)}:{json_text(_city_object(building, lod, vertices, appearance))}")
        file.write("\n}")
        appearance.write(file)
        write_end(file, vertices, epsg, title)
    return len(seen)


def _city_object(building: CityBuilding, lod: str, vertices: VertexList, appearance: _Appearance) -> dict[str, Any]:
    """A building as a CityJSON object."""
    attributes = {str(name): json_value(value) for name, value in building.attributes.items()}
    geometry = []
    if building.solids:
        surfaces: list[dict] = []
        shells = [_shell(solid, vertices, surfaces) for solid in building.solids]
        one = len(shells) == 1
        boundaries = [[boundary] for boundary, _ in shells]
        values = [[value] for _, value in shells]
        geometry.append({
            "type": "Solid" if one else "MultiSolid",
            "lod": building.lod or lod,
            "boundaries": boundaries[0] if one else boundaries,
            "semantics": {"surfaces": surfaces, "values": values[0] if one else values},
        })
        if any(texture is not None for textures in building.textures for texture in textures):
            covers = [[appearance.shell(*pair)] for pair in zip(building.solids, building.textures)]
            geometry[-1]["texture"] = {_THEME: {"values": covers[0] if one else covers}}
    return {"type": "Building", "attributes": attributes, "geometry": geometry}


def _shell(solid: Solid, vertices: VertexList, surfaces: list[dict]) -> tuple[list, list[int]]:
    """Boundary of a solid's outer shell, and for each face its number in `surfaces`, which grows."""
    number = vertices.numbers(solid.vertices)
    boundary = [[[number[vertex] for vertex in ring] for ring in face] for face in solid.faces]
    values = []
    for face, surface_type, roof_id in zip(solid.faces, solid.surface_type, solid.roof_id):
        surface = dict(_SEMANTICS[surface_type])
        if surface_type == ROOF and np.ptp(solid.vertices[list(face[0]), 2]) > 0:
            surface |= _inclination(face_normal(solid.vertices, face))
        if roof_id is not None:
            surface["roof_id"] = json_value(roof_id)
        if surface not in surfaces:
            surfaces.append(surface)
        values.append(surfaces.index(surface))
    return boundary, values


def _inclination(normal: np.ndarray) -> dict[str, float]:
    """Slope and azimuth (clockwise from north, where it falls to) of a sloped face, degrees."""
    level = math.hypot(normal[0], normal[1])
    return {"slope": round(math.degrees(math.atan2(level, normal[2])), 1),
            "azimuth": round(math.degrees(math.atan2(normal[0], normal[1])) % 360.0, 1)}


class _Appearance:
    """The file's textures: images by name, and the places of vertices in them."""

    def __init__(self) -> None:
        self.images: dict[str, int] = {}
        self.places: list[tuple[float, float]] = []

    def shell(self, solid: Solid, textures: Sequence[FaceTexture | None]) -> list:
        """Number of the image and of the places of each ring of a shell's faces; [[None]] for a face without."""
        return [[self._ring(texture, ring) for ring in range(len(face))]
                for face, texture in zip(solid.faces, textures)]

    def _ring(self, texture: FaceTexture | None, ring: int) -> list:
        if texture is None:
            return [None]
        first = len(self.places)
        self.places.extend((round(u, 6), round(v, 6)) for u, v in texture.uv[ring].tolist())
        return [self.images.setdefault(texture.image, len(self.images)), *range(first, len(self.places))]

    def write(self, file: IO[str]) -> None:
        """Write the appearance of the file, where it has any."""
        if not self.images:
            return
        textures = [{"type": "PNG" if name.lower().endswith(".png") else "JPG", "image": name} for name in self.images]
        file.write(f',"appearance":{json_text({"default-theme-texture": _THEME, "textures": textures})[:-1]}'
                   f',"vertices-texture":{json_text(self.places)}}}')


@reads("CityJSON")
def read_cityjson(path: str | os.PathLike) -> tuple[ReadObject, ...]:
    """Read the city objects of a CityJSON file (1.0, 1.1, 2.0) and the outer shells of their solids.

    Solid, MultiSolid and CompositeSolid are read, of each object those of its highest level of detail; inner shells
    and other geometries are left out. A building without solids has those of its parts.

    Raises
    ------
    InputError : the file is missing, is not CityJSON, or names a vertex it does not have.
    """
    content = read_json(path, "CityJSON")
    if not isinstance(content, dict) or content.get("type") != "CityJSON":
        raise InputError(say("{path} is not a CityJSON file: its type is not 'CityJSON'.", path=path))
    try:
        vertices = np.asarray(content["vertices"], dtype=np.float64).reshape(-1, 3)
        transform = content.get("transform")
        if transform:
            vertices = vertices * np.asarray(transform["scale"]) + np.asarray(transform["translate"])
        bad = first_not_finite(vertices)
        if bad is not None:
            raise InputError(say("{path} is damaged: its vertex {bad} has no finite coordinates.", path=path, bad=bad))
        for key, item in content["CityObjects"].items():
            values = item.get("attributes", {}).values()
            if any(isinstance(value, float) and not math.isfinite(value) for value in values):
                raise InputError(say("{path} is damaged: an attribute of {key} is no finite number.", path=path,
                                     key=key))
        return _with_parts(content["CityObjects"], {
            key: ReadObject(key, item["type"], item.get("attributes", {}),
                            tuple(solid for geometry in _most_detailed(item.get("geometry", []))
                                  for solid in _solids(geometry, vertices)))
            for key, item in content["CityObjects"].items()})
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(say("{path} is damaged: a city object or its vertices cannot be understood.",
                             path=path)) from error


def _with_parts(items: Mapping[str, Mapping], objects: Mapping[str, ReadObject]) -> tuple[ReadObject, ...]:
    """Objects in which a building without solids has those of its parts, which are then left out."""
    owner = {key: str(item["parents"][0]) for key, item in items.items()
             if item["type"] == "BuildingPart" and item.get("parents")}
    taken: dict[str, list[ReadSolid]] = {}
    for key, parent in owner.items():
        if parent in objects and not objects[parent].solids:
            taken.setdefault(parent, []).extend(objects[key].solids)
    return tuple(replace(item, solids=tuple(taken[key])) if key in taken else item for key, item in objects.items()
                 if owner.get(key) not in taken)


def _most_detailed(geometries: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Geometries with solids of the highest level of detail that any has."""
    solids = [geometry for geometry in geometries if geometry["type"] in _SOLIDS]
    best = max((str(geometry.get("lod", "")) for geometry in solids), default="")
    return [geometry for geometry in solids if str(geometry.get("lod", "")) == best]


def _solids(geometry: Mapping[str, Any], vertices: np.ndarray) -> list[ReadSolid]:
    """Solids of one geometry, each with its own vertices."""
    one = geometry["type"] == "Solid"
    boundaries = [geometry["boundaries"]] if one else geometry["boundaries"]
    semantics = geometry.get("semantics") or {}
    values = semantics.get("values")
    values = [values] if one else values or [None] * len(boundaries)
    return [_read_shell(solid[0], value[0] if value else None, semantics.get("surfaces", []), vertices)
            for solid, value in zip(boundaries, values)]


def _read_shell(shell: list, values: list | None, surfaces: list, vertices: np.ndarray) -> ReadSolid:
    """One shell on its own vertices."""
    used = sorted({vertex for face in shell for ring in face for vertex in ring})
    local = {vertex: i for i, vertex in enumerate(used)}
    faces = tuple(tuple(tuple(local[vertex] for vertex in ring) for ring in face) for face in shell)
    types = [surfaces[v]["type"] if v is not None else None for v in values] if values else [None] * len(faces)
    return ReadSolid(vertices[used], faces, tuple(types))
