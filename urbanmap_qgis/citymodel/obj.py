"""Wavefront OBJ: a group for each building, a material for each kind of surface, triangles.

Coordinates are written from a local origin, because most programs read OBJ in single precision.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..geometry.solid import Face, FaceTexture
from ..geometry.triangulation import triangulate_face
from ..io.files.atomic import written_beside
from ..progress import SILENT, Progress
from ..wording import say
from .gltf.looks import SURFACE_COLOURS
from .model import CityObject, CitySurface
from .solids import indexed_shell, outer_shells, surface_type, whole_metres

_MATERIALS = {kind: (kind.replace(" ", "_"), colour) for kind, colour in SURFACE_COLOURS.items()}
"""Name and colour of the material of each type of face."""


def write_obj(path: str | os.PathLike, buildings: Iterable[CityObject], *,
              origin: tuple[float, float, float] | None = None, progress: Progress = SILENT) -> int:
    """Write the most detailed solids of buildings to an OBJ file and its materials to a .mtl beside it.

    Faces with a texture get a material of their image, which is expected where its name says.

    Parameters
    ----------
    buildings : buildings, written one by one as they come; those without solids are left out.
    origin : point (m) that the file's coordinates count from; by default the first building's corner,
        rounded down to whole metres. It stands in a comment at the head of the file.

    Returns
    -------
    Number of buildings written.

    Raises
    ------
    OutputError : a file cannot be written.
    InputError : the output's name has no ending .obj.
    """
    target = Path(path)
    if target.suffix.lower() != ".obj":
        raise InputError(say("The mesh file {target} needs a name that ends in .obj.", target=target.name))
    material_file = target.with_suffix(".mtl")
    written = 0
    count = _Count()
    with written_beside(material_file) as materials, written_beside(target) as temporary:
        with open(temporary, "w", encoding="utf-8", newline="\n") as file:
            for building in buildings:
                progress.check()
                shells = outer_shells(building)
                if not shells:
                    continue
                if origin is None:
                    origin = whole_metres(shells)
                if not written:
                    file.write(_head(material_file.name, origin))
                file.write(f"g {_group(building.id)}\n")
                for shell in shells:
                    file.write(_shell_text(shell, np.asarray(origin), count))
                written += 1
            if not written:
                file.write(_head(material_file.name, origin or (0.0, 0.0, 0.0)))
        materials.write_bytes(_material_text(count.images).encode("utf-8"))
    return written


@dataclass
class _Count:
    """What is in the file already: vertices, places in images, images."""

    vertices: int = 0
    places: int = 0
    images: list[str] = field(default_factory=list)


def _head(material_file: str, origin: tuple[float, float, float]) -> str:
    """First lines of the file."""
    x, y, z = origin
    return f"# Add {x:.4f} {y:.4f} {z:.4f} to x y z for coordinates in metres; z is up.\nmtllib {material_file}\n"


def _group(name: str) -> str:
    """A building's id as a group name, which may hold no blanks."""
    return re.sub(r"\s+", "_", name.strip()) or "_"


def _shell_text(shell: Sequence[CitySurface], origin: np.ndarray, count: _Count) -> str:
    """Vertices and faces of a shell, first those without texture by type, then the others by image."""
    vertices, faces = indexed_shell(shell)
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in (vertices - origin).tolist()]
    kinds = list(_MATERIALS)
    order = sorted(range(len(faces)), key=lambda face: (
        shell[face].texture.image if shell[face].texture else "", kinds.index(surface_type(shell[face]))))
    material = None
    for face in order:
        texture = shell[face].texture
        wanted = _material_name(texture.image, count) if texture else _MATERIALS[surface_type(shell[face])][0]
        if wanted != material:
            material = wanted
            lines.append(f"usemtl {material}")
        lines.extend(_face_lines(vertices, faces[face], texture, count))
    count.vertices += len(vertices)
    return "\n".join(lines) + "\n"


def _face_lines(vertices: np.ndarray, face: Face, texture: FaceTexture | None, count: _Count) -> list[str]:
    """Triangles of a face, with places in its image where it has one."""
    triangles, before = triangulate_face(vertices, face), count.vertices + 1
    if texture is None:
        return [f"f {a + before} {b + before} {c + before}" for a, b, c in triangles]
    names = [vertex for ring in face for vertex in ring]
    places = np.vstack(texture.uv)
    number = {vertex: count.places + 1 + place for place, vertex in enumerate(names)}
    count.places += len(names)
    return [*(f"vt {u:.6f} {v:.6f}" for u, v in places.tolist()),
            *("f " + " ".join(f"{vertex + before}/{number[vertex]}" for vertex in triangle) for triangle in triangles)]


def _material_name(image: str, count: _Count) -> str:
    """Name of the material that shows an image."""
    if image not in count.images:
        count.images.append(image)
    return f"texture_{count.images.index(image)}"


def _material_text(images: Sequence[str]) -> str:
    """Text of the material file."""
    plain = [f"newmtl {name}\nKd {r} {g} {b}\nd 1.0\n" for name, (r, g, b) in _MATERIALS.values()]
    shown = [f"newmtl texture_{number}\nKd 1.0 1.0 1.0\nd 1.0\nmap_Kd {image}\n"
             for number, image in enumerate(images)]
    return "\n".join(plain + shown)
