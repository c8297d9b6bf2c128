"""Connected regions of equal classes in a grid."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def grid_regions(classes: np.ndarray) -> np.ndarray:
    """Number of each cell's region, int64 (rows, columns): cells of one class that touch along a side.

    Regions are numbered from 1 in the order of their first cells, row by row; cells of class 0 are 0.
    """
    cell = np.arange(classes.size).reshape(classes.shape)
    beside, below = classes[:, 1:] == classes[:, :-1], classes[1:] == classes[:-1]
    one = np.concatenate([cell[:, :-1][beside], cell[:-1][below]])
    other = np.concatenate([cell[:, 1:][beside], cell[1:][below]])
    links = coo_matrix((np.ones(len(one), bool), (one, other)), (classes.size, classes.size))
    inside = classes.ravel() > 0
    region = connected_components(links, directed=False)[1][inside]
    _, first, number = np.unique(region, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(1, len(first) + 1)
    result = np.zeros(classes.size, np.int64)
    result[inside] = rank[number]
    return result.reshape(classes.shape)
