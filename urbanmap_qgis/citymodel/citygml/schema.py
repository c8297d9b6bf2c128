"""What of CityGML its reader, writer and checks know, as tables: modules, geometry, attributes and their values.

A change of the schema is a change of these tables; the elements of i-UR, one table a version, are in `iur`.

Source: OGC 12-019 (CityGML 2.0), OGC 08-007r1 (CityGML 1.0), OGC 03-105r1 (GML 3.1.1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from types import MappingProxyType

from ..model import (
    AUXILIARY_AREA,
    BUILDING,
    BUILDING_PART,
    BUILDING_ROOM,
    CITY_FURNITURE,
    FOOTPRINT,
    FURNITURE,
    INNER_INSTALLATION,
    INSTALLATION,
    MULTI_SURFACE,
    ROAD,
    ROOF_EDGE,
    SINGLE_TREE,
    SOLID,
    TRAFFIC_AREA,
    CodeValue,
    Measure,
)

CITYGML_SPACE = "http://www.opengis.net/citygml/"
GML = "http://www.opengis.net/gml"
GML_3_2 = "http://www.opengis.net/gml/3.2"
XLINK = "http://www.w3.org/1999/xlink"
XLINK_HREF = f"{{{XLINK}}}href"
XAL = "urn:oasis:names:tc:ciq:xsdschema:xAL:2.0"

WRITTEN_VERSION = "2.0"

MODULES: Mapping[str, str] = MappingProxyType({
    "building": "bldg", "transportation": "tran", "cityfurniture": "frn", "vegetation": "veg", "landuse": "luse",
    "relief": "dem", "bridge": "brid", "tunnel": "tun", "waterbody": "wtr", "generics": "gen",
    "cityobjectgroup": "grp", "appearance": "app"})
"""Usual prefixes by the modules' words in their namespaces, which go on with the version; the core has no word."""

EXTENSIONS = ("uro", "urf")
"""Prefixes of i-UR, which stand in its namespaces of any version."""

MEMBERS = frozenset({"cityObjectMember", "featureMember", "featureMembers"})
"""Properties of a city model that hold its objects."""

OBJECTS: Mapping[str, str] = MappingProxyType({"Building": BUILDING, "BuildingPart": BUILDING_PART})
"""Kinds of objects of the record by the elements of the building module."""

FITTING_ELEMENTS: Mapping[str, str] = MappingProxyType({
    "BuildingInstallation": INSTALLATION, "IntBuildingInstallation": INNER_INSTALLATION, "Room": BUILDING_ROOM,
    "BuildingFurniture": FURNITURE})
"""Kinds of fittings of the record by the elements of the building module."""

FITTING_PROPERTIES: Mapping[tuple[bool, str], str] = MappingProxyType({
    (False, INSTALLATION): "outerBuildingInstallation", (False, INNER_INSTALLATION): "interiorBuildingInstallation",
    (False, BUILDING_ROOM): "interiorRoom", (True, FURNITURE): "interiorFurniture",
    (True, INNER_INSTALLATION): "roomInstallation"})
"""Properties that hold fittings: by whether the owner is a room, and the fitting's kind."""

ROADS: Mapping[str, str] = MappingProxyType({"Road": ROAD})
"""Kinds of objects of the record by the elements of the transportation module."""

MODULE_OBJECTS: Mapping[str, Mapping[str, str]] = MappingProxyType({
    "bldg": OBJECTS, "tran": ROADS, "frn": {"CityFurniture": CITY_FURNITURE},
    "veg": {"SolitaryVegetationObject": SINGLE_TREE}})
"""Kinds of objects of the record by the modules' prefixes and elements."""

ROAD_PARTS = frozenset({"trafficArea", "auxiliaryTrafficArea"})
"""Properties of a road that hold its areas."""

ROAD_AREA_PROPERTIES: Mapping[str, str] = MappingProxyType({
    TRAFFIC_AREA: "trafficArea", AUXILIARY_AREA: "auxiliaryTrafficArea"})
"""Properties of a road that hold its areas, by their kinds, in the schema's order."""

THEMES: Mapping[str, str] = MappingProxyType({
    BUILDING: "bldg", BUILDING_PART: "bldg", ROAD: "tran", CITY_FURNITURE: "frn", SINGLE_TREE: "veg",
    TRAFFIC_AREA: "tran", AUXILIARY_AREA: "tran", **dict.fromkeys(FITTING_ELEMENTS.values(), "bldg")})
"""Prefixes of the modules by the kinds of objects, which are their folders, too, in PLATEAU's data."""

EXTENSIONS_FIRST = (SINGLE_TREE,)
"""Objects whose extensions are those of an abstract type: they stand before the object's own attributes."""

PART_PROPERTY, BOUNDARY_PROPERTY, OPENING_PROPERTY = "consistsOfBuildingPart", "boundedBy", "opening"
ADDRESS_PROPERTY = "address"


@dataclass(frozen=True)
class GeometryProperty:
    """A property of a building or a boundary surface that holds geometry: its level of detail, the kind of shape."""

    name: str
    lod: str
    kind: str


_SHAPES = (("Solid", SOLID), ("MultiSurface", MULTI_SURFACE))
GEOMETRY: Mapping[str, GeometryProperty] = MappingProxyType({item.name: item for item in (
    GeometryProperty("lod0FootPrint", "0", FOOTPRINT), GeometryProperty("lod0RoofEdge", "0", ROOF_EDGE),
    *(GeometryProperty(f"lod{lod}{ending}", lod, kind) for lod in "01234" for ending, kind in _SHAPES))})
