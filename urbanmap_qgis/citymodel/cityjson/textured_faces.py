"""Faces with images of a textured CityJSON file, found again on the solids of the same buildings."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InputError
from ...geometry.solid import FaceTexture, Solid
from ...io.files.named_files import relative_name
from ...wording import say
from ..reading_notes import ReadingNotes
from .reader import read_cityjson

SAME = 0.02
"""Distance (m) up to which middles of faces are of one face, and corners one corner."""


@dataclass(frozen=True, eq=False)
class TexturedFaces:
    """Faces with an image: middles (f, 3), corners of the rings of each, their textures, files of the images.

    `missing` : names of images whose files are not there; their faces are left out.
    """

    middles: np.ndarray
    rings: tuple[tuple[np.ndarray, ...], ...]
    textures: tuple[FaceTexture, ...]
    images: Mapping[str, Path]
    missing: tuple[str, ...] = ()

    def of(self, solid: Solid) -> list[FaceTexture | None]:
        """Texture of each face of a solid, None where there is none."""
        if not len(self.middles):
            return [None] * len(solid.faces)
        tree = cKDTree(self.middles)
        textures = []
        for face in solid.faces:
            rings = [solid.vertices[list(ring)] for ring in face]
            distance, number = tree.query(rings[0].mean(axis=0))
            textures.append(self._on(rings, int(number)) if distance <= SAME else None)
        return textures

    def _on(self, rings: Sequence[np.ndarray], number: int) -> FaceTexture | None:
        """The texture of a known face for rings that may begin elsewhere; None where they have other corners."""
        corners, uv = np.vstack(self.rings[number]), np.vstack(self.textures[number].uv)
        distances, nearest = cKDTree(corners).query(np.vstack(rings))
        if distances.max() > SAME:
            return None
        ends = np.cumsum([len(ring) for ring in rings])[:-1]
        return FaceTexture(self.textures[number].image, tuple(np.split(uv[nearest], ends)))


def read_textured_faces(path: str | os.PathLike) -> TexturedFaces:
    """Faces with images of a CityJSON file, such as "Facade textures" writes.

    Raises
    ------
    InputError : it is no CityJSON, has no textures, or names an image outside of its own folder.
    """
    notes = ReadingNotes()
    model = read_cityjson(path, notes)
    missing = tuple(sorted(notes.missing_images))
    if not model.images and not missing:
        raise InputError(say("{path} has no textures: give the CityJSON file that “Facade textures” wrote.", path=path))
    for name in missing:
        _inside(Path(path), name)
    shown = [surface for building in model.buildings for item in building.objects() for shape in item.shapes
             for surface in shape.surfaces if surface.texture is not None and surface.texture.image in model.images]
    middles = np.array([surface.rings[0].mean(axis=0) for surface in shown]).reshape(-1, 3)
    return TexturedFaces(middles, tuple(surface.rings for surface in shown),
                         tuple(surface.texture for surface in shown), model.images, missing)


def _inside(path: Path, name: str) -> None:
    """Refuse an image that is not beside the model."""
    pure = relative_name(name)
    if pure is None or ".." in pure.parts:
        raise InputError(say("{path} names the image {name}, which is not in its own folder: move it there.",
                             path=path.name, name=name))
