"""Roof points joined to buildings: those whose cells touch in plan."""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

CELL_POINTS = 2.0
"""Roof points that a cell holds in the mean: an empty one by chance is rarer than 1 in 7."""
ROW = 2**32
"""Step of the numbers of cells from one row to the next."""
SQUARE = 2.0
"""Side (m) of the squares in which points are counted."""
MAX_CELL = 1.5
"""Side (m) of the largest cell, so that buildings across a path stay two in thin clouds."""


def cell_side(density: float) -> float:
    """Side (m) of the cells in which roof points of a density (points/m2) are joined."""
    return min(math.sqrt(CELL_POINTS / density), MAX_CELL)


def roof_density(x: np.ndarray, y: np.ndarray) -> float:
    """Points/m2 on roofs: the median over squares that hold any."""
    squares = np.stack([x // SQUARE, y // SQUARE]).astype(np.int64)
    return float(np.median(np.unique(squares, axis=1, return_counts=True)[1])) / SQUARE**2


def cells_of_points(points: np.ndarray, origin: np.ndarray, side: float) -> np.ndarray:
    """Number (n,) of the cell that each point (with fields x and y, m) lies in; `origin` (2,) is south-west of all."""
    row = ((points["y"] - origin[1]) // side).astype(np.int64)
    return (row + 1) * ROW + ((points["x"] - origin[0]) // side).astype(np.int64) + 1


def regions_of_cells(cells: np.ndarray) -> np.ndarray:
    """Region (k,) of each cell: cells that touch, corners included, are one region.

    Regions are numbered from 0 by their first cell.

    Parameters
    ----------
    cells : (k,) numbers of cells (`cells_of_points`), ascending, each once.
    """
    pairs = []
    for step in (1, ROW - 1, ROW, ROW + 1):
        place = np.minimum(np.searchsorted(cells, cells + step), len(cells) - 1)
        one = np.flatnonzero(cells[place] == cells + step)
        pairs.append(np.stack([one, place[one]]))
    joined = np.concatenate(pairs, axis=1)
    graph = coo_matrix((np.ones(joined.shape[1], bool), tuple(joined)), shape=(len(cells), len(cells)))
    label = connected_components(graph, directed=False)[1]
    _, first, region = np.unique(label, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[region.ravel()]
