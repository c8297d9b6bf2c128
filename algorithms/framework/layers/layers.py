"""Vector layers in and out, and their styles.

A feature sink empties an existing destination as soon as it is opened. `write_layer` is therefore called when all is
computed; files have scratch places then (`destinations.staged`), so that a run that fails or is cancelled leaves the
earlier result as it was.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from qgis.core import (
    NULL,
    Qgis,
    QgsCoordinateReferenceSystem,
    QgsFeature,
    QgsFeatureRequest,
    QgsFeatureSink,
    QgsField,
    QgsFields,
    QgsGeometry,
    QgsProcessingContext,
    QgsProcessingFeatureSource,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingUtils,
    QgsVectorLayer,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QMetaType, QVariant

from ....urbanmap_qgis.errors import InputError, OutputError
from ....urbanmap_qgis.io.files.staging import final_text
from ....urbanmap_qgis.progress import SILENT, Progress
from ..declaring.destinations import definition_of, sink_file
from ..declaring.parameters import tr
from .crs import crs_from, require_projected, wkt_of
from .earlier_words import earlier_words
from .field_words import kind_of
from .reprojection import needs_moving, table_in
from .styles import TIME, Earlier, give_style, save_style

BATCH = 1000

SHORT = 10
"""Characters that a shapefile leaves of a field's name."""

OWN = "urbanmap:own"
"""Alias of fields of ours until they are written, which tells them from those of the user."""

_TYPES = QMetaType.Type if Qgis.QGIS_VERSION_INT >= 33800 else QVariant
_KINDS = {"int": "LongLong", "real": "Double", "text": "QString" if _TYPES is not QVariant else "String",
          "bool": "Bool"}


@dataclass(frozen=True)
class VectorTable:
    """A vector layer in memory; all sequences have one entry a feature, in the layer's order.

    Attributes
    ----------
    label : label of the parameter it came from, for messages.
    crs : its coordinate reference system; `crs_wkt` for the core.
    ids : feature ids, int64 array.
    geometries : shapely geometries, object array; None where a feature has none that can be used.
    fields : the fields, without GeoPackage's own ``fid``.
    columns : values by field name; None where there is none.
    problems : by row, a sentence on what is wrong with its geometry (also where it was repaired).
    stated : WKT of the CRS with a height system that was found elsewhere, also where QGIS cannot keep it; else empty.
    """

    label: str
    crs: QgsCoordinateReferenceSystem
    ids: object
    geometries: object
    fields: QgsFields
    columns: Mapping[str, list]
    problems: Mapping[int, str] = field(default_factory=dict)
    stated: str = ""

    @property
    def crs_wkt(self) -> str:
        return wkt_of(self.crs)

    def __len__(self) -> int:
        return len(self.ids)


def make_fields(*names: str | tuple[str, str], base: QgsFields | None = None, style: str = "") -> QgsFields:
    """Fields of a layer to write, of the kinds that their words in a layer with this style have; one without words, or
    of another kind ("int", "real", "text" or "bool"), is a pair with it.

    `base` gives fields to keep in front, such as those of the footprints; a name given again replaces it.
    """
    result = QgsFields()
    fields = [(name, kind_of(name, style)) if isinstance(name, str) else name for name in names]
    taken = {name.lower() for name, _ in fields}
    taken |= {name[:SHORT] for name in taken}  # what a shapefile has left of them
    for item in base or ():
        if item.name().lower() not in taken and item.name().lower() != "fid":
            result.append(item)
    for name, kind in fields:
        field = QgsField(name, getattr(_TYPES, _KINDS[kind]))
        field.setAlias(OWN)
        result.append(field)
    return result


def own_fields(fields: QgsFields) -> tuple[tuple[str, ...], QgsFields]:
    """Names of the fields that `make_fields` made, and all fields without its mark."""
    results = tuple(item.name() for item in fields if item.alias() == OWN)
    plain = QgsFields()
    for item in fields:
        field = QgsField(item)
        if item.alias() == OWN:
            field.setAlias("")
        plain.append(field)
    return results, plain


