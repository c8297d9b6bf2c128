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

from ..gltf.glb_file import GlbBuffer
from ..gltf.looks import add_primitive, image_contents, is_image, look_entries
from .property_table import property_table


@dataclass(frozen=True, eq=False)
class TileBuilding:
    """A building in a tile: attributes, and triangles (t, 3, 3) with places in an image (t, 3, 2) by look.

    The key is the kind of the surface, or "image:" and the image's name. Coordinates are earth-centred, m.
    """

    attributes: Mapping[str, Any]
    triangles: Mapping[str, np.ndarray]
    places: Mapping[str, np.ndarray]


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
        contents = image_contents(looks, images)
        primitives = [_primitive(number, look, buildings, origin, axes, buffer) for number, look in enumerate(looks)]
        document = {
            "asset": {"version": "2.0", "generator": "UrbanMap"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}],
            "extensionsUsed": ["EXT_mesh_features", "EXT_structural_metadata"],
            **look_entries(looks, contents, buffer), "extensions": {"EXT_structural_metadata": metadata},
            "bufferViews": buffer.views, "accessors": buffer.accessors, "buffers": [{"byteLength": buffer.length()}]}
        with open(path, "wb") as target:
            buffer.write(target, document)


def _primitive(number: int, look: str, buildings: Sequence[TileBuilding], origin: np.ndarray, axes: np.ndarray,
               buffer: GlbBuffer) -> dict[str, Any]:
    """All triangles of one look, with the number of their building."""
    rows = [row for row, building in enumerate(buildings) if look in building.triangles]
    corners = np.concatenate([buildings[row].triangles[look] for row in rows])
    owner = np.repeat(rows, [len(buildings[row].triangles[look]) for row in rows])
    places = np.concatenate([buildings[row].places[look] for row in rows]) if is_image(look) else None
    features = {"featureCount": len(buildings), "attribute": 0, "propertyTable": 0, "label": "building"}
    return {**add_primitive(buffer, number, (corners - origin) @ axes.T, places, owner),
            "extensions": {"EXT_mesh_features": {"featureIds": [features]}}}
