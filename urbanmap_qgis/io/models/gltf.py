"""glTF 2.0 binary (.glb): buildings with their textures in one file, for viewers and web maps.

Source: Khronos glTF 2.0 specification. y is up and x to the east; coordinates count from a local origin, which
stands in the file's `extras`, because they are stored in single precision.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import IO

import numpy as np

from ...errors import InputError
from ...geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF
from ...geometry.triangulation import triangulate_face
from ...progress import SILENT, Progress
from ...wording import say
from ..files.atomic import written_beside
from .cityjson import CityBuilding
from .glb_file import GlbBuffer

SURFACE_COLOURS = {ROOF: (0.72, 0.28, 0.22), OUTER_WALL: (0.85, 0.82, 0.75), INNER_WALL: (0.75, 0.70, 0.62),
                   GROUND: (0.45, 0.45, 0.45), OVERHANG: (0.60, 0.56, 0.50)}
"""Red, green and blue, 0 to 1, of surfaces without an image."""

_REPEAT_NOT, _LINEAR, _SMALLER = 33071, 9729, 9987
SAMPLER = {"magFilter": _LINEAR, "minFilter": _SMALLER, "wrapS": _REPEAT_NOT, "wrapT": _REPEAT_NOT}
"""How images are looked at."""


def write_glb(path: str | os.PathLike, buildings: Iterable[CityBuilding], images: Mapping[str, Path] | None = None, *,
              origin: tuple[float, float, float] | None = None, crs: str = "", progress: Progress = SILENT) -> int:
    """Write the solids of buildings to a glTF binary; return how many buildings it holds.

    Parameters
    ----------
    images : PNG or JPEG files that the buildings' textures name.
    origin : point (m) that coordinates count from; by default the first building's corner in whole metres.
    crs : name of the coordinate reference system, for the file's `extras`.

    Raises
    ------
    InputError : the name has no ending .glb, or a texture names an image that was not given.
    OutputError : the file cannot be written.
    """
    if Path(path).suffix.lower() != ".glb":
        raise InputError(say("The model file {path} needs a name that ends in .glb.", path=Path(path).name))
    with tempfile.TemporaryFile() as data:
        file = _Glb(images or {}, data)
        for building in buildings:
            progress.check()
            if not building.solids:
                continue
            if origin is None:
                origin = tuple(np.floor(np.min([s.vertices.min(axis=0) for s in building.solids], axis=0)).tolist())
            file.add(building, np.asarray(origin))
        with written_beside(path) as temporary, open(temporary, "wb") as target:
            file.write(target, {"origin": list(origin or (0.0, 0.0, 0.0)), "crs": crs})
    return len(file.nodes)


class _Glb:
    """A file that grows building by building."""

    def __init__(self, images: Mapping[str, Path], data: IO[bytes]):
        self.given = images
        self.buffer = GlbBuffer(data)
        self.nodes: list[dict] = []
        self.meshes: list[dict] = []
        self.materials: dict[str, int] = {}
        self.images: dict[str, int] = {}
        self.media: dict[str, str] = {}

    def add(self, building: CityBuilding, origin: np.ndarray) -> None:
        """A node of the building's name with a mesh: a primitive for each material."""
        parts: dict[str, list[tuple[np.ndarray, np.ndarray, np.ndarray | None]]] = {}
        for number, solid in enumerate(building.solids):
            textures = building.textures[number] if building.textures else [None] * len(solid.faces)
            for face, (rings, texture) in enumerate(zip(solid.faces, textures)):
                key = texture.image if texture else solid.surface_type[face]
                parts.setdefault(key, []).append(upright_triangles(solid.vertices - origin, rings, texture))
        primitives = [self._primitive(key, pieces) for key, pieces in parts.items()]
        self.nodes.append({"name": building.id, "mesh": len(self.meshes)})
        self.meshes.append({"name": building.id, "primitives": primitives})

    def _primitive(self, key: str, pieces: list) -> dict:
        places, normals, uv = zip(*pieces)
        attributes = {"POSITION": self.buffer.accessor(np.vstack(places), True),
                      "NORMAL": self.buffer.accessor(np.vstack(normals))}
        if uv[0] is not None:
            attributes["TEXCOORD_0"] = self.buffer.accessor(np.vstack(uv))
        return {"attributes": attributes, "material": self._material(key, uv[0] is not None), "mode": 4}

    def _material(self, key: str, image: bool) -> int:
        if image and key not in self.images:
            if key not in self.given:
                raise InputError(say("The image {key} of a texture was not given.", key=key))
            image = self.given[key].read_bytes()
            self.images[key] = self.buffer.view(image)
            self.media[key] = "image/png" if image.startswith(b"\x89PNG") else "image/jpeg"
        return self.materials.setdefault(key, len(self.materials))

    def write(self, target: IO[bytes], extras: dict) -> None:
        """Write the whole file."""
        document = {"asset": {"version": "2.0", "generator": "UrbanMap", "extras": extras}}
        length = self.buffer.length()
        if self.nodes:
            document.update(scene=0, scenes=[{"nodes": list(range(len(self.nodes)))}], nodes=self.nodes,
                            meshes=self.meshes, accessors=self.buffer.accessors, bufferViews=self.buffer.views,
                            buffers=[{"byteLength": length}], materials=self._material_entries())
        if self.images:
            document.update(
                images=[{"bufferView": view, "name": name, "mimeType": self.media[name]}
                        for name, view in self.images.items()],
                textures=[{"source": number, "sampler": 0} for number in range(len(self.images))],
                samplers=[SAMPLER])
        self.buffer.write(target, document)

    def _material_entries(self) -> list[dict]:
        numbers = {name: number for number, name in enumerate(self.images)}
        entries = []
        for key in self.materials:
            look = {"metallicFactor": 0.0, "roughnessFactor": 1.0}
            if key in numbers:
                look["baseColorTexture"] = {"index": numbers[key]}
            else:
                look["baseColorFactor"] = [*SURFACE_COLOURS[key], 1.0]
            entries.append({"name": key, "pbrMetallicRoughness": look})
        return entries


def upright_triangles(vertices: np.ndarray, rings, texture) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Corners (3 t, 3) of a face's triangles, y up, their normals, and their places in the image, from the top."""
    corners = [vertex for triangle in triangulate_face(vertices, rings) for vertex in triangle]
    places = vertices[corners]
    a, b, c = places.reshape(-1, 3, 3).transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    uv = None
    if texture is not None:
        number = {vertex: place for place, vertex in enumerate(vertex for ring in rings for vertex in ring)}
        uv = np.vstack(texture.uv)[[number[vertex] for vertex in corners]] * (1.0, -1.0) + (0.0, 1.0)
    return _upright(places), _upright(np.repeat(normal, 3, axis=0)), uv


def _upright(vectors: np.ndarray) -> np.ndarray:
    """East, north, up as x, y up and z to the south."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])