def read_source(source: QgsProcessingFeatureSource, label: str, progress: Progress = SILENT) -> VectorTable:
    """Read a layer into memory, geometries as shapely's; M values are dropped, arcs become chords."""
    import numpy as np
    import shapely

    carried = [index for index, item in enumerate(source.fields()) if item.name().lower() != "fid"]
    fields = QgsFields()
    for index in carried:
        fields.append(source.fields()[index])
    ids, wkb, rows = [], [], []
    # The geometry check of Processing would stop at the first invalid polygon; here each is looked at below.
    unchecked = QgsProcessingFeatureSource.Flag.FlagSkipGeometryValidityChecks
    for feature in source.getFeatures(QgsFeatureRequest(), unchecked):
        if len(ids) % BATCH == 0:
            progress.check()
        ids.append(feature.id())
        wkb.append(_wkb(feature.geometry()))
        values = feature.attributes()
        rows.append([_plain(values[index]) for index in carried])
    columns = {fields[place].name(): [row[place] for row in rows] for place in range(len(carried))}
    geometries = shapely.from_wkb(np.array(wkb, dtype=object), on_invalid="ignore")
    geometries[shapely.is_empty(geometries)] = None
    return VectorTable(label, source.sourceCrs(), np.array(ids, np.int64), geometries, fields, columns)


def table_of_columns(columns: Mapping[str, list], label: str) -> VectorTable:
    """A table without places, from named columns of text."""
    import numpy as np

    count = max(map(len, columns.values()), default=0)
    return VectorTable(label, QgsCoordinateReferenceSystem(), np.arange(count), np.full(count, None, dtype=object),
                       make_fields(*((name, "text") for name in columns)), columns)


def table_of_layer(place: str, context: QgsProcessingContext, label: str) -> VectorTable:
    """A layer that a step made, in memory."""
    layer = QgsProcessingUtils.mapLayerFromString(place, context)
    return read_source(QgsProcessingFeatureSource(layer, context), label)


def layer_of(context: QgsProcessingContext, fields: QgsFields, columns: Mapping[str, Sequence],
             crs: QgsCoordinateReferenceSystem, geometries: Sequence, geometry_type: str) -> str:
    """Id of a layer in memory for a step of a chain, kept by the context."""
    layer = QgsVectorLayer(geometry_type, "step", "memory")
    layer.setCrs(crs)
    layer.dataProvider().addAttributes(list(own_fields(fields)[1]))
    layer.updateFields()
    _fill(layer.dataProvider(), features_of(layer.fields(), columns, geometries), layer.name())
    layer.updateExtents()
    context.temporaryLayerStore().addMapLayer(layer)
    return layer.id()


def table_of_box(label: str, crs: QgsCoordinateReferenceSystem, low, high) -> VectorTable:
    """A table of one rectangle between two corners (x, y, ...), such as that of a point cloud."""
    import numpy as np
    import shapely

    return VectorTable(label, crs, np.arange(1), np.array([shapely.box(*low[:2], *high[:2])]), QgsFields(), {})


def read_polygon_source(source: QgsProcessingFeatureSource, label: str, progress: Progress = SILENT,
                        target_wkt: str = "") -> VectorTable:
    """Read polygons in a projected CRS in metres; those in another than `target_wkt`, where given, are taken into it.

    Invalid polygons are repaired and noted in `problems`; features without a polygon keep their row, with None as
    geometry and a note. What was noted is told in one warning.

    Raises
    ------
    InputError : the CRS is missing, geographic or not in metres, or there is no polygon at all.
    """
    import numpy as np
    import shapely

    from ....urbanmap_qgis.io.reference.true_lengths import require_true_lengths

    if needs_moving(source.sourceCrs(), target_wkt):
        table = table_in(read_source(source, label, progress), target_wkt, progress)
    else:
        kind = QgsWkbTypes.geometryType(source.wkbType())
        if kind != QgsWkbTypes.GeometryType.PolygonGeometry and source.wkbType() != QgsWkbTypes.Type.Unknown:
            raise InputError(tr("{0} holds features of the kind {1}, not polygons; choose a polygon layer, or take "
                                "the polygons out of it first.").format(
                                    label, QgsWkbTypes.displayString(source.wkbType())))
        require_projected(label, source.sourceCrs())
        table = read_source(source, label, progress)
    problems: dict[int, str] = {}
    geometries = table.geometries
    for row in np.flatnonzero(~shapely.is_valid(geometries) & ~shapely.is_missing(geometries)):
        reason = shapely.is_valid_reason(geometries[row])
        geometries[row] = _polygons_of(shapely.make_valid(geometries[row]))
        problems[int(row)] = tr("The polygon was invalid and was repaired ({0}).").format(reason)
    kinds = shapely.get_type_id(geometries)
    geometries[(kinds != 3) & (kinds != 6)] = None
    for row in np.flatnonzero(shapely.is_missing(geometries)):
        problems[int(row)] = tr("The feature has no polygon.")
    if len(table) and shapely.is_missing(geometries).all():
        raise InputError(tr("{0}: none of the {1} features has a polygon; choose a polygon layer.").format(
            label, len(table)))
    if not len(table):
        raise InputError(tr("{0}: there are no polygons to work on; check the layer and its filter.").format(label))
    require_true_lengths(label, table.crs_wkt, shapely.total_bounds(geometries))
    if problems:
        shown = ", ".join(str(table.ids[row]) for row in sorted(problems)[:10])
        more = " ..." if len(problems) > 10 else ""
        progress.warn(tr("{0}: {1} of {2} polygons are empty, or invalid and were repaired (feature ids {3}{4}).")
                      .format(label, len(problems), len(table), shown, more))
    return VectorTable(label, table.crs, table.ids, geometries, table.fields, table.columns,
                       dict(sorted(problems.items())))


