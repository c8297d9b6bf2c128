"""How surfaces look in glTF: triangles, normals, materials and images, for single models and for tiles alike.

Source: Khronos glTF 2.0 specification. y is up and x to the east.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError
from ...geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF
from ...geometry.tolerances import LEAST_SQUARE
from ...geometry.triangulation import triangulate_face
from ...wording import say
from ..images import web_image
from ..model import CitySurface
from ..solids import surface_type
from .glb_file import GlbBuffer

SURFACE_COLOURS = {ROOF: (0.72, 0.28, 0.22), OUTER_WALL: (0.85, 0.82, 0.75), INNER_WALL: (0.75, 0.70, 0.62),
                   GROUND: (0.45, 0.45, 0.45), OVERHANG: (0.60, 0.56, 0.50)}
"""Red, green and blue, 0 to 1, of surfaces without an image."""

_REPEAT_NOT, _LINEAR, _SMALLER = 33071, 9729, 9987
_SAMPLER = {"magFilter": _LINEAR, "minFilter": _SMALLER, "wrapS": _REPEAT_NOT, "wrapT": _REPEAT_NOT}
_IMAGE = "image:"


def look_of(surface: CitySurface, textured: bool = True) -> str:
    """Key of a surface's material: its type of face, or "image:" and the name of the image that covers it."""
    if textured and surface.texture is not None:
        return f"{_IMAGE}{surface.texture.image}"
    return surface_type(surface)


def is_image(look: str) -> bool:
    """Whether a look is an image."""
    return look.startswith(_IMAGE)


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


def add_primitive(buffer: GlbBuffer, material: int, corners: np.ndarray, places: np.ndarray | None = None,
                  owner: np.ndarray | None = None) -> dict[str, Any]:
    """Put triangles of one look into the buffer; the primitive that shows them.

    Parameters
    ----------
    corners : (t, 3, 3) east, north, up.
    places : (t, 3, 2) in the image, from its lower left corner.
    owner : (t,) number of the feature of each triangle.
    """
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > LEAST_SQUARE, normal / np.maximum(length, LEAST_SQUARE), (0.0, 0.0, 1.0))
    attributes = {"POSITION": buffer.accessor(_y_up(corners.reshape(-1, 3)), True),
                  "NORMAL": buffer.accessor(_y_up(np.repeat(normal, 3, axis=0)))}
    if owner is not None:
        attributes["_FEATURE_ID_0"] = buffer.accessor(np.repeat(owner, 3).astype(float))
    if places is not None:
        attributes["TEXCOORD_0"] = buffer.accessor(places.reshape(-1, 2) * (1.0, -1.0) + (0.0, 1.0))
    return {"attributes": attributes, "material": material, "mode": 4}


def image_contents(looks: Sequence[str], images: Mapping[str, Path]) -> dict[str, bytes]:
    """Bytes of the images that are looks, by look, as PNG or JPEG.

    Raises
    ------
    InputError : an image was not given.
    """
    contents = {}
    for look in filter(is_image, looks):
        name = look.removeprefix(_IMAGE)
        if name not in images:
            raise InputError(say("The image {look} of a texture was not given: its file is missing.", look=name))
        contents[look] = web_image(images[name])
    return contents


def look_entries(looks: Sequence[str], contents: Mapping[str, bytes], buffer: GlbBuffer) -> dict[str, Any]:
    """The document's materials, one a look in order, and its images, textures and sampler where it has any."""
    numbers = {look: number for number, look in enumerate(contents)}
    materials = []
    for look in looks:
        material: dict[str, Any] = {"metallicFactor": 0.0, "roughnessFactor": 1.0}
        if look in numbers:
            material["baseColorTexture"] = {"index": numbers[look]}
        else:
            material["baseColorFactor"] = [*SURFACE_COLOURS[look], 1.0]
        materials.append({"name": look.removeprefix(_IMAGE), "pbrMetallicRoughness": material})
    if not contents:
        return {"materials": materials}
    images = [{"bufferView": buffer.view(content), "name": look.removeprefix(_IMAGE),
               "mimeType": "image/png" if content.startswith(b"\x89PNG") else "image/jpeg"}
              for look, content in contents.items()]
    textures = [{"source": number, "sampler": 0} for number in range(len(contents))]
    return {"materials": materials, "images": images, "textures": textures, "samplers": [_SAMPLER]}


def _y_up(vectors: np.ndarray) -> np.ndarray:
    """East, north, up as x, y up and z to the south."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])
