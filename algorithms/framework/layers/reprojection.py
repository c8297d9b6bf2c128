"""Outlines and rasters in another coordinate reference system than the points, taken into theirs and said so."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ..declaring.parameters import tr
from .crs import crs_from, crs_name, heights, require_projected, same_plan, wkt_of

POINTS = "POINTS"
AROUND = 60.0  # m of a raster read beyond the features that it is for


def points_wkt(algorithm, parameters: Mapping, context) -> str:
    """WKT of the CRS that the point clouds of a run state; empty where there are none, or they state none."""
    definition = algorithm.parameterDefinition(POINTS)
    if definition is None or POINTS not in algorithm.points_names() or not parameters.get(POINTS):
        return ""
    from ....urbanmap_qgis.io.points.pointcloud import open_cloud

    paths = algorithm.point_files(parameters, POINTS, context)
    return open_cloud(paths, may_be_empty=True).crs_wkt or "" if paths else ""


def needs_moving(crs, target_wkt: str) -> bool:
    """Whether data in a CRS must be taken into another one; never where one of them is not known or not in metres."""
    if not target_wkt or not crs_from(crs).isValid() or same_plan(crs, target_wkt):
        return False
    try:
        require_projected("", target_wkt)
    except InputError:
        return False
    return True


def table_in(table, target_wkt: str, progress: Progress = SILENT):
    """A layer's table in another CRS; what was done is told.

    Raises
    ------
    InputError : the datum differs and no transformation of known accuracy is there, or x and y seem to be swapped.
    """
    import numpy as np
    import shapely

    from ....urbanmap_qgis.io.conversion.reprojection import moved_geometries, plane_transform, seem_swapped

    bounds = shapely.total_bounds(table.geometries)
    if not np.isfinite(bounds).all():
        return replace(table, crs=crs_from(target_wkt))
    target = crs_from(target_wkt)
    if table.crs.isGeographic() and (np.abs(bounds) > 360).any():
        raise InputError(tr("{0}: coordinates such as {1:.0f}, {2:.0f} are no degrees, in which {3} counts; assign the "
                            "CRS that the data are in.").format(table.label, bounds[0], bounds[1], crs_name(table.crs)))
    if table.crs.isGeographic() and seem_swapped(bounds):
        raise InputError(tr("{0}: its longitudes and latitudes seem to be swapped ({1:.3f}, {2:.3f}); swap x and y "
                            "(“Swap X and Y coordinates” in the toolbox).").format(table.label, bounds[0], bounds[1]))
    try:
        transform = plane_transform(table.crs_wkt, wkt_of(target), tuple(bounds))
        if transform is None:
            return table
        moved = moved_geometries(table.geometries, transform)
    except InputError as error:
        raise InputError(f"{table.label}: {error}") from error
    progress.warn(told(table.label, table.crs, target, transform))
    return replace(table, crs=target, geometries=moved)


def told(label: str, source, target, transform) -> str:
    """One sentence on a reprojection, with the accuracy where the datum changed."""
    text = tr("{0}: reprojected from {1} to {2}, the system of the points").format(
        label, crs_name(source), crs_name(target))
    return f"{text} ({transform.description})." if transform.description else f"{text}."


def raster_in(path, label: str, target_wkt: str, bounds, progress: Progress = SILENT):
    """Heights of a raster round a box in another CRS: grid and heights (rows, columns), resampled bilinearly.

    Raises
    ------
    InputError : the datum differs and no transformation of known accuracy is there, or the file is no raster.
    """
    from ....urbanmap_qgis.io.conversion.reprojection import plane_transform, resampled
    from ....urbanmap_qgis.io.raster import RasterSampler

    with RasterSampler(path) as source:
        transform = plane_transform(source.crs_wkt, target_wkt)
        progress.warn(told(label, source.crs_wkt, target_wkt, transform))
        return resampled(source, transform, bounds)


def with_heights_of_points(table, cloud, progress: Progress = SILENT):
    """The outlines with the height system that the points state in their CRS: what is made of both states it.

    Where QGIS has no way to keep it in layers, that is told.
    """
    from ....urbanmap_qgis.io.reference.height_systems import heights_of, stating_heights_of

    if cloud is None or not cloud.crs_wkt:
        return table
    stated = stating_heights_of(table.crs_wkt, cloud.crs_wkt)
    if stated == table.crs_wkt:
        return table
    result = replace(table, crs=crs_from(stated), stated=stated)
    if not heights(result.crs).known:
        progress.warn(tr("The points' heights are in {0}, which this release of QGIS cannot state in layers; files "
                         "of city models state it.").format(heights_of(stated)))
    return result


def ground_heights(algorithm, parameters: Mapping, context, table, progress: Progress, name: str = "FOOTPRINTS"):
    """Grid and heights (rows, columns), m, of GROUND round the features of `name`; None where none is given.

    Raises
    ------
    InputError : the raster cannot be taken into the layer's CRS, or does not reach it.
    """
    path = algorithm.raster_path(parameters, "GROUND", context)
    if path is None:
        return None
    import shapely

    from ....urbanmap_qgis.io.raster import RasterSampler, read_raster

    x_min, y_min, x_max, y_max = shapely.total_bounds(table.geometries)
    around = (x_min - AROUND, y_min - AROUND, x_max + AROUND, y_max + AROUND)
    with RasterSampler(path) as source:
        stated = source.crs_wkt
    algorithm.same_heights("GROUND", stated, POINTS, points_wkt(algorithm, parameters, context))
    if needs_moving(stated, table.crs_wkt):
        algorithm.same_heights("GROUND", stated, name, table.crs)
        return raster_in(path, algorithm.label_of("GROUND"), table.crs_wkt, around, progress)
    heights, whole, crs = read_raster(path)
    algorithm.same_crs("GROUND", crs, name, table.crs)
    rows, columns, grid = whole.window(*around)
    heights = heights[rows, columns]
    if not heights.size:
        raise InputError(tr("{0} does not reach {1}; give a raster of the same place.").format(
            algorithm.label_of("GROUND"), algorithm.label_of(name)))
    return grid, heights