def write_layer(algorithm, parameters: Mapping, name: str, context: QgsProcessingContext, fields: QgsFields,
                columns: Mapping[str, Sequence], crs: QgsCoordinateReferenceSystem | str,
                geometries: Sequence | None = None, geometry_type: str = "NoGeometry", style: str = "",
                progress: Progress = SILENT) -> str | None:
    """Write one output layer, when all of it is computed.

    Destinations that are no files (memory, databases) are opened only now.

    Parameters
    ----------
    fields : see `make_fields`; `columns` has a sequence of the same length for each of their names, sliced in batches.
    geometries : shapely geometries, None where a feature has none; `geometry_type` as QGIS names it ("PolygonZ").
    crs : as QGIS's or as WKT.
    style : name of a file in resources/styles without its ending; saved into a GeoPackage and given to the layer.

    Returns
    -------
    The layer's place as QGIS knows it, or None where the user did not ask for this output.

    Raises
    ------
    OutputError : it cannot be written.
    Cancelled : the earlier file, if any, is still there.
    """
    wkb_type = getattr(QgsWkbTypes.Type, geometry_type)
    results, fields = own_fields(fields)
    earlier = earlier_words(algorithm, parameters, context) if len(results) < fields.count() else ()
    features = features_of(fields, columns, geometries, progress)
    reference = crs_from(crs)
    path = sink_file(parameters, name, context)
    if path is None:
        sink, place = algorithm.parameterAsSink(parameters, name, context, fields, wkb_type, reference)
        if sink is None:
            if parameters.get(name) in (None, ""):
                return None
            raise OutputError(tr("{0} cannot be written; choose another output.").format(
                algorithm.label_of(name)))
        _fill(sink, features, algorithm.label_of(name))
        del sink
    else:
        place = _write_file(algorithm, parameters, name, context, path, (fields, wkb_type, reference), features,
                            (style, results, earlier), progress)
    give_style(context, place, style, results, earlier)
    return place


def _wkb(geometry: QgsGeometry) -> bytes | None:
    if geometry.isNull():
        return None
    kind = geometry.wkbType()
    if QgsWkbTypes.isCurvedType(kind):
        geometry.convertToStraightSegment()
    if QgsWkbTypes.hasM(kind):
        geometry.get().dropMValue()
    return geometry.asWkb().data()


def _plain(value: object) -> object:
    return None if value is None or value == NULL else value


def _polygons_of(geometry):
    """The polygons in a geometry, as one polygon or multipolygon; None where there are none."""
    import shapely

    parts = shapely.get_parts(shapely.get_parts(geometry))
    parts = parts[shapely.get_type_id(parts) == 3]
    if len(parts) == 0:
        return None
    return parts[0] if len(parts) == 1 else shapely.multipolygons(parts)


