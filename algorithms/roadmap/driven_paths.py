"""Drives of surveys, and what stands beside them, as lane maps take them."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr


def read_drives(stage, parameters, context, crs_wkt, progress) -> list:
    """The core's drives of all trajectories, in the CRS of the lines."""
    from ...urbanmap_qgis.roadmap.map_records import DrivenPath

    return [DrivenPath(read.trajectory.place)
            for read in stage.read_trajectories(parameters, context, crs_wkt, progress, "LINES")]


def add_street_objects(algorithm, parameters, context, built, lines) -> None:
    """Read objects and rails into a map, with a finding for each signal of which nothing tells what it governs."""
    from ...urbanmap_qgis.roadmap.map_objects import objects_of, rails_of, signals_of_stop_lines

    tables = {name: algorithm.read_vector(parameters, name, context) for name in ("OBJECTS", "RAILS")}
    for name, table in tables.items():
        if table is not None:
            algorithm.same_crs("LINES", lines.crs, name, table.crs)
    objects, rails = tables["OBJECTS"], tables["RAILS"]
    if objects is not None:
        if "kind" not in objects.columns:
            raise InputError(tr("{0} has no field kind; give the points of “Street objects”.").format(objects.label))
        built.objects = objects_of(objects.geometries, objects.columns, objects.label)
        built.findings += signals_of_stop_lines(built)[1]
    if rails is not None:
        built.rails = rails_of(rails.geometries, rails.columns, rails.label)


def with_photo(algorithm, parameters, context, table, lines, areas, settings, progress):
    """The lines of a table with what ORTHOPHOTO shows beside them, and findings on it; as they are without one."""
    path = algorithm.raster_path(parameters, "ORTHOPHOTO", context)
    if path is None:
        return lines, []
    from ...urbanmap_qgis.roadmap.photo.photo_lines import lines_with_photo
    from ...urbanmap_qgis.roadmap.photo.straight_photo import ColourImage

    with ColourImage(path) as image:
        algorithm.same_crs("LINES", table.crs, "ORTHOPHOTO", image.crs_wkt)
        return lines_with_photo(lines, areas, image, settings, progress)
