"""Products of the corners of a ring with those after them."""

from __future__ import annotations

import numpy as np


def cross_with_next(corners: np.ndarray) -> np.ndarray:
    """Cross products (n, 3) of corners (n, 3) with the next ones, that of the last with the first.

    What `numpy.cross` gives, which takes five times as long for the few corners of a ring.
    """
    closed = corners[[*range(len(corners)), 0]]
    before, after = closed[:-1], closed[1:]
    products = np.empty((len(corners), 3))
    for axis, (first, second) in enumerate(((1, 2), (2, 0), (0, 1))):
        products[:, axis] = before[:, first] * after[:, second] - before[:, second] * after[:, first]
    return products
