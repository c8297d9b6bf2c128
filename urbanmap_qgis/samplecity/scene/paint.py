"""Road paint: which marking lies at a place, and whether its paint is still there."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import shapely

from .model import Marking, Material

CELL = 0.25
"""Cells in which no marking lies are skipped, m."""

FINE, COARSE = 0.06, 0.5
"""Sizes of the spots in which paint wears off, m."""


class Paint:
    """The markings of one epoch, to be asked at many places."""

    def __init__(self, markings: Sequence[Marking]):
        self.markings = tuple(markings)
        self._wear = np.array([*(marking.wear for marking in markings), 1.0])
        self._material = np.array([*(Material.PAINT_YELLOW if marking.colour == "yellow" else Material.PAINT_WHITE
                                     for marking in markings), 0], np.uint8)
        plans = [marking.plan for marking in markings]
        self._tree = shapely.STRtree(plans)
        x_min, y_min, x_max, y_max = shapely.total_bounds(plans) if plans else (0, 0, 1, 1)
        self._west, self._north = x_min - 2 * CELL, y_max + 2 * CELL
        shape = (int((y_max - y_min) / CELL) + 5, int((x_max - x_min) / CELL) + 5)
        near = np.zeros(shape, np.uint8)
        for plan in shapely.get_parts(plans):
            ring = shapely.get_coordinates(plan.exterior)
            cells = np.floor(np.column_stack([ring[:, 0] - self._west, self._north - ring[:, 1]]) / CELL)
            cv2.fillPoly(near, [cells.astype(np.int32)], 1)
        # A polygon drawn between the cells of its corners may miss cells that it only grazes.
        self._near = cv2.dilate(near, np.ones((3, 3), np.uint8)).astype(bool)

    def marking_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Number of the marking at the places (x, y any shape), -1 where there is none, worn or not."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        found = np.full(x.shape, -1, np.int32)
        row, column = ((self._north - y) / CELL).astype(np.intp), ((x - self._west) / CELL).astype(np.intp)
        known = (y < self._north) & (x > self._west) & (row < self._near.shape[0]) & (column < self._near.shape[1])
        known[known] = self._near[row[known], column[known]]
        points, markings = self._tree.query(shapely.points(x[known], y[known]), predicate="intersects")
        inside = np.full(np.count_nonzero(known), -1, np.int32)
        np.maximum.at(inside, points, markings.astype(np.int32))
        found[known] = inside
        return found

    def material_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """`Material` of the paint left at the places (uint8), 0 where there is none or it is worn off."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        marking = self.marking_at(x, y)
        left = marking >= 0
        left[left] = wear_field(x[left], y[left]) >= self._wear[marking[left]]
        return np.where(left, self._material[marking], 0).astype(np.uint8)


def wear_field(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """How long paint holds at the places, 0 to 1, evenly spread: a marking of wear w has lost it where this is < w."""
    value = 0.5 * value_noise(x, y, FINE) + 0.5 * value_noise(x, y, COARSE)
    return np.interp(value, _QUANTILES, np.linspace(0.0, 1.0, len(_QUANTILES)))


def value_noise(x: np.ndarray, y: np.ndarray, size: float) -> np.ndarray:
    """A fixed smooth random field of the place with spots of `size` m; values 0 to 1."""
    u, v = np.asarray(x, float) / size, np.asarray(y, float) / size
    column, row = np.floor(u), np.floor(v)
    right, up = u - column, v - row
    column, row = column.astype(np.int64), row.astype(np.int64)
    low = _hash(column, row) * (1 - right) + _hash(column + 1, row) * right
    high = _hash(column, row + 1) * (1 - right) + _hash(column + 1, row + 1) * right
    return low * (1 - up) + high * up


def _hash(column: np.ndarray, row: np.ndarray) -> np.ndarray:
    """A fixed random number in 0 to 1 for each pair of integers."""
    mixed = (column * 374761393 + row * 668265263) & 0xFFFFFFFF
    mixed = ((mixed ^ (mixed >> 13)) * 1274126177) & 0xFFFFFFFF
    mixed = ((mixed ^ (mixed >> 16)) * 2246822519) & 0xFFFFFFFF
    return (mixed ^ (mixed >> 15)) / 2.0**32


def _quantiles() -> np.ndarray:
    """Values of the wear field's noise below which 0, 1, ... 100 % of all places lie."""
    x, y = np.meshgrid(np.arange(300) * 0.173, np.arange(300) * 0.167)
    return np.quantile(0.5 * value_noise(x, y, FINE) + 0.5 * value_noise(x, y, COARSE), np.linspace(0, 1, 101))


_QUANTILES = _quantiles()
