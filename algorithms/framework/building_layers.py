"""Buildings of a layer as solids or outlines, faces and heights as they are."""

from __future__ import annotations

from collections.abc import Mapping

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.progress import SILENT, Progress
from .layers import VectorTable
from .outlines import BUILDING_ID, numbers
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


def building_ids(table: VectorTable):
    """Numbers (n,) of the buildings: the field building_id, or the layer's order from 1.

    Raises
    ------
    InputError : the field holds anything but unique whole numbers.
    """
    import numpy as np

    given = numbers(table, BUILDING_ID)
    if given is None:
        return np.arange(1, len(table) + 1)
    if not np.isfinite(given).all() or (given != np.round(given)).any() or len(np.unique(given)) < len(given):
        raise InputError(tr("{0}: the field {1} must hold a different whole number for each building.").format(
            table.label, BUILDING_ID))
    return given.astype(np.int64)
