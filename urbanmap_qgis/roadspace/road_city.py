"""A road model as CityGML's roads of LOD1 with the attributes that PLATEAU asks for.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.3.1.2 (tran:Road,
tran:lod1MultiSurface, height 0), 4.3.3 (tran:class, tran:function,
uro:tranDataQualityAttribute, uro:roadStructureAttribute), 4.3.4.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import date
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np
import shapely

from ..citymodel.citygml import codelists
from ..citymodel.citygml.codelists import lists_of_module, module_code
from ..citymodel.citygml.iur import VERSIONS
from ..citymodel.citygml.plateau import PUBLIC_SURVEY, SCALES
from ..citymodel.citygml.writer import write_citygml
from ..citymodel.model import (
    MULTI_SURFACE,
    ROAD,
    AttributeGroup,
    CityModel,
    CityObject,
    CityShape,
    CitySurface,
    Measure,
)
from ..citymodel.reference import city_reference
from ..errors import InputError
from ..progress import SILENT, Progress
from ..wording import say
from .road_records import SECTION_TYPES, RoadPiece, RoadSurfaceModel

ROAD_CLASS = "1040"
"""Code of `TransportationComplex_class`: a road."""

NOT_SURVEYED = "9000"
"""Code of `Road_function`: not looked into."""

OTHER_DATA, COMPUTED, NO_SCALE = "400", "803", "9"
"""Codes of the lists of sources: other GIS data, computed from GIS data; of a scale that is not defined."""

PUBLIC_MAPS = {"GSI fundamental data": "022", "digital topographic map": "023"}
"""Codes of `PublicSurveyDataQualityAttribute_publicSurveySrcDesc` by what the edges are from."""


@dataclass(frozen=True)
class RoadDelivery:
    """What holds for all roads of a delivery.

    Attributes
    ----------
    version : of i-UR, "3.2" or "3.1".
    function : code of `Road_function` of roads that say none.
    material : what the edges are from, one of `PUBLIC_MAPS`; anything else is other GIS data.
    map_level : of that map, one of `SCALES`; 0 where it is not known.
    created : day on which the data were made, ISO 8601; empty where not known.
    """

    version: str = VERSIONS[0]
    function: str = NOT_SURVEYED
    material: str = ""
    map_level: int = 0
    created: str = ""


def check_function(code: str) -> None:
    """Refuse what is no code of a road's function.

    Raises
    ------
    InputError : with the codes that there are.
    """
    if code not in lists_of_module("tran")["Road_function"]:
        raise InputError(say("{code} is no code of a road's function: give one of {codes}.", code=code,
                             codes=", ".join(lists_of_module("tran")["Road_function"])))


def known_functions(values: Iterable[Any]) -> list[str]:
    """Values of a field as codes of `Road_function`; empty where they are none."""
    return [str(value) if str(value) in lists_of_module("tran")["Road_function"] else "" for value in values]


def write_road_citygml(folder: str | os.PathLike, model: RoadSurfaceModel, crs_wkt: str,
                       delivery: RoadDelivery | None = None, progress: Progress = SILENT) -> dict[str, int]:
    """Write a road model into a folder as CityGML 2.0; return the files with their number of roads.

    In Japan files are those of PLATEAU, udx/tran by third meshes, in latitude and longitude.

    Parameters
    ----------
    crs_wkt : of the model's coordinates.
    """
    delivery = delivery or RoadDelivery()
    city = CityModel(city_reference(crs_wkt), road_objects(model, delivery))
    return write_citygml(folder, city, progress, delivery.version, lists_of_module("tran"))


def road_objects(model: RoadSurfaceModel, delivery: RoadDelivery) -> Iterator[CityObject]:
    """The roads of a model one after another."""
    for piece in model.pieces:
        rings = tuple(np.column_stack([shapely.get_coordinates(ring)[:-1], np.zeros(len(ring.coords) - 1)])
                      for ring in (piece.polygon.exterior, *piece.polygon.interiors))
        shape = CityShape("1", MULTI_SURFACE, ((CitySurface(rings),),))
        name = uuid5(NAMESPACE_URL, f"urn:urbanmap:tran:{piece.polygon.wkb_hex}")
        yield CityObject(f"tran_{name}", _attributes(piece, delivery), (shape,), ROAD)


def _attributes(piece: RoadPiece, delivery: RoadDelivery) -> dict[str, Any]:
    function = piece.function or delivery.function
    attributes: dict[str, Any] = {}
    if delivery.created:
        attributes["creationDate"] = date.fromisoformat(delivery.created)
    attributes["class"] = module_code("tran", "TransportationComplex_class", ROAD_CLASS)
    attributes["function"] = module_code("tran", "Road_function", function)
    attributes["uro:tranDataQualityAttribute"] = AttributeGroup("uro:DataQualityAttribute", _quality(delivery))
    structure: dict[str, Any] = {}
    if np.isfinite(piece.width):
        structure["width"] = Measure(round(float(piece.width), 2), "m")
    structure["sectionType"] = module_code("tran", "RoadStructureAttribute_sectionType", SECTION_TYPES[piece.kind])
    attributes["uro:roadStructureAttribute"] = AttributeGroup("uro:RoadStructureAttribute", structure)
    return attributes


def _quality(delivery: RoadDelivery) -> dict[str, Any]:
    """Source and scale of LOD1."""
    public = PUBLIC_MAPS.get(delivery.material)
    values: dict[str, Any] = {
        "geometrySrcDescLod1": codelists.code_value("DataQualityAttribute_geometrySrcDesc",
                                                    PUBLIC_SURVEY if public else OTHER_DATA),
        "thematicSrcDesc": codelists.code_value("DataQualityAttribute_thematicSrcDesc", COMPUTED)}
    if public:
        scale = SCALES.get(delivery.map_level, NO_SCALE)
        values["publicSurveyDataQualityAttribute"] = AttributeGroup("uro:PublicSurveyDataQualityAttribute", {
            "srcScaleLod1": codelists.code_value("PublicSurveyDataQualityAttribute_srcScale", scale),
            "publicSurveySrcDescLod1": codelists.code_value("PublicSurveyDataQualityAttribute_publicSurveySrcDesc",
                                                            public)})
    return values
