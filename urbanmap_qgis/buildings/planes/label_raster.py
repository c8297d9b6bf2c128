"""The plan raster of one building: which plane each cell shows, and how high its points reach."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
import shapely
from scipy import ndimage

from ...geometry.grid import Grid

CELL = (0.3, 0.8)
"""Smallest and largest cell, m; the density sets it between them."""

CEILING_REACH = 1.0, 2.5
"""Distance in m, and in cells where those are large, within which the highest point bounds a roof."""


@dataclass(frozen=True)
class LabelRaster:
    """Cells inside the outline, coordinates on the outline's own origin.

    Attributes
    ----------
    x, y : centres of columns and rows, m.
    cell : side, m.
    label : (rows, columns) plane of each cell, gaps filled from the nearest one; -1 outside the outline.
    inside : (rows, columns) bool.
    seen : (rows, columns) bool, cells with points of a plane.
    ceiling : (rows, columns) highest point near each cell, m; inf where there is none.
    """

    x: np.ndarray
    y: np.ndarray
    cell: float
    label: np.ndarray
    inside: np.ndarray
    seen: np.ndarray
    ceiling: np.ndarray


def label_raster(points: np.ndarray, label: np.ndarray, outline: shapely.Geometry, density: float) -> LabelRaster:
    """Raster of points (n, 3) with planes (n,), -1 for none, within an outline."""
    cell = min(max(1.0 / math.sqrt(density), CELL[0]), CELL[1])
    grid = Grid.covering(*outline.bounds, cell)
    x, y = grid.centres()
    shapely.prepare(outline)
    inside = shapely.contains_xy(outline, *np.meshgrid(x, y))
    row, column, on_grid = grid.cells(points[:, 0], points[:, 1])
    at = row * grid.columns + column
    ceiling = _ceiling(grid, at[on_grid], points[on_grid, 2])
    use = on_grid & (label >= 0)
    shown = _most(at[use], label[use], grid.rows * grid.columns).reshape(grid.shape)
    seen = (shown >= 0) & inside
    if not seen.any():
        return LabelRaster(x, y, cell, np.where(inside, 0, -1), inside, seen, ceiling)
    near = ndimage.distance_transform_edt(~seen, return_distances=False, return_indices=True)
    return LabelRaster(x, y, cell, np.where(inside, shown[tuple(near)], -1), inside, seen, ceiling)


def _most(cell: np.ndarray, label: np.ndarray, size: int) -> np.ndarray:
    """The label most points of each cell have, -1 in empty cells."""
    shown = np.full(size, -1)
    if not len(cell):
        return shown
    count = int(label.max()) + 1
    pairs, votes = np.unique(cell * count + label, return_counts=True)
    order = np.lexsort((-pairs, votes))
    shown[pairs[order] // count] = pairs[order] % count
    return shown


def _ceiling(grid: Grid, cell: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Highest point in `CEILING_REACH` of each cell, inf where there is none."""
    top = np.full(grid.rows * grid.columns, -np.inf)
    np.maximum.at(top, cell, z)
    reach = round(max(CEILING_REACH[0] / grid.cell, CEILING_REACH[1]))
    window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    highest = cv2.dilate(np.where(np.isfinite(top), top, -1e9).reshape(grid.shape), window,
                         borderType=cv2.BORDER_CONSTANT, borderValue=-1e9)
    return np.where(highest > -1e8, highest, np.inf)
