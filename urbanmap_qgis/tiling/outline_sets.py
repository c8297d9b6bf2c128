"""Outlines that are moved together, and which of them a tile's buffer cuts apart.

Outlines nearer to each other than twice their longest shift are one set: where each belongs is found for all of them
together. A tile that reads a part of a set only can move its outlines otherwise than one run over everything.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..geometry.linked_groups import linked_groups
from .tile_grid import GridTile, TileGrid


def buffers_needed(outlines: np.ndarray, grid: TileGrid, tiles: Sequence[GridTile], reach: float) -> np.ndarray:
    """Buffer (n,), m, with which the tile of each outline would read all outlines of its set; NaN in no tile.

    Parameters
    ----------
    outlines : (n,) polygons; missing ones are in no tile.
    reach : m, distance up to which two are of one set.
    """
    needed = np.full(len(outlines), np.nan)
    usable = np.flatnonzero(shapely.is_geometry(outlines) & ~shapely.is_empty(outlines))
    if not len(usable):
        return needed
    boxes = shapely.bounds(outlines[usable])
    first, second = shapely.STRtree(outlines[usable]).query(outlines[usable], predicate="dwithin", distance=reach)
    _, number = linked_groups(first, second, len(usable))
    low, high = np.full((number.max() + 1, 2), np.inf), np.full((number.max() + 1, 2), -np.inf)
    np.minimum.at(low, number, boxes[:, :2])
    np.maximum.at(high, number, boxes[:, 2:])
    column, row = grid.numbers((boxes[:, 0] + boxes[:, 2]) / 2, (boxes[:, 1] + boxes[:, 3]) / 2)
    cores = {(tile.column, tile.row): tile.core for tile in tiles}
    core = np.array([cores.get(place, (np.nan,) * 4) for place in zip(column.tolist(), row.tolist())])
    beyond = np.column_stack([core[:, :2] - low[number], high[number] - core[:, 2:]]).max(axis=1)
    needed[usable] = np.maximum(beyond, 0.0)
    return needed
