"""A building's plan divided among its roof planes, or among level roofs where those fit better (J 5.3.3)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from ...errors import Cancelled, trouble_words
from ...settings.buildings import MAXIMUM, PolygonParameters
from ..model_status import LOST_AREA, LOST_ROOFS, MIN_POINTS, SIMPLIFIED
from ..planes.level_alternative import (
    BETTER,
    SUSPECT,
    has_lost_plane,
    high_points,
    level_roof_numbers,
    roof_misfit,
)
from ..planes.plane_partition import partition_planes
from .level_roofs import level_roofs
from .polygon_rows import LEVELS_BETTER, DrawnRoof, RoofedBuilding, RoofPolygons


def plane_roofs(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """The whole outline divided among its roof planes; among level roofs where planes fail or fit worse."""
    try:
        planes = _divided(building, parameters)
    except Cancelled:
        raise
    except Exception as error:  # what planes cannot do, levels may
        levels = _as_levels(building, f"{SIMPLIFIED}: {trouble_words(error)}")
        if levels is None:
            raise
        return level_roofs(levels, parameters)
    return _better_of(planes, building, parameters)


def _as_levels(building: RoofedBuilding, words: str) -> RoofedBuilding | None:
    """The building with its points' roofs found again as level ones; None where there are none."""
    roof = level_roof_numbers(building.outline, building.xyz, building.roof)
    return replace(building.restated(words), roof=roof) if roof.any() else None


def _better_of(planes: RoofPolygons, building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """The planes, or level roofs where the planes miss many points, or few points tilt the only plane, and levels miss
    clearly fewer."""
    high = high_points(building.xyz, building.roof)
    off = roof_misfit(planes.polygon, high)
    levels = _as_levels(building, LEVELS_BETTER) if off > SUSPECT or _tilted_by_few(planes) else None
    if levels is None:
        return planes
    rows = level_roofs(levels, parameters)
    return rows if roof_misfit(shapely.force_3d(rows.polygon, rows.height).tolist(), high) < BETTER * off else planes


def _tilted_by_few(planes: RoofPolygons) -> bool:
    """Whether the only roof is a slope of so few points that a tree or a wall may have tilted it."""
    return len(planes.polygon) == 1 and planes.slope[0] > 0 and planes.points[0] < MIN_POINTS


def _divided(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """Rows of the polygons of a building's roof planes."""
    xyz, roof = building.xyz, building.roof
    found, table = partition_planes(building.outline, xyz, roof), RoofPolygons()
    lost = has_lost_plane(found.polygons, found.roof_numbers, xyz, roof, building.density, LOST_AREA)
    status = building.stated(LOST_ROOFS if lost else found.status)
    order = np.argsort(roof, kind="stable")
    starts, ends = (np.searchsorted(roof[order], found.roof_numbers, side) for side in ("left", "right"))
    for polygon, roof_id, plane, coverage, start, end in zip(found.polygons, found.roof_numbers.tolist(), found.planes,
                                                             found.coverage.tolist(), starts, ends):
        members = xyz[order[start:end]]
        flat = shapely.force_2d(polygon)
        shapely.prepare(flat)
        members = members[shapely.contains_xy(flat, *members[:, :2].T)]
        z = members[:, 2]
        off = z - (members[:, :2] - found.origin) @ plane[:2] - plane[2]
        height = float((np.array(flat.centroid.coords[0]) - found.origin) @ plane[:2] + plane[2])
        top = float(z.max()) if len(z) else height
        table.add(building.number, DrawnRoof(roof_id, polygon, top if parameters.height == MAXIMUM else height, top, z,
                                             status, coverage, plane, off))
    return table
