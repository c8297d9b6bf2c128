"""What the laser points say about every cell of a plan: building, not building, or nothing.

The evidence places displaced outlines (`displacement.py`); J 5.3.1 takes the official outlines for "a good
estimation", which holds only where they are not off by a metre or two.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import minimum_filter, uniform_filter

from ...errors import InputError
from ...geometry.grid import Grid
from ...wording import say

BUILDING_CLASS = 6
GROUND_CLASSES = (2, 9, 11)  # ground, water, road surface (ASPRS)

FINEST_CELL = 0.5
COARSEST_CELL = 1.0
POINTS_PER_CELL = 1.0
HIGH = 2.0  # m above ground: from here on a smooth surface is a building
SMOOTH = 0.12  # m, deviation from a plane of a window lying on one roof
GUESS = 0.5  # weight of the shape where a cloud has classes but this cell holds neither building nor ground

LOW = 1.2  # m above ground: below this nothing is a building
ROUGH = 0.35  # m, the same in foliage
VEGETATION = -0.2  # evidence of a high rough cell: outlines seldom cover it, but a tree may hang over a roof
CERTAIN, REACH = 1.0, 2.5  # m from a cell with points: its evidence holds there as well, or half of it does


def evidence_cell(density: float) -> float:
    """Cell side (m) that suits a cloud of `density` points per m2: 0.5 m, up to 1 m for sparse clouds."""
    if not density > 0:
        raise InputError(say("The point density is not a positive number: check that the points cover the outlines."))
    return float(np.clip(math.sqrt(POINTS_PER_CELL / density), FINEST_CELL, COARSEST_CELL))


class EvidenceAccumulator:
    """Collects points chunk by chunk; memory grows with the area, not with the points.

    Parameters
    ----------
    grid : where the cells lie; `evidence_cell` gives a cell side that suits the density.

    Attributes
    ----------
    count, building, ground, multiple : (rows, columns) int32: all points, points of class 6, points of classes
        2, 9 and 11, and points of pulses with several returns.
    highest, lowest : (rows, columns) float32, z in m; NaN-free inside: -inf and +inf where no point fell.
    """

    def __init__(self, grid: Grid):
        self.grid = grid
        self.count = np.zeros(grid.shape, np.int32)
        self.building = np.zeros(grid.shape, np.int32)
        self.ground = np.zeros(grid.shape, np.int32)
        self.multiple = np.zeros(grid.shape, np.int32)
        self.highest = np.full(grid.shape, -np.inf, np.float32)
        self.lowest = np.full(grid.shape, np.inf, np.float32)

    def add(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, classification: np.ndarray | None = None,
            return_number: np.ndarray | None = None, number_of_returns: np.ndarray | None = None) -> None:
        """Add one chunk of points, all arrays (n,); noise (classes 7 and 18) must have been left out before.

        Points off the grid or without finite coordinates are passed over. Arrays that are None count as unknown.
        """
        x, y, z = (np.asarray(a, float) for a in (x, y, z))
        finite = np.isfinite(x + y + z)
        row, column, use = self.grid.cells(np.where(finite, x, self.grid.x_min), np.where(finite, y, self.grid.y_max))
        use &= finite
        cell = (row * self.grid.columns + column)[use]
        if not len(cell):
            return
        _count(self.count, cell)
        if classification is not None:
            classes = np.asarray(classification)[use]
            _count(self.building, cell[classes == BUILDING_CLASS])
            _count(self.ground, cell[np.isin(classes, GROUND_CLASSES)])
        if number_of_returns is not None:
            _count(self.multiple, cell[np.asarray(number_of_returns)[use] > 1])
        heights = z[use].astype(np.float32)
        np.maximum.at(self.highest.reshape(-1), cell, heights)
        np.minimum.at(self.lowest.reshape(-1), cell, heights)

    @property
    def surface(self) -> np.ndarray:
        """Highest z of every cell (rows, columns) float32, NaN where no point fell."""
        return np.where(self.count > 0, self.highest, np.float32(np.nan))

    def evidence(self, ground: np.ndarray) -> np.ndarray:
        """Evidence of every cell, float32 (rows, columns) in [-1, 1].

        +1: surely building, -1: surely not (ground, road, low things), 0: unknown.
        With class 6 in the cloud the classes decide and the shape only fills in; without, the shape decides:
        high above `ground` (rows, columns; m, NaN = unknown) and smooth is building, high and rough is foliage.
        Cells without points take after the cells around them, as far as `REACH` m.
        """
        ground = np.asarray(ground, np.float32)
        if ground.shape != self.grid.shape:
            raise InputError(say("The ground heights do not lie on the grid of the evidence: give both the same grid."))
        seen = self.count > 0
        shape = self._from_shape(ground, seen)
        if self.building.any():
            classed = (self.building + self.ground).astype(np.float32)
            share = np.divide(self.building - self.ground, classed, out=np.zeros_like(classed), where=classed > 0)
            # A wall's cell holds roof and ground points: their balance tells where in the cell the wall stands.
            shape = np.where(classed > 0, share, GUESS * shape)
        return _filled(shape.astype(np.float32), seen, self.grid.cell)

    def _from_shape(self, ground: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """Evidence of the cells with points, from heights, smoothness and returns only."""
        height = np.where(seen & np.isfinite(ground), self.highest - ground, np.float32(np.nan))
        known = np.isfinite(height)
        height = np.where(known, height, np.float32(0))
        smooth = 1 - np.clip((_roughness(height, known) - SMOOTH) / (ROUGH - SMOOTH), 0, 1)
        points = _box(self.count, 3)
        multiple = np.divide(_box(self.multiple, 3), points, out=np.zeros_like(points), where=points > 0)
        single = 1 - np.clip((multiple - 0.4) / 0.3, 0, 1)
        tall = np.clip((height - LOW) / (HIGH - LOW), 0, 1)
        high = VEGETATION + (1 - VEGETATION) * smooth * single
        return np.where(known, tall * high - (height < LOW), 0)


def _count(target: np.ndarray, cell: np.ndarray) -> None:
    """Add the number of occurrences of each flat cell number to `target`."""
    if not len(cell):
        return
    low = int(cell.min())
    counts = np.bincount(cell - low)
    target.reshape(-1)[low:low + len(counts)] += counts.astype(np.int32)


def _box(values: np.ndarray, size: int) -> np.ndarray:
    """Sum over a moving window of `size` x `size` cells."""
    return uniform_filter(values.astype(np.float64), size, mode="constant") * size**2


def _roughness(height: np.ndarray, known: np.ndarray, size: int = 3) -> np.ndarray:
    """Deviation (m) from a plane of the smoothest window that holds each cell.

    The plane of every window follows from moving sums of x, y, z products. A cell beside a roof's edge or ridge
    still lies in some window that is all on its own side: hence the least over the windows around.
    """
    weight = known.astype(np.float64)
    rows, columns = (np.arange(n, dtype=np.float64) for n in height.shape)
    y, x = rows[:, None] - rows.mean(), columns[None, :] - columns.mean()
    wz = weight * height
    n, sz, szz = _box(weight, size), _box(wz, size), _box(wz * height, size)
    sx, sy = _box(weight * x, size), _box(weight * y, size)
    with np.errstate(invalid="ignore", divide="ignore"):
        mx, my, mz = sx / n, sy / n, sz / n
        cxx = _box(weight * x * x, size) / n - mx * mx
        cyy = _box(weight * y * y, size) / n - my * my
        cxy = _box(weight * x * y, size) / n - mx * my
        cxz = _box(wz * x, size) / n - mx * mz
        cyz = _box(wz * y, size) / n - my * mz
        determinant = cxx * cyy - cxy * cxy
        explained = (cyy * cxz**2 - 2 * cxy * cxz * cyz + cxx * cyz**2) / determinant
        variance = szz / n - mz * mz - explained
        # Three parameters of n heights: an unbiased figure needs n - 3, and says nothing below 5 points.
        sound = (n > 4.5) & (determinant > 0.05)
        rough = np.where(sound, np.sqrt(np.maximum(variance, 0) * n / np.maximum(n - 3, 1)), np.inf)
    rough = minimum_filter(rough, size, mode="nearest")
    return np.where(np.isfinite(rough), rough, (SMOOTH + ROUGH) / 2)


def _filled(evidence: np.ndarray, seen: np.ndarray, cell: float) -> np.ndarray:
    """Evidence with cells that no point fell into given the mean of the seen cells around them.

    Within `CERTAIN` m it is taken whole; up to `REACH` m by half: where the points end (at the edge of a tile, at
    water) an outline must neither be drawn in nor pushed out.
    """
    known, value = seen.astype(np.float32), np.where(seen, evidence, np.float32(0))
    for ring in range(math.ceil(REACH / cell)):
        near = _box(known, 3)
        mean = np.divide(_box(value, 3), near, out=np.zeros_like(near), where=near > 0.5)
        first_outside = (ring - 1) * cell < CERTAIN <= ring * cell
        value = np.where(known == 0, mean * (0.5 if first_outside else 1), value).astype(np.float32)
        known = np.maximum(known, near > 0.5).astype(np.float32)
    return np.clip(value, -1, 1)
