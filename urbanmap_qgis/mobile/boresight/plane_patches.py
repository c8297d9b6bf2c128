"""Small planes in a survey, each of one scanner and one pass: what the calibration of scanners compares."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np

VOXEL = 0.8
"""m, side of the cells in which planes are fitted."""

FEWEST = 15  # points of a plane
MAX_ROUGHNESS = 0.04  # m, of the points about their plane
MIN_EXTENT = 0.12  # m, standard deviation of the points along the plane's shorter side
BITS = (17, 17, 12, 16)  # of a cell's key: x, y, z, group
MERGE_AT = 4_000_000  # cells held before they are merged


@dataclass(frozen=True)
class PlanePatches:
    """Planes, a row each.

    Attributes
    ----------
    group : (n,) number of scanner and pass that measured it.
    time : (n,) s, mean of its points.
    centroid, normal : (n, 3) m.
    sigma : (n,) m, of the plane's place along its normal.
    means : (n, k) of what was collected with its points.
    """

    group: np.ndarray
    time: np.ndarray
    centroid: np.ndarray
    normal: np.ndarray
    sigma: np.ndarray
    means: np.ndarray

    def __len__(self) -> int:
        return len(self.group)

    def select(self, which: np.ndarray) -> PlanePatches:
        """Some of them, by mask or index."""
        return PlanePatches(*(getattr(self, field.name)[which] for field in fields(self)))


class PatchSearch:
    """Collects points chunk by chunk, and fits a plane in each cell of each group.

    Parameters
    ----------
    origin : (3,) m, a place within a hundred kilometres of all points.
    """

    def __init__(self, origin: np.ndarray):
        self._origin = np.floor(origin / VOXEL) * VOXEL
        self._keys: list[np.ndarray] = []
        self._sums: list[np.ndarray] = []
        self._held = 0

    def add(self, points: np.ndarray, time: np.ndarray, group: np.ndarray, values: np.ndarray | None = None) -> None:
        """Take points (n, 3) m, their times (n,) s and groups (n,), and values (n, k) whose means are wanted."""
        if not len(points):
            return
        cell = np.floor((points - self._origin) / VOXEL).astype(np.int64)
        key = np.zeros(len(points), np.int64)
        for value, bits in zip((*cell.T, group), BITS):
            offset = 0 if value is group else 1 << (bits - 1)
            key = (key << bits) | ((value + offset) & ((1 << bits) - 1))
        local = points - self._origin - (cell + 0.5) * VOXEL
        names, number = np.unique(key, return_inverse=True)
        x, y, z = local.T
        columns = (np.ones(len(x)), x, y, z, x * x, x * y, x * z, y * y, y * z, z * z, time - time[0])
        columns += tuple(values.T) if values is not None else ()
        sums = np.column_stack([np.bincount(number, column, len(names)) for column in columns])
        sums[:, 10] += sums[:, 0] * time[0]
        self._keys.append(names)
        self._sums.append(sums)
        self._held += len(names)
        if self._held > MERGE_AT:
            self._merge()

    def _merge(self) -> None:
        keys, sums = np.concatenate(self._keys), np.concatenate(self._sums)
        order = np.argsort(keys, kind="stable")
        keys, sums = keys[order], sums[order]
        first = np.flatnonzero(np.r_[True, keys[1:] != keys[:-1]])
        self._keys, self._sums = [keys[first]], [np.add.reduceat(sums, first, axis=0)]
        self._held = len(first)

    def patches(self) -> PlanePatches:
        """The planes of all cells that are plane enough."""
        if not self._keys:
            return PlanePatches(np.zeros(0, int), np.zeros(0), *np.zeros((2, 0, 3)), np.zeros(0), np.zeros((0, 0)))
        self._merge()
        keys, sums = self._keys[0], self._sums[0]
        enough = sums[:, 0] >= FEWEST
        keys, sums = keys[enough], sums[enough]
        count = sums[:, 0]
        mean = sums[:, 1:4] / count[:, None]
        second = (sums[:, 4:10] / count[:, None])[:, [[0, 1, 2], [1, 3, 4], [2, 4, 5]]]
        values, vectors = np.linalg.eigh(second - mean[:, :, None] * mean[:, None, :])
        values = np.maximum(values, 0.0)
        plane = (np.sqrt(values[:, 0]) <= MAX_ROUGHNESS) & (np.sqrt(values[:, 1]) >= MIN_EXTENT)
        cell, group = _unpacked(keys)
        centre = self._origin + (cell + 0.5) * VOXEL
        sigma = np.sqrt(np.maximum(values[:, 0], 1e-6) / count)
        return PlanePatches(group, sums[:, 10] / count, centre + mean, vectors[:, :, 0], sigma,
                            sums[:, 11:] / count[:, None]).select(plane)


def _unpacked(keys: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cells (n, 3) and groups (n,) of keys."""
    parts = []
    for bits in reversed(BITS):
        parts.append(keys & ((1 << bits) - 1))
        keys = keys >> bits
    group, *cell = parts
    return np.column_stack([values - (1 << (bits - 1)) for values, bits in zip(reversed(cell), BITS)]), group


def group_pairs(groups: np.ndarray) -> Iterator[tuple[int, int]]:
    """All pairs of different groups that have patches."""
    present = np.unique(groups)
    for position, first in enumerate(present):
        for second in present[position + 1:]:
            yield int(first), int(second)
