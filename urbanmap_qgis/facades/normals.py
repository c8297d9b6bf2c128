"""Point normals from the statistics of voxels: millions of points a second, and walls separated from the rest (J 5.7).

Sums of the points in each voxel are added up over the 27 voxels round it; the least axis of the resulting covariance
is the normal. All points of a voxel share it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

VOXEL = 0.3
"""Side of a voxel where points are dense, m."""

MIN_SUPPORT = 12  # Points that a neighbourhood should have: voxels grow until half of the neighbourhoods do.
MAX_VOXEL = 1.2
UPRIGHT = 0.35  # Walls have normals that rise or fall by less than this (sine): 20 degrees.
# The extent of a flat neighbourhood across is at most this share of its second extent (standard deviations).
FLAT = 0.2
ROUNDING = 1e-9  # Of variances, m2.

_DIRECTIONS = [(x - 1, y - 1, z - 1) for x, y, z in np.ndindex(3, 3, 3) if (x, y, z) != (1, 1, 1)]
"""To the 26 voxels round one, those in opposite directions equally far from both ends."""


@dataclass(frozen=True, eq=False)
class NormalVoxels:
    """Points by voxels.

    Attributes
    ----------
    size : side, m.
    of_point : (n,) voxel of each point.
    index : (v, 3) whole coordinates.
    count : (v,) points.
    mean : (v, 3) their centroid, m.
    normal : (v, 3) unit normals of unknown sign; these and the next two are NaN where the surface cannot be upright.
    thickness : (v,) standard deviation across, m.
    extent : (v,) standard deviation along the second axis, m.
    support : (v,) points of the neighbourhood.
    """

    size: float
    of_point: np.ndarray
    index: np.ndarray
    count: np.ndarray
    mean: np.ndarray
    normal: np.ndarray
    thickness: np.ndarray
    extent: np.ndarray
    support: np.ndarray

    @property
    def upright(self) -> np.ndarray:
        """Voxels (v,) that lie on a flat upright surface."""
        return ((np.abs(self.normal[:, 2]) < UPRIGHT) & (self.support >= 5)
                & (self.thickness < np.maximum(FLAT * self.extent, 0.01)))


def voxel_normals(points: np.ndarray) -> NormalVoxels:
    """Voxels of points (n, 3), m, with their normals; they grow where the points are thin.

    The first of `VOXEL`, 1.5 `VOXEL`, ... is taken in which half of the neighbourhoods have a dozen points.
    """
    size = VOXEL
    while True:
        cells = _Cells.of(points, size)
        if size * 1.5 > MAX_VOXEL or np.median(cells.support) >= MIN_SUPPORT:
            return _voxels(points, cells)
        size *= 1.5


@dataclass(frozen=True, eq=False)
class _Cells:
    """Voxels of a side `size`, m, that hold points, and which of them lie side by side.

    Attributes
    ----------
    low : (3,) m, lower corner of all.
    index : (v, 3) whole coordinates.
    of_point, count : see `NormalVoxels`.
    beside : for each of the 26 directions (3,) the voxels that have another there, and the places of these.
    support : (v,) points of each and all beside it.
    """

    size: float
    low: np.ndarray
    index: np.ndarray
    of_point: np.ndarray
    count: np.ndarray
    beside: list[tuple[tuple[int, int, int], np.ndarray, np.ndarray]]
    support: np.ndarray

    @classmethod
    def of(cls, points: np.ndarray, size: float) -> _Cells:
        """The voxels of points (n, 3), m."""
        low = points.min(axis=0)
        index = np.floor((points - low) / size).astype(np.int64) + 1
        shape = index.max(axis=0) + 2
        codes, of_point, count = numbered_cells((index[:, 0] * shape[1] + index[:, 1]) * shape[2] + index[:, 2])
        index = np.column_stack([codes // (shape[1] * shape[2]), codes // shape[2] % shape[1], codes % shape[2]])
        beside = _beside(codes, shape)
        support = count.copy()
        for _, found, place in beside:
            support[found] += count[place]
        return cls(size, low, index, of_point, count, beside, support)


def _beside(codes: np.ndarray, shape: np.ndarray) -> list[tuple[tuple[int, int, int], np.ndarray, np.ndarray]]:
    """`_Cells.beside` of voxels by their codes; who has another on one side is on the other side of that."""
    first = []
    for direction in _DIRECTIONS[:len(_DIRECTIONS) // 2]:
        dx, dy, dz = direction
        first.append((direction, *_found(codes, codes + (dx * shape[1] + dy) * shape[2] + dz)))
    return first + [((-dx, -dy, -dz), place, found) for (dx, dy, dz), found, place in reversed(first)]


def _voxels(points: np.ndarray, cells: _Cells) -> NormalVoxels:
    """The voxels with what is known of each."""
    # Sums about the voxel's corner, so that squares stay small.
    corner = cells.index * cells.size
    inside = points - cells.low - corner[cells.of_point]
    of_point, count = cells.of_point, cells.count
    sums = np.empty((len(count), 10))
    sums[:, 0] = count
    for k in range(3):
        sums[:, 1 + k] = np.bincount(of_point, inside[:, k], len(count))
    for column, (i, j) in enumerate(((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)), 4):
        sums[:, column] = np.bincount(of_point, inside[:, i] * inside[:, j], len(count))
    mean = cells.low + corner + sums[:, 1:4] / count[:, None]
    normal, thickness, extent, support = _neighbourhood_axes(cells, sums)
    return NormalVoxels(cells.size, of_point, np.rint(corner / cells.size).astype(np.int64), count, mean, normal,
                        thickness, extent, support)


def numbered_cells(code: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Different codes (v,) ascending, the place among them of each (n,), and how often they come (v,)."""
    codes, place, count = np.unique(code, return_inverse=True, return_counts=True)
    return codes, place.ravel(), count


