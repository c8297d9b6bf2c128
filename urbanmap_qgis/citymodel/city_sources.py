"""City models from files, whatever their format: CityGML and CityJSON, one or many, in the reference that is wanted."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
from pyproj import CRS, Transformer

from ..errors import InputError, InsufficientDataError
from ..io.conversion.reprojection import epsg_wkt, plane_transform
from ..io.files.packed import content_kind, unpacked_suffix
from ..io.official.gsi_sources import PathLike
from ..io.reference.height_systems import carried_heights, stating_heights
from ..io.reference.plane_rectangular import zone_epsg, zone_numbers
from ..progress import SILENT, Progress
from ..wording import say
from .citygml.reader import open_citygml
from .cityjson.reader import open_cityjson
from .model import CityModel, CityObject, CityReference
from .objects import rings_of
from .reading_notes import ReadingNotes

_JSON = (".json", ".jsonl", ".ndjson", ".cityjson")
_GML = (".gml", ".zip", ".citygml")
_BEYOND = 3.0
"""Models may lie so far beyond the area of use of their reference system, degrees."""

_JAPAN = (122.0, 20.0, 154.0, 46.0)


def open_city_model(path: PathLike | Sequence[PathLike], stack: ExitStack, notes: ReadingNotes,
                    given: CityReference | None = None, progress: Progress = SILENT, more: Collection[str] = (),
                    fittings: bool = False) -> CityModel:
    """Open city models: CityGML (.gml, .zip), CityJSON (.json), CityJSONSeq (.jsonl), also gzipped, or folders of
    them.

    The buildings are read while they are walked through, once; `stack` must stay open until then. Of CityGML
    the modules `more` come among them (`ROADS`, `STREET_THINGS` of the reader); `fittings` (installations and rooms)
    are else counted as left out.

    Raises
    ------
    InputError : nothing is there, a file is damaged, or files are in different reference systems.
    """
    given_paths = [Path(item) for item in ([path] if isinstance(path, (str, os.PathLike)) else path)]
    texts = [file for item in given_paths for file in _json_files(item)]
    others = [item for item in given_paths if not (item.is_file() and _json_files(item))
              and not (item.is_dir() and _json_files(item) and not _gml_there(item))]
    models = [open_cityjson(file, notes, given, progress, fittings) for file in texts]
    if others:
        models.insert(0, open_citygml(others, stack, notes, given, progress, more, fittings))
    if any(model.reference != models[0].reference for model in models):
        raise InputError(say("The city models are in different reference systems: load them in separate runs."))
    images = models[0].images if len(models) == 1 else {}
    return replace(models[0], images=images, buildings=itertools.chain.from_iterable(
        model.buildings for model in models))


def _json_files(path: Path) -> list[Path]:
    if path.is_dir():
        return sorted(file for file in path.rglob("*") if unpacked_suffix(file) in _JSON and file.is_file())
    return [path] if path.is_file() and (unpacked_suffix(path) in _JSON or content_kind(path) == "json") else []


def _gml_there(folder: Path) -> bool:
    return any(unpacked_suffix(file) in _GML for file in folder.rglob("*"))


def placed_model(model: CityModel, target_wkt: str | None, notes: list[str],
                 ) -> tuple[str, Iterator[CityObject], Callable[[np.ndarray], np.ndarray]]:
    """Where a model is to lie: WKT of the reference with its heights, the buildings, the function that moves corners.

    Parameters
    ----------
    target_wkt : wanted reference; None for the model's own, or in Japan's degrees the plane rectangular zone of the
        first building.
    notes : gets a sentence on a change of datum.

    Raises
    ------
    InputError : coordinates are exchanged, degrees lie outside of Japan without a wanted reference, or no
        transformation between the two is known.
    InsufficientDataError : there is no building.
    """
    buildings = iter(model.buildings)
    head = list(itertools.islice(buildings, 1))
    if not head:
        raise InsufficientDataError(say("The city model holds no building: give one that has buildings."))
    heading = head
    place = next((ring[0] for ring in rings_of(head[0])), None)
    while place is None:
        more = list(itertools.islice(buildings, 1))
        if not more:
            raise InsufficientDataError(say("No building of the city model has a geometry: give one with outlines or "
                                            "solids."))
        heading += more
        place = next((ring[0] for ring in rings_of(more[0])), None)
    source = model.reference.wkt
    refuse_exchanged(model.reference, place)
    target = target_wkt or (_own_zone(place) if model.reference.geographic else source)
    x, y = float(place[0]), float(place[1])
    transform = plane_transform(source, target, (x, y, x, y))
    if transform is not None and transform.description:
        notes.append(say("The city model was taken into another datum by {told}.", told=transform.description))

    def places(corners: np.ndarray) -> np.ndarray:
        if transform is None:
            return corners
        return np.column_stack([transform.coordinates(corners[:, :2]), corners[:, 2]])

    return (stating_heights(target, carried_heights(model.reference.heights)), itertools.chain(heading, buildings),
            places)


def refuse_exchanged(reference: CityReference, place: np.ndarray) -> None:
    """Refuse coordinates that lie where their reference system is used only with the two in plan exchanged.

    Raises
    ------
    InputError : they do.
    """
    crs = CRS.from_wkt(reference.wkt) if reference.wkt else None
    if crs is None or crs.geodetic_crs is None:
        return
    code = crs.to_epsg() if crs.area_of_use is None else None  # parts of compound systems come without their area
    area = CRS.from_epsg(code).area_of_use if code else crs.area_of_use
    west, south, east, north = area.bounds if area is not None else (-180.0, -90.0, 180.0, 90.0)
    degrees = Transformer.from_crs(crs, crs.geodetic_crs, always_xy=True)

    def inside(first: float, second: float, margin: float) -> bool:
        longitude, latitude = degrees.transform(first, second) if crs.is_projected else (first, second)
        return (west - margin <= longitude <= east + margin
                and max(south - margin, -90.0) <= latitude <= min(north + margin, 90.0))

    first, second = float(place[0]), float(place[1])
    if not inside(second, first, 0.0) or inside(first, second, _BEYOND):
        return
    if reference.geographic:
        raise InputError(say("Latitude and longitude of the city model are exchanged: as its reference system orders "
                             "degrees, its first building lies at latitude {latitude}, longitude {longitude}, and only "
                             "the other way round where the system is used. Export the model with the degrees in the "
                             "order of its reference system.",
                             latitude=f"{second:.5f}", longitude=f"{first:.5f}"))
    raise InputError(say("East and north of the city model are exchanged: as its reference system orders them, its "
                         "first building lies at east {east} m, north {north} m, and only the other way round where "
                         "the system is used. Export the model with the coordinates in the order of its reference "
                         "system, or name the system in its short form (EPSG:31467), which counts east first.",
                         east=f"{first:.0f}", north=f"{second:.0f}"))


def _own_zone(place: np.ndarray) -> str:
    longitude, latitude = float(place[0]), float(place[1])
    if not (_JAPAN[0] <= longitude <= _JAPAN[2] and _JAPAN[1] <= latitude <= _JAPAN[3]):
        raise InputError(say("The city model is in degrees outside of Japan: choose a projected coordinate reference "
                             "system in metres for the result."))
    return epsg_wkt(zone_epsg(int(zone_numbers(longitude, latitude)[0])))
