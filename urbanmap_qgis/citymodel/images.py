"""Images of textures: read from a textured CityJSON file, put beside a file that names them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

import numpy as np
from scipy.spatial import cKDTree

from ..errors import InputError, OutputError
from ..geometry.solid import FaceTexture, Solid
from ..io.files.guard import read_json, reads
from ..io.files.named_files import IMAGE, is_kind, named_file, relative_name
from ..progress import SILENT, Progress
from ..wording import say
from .model import CityModel, CityObject

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
        made = []
        for face in solid.faces:
            rings = [solid.vertices[list(ring)] for ring in face]
            distance, number = tree.query(rings[0].mean(axis=0))
            made.append(self._on(rings, int(number)) if distance <= SAME else None)
        return made

    def _on(self, rings: Sequence[np.ndarray], number: int) -> FaceTexture | None:
        """The texture of a known face for rings that may begin elsewhere; None where they have other corners."""
        corners, uv = np.vstack(self.rings[number]), np.vstack(self.textures[number].uv)
        distances, nearest = cKDTree(corners).query(np.vstack(rings))
        if distances.max() > SAME:
            return None
        ends = np.cumsum([len(ring) for ring in rings])[:-1]
        return FaceTexture(self.textures[number].image, tuple(np.split(uv[nearest], ends)))


@reads("CityJSON with textures")
def read_textured_faces(path: str | os.PathLike) -> TexturedFaces:
    """Faces with images of a CityJSON file, such as "Facade textures" writes.

    Raises
    ------
    InputError : it is no CityJSON, has no textures, or names an image outside of its own folder.
    """
    content = read_json(path, "CityJSON")
    if not isinstance(content, dict) or content.get("type") != "CityJSON":
        raise InputError(say("{path} is not a CityJSON file: its type is not 'CityJSON'.", path=path))
    appearance = content.get("appearance") or {}
    names = [str(texture["image"]) for texture in appearance.get("textures", ())]
    if not names:
        raise InputError(say("{path} has no textures: give the CityJSON file that “Facade textures” wrote.", path=path))
    for name in names:
        _inside(Path(path), name)
    files = {name: named_file(path, name, IMAGE) for name in names}
    missing = tuple(name for name, file in files.items() if file is None)
    transform = content["transform"]
    vertices = np.asarray(content["vertices"], float) * transform["scale"] + transform["translate"]
    places = np.asarray(appearance["vertices-texture"], float)
    faces, textures = [], []
    for rings, images in _textured_rings(content):
        name = names[images[0][0]]
        if name not in missing:
            faces.append(tuple(vertices[ring] for ring in rings))
            textures.append(FaceTexture(name, tuple(places[image[1:]] for image in images)))
    middles = np.array([rings[0].mean(axis=0) for rings in faces]).reshape(-1, 3)
    return TexturedFaces(middles, tuple(faces), tuple(textures),
                         {name: file for name, file in files.items() if name not in missing}, missing)


def _inside(path: Path, name: str) -> None:
    """Refuse an image that is not beside the model."""
    pure = relative_name(name)
    if pure is None or ".." in pure.parts:
        raise InputError(say("{path} names the image {name}, which is not in its own folder: move it there.",
                             path=path.name, name=name))


def _textured_rings(content: Mapping) -> Iterator[tuple[list, list]]:
    """Rings of vertex numbers and of image numbers of each face that has a texture."""
    for item in content["CityObjects"].values():
        for geometry in item.get("geometry", ()):
            depth = {"MultiSurface": 0, "CompositeSurface": 0, "Solid": 1, "MultiSolid": 2, "CompositeSolid": 2}.get(
                geometry["type"])
            for theme in (geometry.get("texture") or {}).values():
                if depth is not None:
                    yield from ((rings, images) for rings, images in zip(_faces(geometry["boundaries"], depth),
                                                                         _faces(theme["values"], depth))
                                if images and all(image and image[0] is not None for image in images))


def _faces(nested: list, depth: int) -> list:
    """Faces of shells of solids, one after another."""
    for _ in range(depth):
        nested = [item for inner in nested for item in inner]
    return nested


def with_images_there(model: CityModel, progress: Progress = SILENT) -> CityModel:
    """A model, whose buildings are a sequence, without the textures whose image cannot be read, which is warned of."""
    there = {name: file for name, file in model.images.items() if _is_image(file)}
    lost = {surface.texture.image for item in model.buildings for part in item.objects() for shape in part.shapes
            for surface in shape.surfaces if surface.texture is not None} - set(there)
    if not lost:
        return replace(model, images=there)
    progress.warn(say("{lost_count} images of textures are not there ({lost}): their faces are written without.",
                      lost_count=len(lost), lost=", ".join(sorted(lost)[:3])))
    return replace(model, buildings=tuple(_retextured(item, {name: name for name in there})
                                          for item in model.buildings), images=there)


def _is_image(file: Path) -> bool:
    try:
        with file.open("rb") as stream:
            return is_kind(stream.read(16), IMAGE)
    except OSError:  # it has gone since the model was opened, or may not be read
        return False


def images_beside(model: CityModel, path: str | os.PathLike) -> CityModel:
    """The model with its images in the folder `<name>_textures` beside a file, which then names them there.

    Raises
    ------
    OutputError : an image cannot be copied.
    """
    if not model.images:
        return model
    path = Path(path)
    folder = f"{path.name.split('.')[0]}_textures"
    names = {name: f"{folder}/{number}-{PurePosixPath(name.replace(os.sep, '/')).name}"
             for number, name in enumerate(model.images)}
    for name, file in model.images.items():
        try:
            (path.parent / folder).mkdir(exist_ok=True)
            shutil.copyfile(file, path.parent / names[name])
        except OSError as error:
            raise OutputError(say("The image {parent} cannot be written ({strerror}).",
                                  parent=path.parent / names[name], strerror=error.strerror)) from error
    return replace(model, buildings=(_retextured(item, names) for item in model.buildings),
                   images={names[name]: file for name, file in model.images.items()})


def _retextured(item: CityObject, names: Mapping[str, str]) -> CityObject:
    """A building whose textures name their images anew; those of images without a new name are left out."""
    def new(texture: FaceTexture | None) -> FaceTexture | None:
        return FaceTexture(names[texture.image], texture.uv) if texture and texture.image in names else None

    shapes = tuple(replace(shape, shells=tuple(tuple(
        surface if surface.texture is None else replace(surface, texture=new(surface.texture))
        for surface in shell) for shell in shape.shells)) for shape in item.shapes)
    return replace(item, shapes=shapes, parts=tuple(_retextured(part, names) for part in item.parts))
