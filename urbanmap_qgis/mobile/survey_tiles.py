"""The points of a survey of any size in tiles, kept in files, and those of one tile with its margin, pass by pass."""

from __future__ import annotations

from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np

from ..errors import InsufficientDataError
from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ..io.points.whole_records import copied_records, record_rows
from ..progress import Progress
from ..terrain.outliers import plausible
from ..terrain.tiles import TilePoints, Tiling
from ..wording import say
from .packed_points import PackedPoints
from .passes import BlockPositions, SurveyPasses

CHUNK = 250_000
"""Points read at a time."""

_TILE = 128.0
_TILE_POINTS = 2_000_000
_BUCKET_MEMORY = 120_000_000
_HELD_MEMORY = 120_000_000


@contextmanager
def tiles_of_survey(cloud: PointCloud, resolution: float, margin: float, progress: Progress) -> Iterator[SurveyTiles]:
    """The points of a survey in tiles for a cloth of a resolution, m, while the context lasts.

    Raises
    ------
    InsufficientDataError : no usable point.
    """
    packing = PackedPoints(cloud.headers)
    with PointBuckets(packing.dtype, _BUCKET_MEMORY) as buckets, PointBuckets(packing.dtype, _BUCKET_MEMORY) as smaller:
        tiles = SurveyTiles(cloud, packing, buckets, smaller, resolution, margin)
        tiles.read(progress)
        yield tiles


class SurveyTiles:
    """The points of a survey in tiles, on their way to the cloths of its passes.

    Parameters
    ----------
    packing, buckets, smaller : how points are packed, and where they lie: `smaller` takes them where tiles are split.
    resolution, margin : of the cloth, and how far its work on a tile looks beyond it, m.
    """

    def __init__(self, cloud: PointCloud, packing: PackedPoints, buckets: PointBuckets, smaller: PointBuckets,
                 resolution: float, margin: float):
        self.margin = margin
        self.cloud, self.buckets = cloud, buckets
        self.packing, self.smaller = packing, smaller
        self.tiling = Tiling(resolution, max(int(np.ceil(_TILE / resolution)), 16))
        self.keys: list[int] = []
        self.passes = SurveyPasses(np.empty(0))
        self.usable = 0
        self._runs: dict[tuple[int, int], slice] = {}
        """Rows of a tile's records that are those of a pass, for tiles and passes whose rows lie together."""

    def read(self, progress: Progress) -> None:
        """Sort the points into tiles and find the passes."""
        timed = self.cloud.has_dimension("gps_time")
        positions, counts = BlockPositions(), Counter()
        for chunk in iter_chunks(self.cloud, progress, CHUNK):
            x, y, z = (np.asarray(chunk[name]) for name in "xyz")
            time = np.asarray(chunk["gps_time"]) if timed else np.zeros(len(chunk))
            usable = valid_points(chunk) & plausible(x, y, z)
            records = self.packing.packed(chunk, time)
            if not usable.all():
                records, x, y, time = record_rows(records, usable), x[usable], y[usable], time[usable]
            if not len(records):
                continue
            self.usable += len(records)
            positions.add(x, y, time)
            counts.update(self.buckets.add(self.tiling.keys(x, y), records))
        if not counts:
            raise InsufficientDataError(say("{paths} holds no usable points: all are noise, withheld or have no "
                                            "valid height.", paths=self.cloud.paths[0].name))
        self.keys, self.passes = sorted(counts), positions.passes()
        self._split(max(counts.values()))

    def _split(self, most: int) -> None:
        """Put the points into smaller tiles where one holds so many that a few of them would fill the memory."""
        cells, least = self.tiling.cells, 2 * int(np.ceil(self.margin / self.tiling.cell))
        while most > _TILE_POINTS and cells // 2 >= least:
            cells, most = cells // 2, most // 4
        if cells == self.tiling.cells:
            return
        self.tiling, keys = Tiling(self.tiling.cell, cells), set()
        for key in self.keys:
            whole = self.buckets.pop(key)
            for start in range(0, len(whole), CHUNK):
                records = copied_records(whole[start:start + CHUNK])  # a view would keep the whole
                tile = self.tiling.keys(self.packing.column(records, "x"), self.packing.column(records, "y"))
                keys.update(self.smaller.add(tile, records))
        self.keys, self.buckets = sorted(keys), self.smaller

    def extents(self, progress: Progress) -> list[dict[int, tuple]]:
        """For each pass the tiles that hold points of it, with their number and extent."""
        found: list[dict[int, tuple]] = [{} for _ in range(self.passes.count)]
        for step, key in enumerate(self.keys):
            records = self.buckets.read(key)
            pass_number = self.packing.passes(records, self.passes)
            for number in np.flatnonzero(np.bincount(pass_number)).tolist():
                rows = np.flatnonzero(pass_number == number)
                if rows[-1] - rows[0] + 1 == len(rows):
                    rows, count = slice(int(rows[0]), int(rows[-1]) + 1), len(rows)
                    self._runs[key, number] = rows
                else:
                    count = len(rows)
                (x_min, x_max), (y_min, y_max) = (self.packing.extent(records, name, rows) for name in "xy")
                found[number][key] = (count, x_min, y_min, x_max, y_max)
            progress.step((step + 1) / len(self.keys))
        return found

    def points(self, extents: dict[int, tuple], pass_number: int, margin: float) -> Iterator[TilePoints]:
        """The points of each tile and of a margin round it, of one pass with these `extents`; not to be changed."""
        tiles = _HeldTiles(partial(self._of_pass, pass_number=pass_number))
        for key in sorted(extents):
            box = self.tiling.box(key)
            around = box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin
            parts = [dict(tiles.get(key))]
            in_tile = len(parts[0]["x"])
            for near in self.tiling.around(key)[1:]:
                if near in extents and _meet(extents[near][1:], around):
                    parts.append(_within(tiles.get(near), extents[near][1:], around))
            if len(parts) > 1:
                parts = [{name: np.concatenate([part.pop(name) for part in parts]) for name in "xyz"}]
            yield TilePoints(parts[0], in_tile, box)

    def _of_pass(self, key: int, pass_number: int) -> dict[str, np.ndarray]:
        """Coordinates of the points of a tile that were measured in a pass, a column each."""
        run = self._runs.get((key, pass_number))
        records = self.buckets.read(key, run or slice(None))
        rows = run and slice(None)
        if rows is None:
            rows = np.flatnonzero(self.packing.passes(records, self.passes) == pass_number)
        return {name: self.packing.column(records, name, rows) for name in "xyz"}


