"""Textured models into files: glTF, OBJ with materials, CityJSON with appearance, and the image files."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

from ...citymodel.cityjson.writer import write_model_cityjson
from ...citymodel.gltf.glb_writer import write_glb
from ...citymodel.images import images_beside
from ...citymodel.model import CityModel, CityObject, CityReference
from ...citymodel.obj import write_obj
from ...errors import InputError, OutputError
from ...progress import SILENT, Progress
from ...wording import say
from .texture_stage import FacadeRecord, Textured

ENDINGS = (".glb", ".obj", ".city.json", ".json")

IN_FOLDER = ("model.glb", "model.obj", "model.city.json")
"""Files of an output folder, beside the folder of the images."""


def check_model_name(path: str | os.PathLike | None) -> None:
    """Refuse a model file whose ending is not one of `ENDINGS`.

    Raises
    ------
    InputError : with the endings that can be had.
    """
    if path is not None and not Path(path).name.lower().endswith(ENDINGS):
        raise InputError(say("The textured model {path} must end in .glb, .obj or .city.json.", path=Path(path).name))


def write_textured(buildings: Iterable[Textured], model: str | os.PathLike | None, folder: str | os.PathLike | None, *,
                   epsg: int | None = None, crs: str = "", progress: Progress = SILENT) -> list[FacadeRecord]:
    """Write textured buildings as they come, and return what became of their facades.

    Parameters
    ----------
    model : one file, by its ending .glb (which holds its images), .obj or .city.json (images in `<name>_textures`
        beside it); None for none.
    folder : folder that gets all three kinds and the images; None for none. Files of these names are replaced.

    Raises
    ------
    InputError : the model's ending is another.
    OutputError : a file cannot be written.
    """
    check_model_name(model)
    records: list[FacadeRecord] = []
    cities: list[CityObject] = []
    images: dict[str, Path] = {}
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as scratch:
        for number, textured in enumerate(buildings):
            records += textured.records
            cities.append(textured.city)
            for name, data in textured.images.items():
                images[name] = Path(scratch) / f"{number}-{len(images)}.jpg"
                images[name].write_bytes(data)
        city = CityModel(CityReference(epsg=epsg), cities, images, "UrbanMap textured buildings")
        if model is not None:
            _write(Path(model), city, f"{Path(model).name.split('.')[0]}_textures", crs, progress)
        for name in IN_FOLDER if folder is not None else ():
            _make_folder(Path(folder))
            _write(Path(folder) / name, city, "textures", crs, progress)
    return records


def _write(path: Path, model: CityModel, folder: str, crs: str, progress: Progress) -> None:
    """One model file; images are put into `folder` beside it unless the file holds them."""
    if path.suffix.lower() == ".glb":
        write_glb(path, model.buildings, model.images, crs=crs, progress=progress)
        return
    placed = images_beside(model, path, folder)
    if path.suffix.lower() == ".obj":
        write_obj(path, placed.buildings, progress=progress)
    else:
        write_model_cityjson(path, placed, progress)


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(say("The folder {folder} cannot be made ({strerror}): choose another output.", folder=folder,
                              strerror=error.strerror)) from error
