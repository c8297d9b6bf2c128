"""Large clouds by tiles: what is done with the points of one tile, whatever the others hold."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..geometry.grid import Grid
from ..settings.terrain import ClothSettings
from .cloth import bottom_points, lowest_layer
from .delaunay import Blocks, block_triangles, cancel_twins, open_edges, points_of_blocks
from .lowest_heights import lowest_heights
from .outliers import VOXEL, isolated
from .rasterise import rasterise
from .surface import GROUND_CLASSES, shorter, thin_highest, thin_mean

POINT = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("c", "u1")])
VERTEX = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8")])
LEFT_OUT = np.float32(1e30)
"""Marks cells of triangles that are left out."""

_TILE_METRES = 256.0
_KEY_SHIFT = 1 << 30


@dataclass(frozen=True)
class Tiling:
    """Square tiles on multiples of their side, made of whole raster cells.

    Parameters
    ----------
    cell : raster cell, m.
    cells : raster cells along a tile's side.
    """

    cell: float
    cells: int

    @classmethod
    def for_blocks(cls, cell: float, blocks: Blocks) -> Tiling:
        """Tiles that hold whole blocks with their margin within the next tile."""
        return cls(cell, math.ceil(max(_TILE_METRES, 2 * (blocks.side + blocks.radius)) / cell))

    @property
    def side(self) -> float:
        """Side of a tile, m."""
        return self.cell * self.cells

    def keys(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Key of the tile of each point, (n,) int64."""
        return self.key(self._number(x), self._number(y))

    def _number(self, coordinate: np.ndarray) -> np.ndarray:
        """Column or row of the tile of coordinates (n,); divided as real numbers, twice as fast and as exact."""
        number = coordinate / self.cell
        np.floor(number, out=number)
        number /= self.cells
        return np.floor(number, out=number).astype(np.int64)

    @staticmethod
    def key(column, row):
        """Key of a tile, growing by rows."""
        return (row + _KEY_SHIFT) * (2 * _KEY_SHIFT) + column + _KEY_SHIFT

    @staticmethod
    def column_row(key: int) -> tuple[int, int]:
        """Column and row of a tile."""
        return key % (2 * _KEY_SHIFT) - _KEY_SHIFT, key // (2 * _KEY_SHIFT) - _KEY_SHIFT

    def box(self, key: int) -> tuple[float, float, float, float]:
        """(x_min, y_min, x_max, y_max) of a tile."""
        column, row = self.column_row(key)
        return (column * self.side, row * self.side, (column + 1) * self.side, (row + 1) * self.side)

    def around(self, key: int) -> list[int]:
        """Keys of a tile and its eight neighbours, the tile first."""
        column, row = self.column_row(key)
        return [key] + [self.key(column + j, row + i) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]


@dataclass(frozen=True)
class TilePoints:
    """Points of a tile, its own first, then those of a margin round it.

    Attributes
    ----------
    records : (n,) of dtype `POINT`, or columns (n,) by the names that are needed.
    own_count : number of own points.
    box : of the tile.
    """

    records: Any
    own_count: int
    box: tuple[float, float, float, float]


@dataclass(frozen=True)
class ClothPart:
    """A part of a raster of the cloth's nodes: the nodes that a tile answers for."""

    rows: slice
    columns: slice
    layers: tuple[np.ndarray, ...]


def point_margin(settings: ClothSettings) -> float:
    """Width, m, of the margin that `reduce_tile` needs round a tile."""
    return 2 * VOXEL + 4 * settings.resolution


def reduce_tile(tile: TilePoints, cell: float, neighbours: int, cloth_grid: Grid | None
                ) -> tuple[np.ndarray, np.ndarray, ClothPart | None]:
    """What a tile's points leave behind at first reading.

    Parameters
    ----------
    cell : raster cell, m.
    neighbours : see `outliers.isolated`.
    cloth_grid : grid of the whole cloth; None if ground points are told by class.

    Returns
    -------
    The highest points of the cells and, told by class, the mean ground points (`VERTEX` arrays; the second is
    empty with a cloth), and the cloth's levels in the tile.
    """
    x, y, z, classes = (tile.records[name] for name in "xyzc")
    crowd = ~isolated(x, y, z, neighbours=neighbours)
    thinned = crowd[:tile.own_count]
    ox, oy, oz = (np.ascontiguousarray(values[:tile.own_count][thinned]) for values in (x, y, z))
    top = thin_highest(ox, oy, oz, cell)
    highest = _vertices(ox[top], oy[top], oz[top])
    if cloth_grid is None:
        ground = np.isin(classes[:tile.own_count][thinned], GROUND_CLASSES)
        return highest, _vertices(*thin_mean(ox[ground], oy[ground], oz[ground], cell)), None
    return highest, _vertices(ox[:0], oy[:0], oz[:0]), lowest_heights_of_tile(tile, neighbours, cloth_grid)


