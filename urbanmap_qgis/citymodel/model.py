"""The neutral record of a city model: what every reader gives and every writer takes.

Source: the terms of CityGML 2.0 (OGC 12-019) and CityJSON 2.0.1; levels of detail with a decimal are those of
F. Biljecki, H. Ledoux and J. Stoter, "An improved LOD specification for 3D building models" (2016).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from ..geometry.solid import FaceTexture
from ..wording import say

BUILDING, BUILDING_PART, ROAD = "Building", "BuildingPart", "Road"
TRAFFIC_AREA, AUXILIARY_AREA = "TrafficArea", "AuxiliaryTrafficArea"
ROAD_AREAS = (TRAFFIC_AREA, AUXILIARY_AREA)
"""What a road is divided into: areas for traffic, and areas beside it such as islands."""

CITY_FURNITURE, SINGLE_TREE = "CityFurniture", "SolitaryVegetationObject"
STREET_KINDS = (CITY_FURNITURE, SINGLE_TREE)
"""What stands in a street: posts, lamps, signals, signs; trees."""

STREET_SPACE = (ROAD, *STREET_KINDS)
"""What a city model may hold besides buildings."""

INSTALLATION, INNER_INSTALLATION = "BuildingInstallation", "IntBuildingInstallation"
BUILDING_ROOM, FURNITURE = "BuildingRoom", "BuildingFurniture"
FITTINGS = (INSTALLATION, INNER_INSTALLATION, BUILDING_ROOM, FURNITURE)
"""What belongs to a building, a part or a room besides its body: balconies and stairs, rooms, what is in them."""

ROOF_SURFACE, WALL_SURFACE, GROUND_SURFACE = "RoofSurface", "WallSurface", "GroundSurface"
CEILING_SURFACE, FLOOR_SURFACE, CLOSURE_SURFACE = "OuterCeilingSurface", "OuterFloorSurface", "ClosureSurface"
INNER_WALL_SURFACE, ROOM_CEILING, ROOM_FLOOR = "InteriorWallSurface", "CeilingSurface", "FloorSurface"
BOUNDARY_KINDS = (GROUND_SURFACE, WALL_SURFACE, ROOF_SURFACE, FLOOR_SURFACE, CEILING_SURFACE, CLOSURE_SURFACE,
                  INNER_WALL_SURFACE, ROOM_CEILING, ROOM_FLOOR)
WINDOW, DOOR = "Window", "Door"
OPENINGS = (WINDOW, DOOR)
SURFACE_KINDS = (*BOUNDARY_KINDS, *OPENINGS)

FOOTPRINT, ROOF_EDGE, SOLID, MULTI_SURFACE = "footprint", "roof edge", "solid", "multi surface"
"""Kinds of shapes: outline on the ground and of the roof (both level of detail 0), closed solid, loose surfaces."""

UNKNOWN_HEIGHTS = "unknown"

ADDRESS = "address"
"""Attribute that holds postal addresses: groups of `ADDRESS_TYPE` with xAL's elements by name, one in the other."""

ADDRESS_TYPE = "xAL:AddressDetails"


@dataclass(frozen=True)
class CodeValue:
    """A value of a list of codes: its code, the list's name (codeSpace), and what the list says, where it is known."""

    value: str
    space: str = ""
    meaning: str = ""


@dataclass(frozen=True)
class Measure:
    """A number with its unit, such as "m", "m2"."""

    value: float
    unit: str


@dataclass(frozen=True)
class AttributeGroup:
    """A value that has values of its own, such as uro:BuildingIDAttribute: its type and values by name, in order."""

    type: str
    values: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class CitySurface:
    """One polygon in space.

    Attributes
    ----------
    rings : each (n, 3), not closed, the outer one first; counterclockwise seen from outside.
    kind : one of `SURFACE_KINDS`, or empty where the source does not say.
    attributes : slope and azimuth (degrees), area (m2), what the source has.
    id : of the polygon in its source.
    group : id of the surface that the polygon belongs to, where several polygons are one roof or wall.
    parent : of an opening the group of the wall or roof that it is in.
    texture : the image that covers it.
    """

    rings: tuple[np.ndarray, ...]
    kind: str = ""
    attributes: Mapping[str, Any] = field(default_factory=dict)
    id: str = ""
    group: str = ""
    texture: FaceTexture | None = None
    parent: str = ""

    def __post_init__(self) -> None:
        """So that no writer is ever given a coordinate that is no number.

        Raises
        ------
        InputError : a coordinate is none.
        """
        if not all(np.isfinite(ring).all() for ring in self.rings):
            raise InputError(say("A surface of the model has coordinates that are no numbers, as a file without "
                                 "heights has them (a Shapefile of buildings, for example): give the models as they "
                                 "were made."))


