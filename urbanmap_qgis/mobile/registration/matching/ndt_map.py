"""Normal distributions of the reference markings, a grid cell each (J eq. 5 to 7; chapter 4 eq. 1 to 3)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

_MIN_RATIO = 1e-3  # least ratio of a covariance's variances, so that lines and planes can be inverted (Magnusson 2009)
_MIN_POINTS = 3


@dataclass(frozen=True)
class NdtMap:
    """Normal distributions in 2 or 3 dimensions.

    Attributes
    ----------
    cell : m, side of the cells.
    origin : (d,) m.
    shape : (d,) cells. Outermost cells are empty, so that neighbours need no test.
    number : (cells,) int32, number of the distribution of each cell, -1 where there is none.
    mean : (k, d) m, from `origin`.
    inverse : (k, d, d) of the covariances, 1/m2.
    """

    cell: float
    origin: np.ndarray
    shape: tuple[int, ...]
    number: np.ndarray
    mean: np.ndarray
    inverse: np.ndarray

    @property
    def dimensions(self) -> int:
        """2 or 3."""
        return len(self.shape)

    def __len__(self) -> int:
        return len(self.mean)

    @cached_property
    def tree(self) -> cKDTree:
        """Tree of the means."""
        return cKDTree(self.mean)

    def cells_of(self, points: np.ndarray) -> np.ndarray:
        """(m,) flat cell of each point (m, d), given from `origin`; points outside fall on an outermost, empty cell."""
        flat = np.zeros(len(points), dtype=np.int64)
        for axis, size in enumerate(self.shape):
            index = np.floor(points[:, axis] / self.cell)
            flat = flat * size + np.clip(index, 0, size - 1).astype(np.int64)
        return flat

    def distributions(self, local: np.ndarray, cells: str) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Rows of points (m, d), given from `origin`, with the numbers of distributions that they score in.

        `cells` : "neighbours", "own" or "closest", see `RegistrationSettings`.
        """
        if cells == "closest":
            yield np.arange(len(local)), self.tree.query(local)[1]
            return
        flat, last = self.cells_of(local), len(self.number) - 1
        for step in self._neighbour_steps() if cells == "neighbours" else (0,):
            number = self.number[np.clip(flat + step, 0, last)]
            rows = np.flatnonzero(number >= 0)
            if len(rows):
                yield rows, number[rows]

    def _neighbour_steps(self) -> np.ndarray:
        """Steps from a flat cell to itself and to the 8 (26) around it."""
        steps = []
        for offset in itertools.product((-1, 0, 1), repeat=self.dimensions):
            flat = 0
            for step, size in zip(offset, self.shape):
                flat = flat * size + step
            steps.append(flat)
        return np.array(steps, dtype=np.int64)


def build_ndt(points: np.ndarray, cell: float, spread: float = 0.0, min_points: int = _MIN_POINTS,
              min_ratio: float = _MIN_RATIO) -> NdtMap:
    """Distributions of the points in each cell.

    Parameters
    ----------
    points : (n, d) m, d = 2 or 3.
    cell : m, side of a cell.
    spread : m, standard deviation of each point's own place, such as its pixel's extent: added to the covariances.
    min_points : points that make a distribution.
    min_ratio : least ratio of the variances to the largest one.
    """
    points = np.asarray(points, dtype=np.float64)
    dimensions = points.shape[1]
    if not len(points):
        return NdtMap(cell, np.zeros(dimensions), (3,) * dimensions, np.full(3 ** dimensions, -1, dtype=np.int32),
                      np.zeros((0, dimensions)), np.zeros((0, dimensions, dimensions)))
    # Cells on multiples of their side, two empty ones around: a point clipped to the border has empty neighbours only.
    origin = (np.floor(points.min(axis=0) / cell) - 2) * cell
    local = points - origin
    shape = tuple((np.floor(local.max(axis=0) / cell).astype(int) + 3).tolist())
    flat = np.ravel_multi_index(np.floor(local / cell).astype(np.int64).T, shape)
    filled, index, count = np.unique(flat, return_inverse=True, return_counts=True)
    mean = np.stack([np.bincount(index, local[:, a]) / count for a in range(dimensions)], axis=1)
    off = local - mean[index]
    covariance = np.empty((len(filled), dimensions, dimensions))
    for a, b in itertools.combinations_with_replacement(range(dimensions), 2):
        covariance[:, a, b] = covariance[:, b, a] = (np.bincount(index, off[:, a] * off[:, b])
                                                     / np.maximum(count - 1, 1))
    usable = count >= min_points
    covariance = covariance[usable] + spread ** 2 * np.eye(dimensions)
    values, vectors = np.linalg.eigh(covariance)
    largest = np.maximum(values[:, -1:], 1e-12 * cell ** 2)
    values = np.maximum(values, min_ratio * largest)
    inverse = np.einsum("nij,nj,nkj->nik", vectors, 1.0 / values, vectors)
    number = np.full(math.prod(shape), -1, dtype=np.int32)
    number[filled[usable]] = np.arange(int(usable.sum()), dtype=np.int32)
    return NdtMap(cell, origin, shape, number, mean[usable], inverse)
