"""Many small symmetric systems at once, element by element: a library call for each costs more than its sums."""

from __future__ import annotations

import numpy as np


def solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(3, n) solutions x of A x = b for n positive definite matrices A, by A = L D L^T.

    Parameters
    ----------
    matrix : (6, n) elements on and above the diagonals of A, row by row.
    right : (3, n) b.
    """
    a, b, c, d, e, f = matrix
    below, far = b / a, c / a
    second = d - below * b
    last_below = (e - below * c) / second
    third = f - far * c - last_below * last_below * second
    one, two, three = right
    two = two - below * one
    three = (three - far * one - last_below * two) / third
    two = two / second - last_below * three
    return np.stack([one / a - below * two - far * three, two, three])