def features_of(fields: QgsFields, columns: Mapping[str, Sequence], geometries: Sequence | None,
                progress: Progress = SILENT) -> Iterable[list[QgsFeature]]:
    """Features with the values of `columns` and shapely geometries, in batches.

    Both are sliced batch by batch, so sequences that read from a file need not fit into memory.
    """
    values, whole = [columns[item.name()] for item in fields], [item.type() == _TYPES.LongLong for item in fields]
    count = len(geometries) if geometries is not None else len(values[0]) if values else 0
    if any(len(column) != count for column in values):
        raise ValueError("columns and geometries differ in length")
    for start in range(0, count, BATCH):
        progress.check()
        yield _batch(fields, [_values(column[start:start + BATCH], kind) for column, kind in zip(values, whole)],
                     None if geometries is None else geometries[start:start + BATCH], min(BATCH, count - start))


def _batch(fields: QgsFields, values: list[list], geometries: Sequence | None, count: int) -> list[QgsFeature]:
    wkb = None
    if geometries is not None:
        import numpy as np
        import shapely

        array = np.empty(count, dtype=object)
        array[:] = list(geometries)
        wkb = shapely.to_wkb(array, output_dimension=3)
    batch = []
    for row in range(count):
        feature = QgsFeature(fields)
        feature.setAttributes([column[row] for column in values])
        if wkb is not None and wkb[row] is not None:
            geometry = QgsGeometry()
            geometry.fromWkb(wkb[row])
            feature.setGeometry(geometry)
        batch.append(feature)
    return batch


def _values(column: Sequence, whole: bool) -> list:
    """Plain Python values, whole numbers where they are to be; NaN becomes no value."""
    plain = column.tolist() if hasattr(column, "tolist") else [
        value.item() if hasattr(value, "item") else value for value in column]
    plain = [None if isinstance(value, float) and value != value else value for value in plain]
    return [int(value) if isinstance(value, float) else value for value in plain] if whole else plain


def _fill(sink: QgsFeatureSink, features: Iterable[list[QgsFeature]], label: str) -> None:
    try:
        for batch in features:
            if not sink.addFeatures(batch, QgsFeatureSink.Flag.FastInsert):
                raise OutputError(tr("{0} cannot be written: {1}").format(label, sink.lastError()))
    finally:
        # An error's traceback would keep the sink open, and with it the file that is to be removed.
        del sink


def _write_file(algorithm, parameters: Mapping, name: str, context: QgsProcessingContext, path: Path,
                layer: tuple, features: Iterable[list[QgsFeature]], looks: tuple[str, tuple[str, ...], Earlier],
                progress: Progress) -> str:
    style, results, earlier = looks
    label, definition = algorithm.label_of(name), definition_of(parameters, name)
    try:
        plain = QgsProcessingOutputLayerDefinition(str(path))
        if definition is not None:
            plain.createOptions = definition.createOptions
        sink, place = algorithm.parameterAsSink({**parameters, name: plain}, name, context, *layer)
        if sink is None:
            raise OutputError(tr("{0} cannot be written to {1}; choose another file.").format(label, path))
        try:
            _fill(sink, features, label)
        finally:
            del sink
        if path.suffix.lower() == ".gpkg":
            save_style(path, style, results, progress, earlier)
        without_times(path)
    except OSError as error:
        raise OutputError(tr("{0} cannot be written ({1}); close the program that has it open.").format(
            path, error.strerror or error)) from error
    except sqlite3.Error as error:  # on a full disk QGIS says nothing of a GeoPackage without features
        raise OutputError(tr("{0} was not written whole ({1}): make room on its disk, or choose another file.").format(
            path, error)) from error
    if definition is not None and definition.destinationProject is not None:
        title = definition.destinationName or label
        context.addLayerToLoadOnCompletion(final_text(place), QgsProcessingContext.LayerDetails(
            title, definition.destinationProject, name, QgsProcessingUtils.LayerHint.Vector))
    return place


def without_times(path: Path) -> None:
    """Put a fixed time where a GeoPackage says when it was written: the same input gives the same bytes."""
    if path.suffix.lower() != ".gpkg":
        return
    with closing(sqlite3.connect(path)) as database, database:
        tables = {name for name, in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        if "gpkg_contents" in tables:
            database.execute("UPDATE gpkg_contents SET last_change = ?", (TIME,))
    # SQLite counts the changes, and the copy of the count that says for which its size holds: GDAL writes now in one
    # more step, now in one less.
    with path.open("r+b") as file:
        for place in (24, 92):
            file.seek(place)
            file.write((1).to_bytes(4, "big"))
