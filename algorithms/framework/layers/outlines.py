"""Building outlines of a layer as the core takes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from qgis.core import QgsFields
from qgis.PyQt.QtCore import Qt

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ..declaring.parameters import tr
from .crs import crs_name
from .layers import SHORT, VectorTable, make_fields

BUILDING_ID = "building_id"
NUMBER = "bldg_no"
"""Field with the number of a building in point clouds, where its own id is no such number."""

NOTE = "note"

NUMBERS = 2**32
"""Numbers of buildings in point clouds are below this."""

SEGMENTED = "shift_status"
"""Field by which a result of “Segment buildings” is known, whose notes are then handed on."""


def column(table: VectorTable, name: str) -> list | None:
    """Values of a field, whatever its letters' case and also where a shapefile has cut its name; None without it."""
    known = {key.lower(): key for key in table.columns}
    found = known.get(name.lower(), known.get(name.lower()[:SHORT]))
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
                may_be_empty: bool = False, name: str = "FOOTPRINTS"):
    """The point cloud of the parameter POINTS, in the CRS of the outlines of `name`; None where none was given.

    A cloud that states no CRS is taken to be in the outlines' one, and the user is told.

    Raises
    ------
    InputError : it is no point cloud, or in another or an unsuitable CRS.
    InsufficientDataError : it holds no points, unless it may be empty: a result without any building.
    """
    from ....urbanmap_qgis.io.points.pointcloud import open_cloud

    paths = algorithm.point_files(parameters, "POINTS", context)
    if not paths:
        return None
    cloud = open_cloud(paths, may_be_empty=may_be_empty)
    if not cloud.crs_wkt:
        progress.warn(tr("{0}: the files state no coordinate reference system; they are taken to be in that of {1}, "
                         "{2}.").format(algorithm.label_of("POINTS"), algorithm.label_of(name),
                                        crs_name(footprints.crs)))
        refuse_swapped(algorithm, cloud, footprints, name)
        return replace(cloud, crs_wkt=footprints.crs_wkt)
    algorithm.require_projected("POINTS", cloud.crs_wkt)
    algorithm.same_crs("POINTS", cloud.crs_wkt, name, footprints.crs)
    refuse_swapped(algorithm, cloud, footprints, name)
    return cloud


def refuse_swapped(algorithm, cloud, footprints: VectorTable, name: str) -> None:
    """Refuse points that lie on the outlines only where x and y are swapped, as some programs write them in Japan.

    Raises
    ------
    InputError : with what to do.
    """
    import shapely

    from ....urbanmap_qgis.io.conversion.reprojection import swapped_overlap

    if cloud.point_count and swapped_overlap((*cloud.minimum[:2], *cloud.maximum[:2]),
                                             tuple(shapely.total_bounds(footprints.geometries))):
        raise InputError(tr("{0} and {1} lie on each other only where x and y of one of them are swapped; swap them in "
                            "the one that counts x to the north.").format(
                                algorithm.label_of("POINTS"), algorithm.label_of(name)))


@dataclass(frozen=True)
class BuildingNames:
    """Numbers of the buildings of a layer, as point clouds carry them, and the ids that the user gave them.

    Attributes
    ----------
    numbers : (n,) int64, unique, 1 or more.
    own : id by number; empty where the numbers themselves are the ids.
    """

    numbers: object
    own: Mapping[int, object] = field(default_factory=dict)

    def of(self, number: int) -> str:
        """Name of a building in files of models."""
        return str(self.own.get(number, f"building-{number}"))

    def columns(self, columns: Mapping) -> dict:
        """Columns in which `building_id` are the user's ids; the numbers are beside them where they are others."""
        if not self.own or BUILDING_ID not in columns:
            return dict(columns)
        found = [int(number) for number in columns[BUILDING_ID]]
        return {**columns, BUILDING_ID: [self.own[number] for number in found], NUMBER: found}

    def fields(self, fields: QgsFields) -> QgsFields:
        """Fields for `columns`: building_id of the ids' own type."""
        if not self.own or fields.lookupField(BUILDING_ID) < 0:
            return fields
        kind = "int" if all(isinstance(value, int) for value in self.own.values()) else "text"
        result = QgsFields()
        id_fields = make_fields((BUILDING_ID, kind), (NUMBER, "int"))
        for item in fields:
            for new in id_fields if item.name() == BUILDING_ID else [item] if item.name() != NUMBER else []:
                result.append(new)
        return result


