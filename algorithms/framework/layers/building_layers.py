"""Buildings of a layer as solids or outlines, faces and heights as they are; their walls by satellites."""

from __future__ import annotations

from collections.abc import Mapping

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ..declaring.parameters import tr
from .layers import VectorTable
from .outlines import column, numbers
from .reprojection import needs_moving, points_wkt, table_in

_GNSS_STATUSES = {"adjusted", "likely", "not observable", "held"}


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


def add_gnss_walls(algorithm):
    """GNSS_WALLS."""
    algorithm.add_vector("GNSS_WALLS", "Walls by GNSS", "Walls of “Adjust walls by GNSS” from these models: where "
                         "nothing was measured from the street, adjusted and likely ones move the models' walls, "
                         "weighed by their sigma; where they contradict a measured wall, the note tells it.",
                         optional=True, kind="line")


def read_gnss_walls(algorithm, parameters, context, crs, progress):
    """The adjusted and likely walls of GNSS_WALLS in the order of the layer; none where it is not given."""
    from ....urbanmap_qgis.buildings.merging.satellite_walls import satellite_walls

    if not parameters.get("GNSS_WALLS"):
        return []
    table = algorithm.read_vector(parameters, "GNSS_WALLS", context, progress)
    algorithm.same_crs("GNSS_WALLS", table.crs, "WALLS", crs)
    sigma, status = numbers(table, "sigma"), column(table, "status")
    if sigma is None or status is None or not set(status) <= _GNSS_STATUSES:
        raise InputError(tr("{0}: these are no walls with status and sigma; give the layer of walls of “Adjust walls "
                            "by GNSS”.").format(table.label))
    walls = satellite_walls(table.geometries, sigma, status)
    progress.message(tr("{0} of {1} walls by GNSS are adjusted or likely and are used.").format(
        len(walls), len(table)))
    return walls