def lowest_heights_of_tile(tile: TilePoints, neighbours: int, cloth_grid: Grid) -> ClothPart:
    """Lowest heights (see `cloth.LowestHeights`) of the cloth's nodes in a tile; parameters as of `reduce_tile`."""
    x, y, z = (np.ascontiguousarray(tile.records[name]) for name in "xyz")
    grid = _window(cloth_grid, x, y)
    levels = lowest_heights(x, y, z, grid, neighbours)
    return _own_nodes(cloth_grid, grid, tile.box, (levels.lowest, levels.second, levels.support))


def layer_of_tile(tile: TilePoints, cloth_grid: Grid, lowest: np.ndarray, cloth: np.ndarray) -> ClothPart:
    """Lowest layer (see `cloth.lowest_layer`) of the nodes of a tile.

    Parameters
    ----------
    lowest, cloth : (rows, columns) of the whole cloth: believed lowest heights, first cloth.
    """
    x, y, z = (tile.records[name] for name in "xyz")
    grid = _window(cloth_grid, x, y)
    rows, columns = _slices(cloth_grid, grid)
    bottom = bottom_points(x, y, z, grid, lowest[rows, columns])
    return _own_nodes(cloth_grid, grid, tile.box, (lowest_layer(bottom, cloth[rows, columns]),))


def ground_of_tile(tile: TilePoints, cell: float, cloth_grid: Grid, lowest: np.ndarray, cloth: np.ndarray,
                   threshold: float) -> tuple[np.ndarray, int]:
    """Mean ground points of the cells of a tile (`VERTEX`), and how many points are ground.

    Parameters
    ----------
    lowest, cloth : (rows, columns) of the whole cloth: believed lowest heights, converged cloth.
    """
    records = tile.records[:tile.own_count]
    records = records[records["c"] != 6]
    x, y, z = (np.ascontiguousarray(records[name]) for name in "xyz")
    if not len(x):
        return _vertices(x, y, z), 0
    grid = _window(cloth_grid, x, y)
    window = _slices(cloth_grid, grid)
    bottom = bottom_points(x, y, z, grid, lowest[window])
    near = np.abs(bottom.z - bottom.place.heights(cloth[window])) <= threshold
    ground = bottom.points[near]
    return _vertices(*thin_mean(x[ground], y[ground], z[ground], cell)), len(ground)


