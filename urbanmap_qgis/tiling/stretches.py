"""Tiles that are stretches of a drive: mobile surveys are cut by time, so that passes through one place stay apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..errors import InputError
from ..wording import say
from .tile_grid import MAX_TILES, Bounds, GridTile, TileGrid

REACH = 300.0
"""Points of a survey lie nearer to its path than this, m."""
_DRAWN = 5.0
"""Half the width of the band as which a stretch is drawn, m."""


@dataclass(frozen=True)
class StretchTile(GridTile):
    """A stretch of a drive. `core` and `outer` are boxes around all that may be measured from it.

    Attributes
    ----------
    path : (n, 2) its places, m, as nested tuples.
    core_times, read : from and to which GPS second points are the stretch's own, and are read.
    """

    path: tuple[tuple[float, float], ...]
    core_times: tuple[float, float]
    read: tuple[float, float]

    @property
    def name(self) -> str:
        """Its number along the drive."""
        return f"stretch_{self.column:05d}"

    @property
    def square(self) -> shapely.Polygon:
        """The stretch as a band."""
        return shapely.buffer(shapely.linestrings(self.path), _DRAWN)

    def owns_of(self, chunk) -> np.ndarray:
        """Mask (n,) of the points of a chunk that were measured in the stretch."""
        return _between(chunk, self.core_times)

    def reads_of(self, chunk) -> np.ndarray:
        """Mask (n,) of the points of a chunk that the stretch reads."""
        return _between(chunk, self.read)

    def reads_all(self, bounds: Bounds) -> bool:
        """Whether a file with such a box is read whole: a box does not tell times."""
        return False


def _times(chunk) -> np.ndarray:
    if "gps_time" not in chunk.point_format.dimension_names:
        raise InputError(say("The points have no GPS time, by which a survey is cut into stretches: give a point "
                             "cloud with times."))
    return np.asarray(chunk.gps_time, float)


def _between(chunk, span: tuple[float, float]) -> np.ndarray:
    time = _times(chunk)
    return (time >= span[0]) & (time < span[1])


@dataclass(frozen=True)
class StretchGrid(TileGrid):
    """Stretches of equal length of a drive; the last one is longer, by less than a half.

    Parameters
    ----------
    size, buffer : along the path, m.
    time : (n,) s.
    path : (n, 2) m.
    """

    time: np.ndarray = None
    path: np.ndarray = None

    @classmethod
    def along(cls, time: np.ndarray, place: np.ndarray, size: float, buffer: float) -> StretchGrid:
        """Stretches of a trajectory's epochs (n,) s at places (n, 2 or 3) m."""
        return cls(size, buffer, np.asarray(time, float), np.asarray(place, float)[:, :2])

    @property
    def key(self) -> object:
        """What tells this grid from others, beside its buffer."""
        return f"stretches of {self.size:g} m over {self.time[0]:.3f} to {self.time[-1]:.3f}"

    @property
    def title(self) -> str:
        """What the tiles are, for reports."""
        return say("stretches of {size:g} m of the drive", size=self.size)

    @property
    def _ways(self) -> np.ndarray:
        """(n,) way driven until each epoch, m."""
        return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(self.path, axis=0).T))])

    @property
    def _count(self) -> int:
        return max(int(self._ways[-1] / self.size + 0.5), 1)

    def _time_at(self, way: float) -> float:
        """First time at which a way was driven; before the drive and after it there is no limit."""
        ways = self._ways
        if way <= 0:
            return -np.inf
        return float(self.time[np.searchsorted(ways, way)]) if way < ways[-1] else np.inf

    def tile(self, column: int, row: int) -> StretchTile:
        """The stretch of a number."""
        begin, end = column * self.size, (column + 1) * self.size if column + 1 < self._count else np.inf
        core_times = self._time_at(begin), self._time_at(end)
        read = self._time_at(begin - self.buffer), self._time_at(end + self.buffer)
        core, outer = self._path_in(core_times), self._path_in(read)
        return StretchTile(column, row, _box(core), _box(outer), tuple(map(tuple, core.tolist())), core_times, read)

    def _path_in(self, span: tuple[float, float]) -> np.ndarray:
        first, last = np.searchsorted(self.time, span)
        path = self.path[max(min(first, len(self.time) - 2), 0):last + 1]
        return path if len(path) > 1 else np.repeat(path, 2, axis=0)

    def numbers_of(self, chunk) -> tuple[np.ndarray, np.ndarray]:
        """Column and row (n,) int64 of the stretches that own the points of a chunk."""
        limits = [self._time_at(number * self.size) for number in range(1, self._count)]
        column = np.searchsorted(limits, _times(chunk), side="right").astype(np.int64)
        return column, np.zeros_like(column)

    def covering(self, bounds: Bounds) -> list[GridTile]:
        """Stretches from which a box may have been measured, along the drive."""
        if self._count > MAX_TILES:
            raise InputError(say("The drive would take more than a million stretches: give longer ones."))
        box = shapely.box(*bounds)
        return [tile for tile in (self.tile(number, 0) for number in range(self._count))
                if box.intersects(shapely.box(*tile.core))]


def _box(path: np.ndarray) -> Bounds:
    return (*(path.min(axis=0) - REACH).tolist(), *(path.max(axis=0) + REACH).tolist())
