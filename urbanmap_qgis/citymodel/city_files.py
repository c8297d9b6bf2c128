"""One city model into all the files that are wanted."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import Union

from ..errors import InputError, OutputError
from ..io.conversion.geoid import Geoid
from ..io.reference.height_systems import ELLIPSOIDAL, UNKNOWN
from ..progress import SILENT, Progress
from ..wording import known, say
from .city_sources import placed_model, refuse_exchanged
from .citygml.codelists import lists_of_module
from .citygml.plateau import PlateauDelivery, with_plateau_attributes
from .citygml.writer import write_citygml
from .cityjson.writer import write_model_cityjson, write_model_cityjsonseq
from .images import images_beside, with_images_there
from .model import FITTINGS, ROAD, STREET_KINDS, STREET_SPACE, CityModel, CityObject
from .objects import placed, rings_of, street_counts
from .reference import PLATEAU_SYSTEMS, city_reference
from .tiles.tiles_writer import write_tiles

_Place = Union[str, os.PathLike, None]


def write_city_files(model: CityModel, cityjson: _Place = None, cityjsonseq: _Place = None, citygml: _Place = None,
                     tiles: _Place = None, geoid: Geoid | None = None,
                     delivery: PlateauDelivery | None = None, progress: Progress = SILENT) -> None:
    """Write a model, whose buildings are a sequence, to each place that is not None; warn of heights that are not said
    and of images that are not there.

    Parameters
    ----------
    cityjson, cityjsonseq : files.
    citygml, tiles : folders.
    geoid : added to heights in 3D Tiles, unless they are ellipsoidal.
    delivery : what CityGML says of all its buildings.

    Raises
    ------
    InputError : the two coordinates in plan are exchanged.
    """
    place = next((rings[0][0] for rings in map(rings_of, model.buildings) if rings), None)
    if place is not None:
        refuse_exchanged(model.reference, place)
    delivery = delivery or PlateauDelivery()
    delivery = replace(delivery, created=delivery.created or model.date)
    model = with_images_there(model, progress)
    _tell_of_streets(model, progress)
    _warn_of_heights(model, citygml is not None, tiles is not None and geoid is None, progress)
    for number, (path, write) in enumerate(((cityjson, write_model_cityjson), (cityjsonseq, write_model_cityjsonseq))):
        if path is not None:
            plane = model_in_plane(model, progress) if model.reference.geographic else model
            write(path, images_beside(plane, path), progress)
        progress.step((number + 1) / 4)
    if citygml is not None:
        objects: Sequence[CityObject] = tuple(model.buildings)
        buildings = tuple(item for item in objects if item.type not in STREET_SPACE)
        ready = (with_plateau_attributes(item, number, delivery, model.reference.epsg in PLATEAU_SYSTEMS)
                 for number, item in enumerate(buildings, 1))
        others = (item for item in objects if item.type in STREET_SPACE)
        write_citygml(citygml, replace(model, buildings=chain(ready, others)), progress, delivery.version,
                      {**delivery.lists, **_street_lists(objects)})
        if delivery.schemas is not None and model.reference.epsg in PLATEAU_SYSTEMS:
            copy_schemas(delivery.schemas, citygml, delivery.version)
        missing = sum(not any(part.shapes for part in item.objects()) for item in buildings)
        if missing and model.reference.epsg in PLATEAU_SYSTEMS:
            progress.warn(say("{missing} buildings have no model and no place in a mesh: CityGML leaves them out.",
                              missing=missing))
    progress.step(0.75)
    if tiles is not None:
        fittings = sum(item.type in FITTINGS for building in model.buildings for item in building.everything())
        if fittings:
            progress.warn(say("3D Tiles have no place for installations and rooms of buildings: {count} are left out.",
                              count=fittings))
        heights = geoid.interpolate if geoid is not None and model.reference.heights != ELLIPSOIDAL.word else None
        write_tiles(tiles, model, heights, progress)
    progress.step(1.0)


def _street_lists(objects: Sequence[CityObject]) -> dict[str, Mapping[str, str]]:
    """Lists of codes of the modules that roads and what stands in a street need, where there are such."""
    kinds = {item.type for item in objects}
    return {name: codes for module, wanted in (("tran", {ROAD}), ("frn", set(STREET_KINDS))) if kinds & wanted
            for name, codes in lists_of_module(module).items()}


def copy_schemas(source: str | os.PathLike, folder: str | os.PathLike, version: str) -> None:
    """Copy the schemas of a version of i-UR to where a delivery has them (specification, 7.2.4.1).

    Parameters
    ----------
    source : folder with uro/<version>/urbanObject.xsd and urf/<version>/urbanFunction.xsd somewhere in it.

    Raises
    ------
    InputError : one of the two is not there.
    OutputError : one cannot be copied.
    """
    for module, name in (("uro", "urbanObject.xsd"), ("urf", "urbanFunction.xsd")):
        found = next((path for path in sorted(Path(source).rglob(name)) if path.parent.name == version
                      and path.parent.parent.name == module), None)
        if found is None:
            raise InputError(say("{source} holds no {module}/{version}/{name}: give the folder of i-UR's schemas.",
                                 source=source, module=module, version=version, name=name))
        place = Path(folder) / "schemas" / "iur" / module / version / name
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(found, place)
        except OSError as error:
            raise OutputError(say("The file {place} cannot be written ({strerror}).", place=place,
                                  strerror=error.strerror)) from error


def model_in_plane(model: CityModel, progress: Progress = SILENT) -> CityModel:
    """A model in degrees in metres, in the plane rectangular zone of its first building.

    Raises
    ------
    InputError : it lies outside of Japan.
    InsufficientDataError : it holds no building.
    """
    notes: list[str] = []
    wkt, buildings, places = placed_model(model, None, notes)
    for note in notes:
        progress.warn(note)
    reference = city_reference(wkt)
    return replace(model, reference=reference, buildings=(placed(item, places) for item in buildings))


def _tell_of_streets(model: CityModel, progress: Progress) -> None:
    """Say how many roads and street things go along, and how many have no surface that could be drawn."""
    roads, things, bare = street_counts(model.buildings)
    if roads or things:
        progress.message(say("{roads} roads, {things} things of city furniture and trees are written, too.",
                             roads=roads, things=things))
    if bare:
        progress.warn(say("{bare} of the roads, city furniture and trees have no surfaces: CityJSON has them without a "
                          "shape, 3D Tiles and PLATEAU's CityGML leave them out.", bare=bare))


def _warn_of_heights(model: CityModel, plateau: bool, bare: bool, progress: Progress) -> None:
    """Say what a format claims or leaves open of the heights."""
    heights = model.reference.heights
    if plateau and model.reference.epsg in PLATEAU_SYSTEMS and heights not in ("JGD2011", "JGD2024"):
        progress.warn(say("CityGML states heights in JGD2011 (EPSG:6697), but those of the models are {heights}: "
                          "give the height system, or convert the heights, if they are others.",
                          heights=known(heights)))
    if bare and heights != ELLIPSOIDAL.word:
        if heights == UNKNOWN.word:
            progress.warn(say("3D Tiles want heights above the ellipsoid, but the models do not state what theirs "
                              "count from, and they are written as they are: give a geoid model, or buildings sink or "
                              "float on a globe."))
        else:
            progress.warn(say("3D Tiles want heights above the ellipsoid, but those of the models are in {heights} and "
                              "are written as they are: give a geoid model, or buildings sink or float on a globe.",
                              heights=heights))
