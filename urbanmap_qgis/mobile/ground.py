"""Ground points of a mobile survey by the cloth filter (J 3.2.3.1), for files of any size."""

from __future__ import annotations

import os
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..errors import InputError, InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.points.class_layers import class_writer, layers_can_stay
from ..io.points.decoded_points import decoded_once
from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import (
    PointCloud,
    iter_chunks,
    of_classes,
    open_cloud,
    valid_points,
)
from ..progress import SILENT, Progress
from ..terrain.cloth import JAVANMARDI, ClothSettings, LowestHeights, bottom_points, final_cloth, first_cloth
from ..terrain.outliers import isolation_limit, plausible
from ..terrain.surface_files import metric_crs_wkt
from ..terrain.tiles import ClothPart, TilePoints, Tiling, layer_of_tile, lowest_heights_of_tile, point_margin
from ..wording import say
from .markings.survey_points import MIN_GROUND_SHARE
from .packed_points import PackedPoints
from .passes import BlockPositions, SurveyPasses

GROUND, UNASSIGNED = 2, 1
UNDECIDED = (0, UNASSIGNED, GROUND)
"""Classes that say nothing of what a point is, or what the filter is to say anew."""

_MOST_NODES = 100_000_000
_TILE = 64.0
_TILE_POINTS = 2_000_000
_BUCKET_MEMORY = 120_000_000
_HELD_MEMORY = 120_000_000
_CHUNK = 250_000


@dataclass(frozen=True)
class GroundSummary:
    """What was found.

    Attributes
    ----------
    points : in the files.
    usable : without noise, withheld points and absurd heights.
    ground : ground points.
    passes : passes that were filtered apart (1 without GPS time).
    crs_wkt : of the cloud.
    """

    points: int
    usable: int
    ground: int
    passes: int
    crs_wkt: str


@dataclass(frozen=True)
class PassGround:
    """The converged cloth of one pass.

    Attributes
    ----------
    grid : of the cloth's nodes.
    lowest : (rows, columns) believed lowest heights.
    cloth : converged heights, m.
    """

    grid: Grid
    lowest: np.ndarray
    cloth: np.ndarray

    def mask(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, threshold: float) -> np.ndarray:
        """Points (n,) within `threshold` m of the cloth and not below the believed ground; all must be on the grid."""
        bottom = bottom_points(x, y, z, self.grid, self.lowest)
        found = np.zeros(len(z), dtype=bool)
        found[bottom.points[np.abs(bottom.z - bottom.place.heights(self.cloth)) <= threshold]] = True
        return found


def classify_ground_files(paths: Sequence[str | os.PathLike], output: str | os.PathLike,
                          settings: ClothSettings = JAVANMARDI, progress: Progress = SILENT,
                          executor: Executor | None = None, crs_wkt: str | None = None,
                          min_ground_share: float = MIN_GROUND_SHARE) -> GroundSummary:
    """Write a survey's points with ground as class 2; all else of them, and their order, stays as it is.

    Points of other classes than 0, 1 and 2 keep them. Passes through the same place are filtered apart by their GPS
    time (`passes`). The points are read twice; memory holds some tiles and the cloth. The result does not depend on the
    tiles nor on the executor.

    Parameters
    ----------
    paths : LAS, LAZ or COPC files.
    output : LAZ or LAS.
    crs_wkt : CRS where the files state none.
    min_ground_share : less ground among the usable points of undecided class, 0 to 1, is refused.

    Raises
    ------
    InputError : files, CRS or settings cannot be used.
    InsufficientDataError : no usable points, or a share of ground that cannot be right.
    """
    cloud = open_cloud(paths, crs_wkt)
    wkt = metric_crs_wkt(cloud)
    copied = layers_can_stay(cloud, output)
    with decoded_once(shape_and_time=copied):
        packing = PackedPoints(cloud.headers)
        with (PointBuckets(packing.dtype, _BUCKET_MEMORY) as buckets,
              PointBuckets(packing.dtype, _BUCKET_MEMORY) as smaller):
            survey = _Survey(cloud, settings, packing, buckets, smaller, executor, copied)
            survey.read(progress.part(0.0, 0.35))
            grounds = survey.grounds(progress.part(0.35, 0.65))
        ground = _write(cloud, output, survey.passes, grounds, settings, min_ground_share, progress.part(0.65, 1.0))
    return GroundSummary(cloud.point_count, survey.usable, ground, survey.passes.count, wkt)


