"""Building outlines of a layer as the core takes them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.progress import SILENT, Progress
from .crs import crs_name
from .layers import VectorTable
from .parameters import tr

BUILDING_ID = "building_id"
NOTE = "note"

SEGMENTED = "shift_status"
"""Field by which a result of “Segment buildings” is known, whose notes are then handed on."""


def column(table: VectorTable, name: str) -> list | None:
    """Values of a field, whatever its letters' case; None where the layer has no such field."""
    found = {key.lower(): key for key in table.columns}.get(name.lower())
    return None if found is None else table.columns[found]


def numbers(table: VectorTable, name: str):
    """Values of a field as a float array (n,), NaN where empty; None where the layer has no such field.

    Raises
    ------
    InputError : the field holds words.
    """
    import numpy as np

    values = column(table, name)
    if values is None:
        return None
    try:
        return np.array([np.nan if value is None else value for value in values], float)
    except (TypeError, ValueError):
        raise InputError(tr("{0}: the field {1} must hold numbers; convert it or choose another field.").format(
            table.label, name)) from None


def open_points(algorithm, parameters: Mapping, context, footprints: VectorTable, progress: Progress = SILENT,
                may_be_empty: bool = False):
    """The point cloud of the parameter POINTS, in the CRS of the outlines; None where none was given.

    A cloud that states no CRS is taken to be in the outlines' one, and the user is told.

    Raises
    ------
    InputError : it is no point cloud, or in another or an unsuitable CRS.
    InsufficientDataError : it holds no points, unless it may be empty: a result without any building.
    """
    from ...urbanmap_qgis.io.pointcloud import open_cloud

    paths = algorithm.point_files(parameters, "POINTS", context)
    if not paths:
        return None
    cloud = open_cloud(paths, may_be_empty=may_be_empty)
    if not cloud.crs_wkt:
        progress.warn(tr("{0}: the files state no coordinate reference system; they are taken to be in that of {1}, "
                         "{2}.").format(algorithm.label_of("POINTS"), algorithm.label_of("FOOTPRINTS"),
                                        crs_name(footprints.crs)))
        return replace(cloud, crs_wkt=footprints.crs_wkt)
    algorithm.require_projected("POINTS", cloud.crs_wkt)
    algorithm.same_crs("POINTS", cloud.crs_wkt, "FOOTPRINTS", footprints.crs)
    return cloud


def footprints_of(table: VectorTable, progress: Progress = SILENT):
    """The core's outlines of a layer: numbered by its field building_id, or in the layer's order.

    Raises
    ------
    InputError : ids are not unique whole numbers, or no outline is usable.
    """
    import numpy as np

    from ...urbanmap_qgis.buildings.outlines.footprint import Footprints, clean_footprints

    ids = column(table, BUILDING_ID)
    footprints = clean_footprints(table.geometries, None if ids is None else np.array(ids, dtype=object))
    notes = footprints.notes.copy()
    earlier = column(table, NOTE) if column(table, SEGMENTED) else None
    for row, note in enumerate(earlier or ()):
        notes[row] = notes[row] or note or ""
    for row, problem in table.problems.items():
        notes[row] = notes[row] or problem
    unusable = int((~footprints.usable).sum())
    if unusable:
        progress.message(tr("{0} outlines have no usable polygon; their buildings keep their rows.").format(unusable))
    return Footprints(footprints.ids, footprints.polygons, notes)