def _vertices(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """`VERTEX` array of points."""
    records = np.empty(len(x), dtype=VERTEX)
    records["x"], records["y"], records["z"] = x, y, z
    return records


def _window(whole: Grid, x: np.ndarray, y: np.ndarray) -> Grid:
    """Part of a grid that covers points, with one cell more on each side as far as there is one."""
    rows, columns, _inside = whole.cells(np.array([x.min(), x.max()]), np.array([y.max(), y.min()]))
    top, bottom = max(int(rows[0]) - 1, 0), min(int(rows[1]) + 2, whole.rows)
    left, right = max(int(columns[0]) - 1, 0), min(int(columns[1]) + 2, whole.columns)
    return Grid(whole.x_min + left * whole.cell, whole.y_max - top * whole.cell, whole.cell,
                bottom - top, right - left)


def _slices(whole: Grid, part: Grid) -> tuple[slice, slice]:
    """Rows and columns of a grid that a part of it takes."""
    top = round((whole.y_max - part.y_max) / whole.cell)
    left = round((part.x_min - whole.x_min) / whole.cell)
    return slice(top, top + part.rows), slice(left, left + part.columns)


def _own_nodes(whole: Grid, part: Grid, box: tuple[float, float, float, float],
               layers: tuple[np.ndarray, ...]) -> ClothPart:
    """The nodes of `part` whose centres lie in a tile, as a part of the whole grid."""
    x_min, y_min, x_max, y_max = box
    cx, cy = part.centres()
    columns = np.flatnonzero((cx >= x_min) & (cx < x_max))
    rows = np.flatnonzero((cy >= y_min) & (cy < y_max))
    if not len(rows) or not len(columns):
        return ClothPart(slice(0, 0), slice(0, 0), tuple(layer[:0, :0] for layer in layers))
    inner = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    place = _slices(whole, part)
    return ClothPart(slice(place[0].start + rows[0], place[0].start + rows[-1] + 1),
                     slice(place[1].start + columns[0], place[1].start + columns[-1] + 1),
                     tuple(layer[inner] for layer in layers))


@dataclass(frozen=True)
class TileVertices:
    """Vertices of a tile and its margin, each with its number in the whole surface, ascending.

    Attributes
    ----------
    x, y, z : (n,).
    number : (n,) int64.
    inside : (n,) bool, belongs to the tile itself.
    key : of the tile.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    number: np.ndarray
    inside: np.ndarray
    key: int


@dataclass(frozen=True)
class TileSurface:
    """The small triangles of a tile.

    Attributes
    ----------
    rows, columns : where `raster` lies in the whole.
    raster : NaN where no triangle covers, LEFT_OUT where one that is too long does.
    count : of triangles.
    triangles : (m, 3) vertex numbers of those that are not too long.
    edges : (k, 2) open directed edges, in vertex numbers.
    unused : numbers of own vertices without a triangle.
    numbers, vertices : corners of the edges and unused vertices with their places.
    used_elsewhere : numbers of the vertices of other tiles that the triangles use.
    """

    rows: slice
    columns: slice
    raster: np.ndarray
    count: int
    triangles: np.ndarray
    edges: np.ndarray
    numbers: np.ndarray
    vertices: np.ndarray
    unused: np.ndarray
    used_elsewhere: np.ndarray


def triangulate_tile(tile: TileVertices, tiling: Tiling, blocks: Blocks, grid: Grid,
                     max_edge: float) -> TileSurface:
    """Triangles of the blocks whose lower left corner lies in a tile, and their heights on the raster."""
    x_min, y_min, x_max, y_max = tiling.box(tile.key)
    first, last = _blocks_with_corner_in(blocks, x_min, x_max), _blocks_with_corner_in(blocks, y_min, y_max)
    parts, edge_parts = [np.empty((0, 3), dtype=np.int64)], [np.empty((0, 2), dtype=np.int64)]
    for column, row, points in points_of_blocks(tile.x, tile.y, blocks, (first[0], last[0]),
                                                (first[1], last[1])):
        corners = block_triangles(tile.x[points], tile.y[points], blocks, column, row)
        parts.append(points[corners])
        edge_parts.append(points[open_edges(corners)])
    triangles = np.concatenate(parts)
    edges = cancel_twins(np.concatenate(edge_parts))
    used = np.zeros(len(tile.x), dtype=bool)
    used[triangles] = True
    unused = np.flatnonzero(tile.inside & ~used)
    vertices = np.union1d(edges, unused)
    short = shorter(tile.x, tile.y, triangles, max_edge)
    rows, columns, raster = _raster_of(tile, triangles, short, grid)
    return TileSurface(rows, columns, raster, len(triangles), tile.number[short], tile.number[edges],
                       tile.number[vertices], _vertices(tile.x[vertices], tile.y[vertices], tile.z[vertices]),
                       tile.number[unused], tile.number[used & ~tile.inside])


def _blocks_with_corner_in(blocks: Blocks, low: float, high: float) -> tuple[int, int]:
    """First and last number, along one axis, of the blocks that begin in [low, high)."""
    first = blocks.of(low, low)[0]
    while blocks.box(first, 0)[0] < low:
        first += 1
    last = blocks.of(high, high)[0]
    while blocks.box(last, 0)[0] >= high:
        last -= 1
    return first, last


def _raster_of(tile: TileVertices, triangles: np.ndarray, short: np.ndarray,
               grid: Grid) -> tuple[slice, slice, np.ndarray]:
    """Heights of short triangles on the part of the grid that all touch; LEFT_OUT in the others."""
    if not len(triangles):
        return slice(0, 0), slice(0, 0), np.empty((0, 0), dtype=np.float32)
    corners = np.unique(triangles)
    x, y = tile.x[corners], tile.y[corners]
    rows, columns, part = grid.window(x.min(), y.min(), x.max(), y.max())
    raster = np.full(part.shape, np.nan, dtype=np.float32)
    rasterise(tile.x, tile.y, tile.z, short, part, raster)
    if len(short) < len(triangles):
        rasterise(tile.x, tile.y, np.full(len(tile.z), LEFT_OUT), triangles, part, raster, only_empty=True)
    return rows, columns, raster
