"""Gauss-Markov chains: normal equations in which each state is tied to the next alone, solved in linear time.

The matrix is block tridiagonal. Of its inverse only the blocks on the diagonal are made (the selected inverse).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dpotrf, dtrtri

from ..wording import say


@dataclass(frozen=True)
class ChainSolution:
    """Solution of the normal equations of n states with p values each.

    Attributes
    ----------
    state : (n, p), or (n, p, r) of as many right sides.
    covariance : (n, p, p) of each state, given all.
    log_determinant : of the matrix.
    gain : (n - 1, p, p); the covariance of a state and the next one is -gain[k] @ covariance[k + 1].
    """

    state: np.ndarray
    covariance: np.ndarray
    log_determinant: float
    gain: np.ndarray


def solve_chain(diagonal: np.ndarray, ahead: np.ndarray, right: np.ndarray) -> ChainSolution:
    """Solve the symmetric positive definite system with blocks `diagonal` (n, p, p) and `ahead` (n - 1, p, p).

    `ahead[k]` stands in row k, column k + 1; `right` is (n, p), or (n, p, r) for r right sides.
    """
    count = len(right)
    scale = 1.0 / np.sqrt(np.einsum("kii->ki", diagonal))  # states in their own units
    diagonal = diagonal * scale[:, :, None] * scale[:, None, :]
    ahead = ahead * scale[:-1, :, None] * scale[1:, None, :]
    of_right = scale if right.ndim == 2 else scale[:, :, None]
    state = right * of_right
    inverse = np.empty_like(diagonal)  # of each pivot, the states before eliminated
    gain = np.empty_like(ahead)
    roots = np.empty_like(scale)
    pivot = diagonal[0]
    for k in range(count):
        if k:
            back = gain[k - 1].T
            pivot = diagonal[k] - back @ ahead[k - 1]
            state[k] -= back @ state[k - 1]
        lower, wrong = dpotrf(pivot, lower=1)
        if wrong:
            raise np.linalg.LinAlgError(say("Matrix is not positive definite"))
        roots[k] = lower.diagonal()
        half, _ = dtrtri(lower, lower=1)
        np.matmul(half.T, half, out=inverse[k])
        if k < count - 1:
            np.matmul(inverse[k], ahead[k], out=gain[k])
    log_determinant = 2.0 * float(np.log(roots).sum() - np.log(scale).sum())
    covariance = inverse.copy()
    state[-1] = inverse[-1] @ state[-1]
    for k in range(count - 2, -1, -1):
        state[k] = inverse[k] @ state[k] - gain[k] @ state[k + 1]
        covariance[k] += gain[k] @ covariance[k + 1] @ gain[k].T
    return ChainSolution(state * of_right, covariance * scale[:, :, None] * scale[:, None, :], log_determinant,
                         gain * scale[:-1, :, None] / scale[1:, None, :])
