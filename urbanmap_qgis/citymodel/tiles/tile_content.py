"""The content of one tile: buildings as glTF with an id for each and their attributes in a table.

Source: Khronos glTF 2.0, EXT_mesh_features, EXT_structural_metadata; OGC 3D Tiles 1.1.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError
from ...geometry.solid import GROUND, OUTER_WALL, OVERHANG, ROOF
from ...geometry.triangulation import triangulate_face
from ...io.models.glb_file import GlbBuffer
from ...io.models.gltf import SAMPLER, SURFACE_COLOURS
from ...wording import say
from ..model import CEILING_SURFACE, FLOOR_SURFACE, GROUND_SURFACE, ROOF_SURFACE, WALL_SURFACE, CitySurface
from .property_table import property_table

_LOOKS = {ROOF_SURFACE: ROOF, WALL_SURFACE: OUTER_WALL, GROUND_SURFACE: GROUND, CEILING_SURFACE: OVERHANG,
          FLOOR_SURFACE: ROOF}
_NO_AREA = 1e-12


@dataclass(frozen=True, eq=False)
class TileBuilding:
    """A building in a tile: attributes, and triangles (t, 3, 3) with places in an image (t, 3, 2) by look.

    The key is the kind of the surface, or "image:" and the image's name. Coordinates are earth-centred, m.
    """

    attributes: Mapping[str, Any]
    triangles: Mapping[str, np.ndarray]
    places: Mapping[str, np.ndarray]


def look_of(surface: CitySurface, textured: bool) -> str:
    """Key of a surface's material."""
    if textured and surface.texture is not None:
        return f"image:{surface.texture.image}"
    return _LOOKS.get(surface.kind, OUTER_WALL)


def surface_triangles(surface: CitySurface) -> tuple[np.ndarray, np.ndarray]:
    """Corners (t, 3, 3) of a surface's triangles, and their numbers (t, 3) among the corners of all its rings.

    Raises
    ------
    ValueError : its rings cross each other.
    """
    corners = np.vstack(surface.rings)
    ends = np.cumsum([0, *(len(ring) for ring in surface.rings)]).tolist()
    rings = [tuple(range(start, end)) for start, end in zip(ends[:-1], ends[1:])]
    numbers = np.array(triangulate_face(corners, rings), np.int64).reshape(-1, 3)
    return corners[numbers], numbers


def write_tile(path: str | os.PathLike, buildings: Sequence[TileBuilding], origin: np.ndarray, axes: np.ndarray,
               images: Mapping[str, Path]) -> None:
    """Write buildings to a .glb whose coordinates count from `origin` (3,) along east, north, up (`axes` (3, 3)).

    Raises
    ------
    InputError : a texture names an image that was not given.
    """
    with tempfile.TemporaryFile() as data:
        buffer = GlbBuffer(data, alignment=8)  # as property tables want it
        metadata = property_table([building.attributes for building in buildings], buffer)
        looks = sorted({look for building in buildings for look in building.triangles})
        files = {look: images.get(look.removeprefix("image:")) for look in looks if look.startswith("image:")}
        for look, file in files.items():
            if file is None:
                raise InputError(say("The image {look} of a texture was not given: its file is missing.",
                                     look=look.removeprefix("image:")))
        primitives = [_primitive(number, look, buildings, origin, axes, buffer) for number, look in enumerate(looks)]
        document = _document(looks, primitives, {look: file.read_bytes() for look, file in files.items()}, buffer)
        document["extensions"] = {"EXT_structural_metadata": metadata}
        document["bufferViews"] = buffer.views
        document["accessors"] = buffer.accessors
        document["buffers"] = [{"byteLength": buffer.length()}]
        with open(path, "wb") as target:
            buffer.write(target, document)


def _primitive(number: int, look: str, buildings: Sequence[TileBuilding], origin: np.ndarray, axes: np.ndarray,
               buffer: GlbBuffer) -> dict[str, Any]:
    """All triangles of one look, with the number of their building."""
    rows = [row for row, building in enumerate(buildings) if look in building.triangles]
    corners = np.concatenate([buildings[row].triangles[look] for row in rows])
    owner = np.repeat(rows, [len(buildings[row].triangles[look]) for row in rows])
    local = (corners - origin) @ axes.T
    normal = np.cross(local[:, 1] - local[:, 0], local[:, 2] - local[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > _NO_AREA, normal / np.maximum(length, _NO_AREA), (0.0, 0.0, 1.0))
    attributes = {"POSITION": buffer.accessor(_y_up(local.reshape(-1, 3)), True),
                  "NORMAL": buffer.accessor(_y_up(np.repeat(normal, 3, axis=0))),
                  "_FEATURE_ID_0": buffer.accessor(np.repeat(owner, 3).astype(float))}
    if look.startswith("image:"):
        places = np.concatenate([buildings[row].places[look] for row in rows]).reshape(-1, 2)
        attributes["TEXCOORD_0"] = buffer.accessor(places * (1.0, -1.0) + (0.0, 1.0))
    features = {"featureCount": len(buildings), "attribute": 0, "propertyTable": 0, "label": "building"}
    return {"attributes": attributes, "material": number, "mode": 4,
            "extensions": {"EXT_mesh_features": {"featureIds": [features]}}}


def _y_up(vectors: np.ndarray) -> np.ndarray:
    """East, north, up as x, y up and z to the south."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])


def _document(looks: Sequence[str], primitives: list[dict], contents: Mapping[str, bytes],
              buffer: GlbBuffer) -> dict[str, Any]:
    """The JSON without what the buffer says."""
    numbers = {look: number for number, look in enumerate(contents)}
    materials = []
    for look in looks:
        material: dict[str, Any] = {"metallicFactor": 0.0, "roughnessFactor": 1.0}
        if look in numbers:
            material["baseColorTexture"] = {"index": numbers[look]}
        else:
            material["baseColorFactor"] = [*SURFACE_COLOURS[look], 1.0]
        materials.append({"name": look, "pbrMetallicRoughness": material})
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "UrbanMap"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}], "materials": materials,
        "extensionsUsed": ["EXT_mesh_features", "EXT_structural_metadata"]}
    if contents:
        document["images"] = [
            {"bufferView": buffer.view(content), "name": look.removeprefix("image:"),
             "mimeType": "image/png" if content.startswith(b"\x89PNG") else "image/jpeg"}
            for look, content in contents.items()]
        document["textures"] = [{"source": number, "sampler": 0} for number in range(len(contents))]
        document["samplers"] = [SAMPLER]
    return document