class _Survey:
    """The points of a survey in tiles, on their way to the cloths of its passes."""

    def __init__(self, cloud: PointCloud, settings: ClothSettings, packing: PackedPoints, buckets: PointBuckets,
                 smaller: PointBuckets, executor: Executor | None, copied: bool):
        self.copied = copied
        self.cloud, self.settings, self.buckets, self.executor = cloud, settings, buckets, executor
        self.packing, self.smaller = packing, smaller
        self.tiling = Tiling(settings.resolution, max(int(np.ceil(_TILE / settings.resolution)), 16))
        self.keys: list[int] = []
        self.passes = SurveyPasses(np.empty(0))
        self.usable = 0

    def read(self, progress: Progress) -> None:
        """Sort the points into tiles and find the passes."""
        timed = self.cloud.has_dimension("gps_time")
        positions, counts = BlockPositions(), Counter()
        for chunk in iter_chunks(self.cloud, progress, _CHUNK, shape_only=self.copied, timed=self.copied):
            x, y, z = (np.asarray(chunk[name]) for name in "xyz")
            time = np.asarray(chunk["gps_time"]) if timed else np.zeros(len(chunk))
            usable = valid_points(chunk) & plausible(x, y, z)
            records = self.packing.packed(chunk, time)
            if not usable.all():
                records, x, y, time = (values[usable] for values in (records, x, y, time))
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
        cells, least = self.tiling.cells, 2 * int(np.ceil(point_margin(self.settings) / self.tiling.cell))
        while most > _TILE_POINTS and cells // 2 >= least:
            cells, most = cells // 2, most // 4
        if cells == self.tiling.cells:
            return
        self.tiling, keys = Tiling(self.tiling.cell, cells), set()
        for key in self.keys:
            whole = self.buckets.pop(key)
            for start in range(0, len(whole), _CHUNK):
                records = whole[start:start + _CHUNK].copy()  # a part of the whole would keep all of it in memory
                tile = self.tiling.keys(self.packing.column(records, "x"), self.packing.column(records, "y"))
                keys.update(self.smaller.add(tile, records))
        self.keys, self.buckets = sorted(keys), self.smaller

    def grounds(self, progress: Progress) -> list[PassGround | None]:
        """The cloth of each pass."""
        extents = self._extents(progress.part(0.0, 0.1))
        done = []
        share = 0.9 / self.passes.count
        for pass_number in range(self.passes.count):
            part = progress.part(0.1 + share * pass_number, 0.1 + share * (pass_number + 1))
            done.append(self._ground(pass_number, extents[pass_number], part) if extents[pass_number] else None)
        return done

    def _extents(self, progress: Progress) -> list[dict[int, tuple]]:
        """For each pass the tiles that hold points of it, with their number and extent."""
        found: list[dict[int, tuple]] = [{} for _ in range(self.passes.count)]
        for step, key in enumerate(self.keys):
            records = self.buckets.read(key)
            pass_number = self.packing.passes(records, self.passes)
            for number in np.flatnonzero(np.bincount(pass_number)).tolist():
                mine = slice(None) if self.passes.count == 1 else np.flatnonzero(pass_number == number)
                x, y = (self.packing.column(records, name, mine) for name in "xy")
                found[number][key] = (len(x), x.min(), y.min(), x.max(), y.max())
            progress.step((step + 1) / len(self.keys))
        return found

    def _ground(self, pass_number: int, extent: dict[int, tuple], progress: Progress) -> PassGround:
        table = np.array(list(extent.values()))
        (x_min, y_min), (x_max, y_max) = table[:, 1:3].min(axis=0), table[:, 3:5].max(axis=0)
        cloth = self.settings
        grid = Grid.covering(x_min, y_min, x_max, y_max, cloth.resolution)
        grid = Grid(grid.x_min, grid.y_max, grid.cell, grid.rows + 1, grid.columns + 1)
        if grid.rows * grid.columns > _MOST_NODES:
            raise InputError(say("The survey is too large for one cloth: choose a coarser cloth resolution, or "
                                 "filter parts of it."))
        keys = sorted(extent)
        area = len(keys) * self.tiling.side ** 2
        neighbours = isolation_limit(int(table[:, 0].sum()), min(area, max((x_max - x_min) * (y_max - y_min), 1.0)))
        levels = [np.full(grid.shape, fill) for fill in (np.inf, np.inf, 0)]
        work = partial(lowest_heights_of_tile, cloth_grid=grid, neighbours=neighbours)
        for step, part in enumerate(in_order(work, self._tiles(keys, pass_number, point_margin(cloth)), self.executor,
                                             progress.check)):
            _put(levels, part)
            progress.step(0.5 * (step + 1) / len(keys))
        first, trend, lowest = first_cloth(LowestHeights(*levels), cloth, progress.part(0.5, 0.6))
        layer = [np.full(grid.shape, np.inf)]
        work = partial(layer_of_tile, cloth_grid=grid, lowest=lowest, cloth=first)
        for step, part in enumerate(in_order(work, self._tiles(keys, pass_number, cloth.resolution), self.executor,
                                             progress.check)):
            _put(layer, part)
            progress.step(0.6 + 0.3 * (step + 1) / len(keys))
        converged = final_cloth(layer[0], trend, cloth, progress.part(0.9, 1.0))
        return PassGround(grid, lowest, converged)

    def _tiles(self, keys: list[int], pass_number: int, margin: float) -> Iterator[TilePoints]:
        """The points of each tile and of a margin round it, of one pass."""
        known, tiles = set(keys), _HeldTiles(partial(self._of_pass, pass_number=pass_number))
        for key in keys:
            box, (column, row) = self.tiling.box(key), self.tiling.column_row(key)
            parts = [dict(tiles.get(key))]
            for near in self.tiling.around(key)[1:]:
                if near in known:
                    other_column, other_row = self.tiling.column_row(near)
                    parts.append(_beside(tiles.get(near), box, margin, other_column - column, other_row - row))
            in_tile = len(parts[0]["x"])
            yield TilePoints({name: np.concatenate([part.pop(name) for part in parts]) for name in "xyz"}, in_tile, box)

    def _of_pass(self, key: int, pass_number: int) -> dict[str, np.ndarray]:
        """Coordinates of the points of a tile that were measured in a pass, a column each."""
        records = self.buckets.read(key)
        if self.passes.count == 1:
            return {name: self.packing.column(records, name) for name in "xyz"}
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


