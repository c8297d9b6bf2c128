"""Building outlines of a layer as the core takes them."""

from __future__ import annotations

from ..urbanmap_qgis.errors import InputError
from ..urbanmap_qgis.progress import SILENT, Progress
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


def footprints_of(table: VectorTable, progress: Progress = SILENT):
    """The core's outlines of a layer: numbered by its field building_id, or in the layer's order.

    Raises
    ------
    InputError : ids are not unique whole numbers, or no outline is usable.
    """
    import numpy as np

    from ..urbanmap_qgis.buildings.footprint import Footprints, clean_footprints

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
        progress.message(f"{unusable} outlines have no usable polygon; their buildings keep their rows.")
    return Footprints(footprints.ids, footprints.polygons, notes)
