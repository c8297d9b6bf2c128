"""Solids of the geometry as objects of a city model, and the shells of such objects as vertices and faces."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF, Face, FaceTexture, Solid
from ..geometry.solid_faces import area_vector
from .model import (
    BUILDING_PART,
    CEILING_SURFACE,
    CLOSURE_SURFACE,
    DOOR,
    FLOOR_SURFACE,
    GROUND_SURFACE,
    INNER_WALL_SURFACE,
    ROOF_SURFACE,
    ROOM_CEILING,
    ROOM_FLOOR,
    SOLID,
    WALL_SURFACE,
    WINDOW,
    CityObject,
    CityShape,
    CitySurface,
)

KINDS = {ROOF: ROOF_SURFACE, OUTER_WALL: WALL_SURFACE, INNER_WALL: WALL_SURFACE, GROUND: GROUND_SURFACE,
         OVERHANG: CEILING_SURFACE}
"""Kind of a surface by the type of a solid's face."""

TYPES = {ROOF_SURFACE: ROOF, WALL_SURFACE: OUTER_WALL, GROUND_SURFACE: GROUND, CEILING_SURFACE: OVERHANG,
         FLOOR_SURFACE: ROOF, CLOSURE_SURFACE: INNER_WALL, WINDOW: OUTER_WALL, DOOR: OUTER_WALL,
         INNER_WALL_SURFACE: INNER_WALL, ROOM_CEILING: OVERHANG, ROOM_FLOOR: ROOF}
"""Type of a solid's face by the kind of a surface; what fills an opening is part of the wall."""

_SIDES = {OUTER_WALL: "outer", INNER_WALL: "inner"}


def surface_type(surface: CitySurface) -> str:
    """Type of face that a surface is, an outer wall where nothing is said; inner walls say so in `wall`."""
    if surface.kind == WALL_SURFACE and surface.attributes.get("wall") == _SIDES[INNER_WALL]:
        return INNER_WALL
    return TYPES.get(surface.kind, OUTER_WALL)


def solid_object(identifier: str, attributes: Mapping[str, Any] | None = None, solids: Sequence[Solid] = (),
                 textures: Sequence[Sequence[FaceTexture | None]] = (), lod: str = "1.3") -> CityObject:
    """A building of solids at one level of detail; `textures` has for each solid one entry a face, or is empty."""
    covers = textures or [()] * len(solids)
    shapes = [(CityShape(lod, SOLID, (solid_surfaces(solid, faces),)),) for solid, faces in zip(solids, covers)]
    return in_parts(CityObject(identifier, attributes or {}), shapes)


def in_parts(building: CityObject, shapes: Sequence[tuple[CityShape, ...]]) -> CityObject:
    """A building with the shapes of one solid, or with a part for each of several: a building is one solid only."""
    if len(shapes) <= 1:
        return replace(building, shapes=building.shapes + sum(shapes, ()))
    return replace(building, parts=tuple(CityObject(f"{building.id}-part-{number}", {}, part, BUILDING_PART)
                                         for number, part in enumerate(shapes, 1)))


def most_detailed(item: CityObject) -> tuple[CityShape, ...]:
    """Solids of an object, without its parts, at the highest level of detail that has any."""
    solids = [shape for shape in item.shapes if shape.kind == SOLID]
    best = max((shape.lod for shape in solids), default="")
    return tuple(shape for shape in solids if shape.lod == best)


def solid_rows(buildings: Iterable[CityObject]) -> list[tuple[CityObject, tuple[CityShape, ...]]]:
    """Buildings with their most detailed solids: one without has those of its parts, else its parts have own rows.

    A building whose parts are of a higher level of detail has no solid here: its own is a block about the parts.
    """
    rows: list[tuple[CityObject, tuple[CityShape, ...]]] = []
    for building in buildings:
        detailed = most_detailed(building)
        of_parts = [(part, most_detailed(part)) for part in building.parts]
        if detailed and detailed[0].lod[:1] >= max((solids[0].lod[:1] for _, solids in of_parts if solids), default=""):
            rows += [(building, detailed), *of_parts]
        else:
            rows.append((building, tuple(shape for _, solids in of_parts for shape in solids)))
    return rows


def solid_faces(solids: Sequence[CityShape]) -> shapely.MultiPolygon | None:
    """Faces of the outer shells of solids, with z; None where there are none."""
    polygons = [shapely.Polygon(surface.rings[0], surface.rings[1:]) for solid in solids
                for surface in solid.shells[0]]
    return shapely.MultiPolygon(polygons) if polygons else None


def outer_shells(building: CityObject) -> list[tuple[CitySurface, ...]]:
    """Outer shells of the most detailed solids of a building and its parts."""
    return [shape.shells[0] for _, solids in solid_rows([building]) for shape in solids]


def whole_metres(shells: Sequence[Sequence[CitySurface]]) -> tuple[float, float, float]:
    """The lowest corner of shells, rounded down to metres."""
    low = np.min([ring.min(axis=0) for shell in shells for surface in shell for ring in surface.rings], axis=0)
    return tuple(np.floor(low).tolist())


def indexed_shell(shell: Sequence[CitySurface]) -> tuple[np.ndarray, list[Face]]:
    """Vertices (V, 3) of a shell, each once in the order of their use, and its faces as rings of their numbers."""
    corners = np.concatenate([ring for surface in shell for ring in surface.rings])
    _, first, number = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    numbers = iter(rank[number.ravel()].tolist())
    faces = [tuple(tuple(next(numbers) for _ in ring) for ring in surface.rings) for surface in shell]
    return corners[first[order]], faces


def solid_surfaces(solid: Solid, textures: Sequence[FaceTexture | None] = (),
                   remarks: Sequence[Mapping[str, Any]] = ()) -> tuple[CitySurface, ...]:
    """Faces of a solid with their meaning: kind, slope and azimuth (degrees), area (m2), roof_id, and `remarks`."""
    surfaces = []
    for number, (face, kind, roof_id) in enumerate(zip(solid.faces, solid.surface_type, solid.roof_id)):
        rings = tuple(solid.vertices[list(ring)] for ring in face)
        normal = area_vector(solid.vertices, face)
        attributes: dict[str, Any] = {"area": round(float(np.linalg.norm(normal)), 2)}
        if kind == ROOF:
            attributes |= _inclination(normal)
        elif kind in _SIDES:
            attributes |= {"azimuth": _azimuth(normal), "wall": _SIDES[kind]}
        if roof_id is not None:
            attributes["roof_id"] = roof_id
        if remarks:
            attributes |= remarks[number]
        surfaces.append(CitySurface(rings, KINDS[kind], attributes, texture=textures[number] if textures else None))
    return tuple(surfaces)


def _inclination(normal: np.ndarray) -> dict[str, float]:
    """Slope of a roof, and the azimuth (from north, clockwise) of the way down where it has one, degrees."""
    slope = math.degrees(math.atan2(math.hypot(normal[0], normal[1]), normal[2]))
    found = {"slope": round(slope, 1)}
    return {**found, "azimuth": _azimuth(normal)} if found["slope"] > 0 else found


def _azimuth(normal: np.ndarray) -> float:
    return round(math.degrees(math.atan2(normal[0], normal[1])) % 360.0, 1) % 360.0
