"""Images of textures: which of them are there, put beside a file that names them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path, PurePosixPath

import numpy as np

from ..errors import InputError, OutputError
from ..io.files.named_files import IMAGE, is_kind
from ..progress import SILENT, Progress
from ..wording import say
from .model import CityModel
from .objects import retextured

_TIFF = (".tif", ".tiff")
_TIFF_STARTS = (b"II*\0", b"MM\0*")


def with_images_there(model: CityModel, progress: Progress = SILENT) -> CityModel:
    """A model, whose buildings are a sequence, without the textures whose image cannot be read, which is warned of."""
    present = {name: file for name, file in model.images.items() if _is_image(file)}
    lost = {surface.texture.image for item in model.buildings for part in item.objects() for shape in part.shapes
            for surface in shape.surfaces if surface.texture is not None} - set(present)
    if not lost:
        return replace(model, images=present)
    progress.warn(say("{lost_count} images of textures are not there ({lost}): their faces are written without.",
                      lost_count=len(lost), lost=", ".join(sorted(lost)[:3])))
    return replace(model, buildings=tuple(retextured(item, {name: name for name in present})
                                          for item in model.buildings), images=present)


def _is_image(file: Path) -> bool:
    try:
        with file.open("rb") as stream:
            start = stream.read(16)
        if start.startswith(_TIFF_STARTS):
            web_image(file)
        return is_kind(start, IMAGE)
    except (OSError, InputError):  # it has gone since the model was opened, may not be read, or is no whole TIFF
        return False


def web_image(path: Path) -> bytes:
    """The contents of an image as PNG or JPEG, which is all that glTF and CityJSON take; TIFF becomes PNG.

    Raises
    ------
    InputError : it is a TIFF that cannot be read.
    """
    contents = path.read_bytes()
    if not contents.startswith(_TIFF_STARTS):
        return contents
    import cv2

    pixels = cv2.imdecode(np.frombuffer(contents, np.uint8), cv2.IMREAD_COLOR)
    if pixels is None:
        raise InputError(say("The image {path} of a texture is a TIFF that cannot be read: save it as PNG or JPEG.",
                             path=path.name))
    return cv2.imencode(".png", pixels)[1].tobytes()


def web_name(name: str) -> str:
    """The name of an image as `web_image` gives it: .png instead of .tif and .tiff."""
    place = PurePosixPath(name)
    return str(place.with_suffix(".png")) if place.suffix.lower() in _TIFF else name


def images_beside(model: CityModel, path: str | os.PathLike, folder: str = "") -> CityModel:
    """The model with its images in a folder beside a file, which then names them there.

    Parameters
    ----------
    folder : its name, in which images keep theirs; empty for `<name>_textures`, in which they are numbered.

    Raises
    ------
    OutputError : an image cannot be copied.
    """
    if not model.images:
        return model
    path = Path(path)
    folder_name = folder or f"{path.name.split('.')[0]}_textures"
    plain = [PurePosixPath(name.replace(os.sep, "/")).name for name in model.images]
    names = {name: f"{folder_name}/{short if folder else web_name(f'{number}-{short}')}"
             for number, (name, short) in enumerate(zip(model.images, plain))}
    copy_images(path.parent, names, model.images)
    return replace(model, buildings=(retextured(item, names) for item in model.buildings),
                   images={names[name]: file for name, file in model.images.items()})


def copy_images(place: Path, names: Mapping[str, str], images: Mapping[str, Path]) -> None:
    """Copy the images of textures to their new names below a folder, each whole or not at all.

    Raises
    ------
    InputError : an image was not given.
    OutputError : it cannot be copied.
    """
    for image, name in names.items():
        if image not in images:
            raise InputError(say("The image {image} of a texture was not given: its file is missing.", image=image))
        target = place / name
        beside = target.with_name(f".{target.name}.part")
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            if target.suffix.lower() == ".png" and images[image].suffix.lower() in _TIFF:
                beside.write_bytes(web_image(images[image]))
            else:
                shutil.copyfile(images[image], beside)
            os.replace(beside, target)
        except OSError as error:
            raise OutputError(say("The image {place} cannot be written ({strerror}).", place=target,
                                  strerror=error.strerror)) from error
        finally:
            beside.unlink(missing_ok=True)
