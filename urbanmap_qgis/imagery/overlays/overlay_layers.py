"""What is drawn over an image: the nearest laser points and the edges that nothing hides, in pixels."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import minimum_filter

from ..views.views import Source
from .edge_lines import EdgeSamples
from .roof_heights import RoofHeights

BLOCK = 3
"""Side of the square of pixels that shows one laser point, the nearest."""

AROUND = 5  # blocks in which a nearer surface hides what lies behind it
# m and share of the distance behind the nearest point: still its surface
DEEPER = 0.5
DEEPER_SHARE = 0.03
# m
POINT_CLEARANCE = 2.0
EDGE_CLEARANCE = 0.5
# pixels between neighbours along an edge: farther ones lie in different passes of a line camera
LONGEST = 40.0


@dataclass(frozen=True, eq=False)
class DrawnPoints:
    """Laser points over an image, (n,) each: `column` and `row` in pixels, `value` of what colours them."""

    column: np.ndarray
    row: np.ndarray
    value: np.ndarray

    def __len__(self) -> int:
        return len(self.value)


@dataclass(frozen=True, eq=False)
class DrawnEdges:
    """Straight pieces of edges over an image: `start` and `end` (n, 2), column and row in pixels."""

    start: np.ndarray
    end: np.ndarray

    def __len__(self) -> int:
        return len(self.start)


class NearestPoints:
    """Collects laser points over an image, the nearest of each block; memory grows with the image, not the points."""

    def __init__(self, source: Source, max_range: float):
        self._source, self._max_range = source, max_range
        columns, rows = source.size()
        self._shape = (-(-rows // BLOCK), -(-columns // BLOCK))
        self._window = (0.0, 0.0, columns - 1.0, rows - 1.0)
        self._distance = np.full(self._shape, np.inf, np.float32)
        self._value = np.zeros(self._shape, np.float32)
        self._place = np.zeros((*self._shape, 3), np.float64)

    def add(self, points: np.ndarray, value: np.ndarray) -> None:
        """Take in points (n, 3), m, with the values (n,) that colour them."""
        index, column, row, distance = self._source.pixels(points, self._window, self._max_range)
        if not len(index):
            return
        block = ((row + 0.5) // BLOCK).astype(np.int64) * self._shape[1] + ((column + 0.5) // BLOCK).astype(np.int64)
        order = np.lexsort((distance, block))
        first = order[np.concatenate([[True], np.diff(block[order]) > 0])]
        nearer = first[distance[first] < self._distance.ravel()[block[first]]]
        at = np.unravel_index(block[nearer], self._shape)
        self._distance[at] = distance[nearer]
        self._value[at] = value[index[nearer]]
        self._place[at] = points[index[nearer]]

    def drawn(self, roofs: RoofHeights) -> DrawnPoints:
        """Those that neither a nearer surface of points nor a building hides."""
        near = minimum_filter(self._distance, AROUND, mode="nearest")
        seen = np.isfinite(self._distance) & (self._distance <= near * (1 + DEEPER_SHARE) + DEEPER)
        row, column = np.nonzero(seen)
        column, row_middle = column * BLOCK + BLOCK // 2, row * BLOCK + BLOCK // 2
        place, value = self._place[seen], self._value[seen]
        cameras, _ = self._source.rays(column.astype(float), row_middle.astype(float))
        keep = ~roofs.hidden(place, cameras, POINT_CLEARANCE)
        return DrawnPoints(column[keep], row_middle[keep], value[keep])


def nearest_points(sources: Iterable[Source], chunks: Iterable[tuple[np.ndarray, np.ndarray]], max_range: float,
                   roofs: RoofHeights) -> list[DrawnPoints]:
    """Laser points over each image, from chunks of points (n, 3) and values (n,); the points are read once."""
    collected = [NearestPoints(source, max_range) for source in sources]
    for points, value in chunks:
        for one in collected:
            one.add(points, value)
    return [one.drawn(roofs) for one in collected]


def visible_edges(source: Source, samples: EdgeSamples, max_range: float, roofs: RoofHeights) -> DrawnEdges:
    """Edges over an image, without what buildings hide."""
    columns, rows = source.size()
    index, column, row, _ = source.pixels(samples.place, (0.0, 0.0, columns - 1.0, rows - 1.0), max_range)
    cameras, _ = source.rays(column, row)
    seen = ~roofs.hidden(samples.place[index], cameras, EDGE_CLEARANCE)
    index, column, row = index[seen], column[seen], row[seen]
    sweep = _rank_in_group(index)
    order = np.lexsort((index, sweep))
    index, place = index[order], np.column_stack([column, row])[order]
    joined = ((np.diff(index) == 1) & (np.diff(sweep[order]) == 0) & (np.diff(samples.edge[index]) == 0)
              & (np.abs(np.diff(place, axis=0)).max(axis=1, initial=0.0) < LONGEST))
    return DrawnEdges(place[:-1][joined], place[1:][joined])


def _rank_in_group(index: np.ndarray) -> np.ndarray:
    """How manieth of its equals each number is: 0 for the first."""
    order = np.argsort(index, kind="stable")
    ranked = np.empty(len(index), np.int64)
    ranked[order] = np.arange(len(index)) - np.searchsorted(index[order], index[order])
    return ranked
