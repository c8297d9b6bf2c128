"""A building's plan divided among its level roofs, without gaps and with common edges (J 5.3.3)."""

from __future__ import annotations

import numpy as np
import shapely

from ...settings.buildings import MAXIMUM, PolygonParameters
from ..model_status import LOST_AREA, LOST_ROOFS
from ..planes.lost_planes import has_lost_plane
from ..planes.plane_partition import partition_planes
from .polygon_rows import DrawnRoof, RoofedBuilding, RoofPolygons


def level_roofs(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """The whole outline divided among its roofs: no gaps, common edges."""
    table = RoofPolygons()
    on_roof = building.roof > 0
    (x, y, z), roof = (building.xyz[on_roof, axis] for axis in range(3)), building.roof[on_roof]
    levels = {roof_id: roof_height(z[roof == roof_id], parameters) for roof_id in np.unique(roof).tolist()}
    planes = np.column_stack([np.zeros((len(levels), 2)), list(levels.values())])
    partition = partition_planes(building.outline, building.xyz[on_roof], roof, planes)
    lost = has_lost_plane(partition.polygons, partition.roof_numbers, building.xyz, building.roof, building.density,
                          LOST_AREA)
    status = building.stated(LOST_ROOFS if lost else partition.status)
    for polygon, roof_id, coverage in zip(shapely.force_2d(partition.polygons), partition.roof_numbers.tolist(),
                                          partition.coverage.tolist()):
        members = roof == roof_id
        shapely.prepare(polygon)
        members[members] = shapely.contains_xy(polygon, x[members], y[members])
        height = roof_height(z[members], parameters) if members.any() else levels[roof_id]
        top = float(z[members].max()) if members.any() else height
        table.add(building.number, DrawnRoof(roof_id, polygon, height, top, z[members], status, coverage))
    return table


def roof_height(z: np.ndarray, parameters: PolygonParameters) -> float:
    """Height of a roof from its points' heights `z`, m."""
    return float(z.max() if parameters.height == MAXIMUM else np.median(z))
