"""A building's plan divided among its roof planes (J 5.3.3)."""

from __future__ import annotations

import numpy as np
import shapely

from ...settings.buildings import MAXIMUM, PolygonParameters
from ..model_status import LOST_AREA, LOST_ROOFS
from ..planes.lost_planes import has_lost_plane
from ..planes.plane_partition import partition_planes
from .polygon_rows import DrawnRoof, RoofedBuilding, RoofPolygons


def plane_roofs(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """The whole outline divided among its roof planes."""
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
