"""The points of a cloud told apart, tile by tile: roofs, and on request the ground."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from concurrent.futures import Executor
from functools import partial

import numpy as np

from ...errors import InsufficientDataError
from ...execution import in_order
from ...geometry.grid import Grid
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...progress import SILENT, Progress
from ...wording import say
from .roof_points import BUILDING_CLASS, CLASSES, CONTEXT, ECHOES, POINT, ROOF, SURFACES, Box, roofs_of_tile
from .roof_regions import roof_density

TILE_POINTS, TILE_SIDE = 2_000_000, (100.0, 500.0)
"""Points worked on together, and the least and greatest side (m) of the tiles that follow from it."""
BUFFER = 60.0
"""Reach (m) about a tile of the points that its ground is made from; wider than most buildings' halves."""


class LabelledCloud:
    """Roof points of a cloud, and on request those of the ground, kept by tile; a context manager.

    Attributes
    ----------
    tiles : number of tiles.
    origin : (2,) south-west of all points, m.
    density : roof points/m2, the median over the tiles.
    told_by : "classes", "echoes" or "surfaces", see `roof_points`.
    """

    def __init__(self, cloud: PointCloud, ground: tuple[Grid, np.ndarray] | None = None, with_ground: bool = False,
                 executor: Executor | None = None, progress: Progress = SILENT):
        tiles = _Tiles(cloud)
        self.origin = tiles.origin
        self._kept = PointBuckets(ROOF)
        densities = []
        with PointBuckets(POINT) as buckets:
            self.told_by = tiles.read(buckets, progress.part(0.0, 0.4))
            self.tiles = len(tiles.names)
            work = partial(roofs_of_tile, told_by=self.told_by, density=tiles.last_density(buckets),
                           with_ground=with_ground)
            pieces = ((buckets.pop(name), tiles.box(name), _part(ground, tiles.box(name)))
                      for name in tiles.names)
            for done, found in enumerate(in_order(work, pieces, executor, progress.check)):
                self._kept.add(np.full(len(found), done), found)
                roofs = found[found["roof"]]
                if len(roofs):
                    densities.append(roof_density(roofs["x"], roofs["y"]))
                progress.part(0.4, 1.0).step((done + 1) / self.tiles)
        if not densities:
            raise InsufficientDataError(say("No point of the cloud lies on a roof: check that it shows buildings and "
                                            "that its heights are in metres."))
        self.density = float(np.median(densities))

    def __enter__(self) -> LabelledCloud:
        self._kept.__enter__()
        return self

    def __exit__(self, *exception: object) -> None:
        self._kept.__exit__(*exception)

    def __iter__(self) -> Iterator[np.ndarray]:
        """Points (records `ROOF`) of one tile after another."""
        return (self._kept.read(tile) for tile in range(self.tiles))


class _Tiles:
    """Square tiles over a cloud."""

    def __init__(self, cloud: PointCloud):
        self.cloud = cloud
        extent = np.maximum(cloud.maximum[:2] - cloud.minimum[:2], 1.0)
        side = math.sqrt(TILE_POINTS * float(np.prod(extent)) / max(cloud.point_count, 1))
        self.side = float(np.clip(side, *TILE_SIDE))
        self.origin = cloud.minimum[:2] - 1e-3
        self.columns, self.rows = (extent // self.side).astype(int) + 1
        self.names: list[int] = []

    def read(self, buckets: PointBuckets, progress: Progress) -> str:
        """Put all points into the tiles that they lie in or near; returns how roofs are told."""
        several = classed = False
        names: set[int] = set()
        for chunk in iter_chunks(self.cloud, progress, shape_only=True):
            chunk = chunk[valid_points(chunk)]
            points = np.empty(len(chunk), POINT)
            points["x"], points["y"], points["z"], points["code"] = chunk.x, chunk.y, chunk.z, chunk.classification
            points["last"] = np.asarray(chunk.return_number) >= np.asarray(chunk.number_of_returns)
            several = several or not points["last"].all()
            classed = classed or bool((points["code"] == BUILDING_CLASS).any())
            for keys, members in self._keys(points["x"], points["y"]):
                names.update(buckets.add(keys, points[members]))
        self.names = sorted(names)
        return CLASSES if classed else ECHOES if several else SURFACES

    def _keys(self, x: np.ndarray, y: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Names of tiles and numbers of the points that lie in or near them, each pair once."""
        low, high = self._cells(x - BUFFER, y - BUFFER), self._cells(x + BUFFER, y + BUFFER)
        for up, right in itertools.product(range(math.ceil(2 * BUFFER / self.side) + 1), repeat=2):
            row, column = low[1] + up, low[0] + right
            members = np.flatnonzero((row <= high[1]) & (column <= high[0]) & (row >= 0) & (column >= 0)
                                     & (row < self.rows) & (column < self.columns))
            yield row[members] * self.columns + column[members], members

    def _cells(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return (((x - self.origin[0]) // self.side).astype(np.int64),
                ((y - self.origin[1]) // self.side).astype(np.int64))

    def box(self, name: int) -> Box:
        """Bounds (m) of a tile."""
        row, column = divmod(name, int(self.columns))
        x, y = self.origin[0] + column * self.side, self.origin[1] + row * self.side
        return x, y, x + self.side, y + self.side

    def last_density(self, buckets: PointBuckets) -> float:
        """Last echoes/m2: the median over the tiles."""
        last = [points[points["last"]] for points in map(buckets.read, self.names)]
        return float(np.median([roof_density(points["x"], points["y"]) for points in last if len(points)] or [1.0]))


def _part(ground: tuple[Grid, np.ndarray] | None,
          box: Box) -> tuple[Grid, np.ndarray] | None:
    """The part of given ground heights that a tile needs."""
    if ground is None:
        return None
    grid, heights = ground
    rows, columns, part = grid.window(box[0] - CONTEXT, box[1] - CONTEXT, box[2] + CONTEXT, box[3] + CONTEXT)
    return (part, heights[rows, columns]) if part.rows and part.columns else None
