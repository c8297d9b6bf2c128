"""The roof polygons of one building by the method asked for (J 5.3.3)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from ...errors import Cancelled, InsufficientDataError, trouble_words
from ...settings.buildings import PAPER, PLANES, POINTS, PolygonParameters
from ..model_status import BLOCK, SIMPLIFIED
from ..polygons.outline_from_points import outline_from_points
from ..polygons.roof_polygon import PaperParameters, paper_roof_polygons
from .level_roofs import level_roofs, roof_height
from .plane_roofs import plane_roofs
from .polygon_rows import DrawnRoof, RoofedBuilding, RoofPolygons


def roof_polygons_or_block(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """Rows of one building's polygons; a plain block where they cannot be drawn, with `PAPER` none."""
    try:
        return roof_polygons_of(building, parameters)
    except Cancelled:
        raise
    except Exception as error:  # one building's trouble is not the others'
        if parameters.method == PAPER:
            return RoofPolygons()
        z, on_roof = building.xyz[:, 2], building.roof > 0
        return _plain_block(building, z[on_roof] if on_roof.any() else z, f"{SIMPLIFIED}: {trouble_words(error)}")


def roof_polygons_of(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """Rows of one building's polygons."""
    if parameters.method == PAPER:
        return _each_outlined(building, parameters)
    if not building.roof.any():
        return _plain_block(building, building.xyz[:, 2], BLOCK)
    if parameters.method == POINTS:
        building = _outlined_from_points(building)
    return (plane_roofs if parameters.roofs == PLANES else level_roofs)(building, parameters)


def _plain_block(building: RoofedBuilding, z: np.ndarray, status: str) -> RoofPolygons:
    """Rows of a plain block over the whole outline, at the median of the heights `z`."""
    table, height, top = RoofPolygons(), float(np.median(z)), float(z.max())
    for part in shapely.get_parts(building.outline):
        table.add(building.number, DrawnRoof(0, part, height, top, z, status))
    return table


def _outlined_from_points(building: RoofedBuilding) -> RoofedBuilding:
    """The building with an outline from its roof points; with the official one, and words that say so, where they are
    too few."""
    x, y = (building.xyz[building.roof > 0, axis] for axis in (0, 1))
    try:
        found = outline_from_points(x, y, building.density, neighbours=list(building.neighbours))
    except InsufficientDataError:
        return replace(building, status="official outline, too few points for an own")
    return replace(building, outline=found.outline, status=f"outline from points, {found.status}")


def _each_outlined(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """Each roof outlined on its own, as the paper does."""
    table = RoofPolygons()
    if not building.roof.any():
        return table
    x, y, z = building.xyz.T
    shapely.prepare(building.outline)
    density = max(np.count_nonzero(shapely.contains_xy(building.outline, x, y)), 1) / building.outline.area
    drawing = PaperParameters(min_line_points=parameters.min_line_points)
    for drawn in paper_roof_polygons(x, y, building.roof, density, drawing):
        members = z[building.roof == drawn.roof_number]
        if drawn.polygon is None:
            continue
        for polygon in shapely.get_parts(drawn.polygon):
            table.add(building.number, DrawnRoof(drawn.roof_number, polygon, roof_height(members, parameters),
                                                 float(members.max()), members, drawn.status))
    return table
