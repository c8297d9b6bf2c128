"""Wavefront OBJ: a group for each building, a material for each kind of surface, triangles.

Coordinates are written from a local origin, because most programs read OBJ in single precision.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, ROOF, Solid
from ..geometry.triangulation import triangulate_face
from ..progress import SILENT, Progress
from .atomic import written_beside
from .cityjson import CityBuilding

_MATERIALS = {
    ROOF: ("roof", (0.72, 0.28, 0.22)),
    OUTER_WALL: ("outer_wall", (0.85, 0.82, 0.75)),
    INNER_WALL: ("inner_wall", (0.75, 0.70, 0.62)),
    GROUND: ("ground", (0.45, 0.45, 0.45)),
}


def write_obj(path: str | os.PathLike, buildings: Iterable[CityBuilding], *,
              origin: tuple[float, float, float] | None = None, progress: Progress = SILENT) -> int:
    """Write the solids of buildings to an OBJ file and its materials to a .mtl beside it.

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
        raise InputError(f"The mesh file {target.name} needs a name that ends in .obj.")
    material_file = target.with_suffix(".mtl")
    written = vertices = 0
    with written_beside(material_file) as materials, written_beside(target) as temporary:
        materials.write_bytes(_material_text().encode("utf-8"))
        with open(temporary, "w", encoding="utf-8", newline="\n") as file:
            for building in buildings:
                progress.check()
                if not building.solids:
                    continue
                if origin is None:
                    origin = tuple(np.floor(np.min([s.vertices.min(axis=0) for s in building.solids], axis=0)).tolist())
                if not written:
                    file.write(_head(material_file.name, origin))
                file.write(f"g {_group(building.id)}\n")
                for solid in building.solids:
                    file.write(_solid_text(solid, np.asarray(origin), vertices))
                    vertices += len(solid.vertices)
                written += 1
            if not written:
                file.write(_head(material_file.name, origin or (0.0, 0.0, 0.0)))
    return written


def _head(material_file: str, origin: tuple[float, float, float]) -> str:
    """First lines of the file."""
    x, y, z = origin
    return f"# Add {x:.4f} {y:.4f} {z:.4f} to x y z for coordinates in metres; z is up.\nmtllib {material_file}\n"


def _group(name: str) -> str:
    """A building's id as a group name, which may hold no blanks."""
    return re.sub(r"\s+", "_", name.strip()) or "_"


def _solid_text(solid: Solid, origin: np.ndarray, before: int) -> str:
    """Vertices and faces of a solid; `before`: number of vertices already in the file."""
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in (solid.vertices - origin).tolist()]
    ordered = sorted(zip(solid.surface_type, solid.faces), key=lambda item: list(_MATERIALS).index(item[0]))
    for surface_type, faces in groupby(ordered, key=lambda item: item[0]):
        lines.append(f"usemtl {_MATERIALS[surface_type][0]}")
        for _, face in faces:
            lines.extend(f"f {a + before + 1} {b + before + 1} {c + before + 1}"
                         for a, b, c in triangulate_face(solid.vertices, face))
    return "\n".join(lines) + "\n"


def _material_text() -> str:
    """Text of the material file."""
    return "\n".join(f"newmtl {name}\nKd {r} {g} {b}\nd 1.0\n" for name, (r, g, b) in _MATERIALS.values())
