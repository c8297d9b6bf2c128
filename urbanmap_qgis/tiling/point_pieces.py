"""The points of a tile out of files that were not cut for it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import PointLayout, cloud_writer, iter_chunks, open_cloud
from ..progress import SILENT, Progress
from .tile_grid import Bounds, GridTile, TileGrid

LARGE = 9
"""A file that meets more tiles than this is sorted into pieces once, instead of being read by each of them."""

_ROWS = 1 << 31


@dataclass(frozen=True)
class PointFile:
    """A point cloud file and the box around its points, m."""

    path: Path
    bounds: Bounds
    points: int


def point_file(path: str | os.PathLike) -> PointFile:
    """A file by its header. Raises `InputError` where it is no LAS or LAZ."""
    cloud = open_cloud([path], may_be_empty=True)
    return PointFile(Path(path), (*cloud.minimum[:2], *cloud.maximum[:2]), cloud.point_count)


class FileIndex:
    """Finds among many files those that a box meets.

    Attributes
    ----------
    files : all files, in the order given.
    """

    def __init__(self, files: Sequence[PointFile]):
        self.files = list(files)
        self._bounds = np.array([file.bounds for file in files], float).reshape(-1, 4)
        self._full = np.array([file.points > 0 for file in files], bool)

    def meeting(self, bounds: Bounds) -> list[PointFile]:
        """Files that hold points and whose boxes meet a box, in their order."""
        x_min, y_min, x_max, y_max = bounds
        left, bottom, right, top = self._bounds.T
        meet = self._full & (left < x_max) & (right >= x_min) & (bottom < y_max) & (top >= y_min)
        return [self.files[number] for number in np.flatnonzero(meet)]


def sorted_into_pieces(file: PointFile, grid: TileGrid, folder: Path, progress: Progress = SILENT) -> list[PointFile]:
    """Sort a large file into one LAZ piece a tile (cores, without buffers) in `folder`, which must exist.

    The file is read once, whatever the number of tiles; memory is that of `PointBuckets`, the records wait on the disk
    of `folder`. The order of points within a piece is that of the file.
    """
    cloud = open_cloud([file.path])
    layout = PointLayout(cloud)
    with PointBuckets(layout.dtype, folder=folder) as buckets:
        keys: set[int] = set()
        for chunk in iter_chunks(cloud, progress.part(0.0, 0.6)):
            column, row = grid.numbers_of(chunk)
            key = column * _ROWS + row
            keys.update(np.unique(key).tolist())
            buckets.add(key, layout.adapt(chunk, np.ones(len(chunk), bool)))
        pieces = []
        for done, key in enumerate(sorted(keys)):
            row = (key + _ROWS // 2) % _ROWS - _ROWS // 2
            path = folder / f"{grid.tile((key - row) // _ROWS, row).name}.laz"
            with cloud_writer(path, layout) as writer:
                writer.write(buckets.read(key))
            pieces.append(point_file(path))
            progress.part(0.6, 1.0).step((done + 1) / len(keys))
    return pieces


def all_inside(files: Sequence[PointFile], tile: GridTile) -> bool:
    """Whether there are files, and all their points lie in the tile and its buffer."""
    return bool(files) and all(tile.reads_all(file.bounds) for file in files)


def write_tile_points(files: Sequence[PointFile], tile: GridTile, path: str | os.PathLike) -> int:
    """Write the points of the tile and its buffer to one file; their number. Nothing is written where there are none.

    `files` are those that meet the tile. All attributes are kept; the order is that of the files.
    """
    if not files:
        return 0
    cloud = open_cloud([file.path for file in files])
    layout = PointLayout(cloud)
    count = 0
    with cloud_writer(path, layout) as writer:
        for chunk in iter_chunks(cloud):
            inside = tile.reads_of(chunk)
            count += int(np.count_nonzero(inside))
            writer.write(layout.adapt(chunk, inside))
    if not count:
        Path(path).unlink()
    return count


def keep_own_points(path: str | os.PathLike, tile: GridTile, buildings: Sequence[int] | None = None) -> int:
    """Leave in a result of the tile only what is the tile's own; the number of points left.

    `buildings` are the numbers of the tile's own buildings: points that carry one (`building_id`) then go by it, all
    others by their place.
    """
    cloud = open_cloud([path], may_be_empty=True)
    layout = PointLayout(cloud)
    by_building = buildings is not None and cloud.has_dimension("building_id")
    numbers = np.asarray(sorted(buildings or ()), np.int64)
    count = 0
    with cloud_writer(path, layout) as writer:
        for chunk in iter_chunks(cloud):
            keep = tile.owns_of(chunk)
            if by_building:
                number = np.asarray(chunk["building_id"]).astype(np.int64)
                keep = np.where(number > 0, np.isin(number, numbers), keep)
            count += int(np.count_nonzero(keep))
            writer.write(layout.adapt(chunk, keep))
    return count
