"""Layers whose polygons are cut at the edges of tiles, and joined again when tiles are put together."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from qgis.core import QgsProcessingContext, QgsProcessingFeatureSource, QgsVectorLayer

from ....urbanmap_qgis.tiling.tile_grid import GridTile
from ..layers import layers
from ..layers.styles import save_style_text, saved_style
from .tile_layers import TILE_FIELD, layer_file, open_layer

SEAM, EDGE = "seam", "edge"
"""The field that tells pieces at an edge, and what it says in the layer of one tile."""


def read_layer(path: Path) -> layers.VectorTable:
    """The only layer of a GeoPackage in memory."""
    with open_layer(path) as layer:
        return layers.read_source(QgsProcessingFeatureSource(layer, QgsProcessingContext()), path.name)


def cut_features(path: Path, tile: GridTile) -> None:
    """Leave in a layer of polygons what lies in the tile, with the tile's name and whether a piece is at its edge."""
    from ....urbanmap_qgis.tiling.joined_polygons import at_edge, cut_at_tile, share_of_fields

    table, kind, style = read_layer(path), QgsVectorLayer(str(path), path.stem, "ogr").wkbType(), saved_style(path)
    pieces, rows, shares = cut_at_tile(table.geometries, tile)
    columns = share_of_fields(table.columns, rows, shares)
    columns[TILE_FIELD] = [tile.name] * len(pieces)
    columns[SEAM] = [EDGE if near else "" for near in at_edge(pieces, tile)]
    scratch = path.with_name(f"cut-{path.name}")
    with layer_file(scratch, joined_fields(table.fields), kind, table.crs, path.stem) as add:
        for batch in layers.features_of(joined_fields(table.fields), columns, pieces):
            add(batch)
    if style is not None:
        save_style_text(scratch, *style)
    layers.without_times(scratch)
    os.replace(scratch, path)


def joined_fields(fields):
    """Fields of a layer and those that tell tile and seam."""
    return layers.make_fields((TILE_FIELD, "text"), (SEAM, "text"), base=fields)


class EdgePieces:
    """Collects from the layers of tiles what lies at their edges, and joins it in the end."""

    def __init__(self):
        self._pieces: list = []
        self._columns: dict[str, list] = {}

    def collect(self, table: layers.VectorTable) -> tuple[Mapping[str, list], list]:
        """Keep the pieces at edges; columns and polygons of all others."""
        edge = [value == EDGE for value in table.columns[SEAM]]
        for name, column in table.columns.items():
            self._columns.setdefault(name, []).extend(value for value, near in zip(column, edge) if near)
        self._pieces += [piece for piece, near in zip(table.geometries, edge) if near]
        return ({name: [value for value, near in zip(column, edge) if not near]
                 for name, column in table.columns.items()},
                [piece for piece, near in zip(table.geometries, edge) if not near])

    def joined(self) -> tuple[Mapping[str, list], list]:
        """Columns and polygons of what was collected, put together."""
        import numpy as np

        from ....urbanmap_qgis.tiling.joined_polygons import joined

        if not self._pieces:
            return self._columns, []
        pieces = np.empty(len(self._pieces), object)
        pieces[:] = self._pieces
        rest = {name: column for name, column in self._columns.items() if name != SEAM}
        polygons, columns = joined(pieces, self._columns[TILE_FIELD], rest)
        return columns, polygons
