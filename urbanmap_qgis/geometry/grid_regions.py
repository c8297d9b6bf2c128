"""Connected regions of equal classes in a grid."""

from __future__ import annotations

import numpy as np

from .linked_groups import linked_groups


def grid_regions(classes: np.ndarray) -> np.ndarray:
    """Number of each cell's region, int64 (rows, columns): cells of one class that touch along a side.

    Regions are numbered from 1 in the order of their first cells, row by row; cells of class 0 are 0.
    """
    cell = np.arange(classes.size).reshape(classes.shape)
    beside, below = classes[:, 1:] == classes[:, :-1], classes[1:] == classes[:-1]
    one = np.concatenate([cell[:, :-1][beside], cell[:-1][below]])
    other = np.concatenate([cell[:, 1:][beside], cell[1:][below]])
    inside = classes.ravel() > 0
    region = linked_groups(one, other, classes.size)[1][inside]
    result = np.zeros(classes.size, np.int64)
    result[inside] = np.unique(region, return_inverse=True)[1].ravel() + 1
    return result.reshape(classes.shape)
