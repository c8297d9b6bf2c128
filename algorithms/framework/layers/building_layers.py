"""Buildings of a layer as solids or outlines, faces and heights as they are."""

from __future__ import annotations

from collections.abc import Mapping

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ..declaring.parameters import tr
from .layers import VectorTable
from .reprojection import needs_moving, points_wkt, table_in


def read_buildings(algorithm, parameters: Mapping, name: str, context, progress: Progress = SILENT) -> VectorTable:
    """A layer of outlines or models in a projected CRS, that of the points where there are any.

    Its geometries are not repaired: upright faces are no mistakes.

    Raises
    ------
    InputError : the CRS is missing or not in metres, or no feature has a polygon.
    """
    import shapely

    table = algorithm.read_vector(parameters, name, context, progress)
    target = points_wkt(algorithm, parameters, context)
    if needs_moving(table.crs, target):
        table = table_in(table, target, progress)
    algorithm.require_projected(name, table.crs)
    kinds = shapely.get_type_id(table.geometries)
    table.geometries[(kinds != 3) & (kinds != 6)] = None
    if not len(table) or shapely.is_missing(table.geometries).all():
        raise InputError(tr("{0}: no feature has a polygon; choose a layer of outlines or building models.").format(
            table.label))
    return table
