"""A surface laid on the whole raster, tile by tile, then the gaps between the tiles' triangles."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from ..errors import InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.ply import MeshWriter
from ..progress import Progress
from ..wording import say
from .cloud_tiles import CloudTiles, TiledVertices
from .delaunay import bridge, cancel_twins
from .rasterise import rasterise
from .surface import frame_points, shorter
from .tiles import LEFT_OUT, VERTEX, TileSurface, TileVertices, triangulate_tile

_IN_MEMORY = 1_000_000_000  # bytes of a raster; a larger one is a temporary file
_FAR = 10.0  # m


class Canvas:
    """One surface on the whole raster.

    While it is made, `LEFT_OUT` marks cells of triangles that are left out.

    Attributes
    ----------
    raster : (rows, columns) float32.
    covered : cells inside the surface's outline, also where triangles were left out.
    triangles, left_out : number of triangles, and of those longer than `max_edge`.
    far : m from which a triangle's side spans a place without points.
    far_share : share of the raster in triangles with such a side.
    """

    def __init__(self, work: CloudTiles, vertices: TiledVertices, progress: Progress, max_edge: float = 0.0,
                 mesh: MeshWriter | None = None, framed: bool = False):
        self.work, self.vertices, self.max_edge, self.mesh = work, vertices, max_edge, mesh
        self.triangles = self.left_out = 0
        self.far = max(_FAR, 2 * work.blocks.radius)
        progress.message(say("Triangulating the ground.") if framed else say("Triangulating the surface."))
        self.raster = self._blank()
        if mesh:
            for key in sorted(vertices.counts):
                piece = vertices.read(key)
                mesh.add_vertices(piece["x"], piece["y"], piece["z"])
        edges, numbers, places = self._small(progress.part(0.0, 0.9))
        self._large(edges, numbers, places, framed)
        progress.step(1.0)

    def _blank(self) -> np.ndarray:
        """An empty raster, in a temporary file if it is large."""
        shape = self.work.grid.shape
        if 4 * shape[0] * shape[1] <= _IN_MEMORY:
            return np.full(shape, np.nan, dtype=np.float32)
        folder = self.work.stack.enter_context(tempfile.TemporaryDirectory(prefix="urbanmap-"))
        raster = np.memmap(Path(folder) / "raster", dtype=np.float32, mode="w+", shape=shape)
        raster[:] = np.nan
        return raster

    def _small(self, progress: Progress) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Lay the small triangles of all tiles; open edges, and numbers and places of what is on the rim."""
        keys = sorted({near for key in self.vertices.counts for near in self.work.tiling.around(key)})
        work = partial(triangulate_tile, tiling=self.work.tiling, blocks=self.work.blocks, grid=self.work.grid,
                       max_edge=self.max_edge)
        edges, numbers, places = ([np.empty((0, 2), dtype=np.int64)], [np.empty(0, dtype=np.int64)],
                                  [np.empty(0, dtype=VERTEX)])
        unused, used_elsewhere = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        for step, tile in enumerate(in_order(work, self._tiles(keys), self.work.executor)):
            self._lay(tile)
            edges.append(tile.edges)
            numbers.append(tile.numbers)
            places.append(tile.vertices)
            unused.append(tile.unused)
            used_elsewhere.append(tile.used_elsewhere)
            progress.step((step + 1) / len(keys))
        open_edges = cancel_twins(np.concatenate(edges))
        alone = np.setdiff1d(np.concatenate(unused), np.concatenate(used_elsewhere))
        wanted = np.union1d(open_edges, alone)
        known, first = np.unique(np.concatenate(numbers), return_index=True)
        return open_edges, wanted, np.concatenate(places)[first[np.searchsorted(known, wanted)]]

    def _tiles(self, keys: list[int]) -> Iterator[TileVertices]:
        """Vertices of each tile and of a margin that holds its blocks."""
        starts = self.vertices.starts()
        margin = self.work.blocks.side + self.work.blocks.radius + 1.0
        for key in keys:
            x_min, y_min, x_max, y_max = self.work.tiling.box(key)
            parts, numbers, in_tile = [], [], []
            for near in sorted(self.work.tiling.around(key)):
                if near not in starts:
                    continue
                piece = self.vertices.read(near)
                inside = ((piece["x"] >= x_min - margin) & (piece["x"] <= x_max + margin)
                          & (piece["y"] >= y_min - margin) & (piece["y"] <= y_max + margin))
                parts.append(piece[inside])
                numbers.append(starts[near] + np.flatnonzero(inside))
                in_tile.append(np.full(len(parts[-1]), near == key))
            records = np.concatenate(parts)
            yield TileVertices(*(np.ascontiguousarray(records[name]) for name in "xyz"), np.concatenate(numbers),
                               np.concatenate(in_tile), key)

    def _lay(self, tile: TileSurface) -> None:
        """Put a tile's heights onto the raster and its triangles into the mesh."""
        target = self.raster[tile.rows, tile.columns]
        filled = ~np.isnan(tile.raster)
        target[filled] = tile.raster[filled]
        self.triangles += tile.count
        self.left_out += tile.count - len(tile.triangles)
        if self.mesh:
            self.mesh.add_triangles(tile.triangles)

    def _large(self, edges: np.ndarray, numbers: np.ndarray, places: np.ndarray, framed: bool) -> None:
        """Close the gaps between the small triangles."""
        x, y, z = (np.ascontiguousarray(places[name]) for name in "xyz")
        rim = np.searchsorted(numbers, edges)
        if framed:
            frame = frame_points(x, y, z, self.work.grid.bounds)
            x, y, z = (np.concatenate(pair) for pair in zip((x, y, z), frame))
        large = bridge(x, y, rim)
        if not self.triangles + len(large):
            raise InsufficientDataError(say("The points lie in fewer than three places or on one line: a surface "
                                            "cannot be built from them."))
        small = shorter(x, y, large, self.max_edge)
        rasterise(x, y, z, small, self.work.grid, self.raster)
        if len(small) < len(large):
            rasterise(x, y, np.full(len(z), LEFT_OUT), large, self.work.grid, self.raster, only_empty=True)
        self.covered = ~np.isnan(self.raster)
        self.raster[self.raster == LEFT_OUT] = np.nan
        self.triangles += len(large)
        self.left_out += len(large) - len(small)
        if self.mesh:
            self.mesh.add_triangles(numbers[small])
        self.far_share = _share_of(x, y, small, shorter(x, y, small, self.far), self.work.grid) if not framed else 0.0


def _share_of(x: np.ndarray, y: np.ndarray, triangles: np.ndarray, without: np.ndarray, grid: Grid) -> float:
    """Area of triangles less that of some of them, as a share of the grid's area."""
    def area(corners: np.ndarray) -> float:
        a, b, c = corners.T
        return 0.5 * float(np.sum((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])))
    return (area(triangles) - area(without)) / (grid.rows * grid.columns * grid.cell ** 2)
