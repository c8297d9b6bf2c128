"""Buildings of a layer as solids or outlines, faces and heights as they are."""

from __future__ import annotations

from collections.abc import Mapping

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.progress import SILENT, Progress
from .layers import VectorTable
from .parameters import tr


def read_buildings(algorithm, parameters: Mapping, name: str, context, progress: Progress = SILENT) -> VectorTable:
    """A layer of outlines or models in a projected CRS, its geometries untouched: upright faces are no mistakes.

    Raises
    ------
    InputError : the CRS is missing or not in metres, or no feature has a polygon.
    """
    import shapely

    table = algorithm.read_vector(parameters, name, context, progress)
    algorithm.require_projected(name, table.crs)
    kinds = shapely.get_type_id(table.geometries)
    table.geometries[(kinds != 3) & (kinds != 6)] = None
    if not len(table) or shapely.is_missing(table.geometries).all():
        raise InputError(tr("{0}: no feature has a polygon; choose a layer of outlines or building models.").format(
            table.label))
    return table
