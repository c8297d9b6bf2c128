"""Layers of tiles: GeoPackages of one table."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from qgis.core import (
    QgsCoordinateTransformContext,
    QgsFeatureSink,
    QgsFields,
    QgsMapLayer,
    QgsProcessingContext,
    QgsVectorFileWriter,
    QgsVectorLayer,
)

from ....urbanmap_qgis.errors import OutputError
from ....urbanmap_qgis.tiling.tile_grid import GridTile
from ..declaring.parameters import tr
from ..layers.layers import own_fields

LAYER_SUFFIX = ".gpkg"
TILE_FIELD = "tile"


def is_own(tile: GridTile, feature) -> bool:
    """Whether the middle of a feature's box is in the core: the same for every tile, and cheap."""
    if not feature.hasGeometry() or feature.geometry().isEmpty():
        return False
    middle = feature.geometry().boundingBox().center()
    return bool(tile.owns(middle.x(), middle.y()))


@contextmanager
def open_layer(path: Path) -> Iterator[QgsVectorLayer]:
    """The only layer of a GeoPackage. Nothing of it stays open when the block ends: its features must be read by then.

    Of each layer that was read QGIS keeps a connection, 0.4 MB and an open file, until an event loop has run for a
    minute. Runs over tiles have none, and read thousands of layers.
    """
    layer = QgsVectorLayer(str(path), path.stem, "ogr")
    try:
        yield layer
    finally:
        close_connections(layer)


def close_connections(layer: QgsMapLayer) -> None:
    """Let QGIS close the connections by which a layer was read; the next reading opens new ones."""
    if isinstance(layer, QgsVectorLayer) and layer.isValid() and layer.providerType() == "ogr":
        layer.dataProvider().reloadData()


@contextmanager
def layers_closed(context: QgsProcessingContext) -> Iterator[QgsProcessingContext]:
    """At the block's end the layers that a context has loaded hold no connections any more."""
    try:
        yield context
    finally:
        for layer in context.temporaryLayerStore().mapLayers().values():
            close_connections(layer)


@contextmanager
def layer_file(path: Path, fields, wkb_type, crs, name: str = "") -> Iterator[Callable[[list], None]]:
    """A new GeoPackage with one table; gives the function that adds features to it.

    Raises
    ------
    OutputError : it cannot be written, or not all features are in it in the end: the last ones are written when it is
        closed, and nobody tells when that fails.
    """
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName, options.layerName = "GPKG", name or path.stem
    written = QgsFields()
    for item in fields:
        if item.name().lower() != "fid":
            written.append(item)
    _, written = own_fields(written)
    writers = [QgsVectorFileWriter.create(str(path), written, wkb_type, crs, QgsCoordinateTransformContext(), options)]
    places = [fields.lookupField(item.name()) for item in written]

    added = [0]

    def add(features: list) -> None:  # takes the features as its own
        added[0] += len(features)
        for feature in features:
            feature.setAttributes([feature.attributes()[place] for place in places])
        if not writers[0].addFeatures(features, QgsFeatureSink.Flag.FastInsert):
            raise OutputError(tr("{0} cannot be written: {1}").format(path, writers[0].errorMessage()))

    try:
        if writers[0].hasError() != QgsVectorFileWriter.WriterError.NoError:
            raise OutputError(tr("{0} cannot be written: {1}").format(path, writers[0].errorMessage()))
        yield add
    finally:
        writers.clear()  # the file is whole when its writer is gone
    if count_of(path) != added[0]:
        raise OutputError(tr("{0} cannot be written whole: make room on its disk, and run again.").format(path))


def count_of(path: Path) -> int:
    """Number of features in the only layer of a GeoPackage; -1 where it is damaged."""
    try:
        with closing(sqlite3.connect(path)) as database:
            (table,), = database.execute("SELECT table_name FROM gpkg_contents WHERE table_name != 'layer_styles'")
            # SQLite itself quotes the name.
            (statement,), = database.execute("SELECT printf('SELECT count(*) FROM \"%w\"', ?)", (table,))
            (count,), = database.execute(statement)
    except (sqlite3.Error, ValueError):
        return -1
    return count
