"""How many walls a robust match really rests on: drawn displacements, and the solution that an NDT settles at (J 6.2).

The information of walls is not the sum of their points: all points of a wall are displaced together. A linear match
takes the mean of the walls' displacements, weighted by their points; an NDT turns away from walls that disagree and
follows the strongest, so that fewer walls count and its errors are larger.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from .information import Evidence

DRAWS = 2
"""Displacements drawn for each arrangement of vehicles and trees."""

ITERATIONS = 4
"""Of the reweighted solution at each level of tolerance."""

_UPPER = [(i, j) for i in range(3) for j in range(i, 3)]

LEVELS = (1.0, 0.3)
"""Least sigmas of the walls at the levels before the last, m: walls that are farther off still pull."""


@dataclass(frozen=True)
class _Seen:
    """Walls as places see them in one arrangement.

    Attributes
    ----------
    place, wall : (g,) numbers of the pairs.
    row : (g, 3) mean row of the wall's points.
    product : (g, 6) elements on and above the diagonal of the sum of u a a^T.
    weight : (g,) sum of u.
    point : (g,) u of one point, 1/m2.
    sigma : (g,) m.
    """

    place: np.ndarray
    wall: np.ndarray
    row: np.ndarray
    product: np.ndarray
    weight: np.ndarray
    point: np.ndarray
    sigma: np.ndarray


    @classmethod
    def of(cls, evidence: Evidence, rays: np.ndarray, wall: np.ndarray, sigma: np.ndarray, mask: np.ndarray) -> _Seen:
        """Walls of the rows that a mask (m,) leaves."""
        rows = np.flatnonzero(mask)
        width = int(wall.max(initial=0)) + 1
        key, number = np.unique(evidence.of[rows] * width + wall[rows], return_inverse=True)
        weight, row = evidence.weight[rows], evidence.row[rows]
        upper = [weight * row[:, i] * row[:, j] for i, j in _UPPER]
        points = csr_matrix((np.ones(len(rows)), (number.ravel(), np.arange(len(rows)))), (len(key), len(rows)))
        sums = points @ np.column_stack([weight, *upper, weight[:, None] * row, rays[rows],
                                         sigma[rows] * rays[rows]])
        total, of_rays = sums[:, :1], sums[:, 10]
        return cls(key // width, key % width, sums[:, 7:10] / total, sums[:, 1:7], total[:, 0], total[:, 0] / of_rays,
                   sums[:, 11] / of_rays)


def robust_excess(evidence: Evidence, rays: np.ndarray, wall: np.ndarray, sigma: np.ndarray,
                  masks: Sequence[np.ndarray], count: int, prior: np.ndarray, sharpness: float) -> np.ndarray:
    """(count, 3, 3) by which the covariance of an NDT exceeds that of the linear match: the difference of the second
    moments of both solutions for the same displacements, so that little chance is left in it.

    Parameters
    ----------
    evidence : m rows of the points on walls.
    rays, wall, sigma : (m,) rays that each row stands for, number of its wall, and that wall's sigma, m.
    masks : (m,) bool of each arrangement of vehicles and trees: what these leave.
    prior : (3, 3) information of what is known before.
    sharpness : of the NDT's mixture.
    """
    excess = np.zeros((count, 3, 3))
    rng = np.random.default_rng(11)
    for mask in masks:
        seen = _Seen.of(evidence, rays, wall, sigma, mask)
        drawn = rng.normal(size=(int(wall.max(initial=0)) + 1, DRAWS))
        shift = drawn[seen.wall] * seen.sigma[:, None]
        found = linear = _solved(seen, shift, None, count, prior, 0.0, 0.0)
        for level in (*LEVELS, 0.0):
            for _ in range(ITERATIONS):
                found = _solved(seen, shift, found, count, prior, sharpness, level)
        excess += np.einsum("ndi,ndj->nij", found, found) - np.einsum("ndi,ndj->nij", linear, linear)
    return excess / (DRAWS * len(masks))


def _solved(seen: _Seen, shift: np.ndarray, at: np.ndarray | None, count: int, prior: np.ndarray, sharpness: float,
            level: float) -> np.ndarray:
    """(count, draws, 3) solution with the weights that the residuals at `at` have; all walls alike without it."""
    softer = 1.0 / (1.0 + seen.point * (np.maximum(seen.sigma, level) ** 2 - seen.sigma ** 2))
    factor = np.repeat(softer[:, None], shift.shape[1], axis=1)
    if at is not None:
        residual = shift - np.einsum("gi,gdi->gd", seen.row, at[seen.place])
        factor = factor * np.exp(-0.5 * sharpness * (seen.point * softer)[:, None] * residual ** 2)
    walls = csr_matrix((np.ones(len(seen.place)), (seen.place, np.arange(len(seen.place)))), (count, len(seen.place)))
    pulled = factor * shift * seen.weight[:, None]
    parts = np.concatenate([factor[:, :, None] * seen.product[:, None], pulled[:, :, None] * seen.row[:, None]], axis=2)
    sums = (walls @ parts.reshape(len(seen.place), 9 * shift.shape[1])).reshape(count, shift.shape[1], 9)
    h = sums[..., [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(count, shift.shape[1], 3, 3) + prior
    return np.linalg.solve(h, sums[..., 6:, None])[..., 0]
