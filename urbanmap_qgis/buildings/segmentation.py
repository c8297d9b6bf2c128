"""Building segmentation by outlines (J 5.3.1): which points are which building's.

The outlines are first moved to where the points show the buildings, then expanded. Only points that can be
building take part: class 6 where the cloud is classified, otherwise what stands high above the ground.
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Iterator
from concurrent.futures import Executor
from functools import partial

import numpy as np
import shapely

from ..errors import InputError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import PointCloud, PointLayout, cloud_writer, iter_chunks, valid_points
from ..io.points.whole_records import record_rows
from ..progress import SILENT, Progress
from ..settings.buildings import SegmentationParameters
from ..wording import say
from .outlines.footprint import Footprints
from .outlines.segmented_buildings import SegmentedBuildings
from .outlines.tile_ground import BUFFER
from .tile_segmentation import Tile, segment_tile

TILE_POINTS = 3_000_000
"""Points worked on together; the side of the tiles follows from the cloud's density."""

TILE_SIDE = (150.0, 600.0)
"""Least and greatest side (m) of a tile."""


def segment_buildings(cloud: PointCloud, footprints: Footprints, output: str | os.PathLike,
                      parameters: SegmentationParameters | None = None,
                      ground: tuple[Grid, np.ndarray] | None = None, executor: Executor | None = None,
                      progress: Progress = SILENT) -> SegmentedBuildings:
    """Write the points of each building with its `building_id`, sorted by tile and building.

    Parameters
    ----------
    cloud : the laser points, classified or not.
    footprints : the outlines in the cloud's CRS.
    output : LAZ file to write; it holds the buildings' points only.
    ground : grid and ground heights (rows, columns), m; made from the points where not given.

    Raises
    ------
    InputError : the cloud does not reach any outline, or has no sound point near one.
    """
    parameters = parameters or SegmentationParameters()
    layout = PointLayout(cloud, [("building_id", "building number")])
    tiles = _Tiling(cloud, footprints)
    table = SegmentedBuildings.empty(footprints)
    near = sound = 0
    with PointBuckets(layout.dtype) as buckets, cloud_writer(output, layout) as writer:
        for chunk in iter_chunks(cloud, progress.part(0.0, 0.4)):
            keep = valid_points(chunk) & np.isfinite(chunk.x) & np.isfinite(chunk.y)
            sound += int(np.count_nonzero(keep))
            records = layout.adapt(chunk, keep)
            for keys, members in tiles.keys(np.asarray(chunk.x)[keep], np.asarray(chunk.y)[keep]):
                buckets.add(keys, records if len(members) == len(records) else record_rows(records, members))
                near += len(members)
        if not sound:
            raise InputError(say("All points of {name} are marked as noise or as withheld: take the marks off, or "
                                 "export the points without them.", name=cloud.paths[0].name))
        if not near:
            raise InputError(say("No sound point lies near any outline: check that points and outlines are of the "
                                 "same place, and that coordinates and heights are in metres."))
        pieces = _tiles(tiles, buckets, layout, footprints, parameters, ground)
        # Without an executor nobody else looks whether the user cancels while a tile is worked on.
        work = segment_tile if executor else partial(segment_tile, progress=Progress(cancelled=progress.cancelled))
        for done, (rows, part, records) in enumerate(in_order(work, pieces, executor, progress.check)):
            table.put(rows, part)
            writer.write(records)
            progress.part(0.4, 1.0).step((done + 1) / len(tiles.names))
    return table


class _Tiling:
    """Square tiles over the outlines; each outline belongs to the tile of its centre."""

    def __init__(self, cloud: PointCloud, footprints: Footprints):
        rows = np.flatnonzero(footprints.usable)
        bounds = shapely.bounds(footprints.polygons[rows])
        low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
        if (low > cloud.maximum[:2]).any() or (high < cloud.minimum[:2]).any():
            raise InputError(say("The point cloud and the outlines do not overlap: check that both are of the same "
                                 "place and that their coordinate reference systems are set right."))
        extent = np.maximum(cloud.maximum[:2] - cloud.minimum[:2], 1.0)
        self.density = cloud.point_count / float(np.prod(extent))
        self.side = float(np.clip(math.sqrt(TILE_POINTS / self.density), *TILE_SIDE))
        self.origin = low - self.side * 1e-6
        centre = (bounds[:, :2] + bounds[:, 2:]) / 2
        self.columns = int((high[0] - low[0]) // self.side) + 2
        self.rows = rows
        self.bounds = bounds
        column, row = self._cells(centre[:, 0], centre[:, 1])
        self.tile_of_row = row * self.columns + column
        self.names = np.unique(self.tile_of_row)

    def _cells(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Column and row of the tile that each place lies in."""
        far = 2.0**31
        return (np.clip((x - self.origin[0]) // self.side, -far, far).astype(np.int64),
                np.clip((y - self.origin[1]) // self.side, -far, far).astype(np.int64))

    def keys(self, x: np.ndarray, y: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Tiles that points belong to, buffers included: pairs of keys and the points' numbers."""
        first, last = self._cells(x - BUFFER, y - BUFFER), self._cells(x + BUFFER, y + BUFFER)
        spans = math.ceil(2 * BUFFER / self.side) + 1
        for right, up in itertools.product(range(spans), repeat=2):
            column, row = first[0] + right, first[1] + up
            members = np.flatnonzero((column <= last[0]) & (row <= last[1]) & (column >= 0) & (row >= 0)
                                     & (column < self.columns))
            key = row[members] * self.columns + column[members]
            wanted = np.isin(key, self.names)
            yield key[wanted], members[wanted]

    def near(self, name: int) -> np.ndarray:
        """Rows of the outlines that reach into the tile or its buffer."""
        row, column = divmod(int(name), self.columns)
        x, y = self.origin[0] + column * self.side, self.origin[1] + row * self.side
        low = np.array([x, y]) - BUFFER
        high = np.array([x, y]) + self.side + BUFFER
        meets = (self.bounds[:, :2] < high).all(axis=1) & (self.bounds[:, 2:] > low).all(axis=1)
        return np.flatnonzero(meets)


def _tiles(tiles: _Tiling, buckets: PointBuckets, layout: PointLayout, footprints: Footprints,
           parameters: SegmentationParameters, ground: tuple[Grid, np.ndarray] | None) -> Iterator[Tile]:
    """The pieces of work, tile after tile."""
    for name in tiles.names:
        near = tiles.near(name)
        rows = tiles.rows[near]
        part = Footprints(footprints.ids[rows], footprints.polygons[rows], footprints.notes[rows])
        in_tile = tiles.tile_of_row[near] == name
        yield Tile(layout, buckets.pop(int(name)), part, rows, in_tile, tiles.density, parameters,
                   _ground_part(ground, part.polygons))


def _ground_part(ground: tuple[Grid, np.ndarray] | None,
                 polygons: np.ndarray) -> tuple[Grid, np.ndarray] | None:
    """The part of given ground heights that a tile needs."""
    if ground is None:
        return None
    grid, heights = ground
    x_min, y_min, x_max, y_max = shapely.total_bounds(polygons)
    rows, columns, part = grid.window(x_min - BUFFER, y_min - BUFFER, x_max + BUFFER, y_max + BUFFER)
    return (part, heights[rows, columns]) if part.rows and part.columns else None
