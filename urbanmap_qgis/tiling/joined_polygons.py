"""Polygons of rasters, such as road markings, cut at the edges of tiles and joined again across them.

A marking may be longer than any buffer. So that all ground is one tile's own, each tile keeps of its polygons what
lies in it; pieces that meet along an edge are one polygon again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from ..geometry.linked_groups import linked_groups
from ..geometry.tolerances import LEAST_SQUARE, ROUNDING
from .tile_grid import GridTile

WHOLE, JOINED, CUT = "", "joined", "cut"
"""What the field `seam` says: no edge is near, pieces of several tiles, cut at an edge beyond which there is none."""

SUMMED = ("area", "length")
"""Fields that add up over the pieces of a polygon; other numbers are means by area."""

_NEAR = 1e-4
_LEAST = 1e-3
"""Edges nearer than the first are the same, where they run together for longer than the second, m."""


def cut_at_tile(polygons: Sequence[shapely.Geometry | None], tile: GridTile
                ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What of polygons lies in a tile.

    Returns
    -------
    pieces : (m,) polygons.
    rows : (m,) of each, the polygon it is of.
    shares : (m,) of that polygon's area, 0 to 1.
    """
    given = np.empty(len(polygons), object)
    given[:] = polygons
    square = tile.square
    shapely.prepare(square)
    cut = np.where(shapely.contains_properly(square, given), given, None)
    crossing = np.flatnonzero(shapely.is_missing(cut) & shapely.intersects(square, given))
    cut[crossing] = shapely.intersection(given[crossing], square)
    parts, rows = shapely.get_parts(cut, return_index=True)
    keep = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & (shapely.area(parts) > 0)
    parts, rows = parts[keep], rows[keep]
    return parts, rows, shapely.area(parts) / np.maximum(shapely.area(given[rows]), LEAST_SQUARE)


def at_edge(pieces: np.ndarray, tile: GridTile) -> np.ndarray:
    """Mask (m,) of the pieces that touch the edge of their tile."""
    return shapely.dwithin(pieces, tile.square.exterior, _NEAR)


def share_of_fields(columns: Mapping[str, Sequence], rows: np.ndarray, shares: np.ndarray) -> dict[str, list]:
    """Fields of pieces out of those of their polygons: areas and lengths by the share of the area."""
    shared = {}
    for name, column in columns.items():
        picked = [column[row] for row in rows]
        if name in SUMMED:
            picked = [value if value is None or share > 1 - ROUNDING else value * share
                      for value, share in zip(picked, shares)]
        shared[name] = picked
    return shared


def groups_across(pieces: np.ndarray, tiles: Sequence[str]) -> np.ndarray:
    """Number (m,) int64 of the polygon that each piece is of: pieces of other tiles that share an edge are one."""
    near = shapely.STRtree(pieces).query(pieces, predicate="dwithin", distance=_NEAR).T.tolist()
    links = [(one, other) for one, other in near
             if one < other and tiles[one] != tiles[other] and _share_edge(pieces[one], pieces[other])]
    _, group = linked_groups(*np.array(links, np.int64).reshape(-1, 2).T, len(pieces))
    return np.unique(group, return_index=True)[1][group]


def _share_edge(one: shapely.Polygon, other: shapely.Polygon) -> bool:
    together = shapely.intersection(shapely.buffer(one, _NEAR, quad_segs=1), other)
    return shapely.area(together) > 0.5 * _NEAR * _LEAST


def joined(pieces: np.ndarray, tiles: Sequence[str], columns: Mapping[str, Sequence]
           ) -> tuple[list[shapely.Polygon], dict[str, list]]:
    """Pieces at the edges of tiles put together.

    Parameters
    ----------
    pieces : (m,) polygons.
    tiles : names of the tiles that they are of.
    columns : their fields.

    Returns
    -------
    polygons, and their fields: sums of `SUMMED`, of other numbers means by area, of everything else what the largest
    piece says; `seam` says how they came about. The order is that of their first pieces.
    """
    groups = groups_across(pieces, tiles)
    polygons, joined_columns = [], {name: [] for name in [*columns, "seam"]}
    for group in np.unique(groups):
        members = np.flatnonzero(groups == group)
        areas = shapely.area(pieces[members])
        whole = pieces[members[0]] if len(members) == 1 else shapely.union_all(pieces[members], grid_size=_NEAR / 10)
        parts = shapely.get_parts(whole)
        for part in parts:
            share = 1.0 if len(parts) == 1 else part.area / whole.area
            polygons.append(part)
            joined_columns["seam"].append(JOINED if len(members) > 1 else CUT)
            for name, column in columns.items():
                joined_columns[name].append(_joined_field(name, [column[row] for row in members], areas, share))
    return polygons, joined_columns


def _joined_field(name: str, values: list, areas: np.ndarray, share: float) -> object:
    numbers = [isinstance(value, (int, float)) and not isinstance(value, bool) for value in values]
    if not all(numbers):
        return values[int(np.argmax(areas))]
    if name in SUMMED:
        return float(np.sum(values)) * share
    return float(np.average(values, weights=np.maximum(areas, LEAST_SQUARE)))
