"""Objects of a city model taken one by one: each once, placed elsewhere, with images named anew, with closed shells."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from ..errors import InputError
from ..geometry.solid import FaceTexture
from ..wording import say
from .model import MULTI_SURFACE, ROAD, ROAD_AREAS, STREET_SPACE, CityObject, CityShape, CitySurface

Places = Callable[[np.ndarray], np.ndarray]
"""Function from corners (n, 3) as read to corners in another reference."""


def unique_objects(buildings: Iterable[CityObject]) -> Iterator[CityObject]:
    """Buildings as they come.

    Raises
    ------
    InputError : an id, of a building, a part or a fitting, was there before.
    """
    seen: set[str] = set()
    for building in buildings:
        for item in building.everything():
            if item.id in seen:
                raise InputError(say("Two buildings have the id '{id}': give each building its own.", id=item.id))
            seen.add(item.id)
        yield building


def rings_of(building: CityObject) -> list[np.ndarray]:
    """Rings (n, 3) of all surfaces of a building, its parts and fittings."""
    return [ring for item in building.everything() for shape in item.shapes for surface in shape.surfaces
            for ring in surface.rings]


def placed(building: CityObject, places: Places) -> CityObject:
    """A building with its parts and fittings in another reference: all its corners at once.

    Raises
    ------
    InputError : a corner has no place there; the sentence names the building.
    """
    rings = rings_of(building)
    if not rings:
        return building
    try:
        moved = places(np.concatenate(rings))
    except InputError as error:
        raise InputError(say("'{id}' has corners where its reference system cannot be computed: check the system, and "
                             "the corners by “Check city model or lane map”.", id=building.id)) from error
    moved_rings = iter(np.split(moved, np.cumsum([len(ring) for ring in rings])[:-1]))

    def with_places(item: CityObject) -> CityObject:
        shapes = tuple(replace(shape, shells=tuple(
            tuple(replace(surface, rings=tuple(next(moved_rings) for _ in surface.rings)) for surface in shell)
            for shell in shape.shells)) for shape in item.shapes)
        # In the order of `everything`: the object itself, then its parts, then its fittings.
        return replace(item, shapes=shapes, parts=tuple(with_places(part) for part in item.parts),
                       fittings=tuple(with_places(fitting) for fitting in item.fittings))

    return with_places(building)


def with_area_surfaces(road: CityObject) -> CityObject:
    """A road whose areas are semantic surfaces of its own, a shape a level of detail, as CityJSON and 3D Tiles have
    them; any other object as it is."""
    if road.type != ROAD or not road.fittings:
        return road
    levels: dict[str, list[CitySurface]] = {}
    for area in (item for item in road.fittings if item.type in ROAD_AREAS):
        for shape in area.shapes:
            levels.setdefault(shape.lod, []).extend(
                replace(surface, kind=area.type, group=area.id, attributes=area.attributes)
                for surface in shape.surfaces)
    return replace(road, shapes=(*road.shapes, *(CityShape(lod, MULTI_SURFACE, (tuple(surfaces),))
                                                 for lod, surfaces in sorted(levels.items()))),
                   fittings=tuple(item for item in road.fittings if item.type not in ROAD_AREAS))


def street_counts(objects: Iterable[CityObject]) -> tuple[int, int, int]:
    """How many roads there are, how many street things, and how many of both have no surface."""
    found = [item for item in objects if item.type in STREET_SPACE]
    roads = sum(item.type == ROAD for item in found)
    return roads, len(found) - roads, sum(not rings_of(item) for item in found)


def retextured(item: CityObject, names: Mapping[str, str]) -> CityObject:
    """A building whose textures name their images anew; those of images without a new name are left out."""
    def new(texture: FaceTexture | None) -> FaceTexture | None:
        return FaceTexture(names[texture.image], texture.uv) if texture and texture.image in names else None

    shapes = tuple(replace(shape, shells=tuple(tuple(
        surface if surface.texture is None else replace(surface, texture=new(surface.texture))
        for surface in shell) for shell in shape.shells)) for shape in item.shapes)
    return replace(item, shapes=shapes, parts=tuple(retextured(part, names) for part in item.parts),
                   fittings=tuple(retextured(fitting, names) for fitting in item.fittings))


def unmatched_edges(shell: tuple[CitySurface, ...], digits: int) -> int:
    """Edges of a shell that no other face has in the opposite sense; corners are equal within `digits` (height: mm)."""
    count: Counter = Counter()
    places = np.array([digits, digits, 3])
    for surface in shell:
        for ring in surface.rings:
            corners = list(map(tuple, np.rint(ring * 10.0**places).tolist()))
            for start, end in zip(corners, corners[1:] + corners[:1]):
                if start != end:
                    count[start, end] += 1
    return sum(number for (start, end), number in count.items() if count.get((end, start), 0) != number)
