"""What a vector layer shows: by the names of layer and fields where they say it, else by shape and size."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.earth import METRES_A_DEGREE
from ...wording import say
from ..file_facts import (
    AREAS,
    BUILDING_MODELS,
    CONTROL,
    LINES,
    MARKINGS,
    OUTLINES,
    PLACES,
    ROADS,
    ROOFS,
    TIE_POINTS,
    TRAJECTORY,
)

_WORDS = (
    (ROOFS, re.compile(r"roof_?id|^roofs?$|roof_?polygons")),
    (MARKINGS, re.compile(r"marking|paint|dashes|crosswalk|crossing|zebra|標示|白線|区画線|横断歩道")),
    (OUTLINES, re.compile(r"build|bldg|^bld|footprint|outline|^pand$|lokaalid|identificatie|^bag$|maison|batiment|"
                          r"gebouw|建物|建築|presence")),
    (ROADS, re.compile(r"rd_?edg|rd_?compt|road_?surfaces?|道路縁|道路構成線|道路面")),
    (AREAS, re.compile(r"road|drivable|vehicle|areas?$|landuse|parcel|道路|筆界|用途|occlusion")),
)
"""What words in names of layers and fields say, the first that is there."""

_OWN_FIELDS = ((TRAJECTORY, {"time", "roll", "pitch", "heading"}), (CONTROL, {"time", "x_mms", "y_mms"}))
_MEASURES = {"area", "areas", "shape_area"}
"""Fields with the size of each polygon, which say nothing of what it is."""
_SMALLEST_BUILDING = 20.0
"""m2: half of the polygons of a building layer are larger, sheds and all."""
_LARGEST_MARKING = 8.0
"""m2: half of the polygons of a layer of paint are smaller; a crosswalk drawn as one is larger."""
_WIDEST_PAINT = 0.6
"""m: dashes and edge lines are narrower."""
_UPRIGHT = 1e-6
"""Part of its squared perimeter that an upright wall has as area in plan."""


@dataclass(frozen=True)
class LayerSample:
    """Names and some features of a layer.

    Attributes
    ----------
    names : of file and layer.
    fields : of the table.
    type_name : of the geometry.
    shapes : of some features.
    """

    names: tuple[str, ...]
    fields: tuple[str, ...]
    type_name: str
    shapes: Sequence[shapely.Geometry]


def kind_of_layer(sample: LayerSample, degrees: bool) -> tuple[str, str]:
    """Kind of a layer, and why it may be another one ("" where names say it); `degrees`: it is in degrees."""
    fields = {name.lower() for name in sample.fields}
    types = {shape.geom_type.removeprefix("Multi") for shape in sample.shapes} or {
        sample.type_name.title().removeprefix("Multi").removesuffix("Z").removesuffix("M")}
    if types == {"Point"}:
        if {"x_ref", "y_ref"} <= fields:
            return TIE_POINTS, ""
        return next(((kind, "") for kind, names in _OWN_FIELDS if names <= fields), (PLACES, ""))
    if not types <= {"Polygon", "Polyhedralsurface", "PolyhedralSurface", "GeometryCollection", "Geometry", "Patch"}:
        return (ROADS if types <= {"LineString", "Linestring"} and _said(_words(sample)) == ROADS else LINES), ""
    if _has_walls(sample.shapes):
        return BUILDING_MODELS, ""
    said = _said(_words(sample)) or _said({sample.names[0].lower()})
    return (said, "") if said else _by_size(sample.shapes, degrees)


def _words(sample: LayerSample) -> set[str]:
    names = (*sample.names[1:], *(name for name in sample.fields if name.lower() not in _MEASURES))
    return {unicodedata.normalize("NFKC", name).lower() for name in names}


def _said(words: set[str]) -> str:
    return next((kind for kind, pattern in _WORDS if any(pattern.search(word) for word in words)), "")


def _has_walls(shapes: Sequence[shapely.Geometry]) -> bool:
    """Whether some part stands upright: models of buildings as surfaces."""
    parts = shapely.get_parts(np.array([shape for shape in shapes if shape is not None and shape.has_z], object))
    if not len(parts):
        return False
    return bool((shapely.area(parts) < _UPRIGHT * shapely.length(parts) ** 2).any())


def _by_size(shapes: Sequence[shapely.Geometry], degrees: bool) -> tuple[str, str]:
    polygons = shapely.get_parts(np.array([shape for shape in shapes if shape is not None], object))
    polygons = polygons[shapely.area(polygons) > 0.0] if len(polygons) else polygons
    if not len(polygons):
        return AREAS, ""
    latitude = np.median(shapely.get_y(shapely.centroid(polygons)))
    metres = METRES_A_DEGREE * np.sqrt(np.cos(np.radians(latitude))) if degrees else 1.0
    area = np.median(shapely.area(polygons)) * metres**2
    width = np.median(2.0 * shapely.area(polygons) / shapely.length(polygons)) * metres
    doubt = say("told by the size of its polygons (median {area:.1f} m²), not by a name", area=area)
    if area < _LARGEST_MARKING or width < _WIDEST_PAINT:
        return MARKINGS, doubt
    return (OUTLINES, doubt) if area > _SMALLEST_BUILDING else (AREAS, doubt)
