"""Street objects as city furniture and trees of CityGML, with the attributes that PLATEAU asks for.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.14.1 (LOD1: the plan of all raised to
the highest point; LOD2: the outlines of the parts, joined to faces), 4.14.3.1 (frn:class, frn:function,
uro:frnDataQualityAttribute), 4.14.4.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from datetime import date
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np
import shapely

from ...citymodel.citygml.codelists import code_value, lists_of_module, module_code
from ...citymodel.citygml.writer import write_citygml
from ...citymodel.model import (
    CITY_FURNITURE,
    MULTI_SURFACE,
    SINGLE_TREE,
    SOLID,
    AttributeGroup,
    CityModel,
    CityObject,
    CityShape,
    CitySurface,
    Measure,
)
from ...citymodel.reference import city_reference
from ...geometry.short_sides import without_short_sides
from ...progress import SILENT, Progress
from .object_records import BOLLARD, LAMP, OTHER, POLE, SIGN, SIGNAL, TREE, StreetObject

FUNCTIONS = {POLE: "4800", LAMP: "4200", SIGN: "3000", SIGNAL: "4900", BOLLARD: "4800", OTHER: "4000"}
"""Codes of `CityFurniture_function`: posts, lighting, road signs, traffic signals; structures for boxes of any use."""

ROAD_FITTING = "1000"
"""Code of `CityFurniture_class`: of roads and traffic."""

MOBILE_SURVEY, SURVEYED, NO_TEXTURE = "111", "100", "99"
"""Codes of the lists of sources: a mobile laser survey, a survey that is no public one, no texture."""

CORNERS = 8
"""Of the polygon that stands for a round stem."""

ARM_WIDTH, LEAST_DIAMETER = 0.15, 0.05
"""m, of arms, whose width is not measured, and of stems that are drawn."""


def write_object_citygml(folder: str | os.PathLike, objects: Sequence[StreetObject], crs_wkt: str, created: str = "",
                         progress: Progress = SILENT) -> dict[str, int]:
    """Write street objects into a folder as CityGML 2.0; return the files with their number of objects.

    In Japan files are those of PLATEAU, udx/frn and udx/veg by third meshes, in latitude and longitude.

    Parameters
    ----------
    crs_wkt : of the objects' coordinates.
    created : day on which the data were made, ISO 8601; empty where not known.
    """
    city = CityModel(city_reference(crs_wkt), furniture_objects(objects, created))
    return write_citygml(folder, city, progress, lists=lists_of_module("frn"))


def furniture_objects(objects: Sequence[StreetObject], created: str = "") -> Iterator[CityObject]:
    """The objects of a city model, one after another."""
    for thing in objects:
        tree = thing.kind == TREE
        identifier = uuid5(NAMESPACE_URL, f"urn:urbanmap:object:{thing.kind}:{thing.foot.round(3).tolist()}")
        prism = _prism(_whole_plan(thing), thing.foot[2], thing.height)
        shapes: tuple[CityShape, ...] = (CityShape("1", SOLID, (prism,)),)
        if not tree:
            shapes += (CityShape("2", MULTI_SURFACE, (_parts(thing),)),)
        yield CityObject(f"{'veg' if tree else 'frn'}_{identifier}", _attributes(thing, created), shapes,
                         SINGLE_TREE if tree else CITY_FURNITURE)


def _attributes(thing: StreetObject, created: str) -> dict[str, Any]:
    attributes: dict[str, Any] = {}
    if created:
        attributes["creationDate"] = date.fromisoformat(created)
    attributes |= {"gen:kind": thing.kind, "gen:confidence": round(thing.confidence, 2),
                   "gen:sigma": Measure(round(thing.sigma, 3), "m"), "gen:status": thing.status}
    if thing.reason:
        attributes["gen:reason"] = thing.reason
    quality: dict[str, Any] = {
        "geometrySrcDescLod1": code_value("DataQualityAttribute_geometrySrcDesc", MOBILE_SURVEY),
        "geometrySrcDescLod2": code_value("DataQualityAttribute_geometrySrcDesc", MOBILE_SURVEY),
        "thematicSrcDesc": code_value("DataQualityAttribute_thematicSrcDesc", SURVEYED),
        "appearanceSrcDescLod2": code_value("DataQualityAttribute_appearanceSrcDesc", NO_TEXTURE)}
    if thing.kind != TREE:
        return {**attributes, "class": module_code("frn", "CityFurniture_class", ROAD_FITTING),
                "function": module_code("frn", "CityFurniture_function", FUNCTIONS[thing.kind]),
                "uro:frnDataQualityAttribute": AttributeGroup("uro:DataQualityAttribute", quality)}
    quality = {name: value for name, value in quality.items() if not name.endswith("Lod2")}
    return {**attributes, "height": Measure(round(thing.height, 2), "m"),
            "trunkDiameter": Measure(round(thing.diameter, 2), "m"),
            "crownDiameter": Measure(round(thing.crown or 0.0, 2), "m"),
            "uro:vegDataQualityAttribute": AttributeGroup("uro:DataQualityAttribute", quality)}


def _whole_plan(thing: StreetObject) -> shapely.Polygon:
    """The plan of all parts of an object."""
    if thing.kind == TREE:
        return _round_plan(thing.foot, max(thing.crown or 0.0, thing.diameter))
    parts = [] if thing.diameter is None else [_round_plan(thing.foot, thing.diameter)]
    if thing.arm is not None:
        parts.append(_arm_plan(thing))
    if thing.board is not None:
        parts.append(shapely.LineString(_board_ends(thing)).buffer(LEAST_DIAMETER / 2.0, cap_style="square"))
    whole = shapely.union_all(parts)
    # A board before its post may leave a gap of its own width in plan.
    whole = whole if whole.geom_type == "Polygon" else whole.convex_hull
    # Where the outlines of post, arm and board cross, corners may lie millimetres apart.
    return without_short_sides([shapely.Polygon(whole.exterior)])[0]


def _round_plan(foot: np.ndarray, diameter: float) -> shapely.Polygon:
    angle = np.arange(CORNERS) * 2.0 * np.pi / CORNERS
    radius = max(diameter, LEAST_DIAMETER) / 2.0
    return shapely.Polygon(foot[:2] + radius * np.column_stack([np.cos(angle), np.sin(angle)]))


def _arm_plan(thing: StreetObject) -> shapely.Polygon:
    azimuth = np.radians(thing.azimuth)
    end = thing.foot[:2] + thing.arm[0] * np.array([np.sin(azimuth), np.cos(azimuth)])
    return shapely.LineString([thing.foot[:2], end]).buffer(ARM_WIDTH / 2.0, cap_style="flat")


def _board_ends(thing: StreetObject) -> np.ndarray:
    """Left and right end (2, 2) of a board in plan, as who looks at its face sees them."""
    azimuth = np.radians(thing.board.azimuth)
    right = np.array([-np.cos(azimuth), np.sin(azimuth)])
    return thing.board.centre[:2] + thing.board.width / 2.0 * np.array([-right, right])


def _parts(thing: StreetObject) -> tuple[CitySurface, ...]:
    """Faces of the post, its arm and its board."""
    surfaces: tuple[CitySurface, ...] = ()
    if thing.diameter is not None:
        surfaces = _prism(_round_plan(thing.foot, thing.diameter), thing.foot[2], thing.height)
    if thing.arm is not None:
        surfaces += _prism(_arm_plan(thing), thing.foot[2] + thing.arm[1] - ARM_WIDTH / 2.0, ARM_WIDTH)
    if thing.board is not None:
        left, right = _board_ends(thing)
        low, high = thing.board.centre[2] + thing.board.height / 2.0 * np.array([-1.0, 1.0])
        face = np.array([[*left, low], [*right, low], [*right, high], [*left, high]])
        surfaces += (CitySurface((face,)), CitySurface((face[::-1],)))
    return surfaces


def _prism(plan: shapely.Polygon, base: float, height: float) -> tuple[CitySurface, ...]:
    """Faces of a polygon raised by a height, counterclockwise seen from outside."""
    ring = shapely.get_coordinates(shapely.geometry.polygon.orient(plan).exterior)[:-1]
    low, high = (np.column_stack([ring, np.full(len(ring), z)]) for z in (base, base + height))
    following = np.roll(np.arange(len(ring)), -1)
    sides = [CitySurface((np.array([low[i], low[j], high[j], high[i]]),)) for i, j in enumerate(following)]
    return (CitySurface((low[::-1],)), CitySurface((high,)), *sides)
