"""The survey's points beside the path, sorted into square tiles of the map."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InsufficientDataError
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...mobile.gps_time import time_shift
from ...mobile.markings.survey_points import STOPPED, breaks
from ...mobile.trajectory import Trajectory, gaps, path_chainage
from ...progress import SILENT, Progress
from ...wording import say
from .edge_records import POINT

TILE = 20.0
"""Side of a tile, m."""

MARGIN = 2.5
"""Points so far beyond a tile are read with it, m: no step or profile looks farther."""

ROW = 1 << 24
AHEAD = 8.0  # m by which a tilted fan reaches ahead of the vehicle
BELOW = 5.0  # m under the body, at the path
SLOPE = 0.15  # of the ground across
CREEP = 0.02


@dataclass(frozen=True)
class Reach:
    """What is read of a survey: `tile` and `margin` beyond it, m, and m `above` the body, at the path."""

    tile: float = TILE
    margin: float = MARGIN
    above: float = 2.5


@dataclass(frozen=True)
class EdgeTile:
    """Points of a tile and its margin (`POINT`), in coordinates relative to the survey's corner.

    `low` (2,) is the tile's own corner; what lies in [low, low + side) belongs to it.
    """

    low: np.ndarray
    points: np.ndarray
    side: float = TILE

    def owns(self, place: np.ndarray) -> np.ndarray:
        """Mask (n,) of places (n, 2) that belong to this tile."""
        return ((place >= self.low) & (place < self.low + self.side)).all(axis=1)


class EdgePoints:
    """Reads a survey into tiles near its path.

    Coordinates are kept relative to `corner` (3,), whole metres, so that they stay exact.

    Parameters
    ----------
    width : m from the path to either side within which edges are wanted.
    buckets : of records with the fields of `POINT`; their other fields are those of the files, and `time` (s).
    """

    def __init__(self, cloud: PointCloud, trajectory: Trajectory, width: float, buckets: PointBuckets,
                 reach: Reach = Reach()):
        self.cloud, self.trajectory, self.width, self.buckets, self.reach = cloud, trajectory, width, buckets, reach
        self.more = [name for name in buckets.dtype.names if name not in (*POINT.names, "time")]
        self.corner = np.array([*np.floor(trajectory.place[:, :2].min(axis=0)) - 1000.0, 0.0])
        self.shift = time_shift(cloud, trajectory)
        self.chainage = path_chainage(trajectory)
        self.gaps = gaps(trajectory)
        self.breaks = breaks(trajectory, self.chainage)
        self.keys: set[int] = set()
        self.read_points = self.kept_points = 0
        marks = np.arange(0.0, self.chainage[-1] + 0.5, 0.5)
        self.path = np.column_stack([np.interp(marks, self.chainage, axis) for axis in trajectory.place[:, :2].T])
        self.path -= self.corner[:2]
        self.path_tree = cKDTree(self.path)

    def read(self, progress: Progress = SILENT) -> None:
        """Read all points.

        Raises
        ------
        InsufficientDataError : no point lies beside the path at the height of its road.
        """
        for chunk in iter_chunks(self.cloud, progress):
            self.read_points += len(chunk)
            time = np.asarray(chunk["gps_time"]) + self.shift
            rows = np.flatnonzero(valid_points(chunk) & self._moving(time))
            if len(rows):
                more = {name: np.asarray(chunk[name])[rows] for name in self.more}
                self._add(np.column_stack([np.asarray(chunk[name])[rows] for name in "xyz"]), time[rows], more)
        if not self.kept_points:
            raise InsufficientDataError(
                say("No point of {paths} was measured beside the path at the height of its road: give points and "
                    "trajectory of one drive, in one coordinate and height system.", paths=self.cloud.paths[0].name))

    def _moving(self, time: np.ndarray) -> np.ndarray:
        """Mask (n,) of times at which the vehicle's place is known and it does not stand."""
        known = self.trajectory.within(time)
        for start, end in self.gaps:
            known &= (time <= start) | (time >= end)
        now, before = (np.interp(at, self.trajectory.time, self.chainage) for at in (time, time - STOPPED))
        return known & ~((now - before < CREEP) & (time - STOPPED > self.trajectory.time[0]))

    def _add(self, place: np.ndarray, time: np.ndarray, more: dict[str, np.ndarray]) -> None:
        east, north, height = (axis - np.interp(time, self.trajectory.time, body)
                               for axis, body in zip(place.T, self.trajectory.place.T))
        away = np.hypot(east, north)
        near = ((away <= self.width + AHEAD) & (height <= self.reach.above + SLOPE * away)
                & (height >= -BELOW - SLOPE * away))
        place, time = place[near] - self.corner, time[near]
        record = np.empty(len(place), self.buckets.dtype)
        record["x"], record["y"], record["z"] = place.T
        for name, values in more.items():
            record[name] = values[near]
        if "time" in record.dtype.names:
            record["time"] = time
        record["drive"] = np.searchsorted(self.breaks, time).astype(np.uint16)
        column, row = (np.floor(axis / self.reach.tile).astype(np.int64) for axis in place[:, :2].T)
        keys = column * ROW + row
        self.kept_points += len(record)
        self.keys.update(self.buckets.add(keys, record))

    def body(self, time: np.ndarray) -> np.ndarray:
        """Places (n, 2) of the vehicle at some times (s), relative to the corner, m."""
        return np.column_stack([np.interp(time, self.trajectory.time, axis)
                                for axis in self.trajectory.place[:, :2].T]) - self.corner[:2]

    def within(self, place: np.ndarray) -> np.ndarray:
        """Mask (n,) of places (n, 2), relative to the corner, that lie within `width` of the path."""
        return np.isfinite(self.path_tree.query(place, distance_upper_bound=self.width)[0])

    def tiles(self, progress: Progress = SILENT) -> Iterator[EdgeTile]:
        """All tiles that have points, with their margins, column by column."""
        keys = sorted(self.keys)
        loaded: dict[int, np.ndarray] = {}
        for number, key in enumerate(keys):
            around = [key + i * ROW + j for i in (-1, 0, 1) for j in (-1, 0, 1)]
            loaded = {name: loaded[name] if name in loaded else self.buckets.read(name)
                      for name in around if name in self.keys}
            low = np.array([key // ROW, key % ROW], float) * self.reach.tile
            if not self._reached(low):
                continue
            points = np.concatenate([self._within(loaded[name], low) for name in around if name in loaded])
            yield EdgeTile(low, points, self.reach.tile)
            progress.step((number + 1) / len(keys))

    def _reached(self, low: np.ndarray) -> bool:
        """Whether some place of a tile may lie within the width of the path."""
        return bool(self.path_tree.query(low + self.reach.tile / 2)[0] <= self.width + self.reach.tile * 0.71)

    def _within(self, points: np.ndarray, low: np.ndarray) -> np.ndarray:
        """Points of a tile and its margin."""
        x, y = points["x"] - low[0], points["y"] - low[1]
        first, last = -self.reach.margin, self.reach.tile + self.reach.margin
        return points[(x >= first) & (x < last) & (y >= first) & (y < last)]