def _beside(columns: dict[str, np.ndarray], box: tuple[float, float, float, float], margin: float, right: int,
            up: int) -> dict[str, np.ndarray]:
    """The points of the tile `right` columns and `up` rows away that lie within a margin of a tile's box."""
    near = np.ones(len(columns["x"]), dtype=bool)
    for name, step, low, high in (("x", right, box[0], box[2]), ("y", up, box[1], box[3])):
        if step:
            near &= columns[name] <= high + margin if step > 0 else columns[name] >= low - margin
    rows = np.flatnonzero(near)
    return {name: values[rows] for name, values in columns.items()}


def _put(layers: list[np.ndarray], part: ClothPart) -> None:
    """Lay a tile's nodes into the whole."""
    for layer, values in zip(layers, part.layers):
        layer[part.rows, part.columns] = values


def _write(cloud: PointCloud, output: str | os.PathLike, passes: SurveyPasses, grounds: list[PassGround | None],
           settings: ClothSettings, min_share: float, progress: Progress) -> int:
    """Write all points with their new classes; the number of ground points."""
    total = candidates = 0
    copied = layers_can_stay(cloud, output)
    with class_writer(output, cloud) as writer:
        for chunk in iter_chunks(cloud, progress, _CHUNK, shape_only=copied, timed=copied):
            ground = _ground_of(chunk, passes, grounds, settings.threshold)
            total += int(np.count_nonzero(ground))
            classes = np.asarray(chunk.classification)
            undecided = of_classes(chunk, UNDECIDED)
            candidates += int(np.count_nonzero(undecided & valid_points(chunk)))
            writer.write(chunk, np.where(undecided, np.where(ground, GROUND, UNASSIGNED), classes))
        _check_share(total, candidates, min_share)
    return total


def _check_share(ground: int, candidates: int, min_share: float) -> None:
    """Refuse a share of ground that cannot be right, while the output still lies beside its place."""
    if ground < min_share * candidates:
        raise InsufficientDataError(
            say("Only {ground:,} of {candidates:,} points were found to be ground ({ground_2:.2g} %, needed "
                "{min_share:g} %), which cannot be right for a drive: look for many points below the road, a wrong "
                "height unit or a survey that does not show the ground; a smaller minimum ground share accepts it.",
                ground=ground, candidates=candidates, ground_2=100 * ground / candidates, min_share=100 * min_share))


def _ground_of(chunk, passes: SurveyPasses, grounds: list[PassGround | None], threshold: float) -> np.ndarray:
    """Which points of a chunk are ground, (n,) bool."""
    x, y, z = (np.asarray(chunk[name]) for name in "xyz")
    candidate = valid_points(chunk) & plausible(x, y, z) & of_classes(chunk, UNDECIDED)
    pass_number = passes.of(np.asarray(chunk["gps_time"])) if passes.count > 1 else np.zeros(len(z), dtype=int)
    found = np.zeros(len(z), dtype=bool)
    for number in np.unique(pass_number[candidate]).tolist():
        some = np.flatnonzero(candidate & (pass_number == number))
        if grounds[number] is not None:
            found[some] = grounds[number].mask(x[some], y[some], z[some], threshold)
    return found
