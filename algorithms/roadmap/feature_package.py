"""Several layers in one GeoPackage."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from qgis.core import QgsCoordinateTransformContext, QgsFeatureSink, QgsFields, QgsVectorFileWriter, QgsWkbTypes

from ...urbanmap_qgis.errors import OutputError
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from
from ..framework.layers.layers import features_of, without_times


class PackageLayer(NamedTuple):
    """A layer to write: its name, fields, columns by field, shapely geometries and their type as QGIS names it."""

    name: str
    fields: QgsFields
    columns: Mapping[str, Sequence]
    geometries: Sequence
    geometry_type: str


def geometry_type_of(geometries: Sequence) -> str:
    """QGIS's name of the one type that holds all geometries; "Unknown" where they are of several kinds."""
    known = [shape for shape in geometries if shape is not None]
    kinds = {shape.geom_type for shape in known}
    simple = {kind.removeprefix("Multi") for kind in kinds}
    if len(simple) != 1:
        return "Unknown"
    kind = kinds.pop() if len(kinds) == 1 else f"Multi{simple.pop()}"
    return f"{kind}Z" if any(shape.has_z for shape in known) else kind


def write_package(path: Path, layers: Sequence[PackageLayer], crs) -> None:
    """Write layers into a new GeoPackage.

    Raises
    ------
    OutputError : it cannot be written.
    """
    for number, layer in enumerate(layers):
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.driverName, options.layerName = "GPKG", layer.name
        if number:
            options.actionOnExistingFile = QgsVectorFileWriter.ActionOnExistingFile.CreateOrOverwriteLayer
        wkb_type = getattr(QgsWkbTypes.Type, layer.geometry_type)
        # The writer changes fields in their place; the caller's stay as they are.
        writer = QgsVectorFileWriter.create(str(path), QgsFields(layer.fields), wkb_type, crs_from(crs),
                                            QgsCoordinateTransformContext(), options)
        failed = writer.hasError() != QgsVectorFileWriter.WriterError.NoError
        for batch in [] if failed else features_of(layer.fields, layer.columns, layer.geometries):
            failed = failed or not writer.addFeatures(batch, QgsFeatureSink.Flag.FastInsert)
        message = writer.errorMessage()
        del writer
        if failed:
            raise OutputError(tr("{0} cannot be written: {1}").format(path.name, message))
    without_times(path)
