"""Building models of a layer as a city model with the source's ids: what the writers of all formats take."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ..citymodel.cityjson.textured_faces import TexturedFaces
from ..citymodel.model import CityObject
from ..geometry.solid import Solid
from ..progress import SILENT, Progress
from .building_model import BuildingModel, roof_remarks
from .city_objects import BuildingSource, building_source, city_objects
from .model_figures import ModelFigures

SAME = 0.01
"""Distance (m) up to which the middles of two faces are one."""


@dataclass(frozen=True, eq=False)
class SurfaceRows:
    """A layer of surfaces: polygons with z, the type ("roof", "inner wall" ...) and the roof of each; further
    attributes of each may be left out."""

    polygons: np.ndarray
    types: Sequence[str | None]
    roofs: Sequence[Hashable]
    remarks: Sequence[Mapping[str, Any]] = ()


def known_remarks(columns: Mapping[str, Sequence[Any]], rows: Sequence[int]) -> list[dict[str, float]]:
    """Numbers of some rows of columns by name; what is empty or no finite number is left out."""
    return [{name: float(values[row]) for name, values in columns.items()
             if isinstance(values[row], (int, float)) and math.isfinite(values[row])} for row in rows]


@dataclass(frozen=True, eq=False)
class ExportedBuildings:
    """Objects and figures in the rows' order; numbers of ids that had to be changed, of faces with an image."""

    objects: list[CityObject]
    figures: list[ModelFigures]
    renamed: int
    textured: int


def unique_ids(values: Sequence[Any]) -> tuple[list[str], int]:
    """Ids as text, each once: a second one of a name gets a number, an empty one its place; how many were changed."""
    taken = Counter(str(value).strip() for value in values if value is not None)
    unique: list[str] = []
    used: set[str] = set()
    changed = 0
    for row, value in enumerate(values, 1):
        text = "" if value is None else str(value).strip()
        name = text or f"building-{row}"
        number = 1
        while name in used or (name != text and name in taken):
            number += 1
            name = f"{text or f'building-{row}'}-{number}"
        changed += name != text
        used.add(name)
        unique.append(name)
    return unique, changed


def export_buildings(ids: Sequence[Any], faces: Sequence[shapely.Geometry | None],
                     attributes: Sequence[Mapping[str, Any]], lods: Sequence[str | None],
                     surfaces: SurfaceRows | None = None, textures: TexturedFaces | None = None,
                     progress: Progress = SILENT) -> ExportedBuildings:
    """Objects of a city model from rows of a layer of building models.

    Parameters
    ----------
    ids : of the source, made unique.
    faces : MultiPolygon with z of all faces of each building, None without a model.
    lods : level of detail of each, "1.3" or "2.2"; where it is not said, 2.2 with any sloped roof.
    surfaces : types and roofs of faces, where a layer has them.
    textures : images of faces.
    """
    names, renamed = unique_ids(ids)
    index = None if surfaces is None or not len(surfaces.polygons) else _middles(surfaces.polygons)
    sources, textured = [], 0
    for row, (name, geometry) in enumerate(zip(names, faces)):
        progress.check()
        source = building_source(name, geometry, attributes[row], str(lods[row] or ""))
        if index is not None:
            rows = [_rows_of(solid, index) for solid in source.solids]
            source = replace(source, solids=[_with_rows(solid, surfaces, solid_rows)
                                             for solid, solid_rows in zip(source.solids, rows)],
                             remarks=[_remarks(surfaces, solid_rows) for solid_rows in rows])
        if not source.lod:
            source = replace(source, lod=_level(source))
        if textures is not None:
            covers = [textures.of(solid) for solid in source.solids]
            textured += sum(texture is not None for cover in covers for texture in cover)
            source = replace(source, textures=covers)
        sources.append(source)
        progress.part(0.0, 0.5).step((row + 1) / len(names))
    objects, figures = [], []
    for row, (item, its) in enumerate(city_objects(sources)):
        progress.check()
        objects.append(item)
        figures.append(its)
        progress.part(0.5, 1.0).step((row + 1) / len(names))
    return ExportedBuildings(objects, figures, renamed, textured)


def objects_of_models(models: Sequence[BuildingModel], columns: Mapping[str, Sequence],
                      name_of: Callable[[int], str]) -> Iterator[CityObject]:
    """Models as objects with all levels of detail, one after another, without figures that need the neighbours.

    Parameters
    ----------
    columns : attributes, one entry a model; `building_id` is left out.
    name_of : id of a building by its number.
    """
    sources = [BuildingSource(name_of(model.building_id), {name: values[row] for name, values in columns.items()
                                                           if name != "building_id"}, model.solids, model.lod,
                              remarks=roof_remarks(model))
               for row, model in enumerate(models)]
    return (item for item, _ in city_objects(sources, walls=False))


def _middles(polygons: np.ndarray) -> tuple[cKDTree, np.ndarray]:
    """Middles of the corners of polygons, and the row of each."""
    parts, rows = shapely.get_parts(polygons, return_index=True)
    middles = np.array([shapely.get_coordinates(shapely.get_exterior_ring(part), include_z=True)[:-1].mean(axis=0)
                        for part in parts])
    return cKDTree(middles), rows


def _rows_of(solid: Solid, index: tuple[cKDTree, np.ndarray]) -> list[int | None]:
    """Row of the surface that each face of a solid is, None for none."""
    tree, rows = index
    middles = np.array([solid.vertices[list(rings[0])].mean(axis=0) for rings in solid.faces])
    distance, number = tree.query(middles)
    return [int(rows[place]) if off <= SAME else None for off, place in zip(distance, number)]


def _with_rows(solid: Solid, surfaces: SurfaceRows, face_rows: Sequence[int | None]) -> Solid:
    """A solid with the types and roofs that its faces' `face_rows` say."""
    kinds, roofs = list(solid.surface_type), list(solid.roof_id)
    for face, row in enumerate(face_rows):
        if row is not None:
            kinds[face] = surfaces.types[row] or kinds[face]
            roofs[face] = surfaces.roofs[row]
    return replace(solid, surface_type=tuple(kinds), roof_id=tuple(roofs))


def _remarks(surfaces: SurfaceRows, face_rows: Sequence[int | None]) -> list[Mapping[str, Any]]:
    """Further attributes of each face from its row among `face_rows`."""
    return [{} if row is None or not surfaces.remarks else surfaces.remarks[row] for row in face_rows]


def _level(source: BuildingSource) -> str:
    """Level of detail of solids: 2.2 where a roof is sloped."""
    sloped = any(kind == "roof" and np.ptp(solid.vertices[list(face[0]), 2]) > SAME for solid in source.solids
                 for face, kind in zip(solid.faces, solid.surface_type))
    return "2.2" if sloped else "1.3"