def building_names(table: VectorTable) -> BuildingNames:
    """The buildings of a layer by their field building_id, of any type; numbered from 1 where there is none.

    Ids that are no numbers that a point cloud can hold get one: that of an earlier step (the field `bldg_no`), or their
    place in the layer.

    Raises
    ------
    InputError : an id is empty or there more than once.
    """
    import numpy as np

    ids, assigned = column(table, BUILDING_ID), numbers(table, NUMBER)
    order = np.arange(1, len(table) + 1)
    if assigned is not None and (not _are_numbers(assigned.tolist()) or len(set(assigned.tolist())) < len(assigned)):
        raise InputError(tr("{0}: the field {1} must hold the buildings' numbers as an earlier step wrote them; remove "
                            "it.").format(table.label, NUMBER))
    if ids is None:
        return BuildingNames(order if assigned is None else assigned.astype(np.int64))
    ids = [int(value) if isinstance(value, float) and value.is_integer() else value for value in ids]
    if any(value is None or value != value or str(value).strip() == "" for value in ids):
        raise InputError(tr("{0}: some {1} is empty; give each building its own, or remove the field.").format(
            table.label, BUILDING_ID))
    first = {}
    for value in map(str, ids):
        if value in first:
            raise InputError(tr("{0}: the {1} {2} is there more than once; give each building its own, or remove the "
                                "field.").format(table.label, BUILDING_ID, value))
        first[value] = True
    if _are_numbers(ids):
        return BuildingNames(np.array(ids, np.int64))
    if assigned is None:
        try:
            given = [int(str(value)) for value in ids]
        except ValueError:
            given = []
        assigned = np.array(given) if given and _are_numbers(given) and len(set(given)) == len(given) else order
    assigned = assigned.astype(np.int64)
    labels = [value if isinstance(value, int) else str(value) for value in ids]
    labels = labels if all(isinstance(value, int) for value in labels) else list(map(str, labels))
    return BuildingNames(assigned, dict(zip(assigned.tolist(), labels)))


def _are_numbers(values: list) -> bool:
    """Whether all are whole numbers that a point cloud can hold."""
    return all(isinstance(value, (int, float)) and not isinstance(value, bool) and value == value
               and 1 <= value < NUMBERS and int(value) == value for value in values)


def building_numbers(table: VectorTable):
    """The number of each row's building as a float array (n,), NaN where empty; None without such a field.

    For layers in which a building has several rows, such as roofs.
    """
    assigned = numbers(table, NUMBER)
    return numbers(table, BUILDING_ID) if assigned is None else assigned


def dated_columns(table: VectorTable, fields: Sequence[str]) -> dict[str, list]:
    """The columns of a table among `fields` (whatever their case), dates of QGIS as ISO text."""
    wanted = {field.lower() for field in fields}
    return {name: [value.toString(Qt.ISODate) if hasattr(value, "toString") else value for value in values]
            for name, values in table.columns.items() if name.lower() in wanted}


def footprints_of(table: VectorTable, progress: Progress = SILENT):
    """The core's outlines of a layer: numbered by its field building_id, or in the layer's order.

    Raises
    ------
    InputError : an id is empty or there more than once, or no outline is usable.
    """
    from ....urbanmap_qgis.buildings.outlines.footprint import Footprints, clean_footprints

    footprints = clean_footprints(table.geometries, building_names(table).numbers)
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