def _found(codes: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which of the codes (m,) wanted are among ascending `codes`, and their places there."""
    place = np.minimum(np.searchsorted(codes, wanted), len(codes) - 1)
    found = np.flatnonzero(codes[place] == wanted)
    return found, place[found]


def _neighbourhood_axes(cells: _Cells, sums: np.ndarray):
    """Normal, extents across and along, and number of points of the 27 voxels round each."""
    total = sums.copy()
    for direction, found, place in cells.beside:
        total[found] += _shifted(sums[place], np.array(direction) * cells.size)
    support = total[:, 0]
    mean = total[:, 1:4] / support[:, None]
    covariance = np.empty((len(sums), 3, 3))
    for column, (i, j) in enumerate(((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)), 4):
        covariance[:, i, j] = covariance[:, j, i] = total[:, column] / support - mean[:, i] * mean[:, j]
    # Points on a surface nearer to upright than to level spread less along some level line than up and down.
    (a, b), c = covariance[:, 0, :2].T, covariance[:, 1, 1]
    least = (a + c) / 2 - np.hypot((a - c) / 2, b)
    upright = np.flatnonzero((least <= covariance[:, 2, 2] + ROUNDING) & (support >= 5))
    values, vectors = np.linalg.eigh(covariance[upright])
    normal, extents = np.full((len(sums), 3), np.nan), np.full((len(sums), 2), np.nan)
    normal[upright], extents[upright] = vectors[:, :, 0], np.sqrt(np.maximum(values[:, :2], 0.0))
    return normal, *extents.T, support


def _shifted(sums: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Sums (k, 10) about an origin `shift` further away."""
    moved = sums.copy()
    count = sums[:, 0]
    for k in np.flatnonzero(shift):
        moved[:, 1 + k] += count * shift[k]
    for column, (i, j) in enumerate(((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)), 4):
        if shift[i] and shift[j]:
            moved[:, column] += shift[i] * sums[:, 1 + j] + shift[j] * sums[:, 1 + i] + count * shift[i] * shift[j]
        elif shift[i] or shift[j]:
            moved[:, column] += shift[i] * sums[:, 1 + j] if shift[i] else shift[j] * sums[:, 1 + i]
    return moved