@dataclass(frozen=True, eq=False)
class CityShape:
    """One geometry of an object at one level of detail.

    Attributes
    ----------
    lod : "0", "1", "1.2", "1.3", "2", "2.2", "3" ...
    kind : `FOOTPRINT`, `ROOF_EDGE`, `SOLID` or `MULTI_SURFACE`.
    shells : of a solid its outer shell, then its cavities; of the other kinds one tuple of surfaces.
    id : of the geometry in its source.
    """

    lod: str
    kind: str
    shells: tuple[tuple[CitySurface, ...], ...]
    id: str = ""

    @property
    def surfaces(self) -> tuple[CitySurface, ...]:
        """Surfaces of all shells."""
        return tuple(surface for shell in self.shells for surface in shell)


@dataclass(frozen=True, eq=False)
class CityObject:
    """A building, a part of one that stands alone, a road, what stands in a street (`STREET_KINDS`), or what belongs to
    a building (`FITTINGS`).

    Attributes
    ----------
    id : its own id; unique in the model.
    attributes : by name, in order. Values: number, text, bool, None, `datetime.date`, `CodeValue`, `Measure`,
        `AttributeGroup`, or a list of these. Names of CityGML's building and transportation
        modules stand alone ("measuredHeight", "function"), those
        of generic attributes and of extensions carry "gen:" and "uro:". Postal addresses stand under `ADDRESS`.
    shapes : all levels of detail side by side; several solids of one level are one geometry.
    type : `BUILDING`, `BUILDING_PART`, `ROAD`, one of `ROAD_AREAS`, of `STREET_KINDS` or of `FITTINGS`.
    parts : parts that stand alone, of a building only.
    problems : what a reader found wrong with the object, in words.
    fittings : its installations and rooms, a room's furniture, a road's areas.
    """

    id: str
    attributes: Mapping[str, Any] = field(default_factory=dict)
    shapes: tuple[CityShape, ...] = ()
    type: str = BUILDING
    parts: tuple[CityObject, ...] = ()
    problems: tuple[str, ...] = ()
    fittings: tuple[CityObject, ...] = ()

    def objects(self) -> Iterator[CityObject]:
        """The object and its parts."""
        yield self
        yield from self.parts

    def everything(self) -> Iterator[CityObject]:
        """The object, its parts, and what belongs to each of them."""
        yield self
        for item in (*self.parts, *self.fittings):
            yield from item.everything()

    def shapes_at(self, lod: str, kind: str = SOLID) -> tuple[CityShape, ...]:
        """Shapes of a kind at a level of detail; "2" stands for all of 2, 2.0 to 2.3."""
        return tuple(shape for shape in self.shapes if shape.kind == kind
                     and (shape.lod == lod or shape.lod.split(".")[0] == lod))


@dataclass(frozen=True)
class CityReference:
    """What coordinates count in: x to the east or longitude, y to the north or latitude (degrees), z up, m.

    Attributes
    ----------
    wkt : horizontal or compound coordinate reference system; empty where it is not known.
    epsg : code of the horizontal system, or of the compound one that the source names.
    geographic : x and y are longitude and latitude, degrees.
    heights : height system: "unknown", "JGD2000", "JGD2011", "JGD2024", "ellipsoidal" or "EPSG:<code>".
    """

    wkt: str = ""
    epsg: int | None = None
    geographic: bool = False
    heights: str = UNKNOWN_HEIGHTS


@dataclass(frozen=True, eq=False)
class CityModel:
    """Buildings, one after another as they are asked for, with what holds for all.

    Attributes
    ----------
    reference : of all coordinates.
    buildings : may be walked through once only, so that a city need not be in memory.
    images : files of the images that textures name, by that name.
    title : of the data set.
    date : of the data, ISO 8601 text, empty where not known.
    """

    reference: CityReference
    buildings: Iterable[CityObject]
    images: Mapping[str, Path] = field(default_factory=dict)
    title: str = ""
    date: str = ""
