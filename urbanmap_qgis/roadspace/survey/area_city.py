"""A surveyed road model as CityGML: roads of traffic areas and auxiliary traffic areas, with what PLATEAU asks for.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.3.3 (a road's surface is made of the
polygons of its areas; uro:lodType of roads of level 3), 4.3.4.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from datetime import date
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np
import shapely

from ...citymodel.citygml.codelists import code_value, lists_of_module, module_code
from ...citymodel.citygml.writer import write_citygml
from ...citymodel.model import (
    AUXILIARY_AREA,
    MULTI_SURFACE,
    ROAD,
    TRAFFIC_AREA,
    AttributeGroup,
    CityModel,
    CityObject,
    CityShape,
    CitySurface,
    Measure,
)
from ...citymodel.reference import city_reference
from ...geometry.triangulation import triangulate_face
from ...progress import SILENT, Progress
from ..road_city import ROAD_CLASS, RoadDelivery
from ..road_records import SECTION_TYPES, RoadPiece
from .area_records import FUNCTIONS, ISLAND, LANE, UNDIVIDED, StepFace, SurveyedRoads, TrafficSurface

MOBILE_SURVEY, SURVEYED = "111", "100"
"""Codes of the lists of sources: a mobile laser survey, a survey that is no public one."""

FLAT = 0.002
"""Corners of a face lie nearer to a plane than this, m; others are cut into triangles."""


def write_survey_citygml(folder: str | os.PathLike, model: SurveyedRoads, crs_wkt: str, delivery: RoadDelivery,
                         progress: Progress = SILENT) -> dict[str, int]:
    """Write a surveyed road model into a folder as CityGML 2.0; return the files with their number of roads.

    Parameters
    ----------
    crs_wkt : of the model's coordinates.
    """
    city = CityModel(city_reference(crs_wkt), survey_road_objects(model, delivery))
    return write_citygml(folder, city, progress, delivery.version, lists_of_module("tran"))


def survey_road_objects(model: SurveyedRoads, delivery: RoadDelivery) -> Iterator[CityObject]:
    """Sections and junctions one after another; what was not surveyed is left out, as its division is not known."""
    for number, piece in enumerate(model.pieces):
        areas = [(k, area) for k, area in enumerate(model.areas) if area.road == number and area.kind != UNDIVIDED]
        if not areas:
            continue
        name = uuid5(NAMESPACE_URL, f"urn:urbanmap:tran:{model.level}:{piece.polygon.wkb_hex}")
        whole = shapely.union_all([area.polygon for _, area in areas])
        flat = tuple(CitySurface(tuple(_level(ring) for ring in (part.exterior, *part.interiors)))
                     for part in map(shapely.geometry.polygon.orient, shapely.get_parts(whole)))
        lanes = sum(area.kind == LANE for _, area in areas)
        yield CityObject(f"tran_{name}", _attributes(piece, model.level, lanes, delivery),
                         (CityShape("1", MULTI_SURFACE, (flat,)),), ROAD,
                         fittings=tuple(_area(area, [step for step in model.steps if step.area == k], model.level)
                                        for k, area in areas))


def _level(ring) -> np.ndarray:
    corners = shapely.get_coordinates(ring)[:-1]
    return np.column_stack([corners, np.zeros(len(corners))])


def _area(area: TrafficSurface, steps: list[StepFace], level: str) -> CityObject:
    name = uuid5(NAMESPACE_URL, f"urn:urbanmap:tran:{level}:{area.kind}:{area.polygon.wkb_hex}")
    kind = AUXILIARY_AREA if area.kind == ISLAND else TRAFFIC_AREA
    rings = [*faces_of(area), *((step.ring,) for step in steps)]
    surfaces = tuple(CitySurface(tuple(one), id=f"poly_{name}_{k}") for k, one in enumerate(rings))
    attributes: dict[str, Any] = {"gen:source": area.source, "gen:seen": round(area.seen, 3)}
    if np.isfinite(area.sigma):
        attributes["gen:sigma"] = Measure(round(area.sigma, 3), "m")
    attributes["function"] = module_code("tran", f"{kind}_function", FUNCTIONS[area.kind])
    return CityObject(f"{'traf' if kind == TRAFFIC_AREA else 'aux'}_{name}", attributes,
                      (CityShape(level, MULTI_SURFACE, (surfaces,)),), kind)


def faces_of(area: TrafficSurface) -> list[tuple[np.ndarray, ...]]:
    """Plane faces of an area, each as rings (n, 3), counterclockwise seen from above, m."""
    rings = [ring[:-1] for ring in area.rings()]
    corners = np.concatenate(rings)
    middle = corners.mean(axis=0)
    if np.linalg.norm(corners - middle, axis=1).max() == 0 or np.ptp(corners[:, 2]) < FLAT:
        return [tuple(rings)]
    normal = np.linalg.svd(corners - middle, full_matrices=False)[2][2]
    if np.abs((corners - middle) @ normal).max() < FLAT:
        return [tuple(rings)]
    ends = np.cumsum([len(ring) for ring in rings])
    face = [list(range(end - len(ring), end)) for end, ring in zip(ends.tolist(), rings)]
    flat = np.column_stack([corners[:, :2], np.zeros(len(corners))])
    return [(corners[list(triangle)],) for triangle in triangulate_face(flat, face)]


def _attributes(piece: RoadPiece, level: str, lanes: int, delivery: RoadDelivery) -> dict[str, Any]:
    attributes: dict[str, Any] = {}
    if delivery.created:
        attributes["creationDate"] = date.fromisoformat(delivery.created)
    attributes["class"] = module_code("tran", "TransportationComplex_class", ROAD_CLASS)
    attributes["function"] = module_code("tran", "Road_function", piece.function or delivery.function)
    number = level[:1]
    quality: dict[str, Any] = {
        "geometrySrcDescLod1": code_value("DataQualityAttribute_geometrySrcDesc", MOBILE_SURVEY),
        f"geometrySrcDescLod{number}": code_value("DataQualityAttribute_geometrySrcDesc", MOBILE_SURVEY),
        "thematicSrcDesc": code_value("DataQualityAttribute_thematicSrcDesc", SURVEYED)}
    if number == "3":
        quality["lodType"] = module_code("tran", "Road_lodType", level)
    attributes["uro:tranDataQualityAttribute"] = AttributeGroup("uro:DataQualityAttribute", quality)
    structure: dict[str, Any] = {}
    if np.isfinite(piece.width):
        structure["width"] = Measure(round(float(piece.width), 2), "m")
    if lanes and np.isfinite(piece.width):
        attributes["gen:lanes"] = lanes
    structure["sectionType"] = module_code("tran", "RoadStructureAttribute_sectionType", SECTION_TYPES[piece.kind])
    attributes["uro:roadStructureAttribute"] = AttributeGroup("uro:RoadStructureAttribute", structure)
    return attributes
