"""The reference markings as a parameter: a mask raster or a polygon layer."""

from __future__ import annotations

from pathlib import Path

from qgis.core import (
    QgsProcessing,
    QgsProcessingFeatureSource,
    QgsProcessingParameterMapLayer,
    QgsRasterLayer,
    QgsWkbTypes,
)

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers import layers

HELP = ("The reference: a raster whose cells are above 0 where there is paint, or marking polygons. “Road markings "
        "from orthophoto” makes both.")


def add_markings(algorithm, optional: bool = False) -> None:
    """Declare MARKINGS."""
    kinds = QgsProcessing.SourceType
    algorithm.declare_parameter(QgsProcessingParameterMapLayer(
        "MARKINGS", tr("Reference markings"), None, optional, [kinds.TypeRaster, kinds.TypeVectorPolygon]), HELP)


def read_reference(algorithm, parameters, context, ground, progress):
    """The core's `Reference` of MARKINGS, with heights from the raster file `ground` (or None), and its CRS."""
    from ...urbanmap_qgis.mobile.registration.start.reference import Reference

    label = algorithm.label_of("MARKINGS")
    layer = algorithm.parameterAsLayer(parameters, "MARKINGS", context)
    if layer is None or not layer.isValid():
        raise InputError(tr("{0}: {1} is neither a raster nor a polygon layer; check the file.").format(
            label, parameters.get("MARKINGS")))
    if isinstance(layer, QgsRasterLayer):
        path = Path(layer.source().split("|")[0])
        if not path.is_file():
            raise InputError(tr("{0}: {1} is no file; export the layer to a GeoTIFF first.").format(
                label, layer.name()))
        return Reference.from_mask(path, ground), layer.crs()
    polygon = QgsWkbTypes.GeometryType.PolygonGeometry
    if not hasattr(layer, "wkbType") or QgsWkbTypes.geometryType(layer.wkbType()) != polygon:
        raise InputError(tr("{0}: {1} is neither a raster nor a polygon layer; choose another one.").format(
            label, layer.name()))
    table = layers.read_polygon_source(QgsProcessingFeatureSource(layer, context), label, progress)
    return Reference.from_polygons(table.geometries, ground, table.crs_wkt), table.crs
