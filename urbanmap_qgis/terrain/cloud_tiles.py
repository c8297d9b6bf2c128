"""Points of files of any size sorted into tiles, and the vertices of surface and ground that come of them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack
from functools import partial

import numpy as np

from ..errors import InputError, InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ..io.points.whole_records import joined_records, record_rows
from ..progress import Progress
from ..settings.terrain import SurfaceSettings
from ..wording import say
from .cloth import LowestHeights, final_cloth, first_cloth
from .delaunay import Blocks
from .outliers import isolation_limit, plausible
from .surface import GROUND_CLASSES, GroundSource
from .tiles import (
    POINT,
    VERTEX,
    ClothPart,
    TilePoints,
    Tiling,
    ground_of_tile,
    layer_of_tile,
    point_margin,
    reduce_tile,
)

MOST_CELLS = 4_000_000_000
MOST_NODES = 100_000_000
PLACE = 1000.0  # m
# times the squares of `place` with points: a corridor of 100 km from corner to corner takes 35
LEAST_FILLED = 300
WIDEST_SPACING = 5.0  # m


class CloudTiles:
    """The points of a cloud on their way to vertices, tile by tile.

    Attributes
    ----------
    cloud, settings, executor, stack : as given; `stack` closes what lies on the disk.
    neighbours : within a voxel, below which a point is alone in space.
    blocks, tiling : how points are cut into pieces of work.
    highest, ground : vertices of the surface and of the ground.
    class_counts : (256,) usable points of each class.
    keys : tiles with points.
    ground_points : number of them.
    grid, cloth_grid : places of the rasters and of the cloth's nodes, after `read`.
    """

    def __init__(self, cloud: PointCloud, settings: SurfaceSettings, executor: Executor | None, stack: ExitStack):
        self.cloud, self.settings, self.executor, self.stack = cloud, settings, executor, stack
        extent = np.maximum(cloud.maximum[:2] - cloud.minimum[:2], settings.resolution)
        area = float(extent[0] * extent[1])
        spacing = math.sqrt(area / cloud.point_count)
        self.neighbours = isolation_limit(cloud.point_count, area)
        self.blocks = Blocks.for_spacing(max(settings.resolution, min(spacing, WIDEST_SPACING)))
        self.tiling = Tiling.for_blocks(settings.resolution, self.blocks)
        self.points = stack.enter_context(PointBuckets(POINT))
        self.highest, self.ground = TiledVertices(stack), TiledVertices(stack)
        self.class_counts = np.zeros(256, dtype=np.int64)
        self.keys: list[int] = []
        self.ground_points = 0

    @property
    def points_used(self) -> int:
        """Points that are neither noise nor withheld and have a height in reason."""
        return int(self.class_counts.sum())

    def read(self, progress: Progress) -> None:
        """Sort the points into tiles; find the extent."""
        low, high, keys, places = np.full(2, np.inf), np.full(2, -np.inf), set(), Counter()
        for chunk in iter_chunks(self.cloud, progress):
            records = np.empty(len(chunk), dtype=POINT)
            records["x"], records["y"], records["z"] = chunk.x, chunk.y, chunk.z
            records["c"] = chunk.classification
            records = record_rows(records, valid_points(chunk) & plausible(records["x"], records["y"], records["z"]))
            if not len(records):
                continue
            self.class_counts += np.bincount(records["c"], minlength=256)
            low = np.minimum(low, [records["x"].min(), records["y"].min()])
            high = np.maximum(high, [records["x"].max(), records["y"].max()])
            tile = self.tiling.keys(records["x"], records["y"])
            keys.update(np.unique(tile).tolist())
            place, count = np.unique(np.floor(records["x"] / PLACE) + 1j * np.floor(records["y"] / PLACE),
                                     return_counts=True)
            places.update(dict(zip(place.tolist(), count.tolist())))
            self.points.add(tile, records)
        if not keys:
            raise InsufficientDataError(say("{paths} holds no usable points: all are noise, withheld or have no "
                                            "valid height.", paths=self.cloud.paths[0].name))
        self.keys = sorted(keys)
        self.grid = Grid.covering(*low, *high, self.settings.resolution)
        if self.grid.rows * self.grid.columns > MOST_CELLS:
            raise InputError(say("The raster would have {columns:,} x {rows:,} cells: choose a coarser resolution, "
                                 "or check for points far outside the area.", columns=self.grid.columns,
                                 rows=self.grid.rows))
        _require_filled(places)
        cell = self.settings.cloth.resolution
        cloth = Grid.covering(*low, *high, cell)
        self.cloth_grid = Grid(cloth.x_min, cloth.y_max, cell, cloth.rows + 1, cloth.columns + 1)

    def reduce(self, source: GroundSource | None, progress: Progress) -> None:
        """Highest points and ground points of all cells."""
        with_cloth = source is not None and source.method == "cloth"
        grid = self.cloth_grid if with_cloth else None
        if grid and grid.rows * grid.columns > MOST_NODES:
            raise InputError(say("The area is too large for one cloth: choose a coarser cloth resolution."))
        levels = [np.full(grid.shape, fill) for fill in (np.inf, np.inf, 0)] if grid else []
        work = partial(reduce_tile, cell=self.settings.resolution, neighbours=self.neighbours, cloth_grid=grid)
        progress.message(say("Finding the highest points of the cells."))
        pieces = self._tiles(point_margin(self.settings.cloth))
        for step, (highest, ground, part) in enumerate(in_order(work, pieces, self.executor)):
            self.highest.add(self.keys[step], highest)
            self.ground.add(self.keys[step], ground)
            if part:
                _put(levels, part)
            progress.step(0.4 * (step + 1) / len(self.keys))
        if with_cloth:
            self._drape(LowestHeights(*levels), progress.part(0.4, 1.0))
        elif source:
            self.ground_points = int(self.class_counts[list(GROUND_CLASSES)].sum())

    def _drape(self, levels: LowestHeights, progress: Progress) -> None:
        """Ground points by the cloth."""
        cloth = self.settings.cloth
        progress.message(say("Settling the cloth."))
        first, trend, lowest = first_cloth(levels, cloth, progress.part(0.0, 0.2))
        layer = [np.full(lowest.shape, np.inf)]
        work = partial(layer_of_tile, cloth_grid=self.cloth_grid, lowest=lowest, cloth=first)
        for step, part in enumerate(in_order(work, self._tiles(cloth.resolution), self.executor)):
            _put(layer, part)
            progress.step(0.2 + 0.3 * (step + 1) / len(self.keys))
        converged = final_cloth(layer[0], trend, cloth, progress.part(0.5, 0.6))
        sift = partial(ground_of_tile, cell=self.settings.resolution, cloth_grid=self.cloth_grid, lowest=lowest,
                       cloth=converged, threshold=cloth.threshold)
        for step, (ground, count) in enumerate(in_order(sift, self._tiles(0.0), self.executor)):
            self.ground.add(self.keys[step], ground)
            self.ground_points += count
            progress.step(0.6 + 0.4 * (step + 1) / len(self.keys))

    def _tiles(self, margin: float) -> Iterator[TilePoints]:
        """The points of each tile with those of a margin round it."""
        known = set(self.keys)
        for key in self.keys:
            inside = self.points.read(key)
            x_min, y_min, x_max, y_max = box = self.tiling.box(key)
            parts = [inside]
            for neighbour in self.tiling.around(key)[1:] if margin else []:
                if neighbour in known:
                    other = self.points.read(neighbour)
                    near = ((other["x"] >= x_min - margin) & (other["x"] <= x_max + margin)
                            & (other["y"] >= y_min - margin) & (other["y"] <= y_max + margin))
                    parts.append(record_rows(other, near))
            yield TilePoints(joined_records(parts), len(inside), box)


def _require_filled(places: Counter[complex]) -> None:
    """Refuse points whose squares of `PLACE` fill next to nothing of their box: one strange place does that."""
    corners = np.array([(place.real, place.imag) for place in places])
    if np.prod(np.ptp(corners, axis=0) + 1) > LEAST_FILLED * len(corners):
        most = places.most_common(1)[0][0]
        away = np.linalg.norm(corners - (most.real, most.imag), axis=1) * PLACE / 1000
        x, y = (corners[np.argmax(away)] + 0.5) * PLACE
        raise InputError(say("The points fill next to nothing of the box around them, and some lie near "
                             "{x:.0f}, {y:.0f}, {length:.0f} km from the others: remove those, or work on the "
                             "places one by one.", x=x, y=y, length=away.max()))


def _put(layers: list[np.ndarray], part: ClothPart) -> None:
    """Lay a tile's nodes into the whole."""
    for layer, values in zip(layers, part.layers):
        layer[part.rows, part.columns] = values


class TiledVertices:
    """Vertices of a surface by tiles, numbered from 0 in the order of the tiles' keys."""

    def __init__(self, stack: ExitStack):
        self._buckets = stack.enter_context(PointBuckets(VERTEX))
        self.counts: dict[int, int] = {}

    def add(self, key: int, vertices: np.ndarray) -> None:
        """Add the vertices of a tile."""
        if len(vertices):
            self._buckets.add(np.full(len(vertices), key), vertices)
            self.counts[key] = self.counts.get(key, 0) + len(vertices)

    def read(self, key: int) -> np.ndarray:
        """Vertices of a tile."""
        return self._buckets.read(key)

    def starts(self) -> dict[int, int]:
        """Number of the first vertex of each tile."""
        keys = sorted(self.counts)
        ends = np.cumsum([self.counts[key] for key in keys])
        return {key: int(end) - self.counts[key] for key, end in zip(keys, ends)}