class _HeldTiles:
    """Columns of the tiles used last: each is a neighbour of eight others, but a slow drive has millions of points."""

    def __init__(self, read: Callable[[int], dict[str, np.ndarray]]):
        self._read = read
        self._tiles: OrderedDict[int, dict[str, np.ndarray]] = OrderedDict()
        self._bytes = 0

    def get(self, key: int) -> dict[str, np.ndarray]:
        """The columns of a tile; they must not be changed."""
        if key in self._tiles:
            self._tiles.move_to_end(key)
            return self._tiles[key]
        columns = self._tiles[key] = self._read(key)
        self._bytes += _size(columns)
        while self._bytes > _HELD_MEMORY and len(self._tiles) > 1:
            self._bytes -= _size(self._tiles.popitem(last=False)[1])
        return columns


def _size(columns: dict[str, np.ndarray]) -> int:
    """Bytes of columns."""
    return sum(values.nbytes for values in columns.values())


def _meet(extent: tuple[float, ...], box: tuple[float, ...]) -> bool:
    """Whether two boxes (x_min, y_min, x_max, y_max) have a place in common."""
    return extent[0] <= box[2] and extent[1] <= box[3] and extent[2] >= box[0] and extent[3] >= box[1]


def _within(columns: dict[str, np.ndarray], extent: tuple[float, ...], box: tuple[float, ...]) -> dict[str, np.ndarray]:
    """Those of points with an extent that lie in a box, its edges included."""
    near = np.ones(len(columns["x"]), dtype=bool)
    for name, axis in (("x", 0), ("y", 1)):
        if extent[axis + 2] > box[axis + 2]:
            near &= columns[name] <= box[axis + 2]
        if extent[axis] < box[axis]:
            near &= columns[name] >= box[axis]
    rows = np.flatnonzero(near)
    return {name: values[rows] for name, values in columns.items()}