"""In the schema's order. Of level 0 solids and surfaces, too, are read where files have them, though not written."""

GEOMETRY_NAMES: Mapping[tuple[str, str], str] = MappingProxyType(
    {(item.lod, item.kind): item.name for item in GEOMETRY.values()})
"""Properties by level of detail and kind of shape."""

ANY_GEOMETRY: Mapping[str, str] = MappingProxyType({f"lod{lod}Geometry": lod for lod in "1234"})
"""Levels of detail of the properties of installations, furniture and trees, which hold geometry of any kind."""

IMPLICIT_GEOMETRY: Mapping[str, str] = MappingProxyType({f"lod{lod}ImplicitRepresentation": lod for lod in "1234"})
"""Levels of detail of the properties that hold a prototype, which stands where a matrix and a point put it."""

LAST_BEFORE_BOUNDARIES = GEOMETRY_NAMES["2", MULTI_SURFACE]
"""The property behind which the schema has the boundary surfaces."""

FEATURE_FIELDS: Mapping[str, str] = MappingProxyType({
    "description": "gml:description", "name": "gml:name", "creationDate": "core:creationDate",
    "terminationDate": "core:terminationDate"})
"""Attributes that every object has, in the schema's order: elements by the record's names."""


@dataclass(frozen=True)
class BuildingField:
    """An attribute of the building module: kinds of values that it takes, their form, and the unit of a bare number."""

    takes: tuple[type, ...]
    form: str = ""
    unit: str = ""


_CODE, _YEAR = BuildingField((str, int, CodeValue)), BuildingField((str, int), r"-?\d{4,}")
_COUNT, _HEIGHTS = BuildingField((str, int), r"\d+"), BuildingField((Measure,))
BUILDING_FIELDS: Mapping[str, BuildingField] = MappingProxyType({
    "class": _CODE, "function": _CODE, "usage": _CODE, "yearOfConstruction": _YEAR, "yearOfDemolition": _YEAR,
    "roofType": _CODE, "measuredHeight": BuildingField((Measure, int, float), unit="m"),
    "storeysAboveGround": _COUNT, "storeysBelowGround": _COUNT,
    "storeyHeightsAboveGround": _HEIGHTS, "storeyHeightsBelowGround": _HEIGHTS})
"""Attributes of bldg:_AbstractBuilding in the schema's order."""

ROAD_FIELDS: Mapping[str, BuildingField] = MappingProxyType({"class": _CODE, "function": _CODE, "usage": _CODE})
"""Attributes of tran:TransportationComplex, and of installations, rooms and all furniture, in the schema's order."""

ROAD_AREA_FIELDS: Mapping[str, BuildingField] = MappingProxyType({**ROAD_FIELDS, "surfaceMaterial": _CODE})
"""Attributes of tran:TrafficArea and tran:AuxiliaryTrafficArea in the schema's order."""

_LENGTH = BuildingField((Measure, int, float), unit="m")
TREE_FIELDS: Mapping[str, BuildingField] = MappingProxyType({
    **ROAD_FIELDS, "species": _CODE, "height": _LENGTH, "trunkDiameter": _LENGTH, "crownDiameter": _LENGTH})
"""Attributes of veg:SolitaryVegetationObject in the schema's order."""

FIELDS: Mapping[str, Mapping[str, BuildingField]] = MappingProxyType(
    {BUILDING: BUILDING_FIELDS, BUILDING_PART: BUILDING_FIELDS, ROAD: ROAD_FIELDS, CITY_FURNITURE: ROAD_FIELDS,
     SINGLE_TREE: TREE_FIELDS, TRAFFIC_AREA: ROAD_AREA_FIELDS, AUXILIARY_AREA: ROAD_AREA_FIELDS,
     **dict.fromkeys(FITTING_ELEMENTS.values(), ROAD_FIELDS)})
"""Attributes of its module that an object has, by its kind."""

GENERIC_SET = "genericAttributeSet"
GENERIC_FIELDS: Mapping[str, type] = MappingProxyType({
    "stringAttribute": str, "intAttribute": int, "doubleAttribute": float, "dateAttribute": date,
    "uriAttribute": str, "measureAttribute": Measure})
"""Types of the values of generic attributes, by their elements."""

GENERIC_NAMES: Mapping[type, str] = MappingProxyType(
    {kind: name for name, kind in GENERIC_FIELDS.items() if name != "uriAttribute"})
"""The element that a value of a type is written as."""


def namespace_of(prefix: str) -> str:
    """Namespace of a module of CityGML, in the version that is written."""
    word = next((word for word, known in MODULES.items() if known == prefix), "")
    return f"{CITYGML_SPACE}{word}/{WRITTEN_VERSION}" if word else f"{CITYGML_SPACE}{WRITTEN_VERSION}"


def module_of(namespace: str) -> str | None:
    """Prefix of a module of CityGML by its namespace of any version, "core" for the core; None for any other."""
    if not namespace.startswith(CITYGML_SPACE):
        return None
    word = namespace[len(CITYGML_SPACE):].partition("/")[0]
    return MODULES.get(word) or ("core" if word.startswith(("1", "2", "3")) else None)
