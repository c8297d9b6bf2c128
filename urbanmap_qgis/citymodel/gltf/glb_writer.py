"""glTF 2.0 binary (.glb): buildings with their textures in one file, for viewers and web maps.

Source: Khronos glTF 2.0 specification. Coordinates count from a local origin, which stands in the file's `extras`,
because they are stored in single precision.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.atomic import written_beside
from ...progress import SILENT, Progress
from ...wording import say
from ..model import CityObject, CitySurface
from ..solids import outer_shells, whole_metres
from .glb_file import GlbBuffer
from .looks import add_primitive, image_contents, is_image, look_entries, look_of, surface_triangles


def write_glb(path: str | os.PathLike, buildings: Iterable[CityObject], images: Mapping[str, Path] | None = None, *,
              origin: tuple[float, float, float] | None = None, crs: str = "", progress: Progress = SILENT) -> int:
    """Write the most detailed solids of buildings to a glTF binary, a node each; return how many it holds.

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
        buffer, looks = GlbBuffer(data), {}
        names, meshes = [], []
        for building in buildings:
            progress.check()
            shells = outer_shells(building)
            if not shells:
                continue
            origin = whole_metres(shells) if origin is None else origin
            names.append(building.id)
            meshes.append({"name": building.id, "primitives": _primitives(shells, np.asarray(origin), looks, buffer)})
        extras = {"origin": list(origin or (0.0, 0.0, 0.0)), "crs": crs}
        document: dict[str, object] = {"asset": {"version": "2.0", "generator": "UrbanMap", "extras": extras}}
        if names:
            nodes = [{"name": name, "mesh": number} for number, name in enumerate(names)]
            document.update(scene=0, scenes=[{"nodes": list(range(len(nodes)))}], nodes=nodes, meshes=meshes,
                            **look_entries(list(looks), image_contents(list(looks), images or {}), buffer),
                            accessors=buffer.accessors, bufferViews=buffer.views,
                            buffers=[{"byteLength": buffer.length()}])
        with written_beside(path) as temporary, open(temporary, "wb") as target:
            buffer.write(target, document)
    return len(names)


def _primitives(shells: Sequence[Sequence[CitySurface]], origin: np.ndarray, looks: dict[str, int],
                buffer: GlbBuffer) -> list[dict]:
    """A primitive for each look of a building; `looks` gets a number for those that are new."""
    corners: dict[str, list[np.ndarray]] = {}
    places: dict[str, list[np.ndarray]] = {}
    for surface in (surface for shell in shells for surface in shell):
        look = look_of(surface)
        triangles, numbers = surface_triangles(surface)
        corners.setdefault(look, []).append(triangles - origin)
        if is_image(look):
            places.setdefault(look, []).append(np.vstack(surface.texture.uv)[numbers])
    return [add_primitive(buffer, looks.setdefault(look, len(looks)), np.concatenate(found),
                          np.concatenate(places[look]) if look in places else None)
            for look, found in corners.items()]
